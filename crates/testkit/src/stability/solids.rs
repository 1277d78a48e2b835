//! Bodies where signs are hard to tell: what is lost of H, and what is gained.

use super::Table;
use super::arithmetic::Big;
use super::bodies::{Difference, hull, naive, vertices};
use super::lights::in_f32;
use super::linear::{V4, homogeneous};
use super::measure::figure;
use super::setup::{Lamp, Setup};
use shadowfit::glam::DVec3;
use shadowfit::{Focus, FocusForm, focus::Plane};

/// The absolute epsilon of the naive construction.
const EPSILON: f64 = 1e-6;

const COLUMNS: [&str; 6] = ["naive f32: lost", "beyond", "naive f64: lost", "beyond", "ours: lost", "beyond"];

fn with_columns(first: &'static str) -> Vec<&'static str> {
    [first].into_iter().chain(COLUMNS).collect()
}

/// Adds a line for H in the paper's form: of the very planes that the crate hands out, so that all constructions begin
/// with the same numbers. Distances are parts of the scene's size.
fn compare(table: &mut Table, name: &str, setup: &Setup) {
    let (view, light, scene) = (setup.camera.view(), setup.lamp.light(), setup.scene());
    let exact = |planes: &[Plane]| -> Vec<V4<Big>> { planes.iter().map(|p| homogeneous(p.to_row())).collect() };
    let mut planes = hull(&exact(view.planes().as_slice()), &homogeneous(light.homogeneous()));
    for (axis, normal) in DVec3::AXES.into_iter().enumerate() {
        planes.push(homogeneous(normal.extend(-setup.min[axis])));
        planes.push(homogeneous((-normal).extend(setup.max[axis])));
    }
    planes.extend(exact(light.planes().as_slice()));
    let body = vertices(&planes);
    let size = (setup.max - setup.min).max_element();
    let ours = Focus::new(&view, &light, &scene).caster_volume(FocusForm::ViewHull).vertices().to_vec();
    let bodies = [naive::<f32>(&planes, EPSILON), naive::<f64>(&planes, EPSILON), ours];
    let differences = bodies.map(|other| Difference::new(&body, &planes, &other));
    let cell = |distance: f64| if distance.is_infinite() { "all".into() } else { figure(distance / size) };
    let cells = differences.iter().flat_map(|d| [cell(d.lost), cell(d.gained)]);
    table.lines.push([name.to_string()].into_iter().chain(cells).collect());
    let ours = differences[2];
    table.hold(&format!("{name}: lost"), ours.lost / size, 0.0);
    table.hold(&format!("{name}: beyond"), ours.gained / size, beyond(setup));
}

/// How far beyond the exact body ours may be, as a part of the scene's size: planes stand 48 roundings of their terms
/// outwards, twice for the hull's and once more for the vertices (`oracle::focus` derives it for every plane); where
/// planes meet at an angle α, vertices travel 1/sin α times as far.
fn beyond(setup: &Setup) -> f64 {
    let size = (setup.max - setup.min).max_element();
    let terms = setup.min.abs().max(setup.max.abs()).element_sum() + setup.camera.eye.abs().element_sum();
    let narrowest = (0.5 * setup.camera.fov_y).sin();
    4.0 * 48.0 * f64::EPSILON * terms / size / narrowest
}

fn sun() -> Lamp {
    Lamp::Sun(DVec3::new(in_f32(0.4), 0.75, in_f32(-0.3)))
}

/// Looking down at a ground.
fn over_ground(thickness: f64) -> Setup {
    let mut setup = Setup::outdoors(sun());
    setup.camera.eye = DVec3::new(0.0, 8.0, 0.0);
    setup.camera.forward = DVec3::new(0.0, -0.25, -1.0);
    (setup.min, setup.max) = (DVec3::new(-64.0, -thickness, -64.0), DVec3::new(64.0, 0.0, 64.0));
    setup
}

pub fn flat_scenes() -> Table {
    let heading = "a ground whose thickness goes to 0, in parts of its size";
    let mut table = Table::new(heading, &with_columns("thickness"));
    for k in (1..=16).step_by(3) {
        compare(&mut table, &format!("1e-{k}"), &over_ground(in_f32(10_f64.powi(-k))));
    }
    compare(&mut table, "0", &over_ground(0.0));
    let mut edge_on = over_ground(0.0);
    edge_on.lamp = Lamp::Sun(DVec3::new(1.0, 0.0, 0.0));
    compare(&mut table, "0, edge-on to the light", &edge_on);
    table
}

pub fn planes_that_touch() -> Table {
    let heading = "a box that touches the near plane of V: the gap swept through 0 in steps of f64, and by 10⁻ᵏ";
    let mut table = Table::new(heading, &with_columns("gap"));
    let mut gap = |name: String, near_face: f64| {
        let mut setup = Setup::outdoors(sun());
        // Through the frustum's edge too: 0.75 before the eye at a slope of 0.75.
        (setup.min, setup.max) = (DVec3::new(-0.25, -0.25, near_face), DVec3::new(0.25, 0.25, 0.0));
        compare(&mut table, &name, &setup);
    };
    for steps in -4..=4_i32 {
        let face = -1.0 + f64::from(steps) * 0.5 * f64::EPSILON;
        gap(format!("{steps} steps"), face);
    }
    for k in [15, 12, 9, 7, 6, 3] {
        gap(format!("-1e-{k}"), -1.0 - 10_f64.powi(-k));
        gap(format!("+1e-{k}"), -1.0 + 10_f64.powi(-k));
    }
    table
}

pub fn narrow_views() -> Table {
    let heading = "nearly parallel planes: the field of view, in radians, swept to 0";
    let mut table = Table::new(heading, &with_columns("field of view"));
    for k in 0..=6 {
        let mut setup = Setup::outdoors(sun());
        setup.camera.fov_y = in_f32(10_f64.powi(-k));
        setup.camera.forward = DVec3::new(0.25, -0.125, -1.0);
        (setup.min, setup.max) = (DVec3::splat(-64.0), DVec3::splat(64.0));
        compare(&mut table, &format!("1e-{k}"), &setup);
    }
    table
}

pub fn scales() -> Table {
    let heading = "the same scene at other scales, and far from the origin";
    let mut table = Table::new(heading, &with_columns("scale, offset"));
    let mut at = |name: String, scale: f64, offset: f64| {
        let mut setup = over_ground(0.5);
        setup.camera.eye = setup.camera.eye * scale + offset;
        (setup.camera.near, setup.camera.far) = (setup.camera.near * scale, setup.camera.far * scale);
        (setup.min, setup.max) = (setup.min * scale + offset, setup.max * scale + offset);
        compare(&mut table, &name, &setup);
    };
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        at(format!("{scale:e}, 0"), scale, 0.0);
    }
    for offset in [1e3, 1e5, 1e7] {
        at(format!("1, {offset:e}"), 1.0, offset);
    }
    table
}
