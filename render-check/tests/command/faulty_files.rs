//! Files with something wrong in them, as the program meets them: what is sound is checked as it is without the rest, and
//! what is not is named.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};

/// A file in the making: a floor with a box on it, under a sun, and whatever else there is to be.
struct File {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    lights: Vec<Value>,
    cameras: Vec<Value>,
}

/// A box with its least and its greatest corner, counter-clockwise seen from outside.
fn cuboid(min: [f32; 3], max: [f32; 3]) -> (Vec<[f32; 3]>, Vec<u32>) {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { max[axis] } else { min[axis] });
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]);
    ((0..8).map(corner).collect(), triangles.collect())
}

impl File {
    fn sound() -> Self {
        let mut file = Self {
            binary: Vec::new(),
            views: Vec::new(),
            accessors: Vec::new(),
            meshes: Vec::new(),
            nodes: Vec::new(),
            lights: vec![json!({"type": "directional"}), json!({"type": "point", "range": 50})],
            cameras: vec![json!({"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.5, "zfar": 40}})],
        };
        let light = |light: usize| json!({"KHR_lights_punctual": {"light": light}});
        file.nodes.push(json!({"camera": 0, "translation": [0, 4, 10], "rotation": [-0.17, 0, 0, 0.985]}));
        file.nodes.push(json!({"extensions": light(0), "rotation": [-0.577, -0.577, 0, 0.423]}));
        file.nodes.push(json!({"extensions": light(1), "translation": [3, 6, 2]}));
        let (positions, indices) = cuboid([-6.0, -1.0, -6.0], [6.0, 0.0, 6.0]);
        file.add_mesh(&positions, &indices, json!({}));
        let (positions, indices) = cuboid([-1.0, -0.5, -1.0], [1.0, 2.0, 1.0]);
        file.add_mesh(&positions, &indices, json!({}));
        file
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>) -> usize {
        let offset = self.binary.len();
        self.binary.extend(bytes);
        self.views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": self.binary.len() - offset}));
        self.views.len() - 1
    }

    /// A mesh and a node that shows it.
    fn add_mesh(&mut self, positions: &[[f32; 3]], indices: &[u32], mut node: Value) {
        let of_positions = self.view(positions.iter().flatten().flat_map(|x| x.to_le_bytes()));
        let of_indices = self.view(indices.iter().flat_map(|i| i.to_le_bytes()));
        let first = self.accessors.len();
        self.accessors.push(json!({"bufferView": of_positions, "componentType": 5126, "count": positions.len(),
            "type": "VEC3", "min": [-9, -9, -9], "max": [9, 9, 9]}));
        self.accessors.push(
            json!({"bufferView": of_indices, "componentType": 5125, "count": indices.len(), "type": "SCALAR"}),
        );
        self.meshes.push(json!({"primitives": [{"attributes": {"POSITION": first}, "indices": first + 1}]}));
        node["mesh"] = json!(self.meshes.len() - 1);
        self.nodes.push(node);
    }

    fn bytes(&self) -> Vec<u8> {
        let json = json!({
            "asset": {"version": "2.0"},
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": self.lights}},
            "buffers": [{"byteLength": self.binary.len()}],
            "bufferViews": self.views, "accessors": self.accessors, "meshes": self.meshes,
            "cameras": self.cameras, "nodes": self.nodes,
            "scenes": [{"nodes": (0..self.nodes.len()).collect::<Vec<_>>()}],
        });
        let mut json = json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let chunk = |kind: &[u8; 4], data: &[u8]| [&(data.len() as u32).to_le_bytes(), &kind[..], data].concat();
        let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &self.binary)].concat();
        let header = [2_u32, 12 + chunks.len() as u32].map(u32::to_le_bytes);
        [b"glTF", header.as_flattened(), &chunks].concat()
    }
}

fn run(name: &str, directory: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_render-check"));
    command.args([name, "--width", "160", "--height", "100", "--size", "256", "--frames", "1"]);
    command.args(["--technique", "uniform", "--technique", "psm", "--technique", "cube"]);
    command.current_dir(directory).output().expect("the program starts")
}

/// Checks a file; what it printed, what it complained of, and its report.
fn checked(file: &File) -> (String, String, Value) {
    let directory = tempfile::tempdir().expect("a temporary directory");
    fs::write(directory.path().join("file.glb"), file.bytes()).expect("written");
    let output = run("file.glb", directory.path());
    let [printed, complaint] =
        [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(output.status.success(), "{complaint}\n{printed}");
    let json = fs::read_to_string(directory.path().join("out/file/check.json")).expect("written");
    assert!(!json.contains("NaN") && !json.contains("inf,"), "{json}");
    (printed, complaint, serde_json::from_str(&json).expect("sound JSON"))
}

fn counts(report: &Value) -> Vec<&Value> {
    report["runs"].as_array().expect("a list").iter().map(|run| &run["counts"]).collect()
}

#[test]
fn the_sound_part_of_a_file_is_checked_as_if_it_were_alone() {
    let (printed, _, sound) = checked(&File::sound());
    assert!(!printed.contains("left out"), "{printed}");
    assert_eq!(counts(&sound).len(), 6, "two lights, three techniques");
    for counts in counts(&sound) {
        let count = |name: &str| counts[name].as_u64().expect("a number");
        assert!(count("compared") > 5000 && count("shadowed") > 200 && count("missing") == 0, "{counts}");
    }

    let mut file = File::sound();
    let (positions, indices) = cuboid([-1.0; 3], [1.0; 3]);
    // A corner that is no place, in five triangles of the box's twelve that meet there or six.
    for (corner, wrong) in [(0, f32::NAN), (3, f32::INFINITY), (6, 1e30)] {
        let mut positions = positions.clone();
        positions[corner][1] = wrong;
        let triangles: Vec<u32> =
            indices.chunks(3).filter(|t| t.contains(&(corner as u32))).flatten().copied().collect();
        file.add_mesh(&positions, &triangles, json!({}));
    }
    // Indices that have no vertex, and triangles without area.
    file.add_mesh(&positions, &[0, 1, 8, 1, 2, u32::MAX, 3, 3, 3, 4, 4, 5], json!({}));
    // Nodes that shrink, that move beyond all that is taken, and that grow beyond it.
    file.add_mesh(&positions, &indices, json!({"scale": [0, 0, 0]}));
    file.add_mesh(&positions, &indices, json!({"translation": [1e38, 0, 0]}));
    file.add_mesh(&positions, &indices, json!({"matrix": [1e25,0,0,0, 0,1e25,0,0, 0,0,1e25,0, 0,0,0,1]}));
    // Nothing at all.
    file.add_mesh(&positions, &[], json!({}));
    file.add_mesh(&[], &[], json!({}));
    file.nodes.push(json!({}));
    file.nodes.push(json!({"translation": [0, 0, 0], "scale": [0, 0, 0]}));
    // A camera that sees nothing and lights that are nowhere; they come first.
    file.cameras.push(json!({"type": "perspective", "perspective": {"yfov": 0.8, "znear": 40, "zfar": 0.5}}));
    file.nodes.insert(0, json!({"camera": 1}));
    file.lights.push(json!({"type": "point", "range": 1e-9}));
    file.lights.push(json!({"type": "point"}));
    for (light, x) in [(2, 1.0), (3, 1e30)] {
        file.nodes.push(json!({"translation": [x, 1, 1], "extensions": {"KHR_lights_punctual": {"light": light}}}));
    }

    let (printed, complaint, faulty) = checked(&file);
    let left_out = &faulty["left_out"];
    let count = |name: &str| left_out[name].as_u64().expect("a number");
    assert_eq!(count("out_of_range"), 2, "{left_out}");
    assert_eq!(count("flat"), 2 + 12, "{left_out}");
    assert!((8..=12).contains(&count("not_finite")), "{left_out}");
    assert!((4..=6).contains(&(count("too_large") - 24)), "{left_out}");
    assert_eq!(count("cameras"), 1, "{left_out}");
    for said in ["left out:", "index beyond the vertices", "not a finite number", "beyond 2^40", "without area"] {
        assert!(printed.contains(said), "no '{said}' in\n{printed}");
    }
    for said in ["point:1,1,1/", "point:1000000"] {
        assert!(complaint.contains(said), "no '{said}' in\n{complaint}");
    }
    assert_eq!(counts(&faulty), counts(&sound));
}

#[test]
fn a_file_with_nothing_sound_in_it_is_told_what_is_wrong() {
    let mut file = File::sound();
    for node in &mut file.nodes {
        node["scale"] = json!([0, 0, 0]);
    }
    let directory = tempfile::tempdir().expect("a temporary directory");
    fs::write(directory.path().join("file.glb"), file.bytes()).expect("written");
    let output = run("file.glb", directory.path());
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && !complaint.contains("panicked"), "{complaint}");
    assert!(complaint.contains("no triangles") && complaint.contains("24 triangle(s) without area"), "{complaint}");
}

/// A solid that a node flattens still has two faces with an area, though its matrix has no inverse.
#[test]
fn a_flattened_solid_is_drawn() {
    let mut file = File::sound();
    let (positions, indices) = cuboid([-1.0; 3], [1.0; 3]);
    file.add_mesh(&positions, &indices, json!({"scale": [1, 0, 1], "translation": [2.5, 1, 2]}));
    let (printed, _, report) = checked(&file);
    assert!(printed.contains("8 triangle(s) without area"), "{printed}");
    for counts in counts(&report) {
        assert_eq!(counts["missing"], 0, "{counts}");
    }
}
