//! Lights at the edges of their classes, and casters at the camera plane.

use super::Table;
use super::arithmetic::{Big, Real};
use super::linear::{M4, dot, exactly, point, rows_of, vector};
use super::measure::{Comparison, Errors, Ours, figure};
use super::setup::{Lamp, Setup};
use super::textbook::{is_beside_the_cube, textbook};
use shadowfit::glam::DVec3;
use shadowfit::{ClipSpace, ShadowMap};

/// A number that f32 holds.
pub fn in_f32(value: f64) -> f64 {
    f64::from(value as f32)
}

const COLUMNS: [&str; 4] = ["textbook f32", "textbook f64", "ours f64", "ours f32 upload"];

/// Adds a line of the four errors.
pub fn compare(table: &mut Table, name: &str, setup: &Setup) {
    let Comparison { textbook, ours: Ours { errors: ours, bounds }, points } = Comparison::new(setup);
    let cell = |errors: &Errors| {
        let mut text = figure(errors.most);
        if errors.most.is_nan() {
            return text;
        }
        if errors.wrapped > 0 {
            text += &format!(", {} of {points} wrapped", errors.wrapped);
        } else if errors.disorder > 0 {
            text += &format!(", {} out of order", errors.disorder);
        }
        text
    };
    let line = textbook.iter().chain(&ours).map(cell);
    table.lines.push([name.to_string()].into_iter().chain(line).collect());
    for ((what, errors), bound) in [("f64", ours[0]), ("f32", ours[1])].into_iter().zip(bounds) {
        table.hold(&format!("{name}, {what}"), errors.most, bound);
        table.hold(
            &format!("{name}, {what}: wrapped or out of order"),
            (errors.wrapped + errors.disorder) as f64,
            0.0,
        );
    }
}

fn with_columns(first: &'static str) -> Vec<&'static str> {
    [first].into_iter().chain(COLUMNS).collect()
}

/// ±10⁻ᵏ, ± some of the smallest steps of f32, and ±0.
pub fn through_zero() -> Vec<(String, f64)> {
    let mut values = Vec::new();
    for sign in [1.0, -1.0] {
        let name = if sign > 0.0 { '+' } else { '-' };
        values.extend((1..=16).map(|k| (format!("{name}1e-{k}"), in_f32(sign * 10_f64.powi(-k)))));
        for steps in [4_u32, 1] {
            let step = f64::from(f32::from_bits(steps));
            values.push((format!("{name}{steps} steps of f32"), sign * step));
        }
        values.push((format!("{name}0"), sign * 0.0));
    }
    values
}

pub fn through_the_camera_plane() -> Table {
    let heading = "a sun through the image plane: λw swept through 0";
    let mut table = Table::new(heading, &with_columns("λw"));
    for (name, w) in through_zero() {
        let sun = Lamp::Sun(DVec3::new(in_f32(0.6), in_f32(0.8), -w));
        compare(&mut table, &name, &Setup::outdoors(sun));
    }
    table
}

pub fn lamp_through_the_camera_plane() -> Table {
    let heading = "a lamp through the camera plane, 50 units from the eye: depth before the eye swept through 0";
    let mut table = Table::new(heading, &with_columns("depth"));
    for (name, depth) in through_zero() {
        let lamp = Lamp::At(DVec3::new(30.0, 40.0, -depth));
        compare(&mut table, &name, &Setup::outdoors(lamp));
    }
    table
}

pub fn on_the_infinity_plane() -> Table {
    let heading = "a sun before the viewer, less than half a field of view off the view axis; far/near swept";
    let mut table = Table::new(heading, &with_columns("far/near"));
    for k in 1..=6 {
        let mut setup = Setup::outdoors(Lamp::Sun(DVec3::new(in_f32(0.1), in_f32(0.2), -1.0)));
        setup.camera.near = 1.0 / 16.0;
        setup.camera.far = setup.camera.near * 10_f64.powi(k);
        (setup.min, setup.max) = (DVec3::splat(-4.0 * setup.camera.far), DVec3::splat(4.0 * setup.camera.far));
        assert!(is_beside_the_cube(&setup));
        compare(&mut table, &format!("1e{k}"), &setup);
    }
    table
}

pub fn along_the_view() -> Table {
    let heading = "a sun along the view: sine of the angle between them swept to 0";
    let mut table = Table::new(heading, &with_columns("sine"));
    for k in (1..=16).step_by(3) {
        for (name, towards) in [("behind", 1.0), ("ahead", -1.0)] {
            let sun = DVec3::new(0.0, in_f32(10_f64.powi(-k)), towards);
            compare(&mut table, &format!("{name}, 1e-{k}"), &Setup::outdoors(Lamp::Sun(sun)));
        }
    }
    table
}

pub fn caster_through_the_camera_plane() -> Table {
    let heading = "a caster between the sun and a receiver: its depth before the eye swept through 0; measured: its depth \
                   in the map, 0 to 1, growing away from the light";
    let columns = ["eye depth", "textbook f32", "textbook f64", "ours f64", "ours f32 upload"];
    let mut table = Table::new(heading, &columns);
    // Light from behind the viewer and above.
    let setup = Setup::outdoors(Lamp::Sun(DVec3::new(0.0, 1.0, 1.0)));
    let map = setup.map();
    let inverted = setup.lambda_w() < 0.0;
    let matrices: [M4<Big>; 4] = [
        exactly(&textbook::<f32>(&setup)),
        exactly(&textbook::<f64>(&setup)),
        exactly(&rows_of(&map.clip_from_world_in(ClipSpace::WGPU))),
        exactly(&rows_of(&map.caster_matrix().as_dmat4())),
    ]
    .map(|matrix| matrix.expect("nothing is degenerate but the caster"));
    let receiver = DVec3::new(0.0, -1.0, -4.0);
    for eye_depth in [4.0, 2.0, 1e-1, 1e-4, 1e-8, 1e-16, 0.0, -1e-16, -1e-8, -1e-4, -1e-1, -2.0, -50.0] {
        // On the ray.
        let caster = DVec3::new(0.0, receiver.y + 4.0 - eye_depth, -eye_depth);
        let mut line = vec![format!("{eye_depth:e}")];
        for (index, matrix) in matrices.iter().enumerate() {
            let depth = |p: DVec3| {
                let [_, _, z, w] = matrix.each_ref().map(|row| dot(row, &point(&vector(p))));
                let depth = if w > Big::of(0.0) { (z / w).to_f64() } else { f64::NAN };
                if inverted && index < 2 { 1.0 - depth } else { depth }
            };
            let depth_of_caster = depth(caster);
            line.push(match depth_of_caster {
                depth if depth.is_nan() => "wraps around".into(),
                depth if (0.0..=1.0).contains(&depth) => format!("{depth:.4}"),
                depth => format!("{depth:.4}, clipped"),
            });
            if index >= 2 {
                let name = format!("{eye_depth:e}, {}", columns[index + 1]);
                table.hold(&format!("{name}: before the near end"), -depth_of_caster, 0.0);
                if eye_depth < 4.0 {
                    // By a thousandth of the range at least: the scene is 512 units large and the caster two away.
                    table.hold(&format!("{name}: behind the receiver"), depth_of_caster - depth(receiver), -1e-3);
                }
            }
        }
        table.lines.push(line);
    }
    table
}

/// Depth ranges are taken from the report as distances from the lamp: far away their own rounding is most of our f64 error.
pub fn lamp_far_away() -> Table {
    let heading =
        "a lamp farther and farther away; and how far its map, in f64, is from that of the sun it becomes";
    let mut table = Table::new(heading, &with_columns("distance"));
    table.columns.push("ours, from the sun's");
    let direction = DVec3::new(in_f32(0.6), in_f32(0.75), in_f32(-0.25));
    let sun = Setup::outdoors(Lamp::Sun(direction));
    let place = |map: &ShadowMap, p: DVec3| map.clip_from_world_in(ClipSpace::WGPU).project_point3(p);
    // From beyond the scene on, the same f32 direction times a power of two.
    for k in 3..=9 {
        let distance = 2_f64.powf((10_f64.powi(k)).log2().round());
        let setup = Setup::outdoors(Lamp::At(direction * distance));
        compare(&mut table, &format!("{distance:.1e}"), &setup);
        let maps = [setup.map(), sun.map()];
        let off = setup.receivers().into_iter().map(|p| (place(&maps[0], p) - place(&maps[1], p)).abs());
        let off = off.map(|off| (off * DVec3::new(0.5, 0.5, 1.0)).max_element()).fold(0.0, f64::max);
        table.lines.last_mut().expect("a line").push(figure(off));
        // Rays differ by the angle that the scene is seen under, coordinates in the map by a few times that.
        table.hold(&format!("{distance:e}: from the sun's"), off, 8.0 * 200.0 / distance);
    }
    compare(&mut table, "sun", &sun);
    table.lines.last_mut().expect("a line").push("0".into());
    table
}
