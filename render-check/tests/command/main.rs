//! The program as its users meet it: what it prints, what it leaves behind, and what it says when it cannot.

mod faulty_files;

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
        ["chess-board", "sun:", "point:", "spot:", "infinity plane", "light-space 16", "best 16", "missing", "µs"]
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
    assert_eq!(runs.len(), 12, "three lights, four techniques");
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
    let still = ["walk", "--steps", "6", "--pace", "1e-9", "--turn", "0", "--width", "160", "--height", "100"];
    let output = run(&[&still[..], &["--size", "256"]].concat(), directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = directory.path().join("out/chess-board/walk.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
    for map in report.as_array().expect("a list") {
        // A search that goes on where that of the step before ended may find some more, and comes to an end.
        let first = if map["warm"] == true { 4 } else { 0 };
        for step in &map["steps"].as_array().expect("a list")[first..] {
            let [changed, compared] = ["changed", "compared"].map(|name| step[name].as_u64().expect("a number"));
            // All is rounded about another eye, which may move a pixel or two over an edge.
            assert!(compared > 1000 && changed * 1000 <= compared, "{map}");
        }
    }
}

/// Lights that stand still, and a camera that moves, that turns, and that does both: what is seen at one place of the world
/// keeps its shadow, and so should the map. A stable one changes it where f32 rounds a point about another eye to another
/// texel, which is a pixel here and there, and, in cascades, where the point passes to another map; a uniform one along all
/// edges of shadows.
#[test]
fn a_stable_map_does_not_flicker() {
    let directory = temporary();
    let walk = "walk --steps 6 --technique uniform --technique stable --light sun:-0.8,0.6,0.2 \
                --light spot:6,6,-1/0,0,-5/50 --width 240 --height 150 --size 512";
    for way in ["", "--turn 0", "--pace 1e-9", "--cascades 3"] {
        let line = format!("{walk} {way}");
        let output = run(&line.split_whitespace().collect::<Vec<_>>(), directory.path());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let path = directory.path().join("out/chess-board/walk.json");
        let report: serde_json::Value =
            serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
        let changed = |map: &serde_json::Value| -> u64 {
            let count = |step: &serde_json::Value, name: &str| step[name].as_u64().expect("a map");
            let steps = map["steps"].as_array().expect("a list").iter();
            steps.map(|step| count(step, "changed") - count(step, "over_a_cut")).sum()
        };
        for light in [0, 2] {
            let [uniform, stable] = [&report[light], &report[light + 1]];
            assert_eq!((&uniform["technique"], &stable["technique"]), (&"uniform".into(), &"stable".into()));
            let [uniform, stable] = [uniform, stable].map(changed);
            assert!(uniform > 200 && 50 * stable < uniform, "{way}: {uniform} and {stable}");
        }
    }
}

/// Found from the map of the step before, the best map stays where it is, and flickers no more than one that is found anew.
#[test]
fn a_best_map_on_the_way_stays_what_it_is() {
    let directory = temporary();
    let arguments = "walk --steps 6 --technique best --light sun:-0.8,0.6,0.2 --width 240 --height 150 --size 512";
    let output = run(&arguments.split(' ').collect::<Vec<_>>(), directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("best 512, warm"));
    let path = directory.path().join("out/chess-board/walk.json");
    let report: serde_json::Value = serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
    let [cold, warm] = [0, 1].map(|i| &report[i]);
    assert_eq!((&cold["warm"], &warm["warm"], &warm["jumps"]), (&false.into(), &true.into(), &0.into()));
    let changed = |map: &serde_json::Value| -> u64 {
        map["steps"].as_array().expect("a list").iter().filter_map(|step| step["changed"].as_u64()).sum()
    };
    // Of n pixels that change by chance √n more or fewer would be no surprise.
    let [cold, warm] = [cold, warm].map(changed);
    assert!(cold > 100 && warm as f64 <= cold as f64 + 3.0 * (cold as f64).sqrt(), "{cold} cold, {warm} warm");
}

#[test]
fn a_close_up_shows_the_truth_and_every_map() {
    let directory = temporary();
    let output = run_small(&["--light", "sun:1,1,0", "--close-up", "16,10,12"], directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let image = image::open(directory.path().join("out/chess-board/1-sun-close-up.png")).expect("a picture");
    // Of 12 pixels, 20 times as large; five of them, and a line of two pixels between.
    assert_eq!((image.width(), image.height()), (5 * 240 + 4 * 2, 240));
}

#[test]
fn cascades_are_drawn_as_the_command_line_asks() {
    let directory = temporary();
    let arguments =
        "--light sun:1,1,0 --technique uniform --technique stable --cascades 1 --cascades 3 --split practical:0.5";
    let output = run_small(&arguments.split(' ').collect::<Vec<_>>(), directory.path());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).contains("stable 3 x 16"));
    let out = directory.path().join("out/chess-board");
    let image = image::open(out.join("1-sun-uniform-3x16-cascades.png")).expect("a picture");
    assert_eq!((image.width(), image.height()), (2 * 32 + 2, 20));
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("check.json")).expect("written")).expect("sound JSON");
    let counts: Vec<_> =
        report["runs"].as_array().expect("a list").iter().map(|run| &run["cascading"]["count"]).collect();
    assert_eq!(counts, [1, 1, 3, 3]);
    let run = &report["runs"][2];
    assert_eq!((&run["cascading"]["split"], &run["texels"]), (&"practical:0.5".into(), &(3 * 256).into()));
    assert!(
        run["limit"].as_f64() < run["predicted"].as_f64()
            && run["predicted"].as_f64() <= run["predicted_at_most"].as_f64()
    );
    let ends = |map: usize| &run["maps"][map]["depths"];
    assert!((0..2).all(|map| ends(map)[1] == ends(map + 1)[0] && ends(map)[1].is_f64()), "{run}");

    let endless = ["--technique", "stable", "--cascades", "2", "--far", "inf", "--light", "sun:0,1,0.2"];
    assert!(complaint(&run_small(&endless, directory.path())).contains("--far"));
}

#[test]
fn a_plan_has_the_warp_that_is_asked_for() {
    let directory = temporary();
    for warp in ["psm", "best", "stable"] {
        let arguments = ["plan", "street", "--light", "sun:0.62,0.72,-0.42", "--near", "2", "--warp", warp];
        let output =
            run(&[&arguments[..], &["--width", "64", "--height", "40", "--size", "64"]].concat(), directory.path());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let path = directory.path().join("out/street/plan.json");
        let report: serde_json::Value =
            serde_json::from_slice(&fs::read(path).expect("written")).expect("sound JSON");
        let expected = if warp == "stable" { "uniform" } else { "warped" };
        assert_eq!(report["lights"][0]["kind"], expected, "{warp}: {}", report["lights"][0]["reasons"]);
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
    for expected in ["chess-board", "sun:", "point:", "spot:", "infinity plane", "light-space", "aliasing", "µs"] {
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
