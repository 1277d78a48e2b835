//! Views far from the origin, deep, narrow and wide.

use super::Table;
use super::lights::{compare, in_f32};
use super::measure::figure;
use super::setup::{Lamp, Setup};
use super::textbook::textbook;
use shadowfit::glam::{DMat4, DVec3, DVec4, Mat4, Vec4};
use shadowfit::{ClipSpace, Focus, FocusForm, Origin, Scene, Settings, View, Warp};

const COLUMNS: [&str; 4] = ["textbook f32", "textbook f64", "ours f64", "ours f32 upload"];

fn with_columns(first: &'static str) -> Vec<&'static str> {
    [first].into_iter().chain(COLUMNS).collect()
}

fn sun() -> Lamp {
    Lamp::Sun(DVec3::new(in_f32(0.4), 0.75, in_f32(-0.3)))
}

pub fn far_from_the_origin() -> Table {
    let heading =
        "everything far from the origin, the camera turned: distance swept; ours with the matrix about the eye";
    let mut table = Table::new(heading, &with_columns("distance"));
    for k in 0..=8 {
        let distance = in_f32(10_f64.powi(k));
        let offset = DVec3::new(distance, -distance, distance);
        let mut setup = Setup::outdoors(sun());
        setup.camera.eye += offset;
        setup.camera.forward = DVec3::new(0.25, -0.125, -1.0);
        (setup.min, setup.max) = (setup.min + offset, setup.max + offset);
        setup.origin = Origin::Eye;
        compare(&mut table, &format!("1e{k}"), &setup);
    }
    table
}

pub fn far_planes() -> Table {
    let heading = "near → 0: far/near swept, far = 100";
    let mut table = Table::new(heading, &with_columns("far/near"));
    for k in 1..=9 {
        let mut setup = Setup::outdoors(sun());
        setup.camera.near = in_f32(100.0 / 10_f64.powi(k));
        compare(&mut table, &format!("1e{k}"), &setup);
    }
    table
}

pub fn fields_of_view() -> Table {
    let heading = "fields of view, in degrees";
    let mut table = Table::new(heading, &with_columns("degrees"));
    for degrees in [1e-3_f64, 1e-2, 0.1, 1.0, 10.0, 60.0, 120.0, 170.0, 179.0] {
        let mut setup = Setup::outdoors(sun());
        setup.camera.fov_y = in_f32(degrees.to_radians());
        let width = 400.0 * (1.0 + (0.5 * setup.camera.fov_y).tan());
        (setup.min, setup.max) = (DVec3::splat(-width), DVec3::splat(width));
        compare(&mut table, &format!("{degrees}"), &setup);
    }
    table
}

/// One camera in a convention: its view matrix, its projection, and what the projection means.
fn conventions(near: f64, far: f64) -> Vec<(&'static str, View)> {
    let eye_from_world = DMat4::from_rotation_y(0.7) * DMat4::from_translation(DVec3::new(-1.0, -5.0, 3.0));
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let left_handed = DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let (w, ratio) = (DVec4::NEG_Z, near / far);
    let zero_to_one = DVec4::new(0.0, 0.0, -1.0, -near) / (1.0 - ratio);
    let projection = |y: f64, z: DVec4| DMat4::from_cols(DVec4::X * 1.25, DVec4::Y * (2.0 * y), z, w).transpose();
    let plain = projection(1.0, zero_to_one);
    let symmetric = zero_to_one * 2.0 - w;
    [
        ("0 to 1", eye_from_world, plain, ClipSpace::WGPU),
        ("reversed", eye_from_world, projection(1.0, w - zero_to_one), ClipSpace::WGPU.reversed()),
        ("-1 to 1", eye_from_world, projection(1.0, symmetric), ClipSpace::OPENGL),
        ("-1 to 1, reversed", eye_from_world, projection(1.0, -symmetric), ClipSpace::OPENGL.reversed()),
        ("y down", eye_from_world, projection(-1.0, zero_to_one), ClipSpace::VULKAN),
        ("mirrored", mirror * eye_from_world, plain, ClipSpace::WGPU),
        ("left-handed", left_handed * eye_from_world, plain * left_handed, ClipSpace::WGPU),
    ]
    .map(|(name, view, projection, clip)| (name, View::from_matrices(view, projection, clip).expect("a camera")))
    .to_vec()
}

pub fn one_camera_in_every_convention() -> Table {
    let heading = "one camera in every convention: how far the depth range, H, and the map are from those of the first, in \
                   parts of the far distance, of the scene, and of the clip volume";
    let mut table = Table::new(heading, &["far", "convention", "depth range", "H", "map"]);
    let scene = Scene::from_box((-30.0, 0.0, -30.0), (30.0, 10.0, 30.0)).expect("a legal scene");
    let light = sun().light();
    for far in [80.0, 50_000.0, f64::INFINITY] {
        let near = 0.3;
        let all = conventions(near, far);
        let first = Focus::new(&all[0].1, &light, &scene);
        let settings = Settings::default().with_warp(Warp::Perspective);
        let map = |focus: &Focus<'_>| focus.fit(&settings).into_map().expect("one map does");
        for (name, view) in &all {
            let focus = Focus::new(view, &light, &scene);
            let of_far = if far.is_finite() { (view.far() / all[0].1.far() - 1.0).abs() } else { 0.0 };
            let range = ((view.near() / near - 1.0).abs()).max(of_far);
            let [(min, max), (first_min, first_max)] = [&focus, &first]
                .map(|focus| focus.caster_volume(FocusForm::ViewHull).bounds().expect("something is in view"));
            let off = (min - first_min).abs().max((max - first_max).abs()).max_element() / 60.0;
            let [ours, theirs] = [map(&focus), map(&first)].map(|map| map.clip_from_world_in(ClipSpace::WGPU));
            let visible = first.receiver_volume();
            let apart = visible.vertices().iter().map(|&p| {
                let places = [ours, theirs].map(|matrix| matrix.project_point3(p));
                // A mirrored image may be mirrored in the map.
                let [a, b] = places.map(|place| DVec3::new(place.x.abs(), place.y, place.z));
                ((a - b) * DVec3::new(0.5, 0.5, 1.0)).abs().max_element()
            });
            let apart = apart.fold(0.0, f64::max);
            let cells = [figure(range), figure(off), figure(apart)];
            let line = [format!("{far}"), (*name).to_string()].into_iter().chain(cells).collect();
            table.lines.push(line);
            // What a matrix keeps of the far distance is 1 − n/f.
            let kept = 16.0 * f64::EPSILON * if far.is_finite() { far / near } else { 1.0 };
            table.hold(&format!("{name}, {far}: depth range"), range, kept);
            // Where it bounds H, the far plane moves it by as much as itself.
            let moved = 64.0 * f64::EPSILON + if far < 100.0 { 2.0 * kept } else { 0.0 };
            table.hold(&format!("{name}, {far}: H"), off, moved);
        }
    }
    table
}

pub fn positions_in_f32() -> Table {
    let heading = "all in f32, matrix and positions, as a vertex shader has it: the world's distance from the origin swept; \
                   of the corners of what is visible, how many fall out of the clip volume";
    let columns = ["distance", "textbook", "beyond by", "ours", "beyond by", "ours about the eye", "beyond by"];
    let mut table = Table::new(heading, &columns);
    for k in 0..=7 {
        let mut setup = Setup::outdoors(sun());
        let distance = in_f32(10_f64.powi(k));
        let offset = DVec3::new(distance, -distance, distance);
        setup.camera.eye += offset;
        setup.camera.forward = DVec3::new(0.25, -0.125, -1.0);
        (setup.min, setup.max) = (setup.min + offset, setup.max + offset);
        let of_textbook = textbook::<f32>(&setup).map(Vec4::from);
        let textbook = Mat4::from_cols(of_textbook[0], of_textbook[1], of_textbook[2], of_textbook[3]).transpose();
        let corners = setup.visible();
        let mut line = vec![format!("1e{k}")];
        for (index, origin) in [None, Some(Origin::World), Some(Origin::Eye)].into_iter().enumerate() {
            let (matrix, about) = match origin {
                None => (textbook, DVec3::ZERO),
                Some(origin) => {
                    let setup = Setup { origin, ..setup };
                    let about = if origin == Origin::Eye { setup.camera.eye } else { DVec3::ZERO };
                    (setup.map().caster_matrix(), about)
                }
            };
            let beyond = corners.iter().map(|&p| {
                let [x, y, z, w] = (matrix * (p - about).as_vec3().extend(1.0)).to_array().map(f64::from);
                let off = (x.abs() - w).max(y.abs() - w).max(-z).max(z - w) / w;
                if w > 0.0 { off } else { f64::INFINITY }
            });
            let (count, most) =
                beyond.fold((0, 0.0_f64), |(count, most), off| (count + usize::from(off > 0.0), most.max(off)));
            line.extend([format!("{count} of {}", corners.len()), figure(most)]);
            if index > 0 {
                table.hold(&format!("1e{k}, {origin:?}"), most, 0.0);
            }
        }
        table.lines.push(line);
    }
    table
}
