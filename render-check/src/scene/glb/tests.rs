use super::*;
use shadowfit::glam::Vec4;

/// Packs a description and its data as a `.glb` file.
fn pack(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let mut file = b"glTF".to_vec();
    file.extend([2, length as u32, json.len() as u32].iter().flat_map(|n| n.to_le_bytes()));
    file.extend(b"JSON");
    file.extend(json);
    file.extend((binary.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(binary);
    file
}

/// A right triangle in the plane z = 0 with 16-bit indices, a degenerate triangle after it.
fn triangle_data() -> Vec<u8> {
    let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let indices = [0_u16, 1, 2, 0, 0, 1];
    let positions = positions.iter().flatten().flat_map(|x| x.to_le_bytes());
    positions.chain(indices.iter().flat_map(|i| i.to_le_bytes())).collect()
}

const MESH: &str = r#"
    "buffers": [{"byteLength": 48}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
        {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 1]}}],
    "meshes": [{"primitives": [
        {"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
        {"attributes": {"POSITION": 0}, "mode": 0}]}]"#;

/// Two instances of one mesh, one of them two nodes deep under a matrix, a camera and three lights.
fn whole_scene() -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 3, 4, 5, 6]}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {{"KHR_lights_punctual": {{"lights": [
            {{"type": "directional"}},
            {{"type": "point", "range": 7}},
            {{"type": "spot", "spot": {{"outerConeAngle": 0.5}}}}]}}}},
        "cameras": [
            {{"type": "perspective", "perspective": {{"yfov": 0.75, "znear": 0.125}}}},
            {{"type": "orthographic", "orthographic": {{"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}}}],
        "nodes": [
            {{"mesh": 0, "translation": [10, 0, 0], "children": [1]}},
            {{"matrix": [2,0,0,0, 0,2,0,0, 0,0,2,0, 0,5,0,1], "children": [2]}},
            {{"mesh": 0, "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476]}},
            {{"camera": 0, "translation": [1, 2, 3],
              "children": [7]}},
            {{"rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476],
              "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}},
            {{"translation": [0, 4, 0], "extensions": {{"KHR_lights_punctual": {{"light": 1}}}}}},
            {{"translation": [0, 0, 9], "extensions": {{"KHR_lights_punctual": {{"light": 2}}}}}},
            {{"camera": 1}}],
        {MESH}}}"#
    )
}

/// A scene whose only node shows the mesh, with one thing in the JSON replaced by another.
fn with_replaced(what: &str, by: &str) -> Result<LoadedScene> {
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], {MESH}}}"#
    );
    assert!(json.contains(what), "{what}");
    parse(&pack(&json.replacen(what, by, 1), &triangle_data()), "test".into())
}

fn complaint(what: &str, by: &str) -> String {
    format!("{:#}", with_replaced(what, by).expect_err(by))
}

#[test]
fn instances_and_nested_nodes_stand_where_their_nodes_put_them() {
    let scene = parse(&pack(&whole_scene(), &triangle_data()), "test".into()).expect("a sound file");
    assert_eq!(scene.mesh.triangles.len(), 2);
    assert_eq!(scene.mesh.colours, [[0.5, 0.25, 1.0]; 2]);
    assert_eq!(scene.mesh.corners(0), [(10.0, 0.0, 0.0), (11.0, 0.0, 0.0), (10.0, 1.0, 0.0)].map(DVec3::from));
    // A quarter turn about y takes x to −z; then twice as large, five up and ten along x.
    let expected = [(10.0, 5.0, 0.0), (10.0, 5.0, -2.0), (10.0, 7.0, 0.0)].map(DVec3::from);
    for (corner, expected) in scene.mesh.corners(1).into_iter().zip(expected) {
        assert!(corner.distance(expected) < 1e-6, "{corner} should be {expected}");
    }
}

#[test]
fn what_is_left_out_is_counted() {
    let scene = parse(&pack(&whole_scene(), &triangle_data()), "test".into()).expect("a sound file");
    let left_out = scene.left_out;
    assert_eq!((left_out.flat, left_out.points, left_out.cameras), (2, 6, 1));
    assert_eq!((left_out.not_finite, left_out.lights), (0, 0));
}

#[test]
fn the_camera_and_the_lights_come_along() {
    let scene = parse(&pack(&whole_scene(), &triangle_data()), "test".into()).expect("a sound file");
    let camera = scene.camera.expect("a perspective camera");
    assert_eq!((camera.eye, camera.forward, camera.up), (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Z, DVec3::Y));
    assert_eq!((camera.fov_y, camera.near, camera.far), (0.75, Some(0.125), Some(f64::INFINITY)));
    let [sun, point, spot] = scene.lights[..] else { panic!("three lights, not {:?}", scene.lights) };
    // Turned by −90 degrees about x, a light shines down: the sun is straight above.
    let LightSpec::Sun { direction_to_light } = sun else { panic!("a sun, not {sun}") };
    assert!(direction_to_light.distance(DVec3::Y) < 1e-6, "{direction_to_light}");
    assert_eq!(point, LightSpec::Point { position: DVec3::new(0.0, 4.0, 0.0), range: 7.0 });
    let LightSpec::Spot { position, target, cone_degrees, range } = spot else { panic!("a spot, not {spot}") };
    assert_eq!((position, target), (DVec3::new(0.0, 0.0, 9.0), DVec3::new(0.0, 0.0, 8.0)));
    assert!((cone_degrees - 1.0_f64.to_degrees()).abs() < 1e-6 && range.is_infinite());
}

#[test]
fn a_description_that_lies_about_its_data_is_refused_with_the_reason() {
    assert!(complaint(r#""count": 3"#, r#""count": 4"#).contains("reach beyond the file's data"));
    assert!(complaint(r#""count": 6"#, r#""count": 7"#).contains("reach beyond the file's data"));
    assert!(complaint(r#""byteLength": 36}"#, r#""byteLength": 36, "byteStride": 8}"#).contains("8 bytes apart"));
    assert!(complaint(r#""byteLength": 36}"#, r#""byteLength": 9000000000000000000}"#).contains("reach beyond"));
    assert!(complaint(r#""POSITION": 0"#, r#""NORMAL": 0"#).contains("POSITION"));
    assert!(complaint(r#""byteLength": 48}"#, r#""byteLength": 48, "uri": "a.bin"}"#).contains("another file"));
    assert!(complaint(r#""POSITION": 0"#, r#""POSITION": 9"#).contains("POSITION"));
    assert!(complaint(r#"{"bufferView": 1, "#, "{").contains("bufferView"));
    assert!(complaint(r#""componentType": 5123"#, r#""componentType": 5126"#).contains("not unsigned integers"));
    assert!(complaint(r#""nodes": [0]"#, r#""nodes": [5]"#).contains("breaks the rules"));
    assert!(complaint(r#""version""#, r#""ver"#).contains("description is broken"));
}

#[test]
fn a_triangle_with_an_index_beyond_the_vertices_is_left_out() {
    let mut data = triangle_data();
    data[46] = 9;
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}], {MESH}}}"#
    );
    let scene = parse(&pack(&json, &data), "test".into()).expect("one triangle is sound");
    assert_eq!(scene.mesh.triangles, [[0, 1, 2]]);
    assert_eq!((scene.left_out.out_of_range, scene.left_out.flat), (1, 0));
}

#[test]
fn nodes_in_a_circle_are_refused() {
    let error = complaint(r#"[{"mesh": 0}]"#, r#"[{"children": [1]}, {"children": [0]}]"#);
    assert!(error.contains("not a tree"), "{error}");
}

#[test]
fn a_file_without_a_scene_shows_all_its_nodes_once() {
    let scene = with_replaced(
        r#""scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}]"#,
        r#""nodes": [{"mesh": 0}, {"children": [0], "translation": [0, 0, 3]}]"#,
    );
    let (min, _) = scene.expect("a sound file").mesh.bounds();
    assert_eq!(min, DVec3::new(0.0, 0.0, 3.0));
}

#[test]
fn a_camera_that_is_not_what_it_says_does_no_harm() {
    let scene = with_replaced(
        r#""nodes": [{"mesh": 0}]"#,
        r#""nodes": [{"mesh": 0, "camera": 0}],
           "cameras": [{"type": "perspective", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}]"#,
    );
    assert_eq!(scene.expect("the triangles are sound").left_out.cameras, 1);
}

#[test]
fn a_file_with_any_byte_changed_or_cut_off_anywhere_never_panics() {
    let file = pack(&whole_scene(), &triangle_data());
    for i in 0..file.len() {
        // Either outcome will do: many changes are harmless, the others are errors.
        drop(parse(&file[..i], "cut".into()));
        for byte in [0, b'-', b'9', b']', 0x7f, 0xff] {
            let mut changed = file.clone();
            changed[i] = byte;
            drop(parse(&changed, "changed".into()));
        }
    }
}

#[test]
fn rotations_of_no_length_are_no_rotation() {
    let scene =
        with_replaced(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "rotation": [0, 0, 0, 0]}]"#).expect("a sound file");
    assert_eq!(scene.mesh.corners(0)[1], DVec3::X);
    assert_eq!(scene.mesh.normals[0].extend(0.0), Vec4::ZERO, "no normals in the file: a flat look");
}
