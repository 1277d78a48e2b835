//! The program as its users meet it: what it prints, what it leaves behind, and what it says when it cannot.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str], directory: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_render-check"));
    command.args(arguments).current_dir(directory).output().expect("the program starts")
}

/// Pictures as small as they may be: these tests are about everything but what they show.
const SMALL: [&str; 6] = ["--width", "32", "--height", "20", "--size", "16"];

fn run_small(arguments: &[&str], directory: &Path) -> Output {
    run(&[arguments, &SMALL[..]].concat(), directory)
}

fn complaint(output: &Output) -> String {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success(), "it should fail: {message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

/// Runs a command that cannot work; checks that it says so in one line, and returns the line.
fn one_line_complaint(arguments: &[&str], directory: &Path) -> String {
    let message = complaint(&run_small(arguments, directory));
    assert!(message.starts_with("error: ") && message.trim_end().lines().count() == 1, "{message}");
    message
}

fn temporary() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary directory")
}

/// The header and an empty description.
fn glb(json: &str) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let words = [2, 20 + json.len() as u32, json.len() as u32].map(u32::to_le_bytes);
    [b"glTF", words.as_flattened(), b"JSON", &json].concat()
}

#[test]
fn without_arguments_it_checks_a_chess_board_under_three_lights() {
    let directory = temporary();
    let output = run_small(&[], directory.path());
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for expected in
        ["chess-board", "sun:", "point:", "spot:", "infinity plane", "psm-unshifted 16", "missing", "µs"]
    {
        assert!(printed.contains(expected), "no '{expected}' in\n{printed}");
    }
    let out = directory.path().join("out/chess-board");
    for light in ["1-sun", "2-point", "3-spot"] {
        assert!(out.join(format!("{light}-truth.png")).exists());
        for picture in ["image", "faults", "map", "aliasing"] {
            let path = out.join(format!("{light}-psm-16-{picture}.png"));
            let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(bytes.starts_with(b"\x89PNG"), "{}", path.display());
        }
    }
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("check.json")).expect("written")).expect("sound JSON");
    let runs = report["runs"].as_array().expect("a list");
    assert_eq!(runs.len(), 9, "three lights, three techniques");
    for run in runs {
        assert_eq!(run["counts"]["missing"], 0, "{run}");
        assert_eq!((&run["map_size"], &run["filter"]), (&16.into(), &"nearest".into()));
        assert!(run["counts"]["compared"].as_u64().expect("a number") > 100, "{run}");
    }
}

#[test]
fn maps_are_as_the_command_line_asks() {
    let directory = temporary();
    let arguments =
        "--light sun:1,1,0 --technique psm --size 32 --filter pcf3 --clip opengl-reversed --format float32";
    let output = run_small(&arguments.split(' ').collect::<Vec<_>>(), directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = directory.path().join("out/chess-board/check.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
    let sizes: Vec<_> = report["runs"].as_array().expect("a list").iter().map(|run| &run["map_size"]).collect();
    assert_eq!(sizes, [32, 16], "--size adds up");
    let run = &report["runs"][0];
    assert_eq!((&run["filter"], &run["clip"]), (&"pcf3".into(), &"opengl-reversed".into()));
    assert_eq!(run["maps"][0]["pass"]["format"], "float32");
}

#[test]
fn a_walk_tells_what_flickers() {
    let directory = temporary();
    let output = run_small(&["walk", "--steps", "2", "--light", "sun:1,1,0"], directory.path());
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(printed.contains("change in a step"), "{printed}");
    let path = directory.path().join("out/chess-board/walk.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
    assert_eq!(report[0]["steps"].as_array().map(Vec::len), Some(2));
}

#[test]
fn nothing_flickers_where_the_camera_stands_still() {
    let directory = temporary();
    let still = ["walk", "--steps", "1", "--pace", "1e-9", "--turn", "0", "--width", "160", "--height", "100"];
    let output = run(&[&still[..], &["--size", "256"]].concat(), directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = directory.path().join("out/chess-board/walk.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
    for map in report.as_array().expect("a list") {
        let step = &map["steps"][0];
        let [changed, compared] = ["changed", "compared"].map(|name| step[name].as_u64().expect("a number"));
        // All is rounded about another eye, which may move a pixel or two over an edge.
        assert!(compared > 1000 && changed * 1000 <= compared, "{map}");
    }
}

#[test]
fn a_sweep_that_knows_no_such_group_names_those_it_knows() {
    let directory = temporary();
    let message = complaint(&run(&["sweep", "nonsense"], directory.path()));
    assert!(message.contains("classes-of-suns") && message.contains("scales"), "{message}");
}

#[test]
fn without_a_graphics_adapter_it_says_what_to_install() {
    let directory = temporary();
    let mut command = Command::new(env!("CARGO_BIN_EXE_render-check"));
    // The loader's own ways to be told where the drivers are, old and new.
    command.env("VK_DRIVER_FILES", "/nowhere.json").env("VK_ICD_FILENAMES", "/nowhere.json");
    let output = command.env("WGPU_BACKEND", "vulkan").current_dir(directory.path()).output().expect("it starts");
    let message = complaint(&output);
    assert!(message.contains("mesa-vulkan-drivers") && message.contains("render-check draw"), "{message}");
}

#[test]
fn a_drawing_needs_no_graphics_adapter() {
    let directory = temporary();
    let mut command = Command::new(env!("CARGO_BIN_EXE_render-check"));
    command.env("VK_DRIVER_FILES", "/nowhere.json").env("VK_ICD_FILENAMES", "/nowhere.json");
    let output = command.arg("draw").args(SMALL).current_dir(directory.path()).output().expect("it starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8_lossy(&output.stdout);
    for expected in ["chess-board", "sun:", "point:", "spot:", "infinity plane", "PSM", "aliasing", "µs"] {
        assert!(printed.contains(expected), "no '{expected}' in\n{printed}");
    }
    for light in ["1-sun", "2-point", "3-spot"] {
        for picture in ["camera", "light", "maps"] {
            let path = directory.path().join(format!("out/chess-board/{light}-{picture}.png"));
            let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert!(bytes.starts_with(b"\x89PNG"), "{}", path.display());
        }
    }
}

#[test]
fn lights_and_directory_are_taken_from_the_command_line() {
    let directory = temporary();
    let output = run_small(&["draw", "--light", "sun:0,1,0", "--out", "here/and there"], directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut names: Vec<_> = fs::read_dir(directory.path().join("here/and there"))
        .expect("the directory was made")
        .map(|entry| entry.expect("readable").file_name().into_string().expect("plain names"))
        .collect();
    names.sort();
    assert_eq!(names, ["1-sun-camera.png", "1-sun-light.png", "1-sun-maps.png"]);
}

#[test]
fn a_lamp_among_what_it_lights_is_told_which_maps_serve() {
    let directory = temporary();
    let output = run_small(&["--light", "point:0,0.8,-8"], directory.path());
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(printed.contains("psm 16: no map") && printed.contains("paraboloid"), "{printed}");

    let output = run_small(&["draw", "--light", "point:0,0.8,-8"], directory.path());
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.contains("light 1: no map") && printed.contains("paraboloid"), "{printed}");
    assert!(directory.path().join("out/chess-board/1-point-camera.png").exists());
    assert!(!directory.path().join("out/chess-board/1-point-maps.png").exists());
}

#[test]
fn an_endless_far_plane_is_fine() {
    let directory = temporary();
    let output = run_small(&["--far", "inf", "--light", "sun:0,1,0.2"], directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn files_that_cannot_be_used_are_named_with_the_reason() {
    let directory = temporary();
    let write = |name: &str, bytes: &[u8]| fs::write(directory.path().join(name), bytes).expect("written");
    assert!(one_line_complaint(&["missing.glb"], directory.path()).contains("'missing.glb'"));

    write("text.glb", b"this is not a scene");
    assert!(one_line_complaint(&["text.glb"], directory.path()).contains("export it as .glb"));

    let whole = glb(r#"{"asset": {"version": "2.0"}}"#);
    write("cut.glb", &whole[..whole.len() - 8]);
    assert!(one_line_complaint(&["cut.glb"], directory.path()).contains("fetch or export it again"));

    write("broken.glb", &glb("{]"));
    assert!(one_line_complaint(&["broken.glb"], directory.path()).contains("description is broken"));

    write("empty.glb", &whole);
    assert!(one_line_complaint(&["empty.glb"], directory.path()).contains("'empty' has no triangles"));
}

#[test]
fn cameras_that_see_nothing_are_told_where_to_look() {
    let directory = temporary();
    let away = one_line_complaint(&["--eye", "0,2,3", "--target", "0,2,9"], directory.path());
    assert!(away.contains("nothing is in view") && away.contains("--target"), "{away}");
    let nowhere = one_line_complaint(&["--eye", "0,2,3", "--target", "0,2,3"], directory.path());
    assert!(nowhere.contains("--eye"), "{nowhere}");
    let backwards = one_line_complaint(&["--near", "9", "--far", "5"], directory.path());
    assert!(backwards.contains("camera cannot be used"), "{backwards}");
}

#[test]
fn a_directory_that_cannot_be_made_is_named() {
    let directory = temporary();
    fs::write(directory.path().join("file"), b"in the way").expect("written");
    let message = one_line_complaint(&["--out", "file/pictures"], directory.path());
    assert!(message.contains("'file/pictures'") && message.contains("--out"), "{message}");
}

#[test]
fn a_wrong_light_is_shown_the_right_spelling() {
    let directory = temporary();
    let message = complaint(&run(&["--light", "spot:1,2,3"], directory.path()));
    assert!(message.contains("--light") && message.contains("spot:X,Y,Z/TX,TY,TZ/DEGREES"), "{message}");
    let message = complaint(&run(&["--light", "point:1,2,3/0.0001"], directory.path()));
    assert!(message.contains("point:1,2,3/0.0001"), "{message}");
}
