//! The built-in scene inside walls: a room with a table and chairs under a hanging lamp that is out of view, and
//! a window that lets the sun in. The floor's top is y = 0; the room reaches from x = −3 to 3 and from z = −5 to 0.

use shadowfit::glam::{DMat4, DVec2, DVec3};

use super::solids::{add_board_with_opening, add_box, add_turned};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

const HALF_WIDTH: f64 = 3.0;
const LENGTH: f64 = 5.0;
const HEIGHT: f64 = 2.9;
const WALL_THICKNESS: f64 = 0.25;

/// The window in the left wall, as (z, y) of its least and its greatest corner.
const WINDOW: [DVec2; 2] = [DVec2::new(-3.7, 0.7), DVec2::new(-1.9, 2.2)];

/// The middle of the table top, on the floor.
const TABLE: DVec3 = DVec3::new(0.1, 0.0, -3.1);
/// Where the lamp shines from: inside its shade, which is open above and below.
const LAMP: DVec3 = DVec3::new(0.9, 2.3, -1.9);

const PLASTER: [f32; 3] = [0.72, 0.68, 0.60];
const BACK_PLASTER: [f32; 3] = [0.42, 0.52, 0.52];
const CEILING: [f32; 3] = [0.80, 0.79, 0.76];
const FLOOR: [f32; 3] = [0.48, 0.30, 0.16];
const PAINT: [f32; 3] = [0.80, 0.79, 0.75];
const OAK: [f32; 3] = [0.55, 0.34, 0.16];
const DARK_WOOD: [f32; 3] = [0.20, 0.10, 0.05];
const METAL: [f32; 3] = [0.10, 0.10, 0.11];
const CHINA: [f32; 3] = [0.70, 0.72, 0.75];
const RUG: [f32; 3] = [0.40, 0.09, 0.08];
const BOOKS: [[f32; 3]; 5] =
    [[0.45, 0.08, 0.06], [0.08, 0.18, 0.34], [0.12, 0.28, 0.14], [0.58, 0.42, 0.14], [0.32, 0.28, 0.26]];

/// The shade, once around its cut as (radius, height above the lamp): up outside and down inside.
const SHADE: [(f64, f64); 5] = [(0.24, -0.10), (0.09, 0.14), (0.08, 0.14), (0.23, -0.10), (0.24, -0.10)];
const VASE: [(f64, f64); 9] = [
    (0.0, 0.0),
    (0.06, 0.0),
    (0.10, 0.07),
    (0.11, 0.14),
    (0.08, 0.23),
    (0.04, 0.29),
    (0.045, 0.34),
    (0.06, 0.37),
    (0.0, 0.36),
];
const BOWL: [(f64, f64); 8] =
    [(0.0, 0.0), (0.07, 0.0), (0.14, 0.05), (0.18, 0.11), (0.17, 0.11), (0.13, 0.06), (0.06, 0.03), (0.0, 0.03)];

/// Makes the scene with its camera and two lights: the hanging lamp and the sun in the window.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    add_shell(&mut builder);
    add_window_frame(&mut builder);
    add_table(&mut builder);
    // Where each chair stands from the table's middle, and how it is turned; one is pushed back.
    for (x, z, turn) in [(-0.45, -0.62, 0.0), (0.45, -0.64, 0.1), (-0.40, 0.66, 3.2), (1.25, 0.15, -1.9)] {
        let world_from_chair =
            DMat4::from_translation(TABLE + DVec3::new(x, 0.0, z)) * DMat4::from_rotation_y(turn);
        add_chair(&mut builder, world_from_chair);
    }
    add_shelf(&mut builder);
    add_lamp(&mut builder);
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(2.55, 1.65, -0.25);
    LoadedScene {
        name: "room".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (DVec3::new(-0.5, 0.45, -3.4) - eye).normalize(),
            up: DVec3::Y,
            fov_y: 46_f64.to_radians(),
            near: Some(0.5),
            far: Some(9.0),
        }),
        lights: vec![
            LightSpec::Point { position: LAMP, range: f64::INFINITY },
            LightSpec::Sun { direction_to_light: DVec3::new(-0.8, 0.42, -0.12) },
        ],
        left_out,
    }
}

/// Floor, ceiling and walls. They overlap, each by a different length, so that no two faces coincide.
fn add_shell(builder: &mut MeshBuilder) {
    let thickness = WALL_THICKNESS;
    let mut add = |min: [f64; 3], max: [f64; 3], colour| {
        add_box(builder, min.into(), max.into(), DMat4::IDENTITY, colour);
    };
    let (side, back, front) = (HALF_WIDTH + thickness, -LENGTH - thickness, thickness);
    add([-side - 0.05, -0.2, back - 0.05], [side + 0.05, 0.0, front + 0.05], FLOOR);
    add([-side - 0.05, HEIGHT, back - 0.05], [side + 0.05, HEIGHT + 0.2, front + 0.05], CEILING);
    let (low, high) = (-0.1, HEIGHT + 0.1);
    add([-side, low, back], [side, high, -LENGTH], BACK_PLASTER);
    add([-side, low, 0.0], [side, high, front], PLASTER);
    let (low, high, ends) = (-0.08, HEIGHT + 0.08, [-LENGTH - 0.1, 0.1]);
    add([HALF_WIDTH, low, ends[0]], [side - 0.02, high, ends[1]], PLASTER);
    // The skirting along the back wall.
    add([-HALF_WIDTH - 0.02, -0.02, -LENGTH - 0.02], [HALF_WIDTH + 0.02, 0.10, -LENGTH + 0.02], PAINT);
    add([-1.35, -0.03, -4.25], [1.75, 0.012, -2.0], RUG);
    let outline = [DVec2::new(ends[0], low), DVec2::new(ends[1], high)];
    let across = [-side + 0.02, -HALF_WIDTH];
    add_board_with_opening(builder, outline, WINDOW, across, left_wall(), PLASTER);
}

/// Takes (z, y, x) to (x, y, z): boards with openings are described as seen along z. That mirrors, and the builder
/// keeps fronts in front.
fn left_wall() -> DMat4 {
    DMat4::from_cols(DVec3::Z.extend(0.0), DVec3::Y.extend(0.0), DVec3::X.extend(0.0), DVec3::ZERO.extend(1.0))
}

fn add_window_frame(builder: &mut MeshBuilder) {
    let [min, max] = WINDOW;
    let middle = -HALF_WIDTH - 0.5 * WALL_THICKNESS;
    // The frame reaches a little into the wall.
    let outline = [min - 0.02, max + 0.02];
    let opening = [min + 0.05, max - 0.05];
    add_board_with_opening(builder, outline, opening, [middle - 0.04, middle + 0.04], left_wall(), PAINT);
    let centre = 0.5 * (min + max);
    let mut add = |min: DVec2, max: DVec2, half_depth: f64| {
        let (min, max) = (min.extend(middle - half_depth), max.extend(middle + half_depth));
        add_box(builder, min, max, left_wall(), PAINT);
    };
    add(DVec2::new(centre.x - 0.03, min.y + 0.03), DVec2::new(centre.x + 0.03, max.y - 0.03), 0.03);
    add(DVec2::new(min.x + 0.03, centre.y + 0.20), DVec2::new(max.x - 0.03, centre.y + 0.25), 0.025);
    let sill = [DVec3::new(min.x - 0.1, min.y - 0.04, -3.02), DVec3::new(max.x + 0.1, min.y + 0.01, -2.88)];
    add_box(builder, sill[0], sill[1], left_wall(), PAINT);
}

fn add_table(builder: &mut MeshBuilder) {
    let world_from_table = DMat4::from_translation(TABLE);
    let mut add = |min: [f64; 3], max: [f64; 3]| {
        add_box(builder, min.into(), max.into(), world_from_table, OAK);
    };
    add([-0.85, 0.71, -0.48], [0.85, 0.75, 0.48]);
    add([-0.75, 0.62, -0.38], [0.75, 0.72, 0.38]);
    for (x, z) in [(-0.74, -0.37), (0.74, -0.37), (-0.74, 0.37), (0.74, 0.37)] {
        add([x - 0.035, -0.02, z - 0.035], [x + 0.035, 0.715, z + 0.035]);
    }
    // Things on the table are sunk into it a little, so that no two surfaces coincide.
    for (profile, x, z) in [(&VASE[..], -0.25, -0.12), (&BOWL[..], 0.35, 0.08)] {
        let foot = TABLE + DVec3::new(x, 0.74, z);
        add_profile(builder, profile, foot, CHINA);
    }
}

/// A chair that faces +z.
fn add_chair(builder: &mut MeshBuilder, world_from_chair: DMat4) {
    let mut add = |min: [f64; 3], max: [f64; 3]| {
        add_box(builder, min.into(), max.into(), world_from_chair, DARK_WOOD);
    };
    add([-0.22, 0.42, -0.21], [0.22, 0.46, 0.22]);
    for x in [-0.19, 0.19] {
        add([x - 0.02, -0.02, 0.16], [x + 0.02, 0.43, 0.20]);
        add([x - 0.02, -0.02, -0.20], [x + 0.02, 0.95, -0.16]);
    }
    for y in [0.60, 0.73, 0.86] {
        add([-0.18, y, -0.19], [0.18, y + 0.06, -0.17]);
    }
}

/// A shelf with books against the back wall.
fn add_shelf(builder: &mut MeshBuilder) {
    let (left, right, back, front) = (-2.3, -0.9, -LENGTH + 0.03, -LENGTH + 0.33);
    let mut add = |min: [f64; 3], max: [f64; 3], colour| {
        add_box(builder, min.into(), max.into(), DMat4::IDENTITY, colour);
    };
    for x in [left, right] {
        add([x - 0.02, -0.02, back], [x + 0.02, 1.62, front], OAK);
    }
    let boards = [0.10, 0.50, 0.90, 1.30];
    for board in boards {
        add([left - 0.01, board, back + 0.01], [right + 0.01, board + 0.03, front - 0.01], OAK);
        // Sizes that differ from book to book, deterministically.
        let mut x = left + 0.05;
        let mut book = (board * 10.0) as usize;
        while x < right - 0.12 - 0.07 * (book % 3) as f64 {
            let width = 0.030 + 0.008 * ((book * 5) % 4) as f64;
            let height = 0.20 + 0.025 * ((book * 7) % 5) as f64;
            let depth = 0.16 + 0.02 * ((book * 3) % 4) as f64;
            let colour = BOOKS[(book * 3 + book / 4) % BOOKS.len()];
            add([x, board + 0.02, back + 0.03], [x + width, board + 0.03 + height, back + 0.03 + depth], colour);
            x += width + 0.004 + if book % 9 == 8 { 0.12 } else { 0.0 };
            book += 1;
        }
    }
}

/// The hanging lamp: a shade that is open above and below, with nothing round the light itself.
fn add_lamp(builder: &mut MeshBuilder) {
    add_profile(builder, &SHADE, LAMP, METAL);
    let mut add = |min: [f64; 3], max: [f64; 3]| {
        add_box(builder, min.into(), max.into(), DMat4::from_translation(LAMP), METAL);
    };
    add([-0.093, 0.11, -0.01], [0.093, 0.125, 0.01]);
    add([-0.006, 0.12, -0.006], [0.006, HEIGHT + 0.02 - LAMP.y, 0.006]);
}

fn add_profile(builder: &mut MeshBuilder, profile: &[(f64, f64)], foot: DVec3, colour: [f32; 3]) {
    let profile: Vec<DVec2> = profile.iter().copied().map(DVec2::from).collect();
    add_turned(builder, &profile, DMat4::from_translation(foot), colour);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Lens;

    #[test]
    fn the_room_is_closed_around_the_camera() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        let (outside, inside) = (WALL_THICKNESS + 0.05, DVec3::new(HALF_WIDTH, HEIGHT, 0.0));
        assert_eq!((min.x, max.x), (-HALF_WIDTH - outside, HALF_WIDTH + outside));
        assert_eq!((min.y, max.y), (-0.2, HEIGHT + 0.2));
        assert_eq!((min.z, max.z), (-LENGTH - outside, outside));
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
        assert!(scene.mesh.triangles.len() <= 20_000, "{}", scene.mesh.triangles.len());
        let eye = scene.camera.expect("the scene has a camera").eye;
        assert!(eye.cmplt(inside).all() && eye.cmpgt(DVec3::new(-HALF_WIDTH, 0.0, -LENGTH)).all());
    }

    #[test]
    fn the_lamp_is_in_the_room_and_out_of_view() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        assert!(LAMP.cmpgt(min).all() && LAMP.cmplt(max).all());
        let view = scene.camera.expect("the scene has a camera").view(1.6, 0.5, 9.0).expect("a sound camera");
        let seen = Lens::of_view(&view).expect("invertible").project(LAMP);
        assert!(seen.y > 1.2, "the lamp is above the picture, at {seen}");
    }

    #[test]
    fn the_sun_reaches_the_floor_through_the_window() {
        let scene = make();
        let LightSpec::Sun { direction_to_light } = scene.lights[1] else { panic!("the second light is the sun") };
        let floor = DVec3::new(-1.3, 0.012, -2.5);
        let at_wall = floor + (-HALF_WIDTH - floor.x) / direction_to_light.x * direction_to_light;
        let [min, max] = WINDOW;
        assert!(
            DVec2::new(at_wall.z, at_wall.y).cmpgt(min).all() && DVec2::new(at_wall.z, at_wall.y).cmplt(max).all()
        );
    }
}
