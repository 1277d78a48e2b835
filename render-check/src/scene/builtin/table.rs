//! The built-in scene for depth tests: a table with thin legs that stands on a floor, as in Wang & Molnar's figures. All of
//! it is solid. At 512² texels a leg is a few of them wide, at 128² less than one.

use shadowfit::glam::{DMat4, DVec2, DVec3};

use super::solids::{add_box, add_boxes, add_turned};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

/// Half of the floor's width and length.
const HALF_FLOOR: f64 = 2.5;
const FLOOR_THICKNESS: f64 = 0.12;
/// Half of the table's width and length.
const HALF_TABLE: DVec2 = DVec2::new(0.8, 0.5);
const TABLE_HEIGHT: f64 = 0.74;
const TABLE_THICKNESS: f64 = 0.03;
const LEG_THICKNESS: f64 = 0.04;
/// How deep things are sunk into what they stand on, so that no two faces are coplanar.
const LET_IN: f64 = 0.004;

const WOOD: [f32; 3] = [0.50, 0.31, 0.16];
const DARK_WOOD: [f32; 3] = [0.33, 0.19, 0.10];
const STONE: [f32; 3] = [0.62, 0.60, 0.55];
const CLAY: [f32; 3] = [0.66, 0.30, 0.18];

/// Makes the scene with its camera and two lights: an oblique sun and a lamp.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    let half = DVec3::new(HALF_FLOOR, 0.0, HALF_FLOOR);
    add_box(&mut builder, -half - FLOOR_THICKNESS * DVec3::Y, half, DMat4::IDENTITY, STONE);

    let turned = DMat4::from_rotation_y(0.35);
    let top = DVec3::new(HALF_TABLE.x, TABLE_HEIGHT, HALF_TABLE.y);
    let under = DVec3::new(-HALF_TABLE.x, TABLE_HEIGHT - TABLE_THICKNESS, -HALF_TABLE.y);
    add_box(&mut builder, under, top, turned, WOOD);
    let leg = |x: f64, z: f64| {
        let middle = DVec2::new(x * (HALF_TABLE.x - 0.08), z * (HALF_TABLE.y - 0.08));
        let (foot, head) = (-LET_IN, TABLE_HEIGHT - TABLE_THICKNESS + LET_IN);
        let corner = |side: f64, y: f64| {
            DVec3::new(middle.x + side * LEG_THICKNESS / 2.0, y, middle.y + side * LEG_THICKNESS / 2.0)
        };
        [corner(-1.0, foot), corner(1.0, head)]
    };
    let legs = [leg(-1.0, -1.0), leg(1.0, -1.0), leg(1.0, 1.0), leg(-1.0, 1.0)];
    add_boxes(&mut builder, &legs, turned, DARK_WOOD);

    // A vase on the table, and a ball of wood on the floor, which touches it at its lowest point.
    let vase = [(0.0, -LET_IN), (0.05, -LET_IN), (0.09, 0.1), (0.05, 0.2), (0.06, 0.24), (0.0, 0.24)];
    let on_table = turned * DMat4::from_translation(DVec3::new(0.3, TABLE_HEIGHT, -0.1));
    add_turned(&mut builder, &vase.map(DVec2::from), on_table, CLAY);
    let ball: Vec<DVec2> = (0..=24)
        .map(|i| {
            let polar = std::f64::consts::PI * f64::from(i) / 24.0;
            DVec2::new(if i % 24 == 0 { 0.0 } else { 0.16 * polar.sin() }, 0.16 - 0.16 * polar.cos())
        })
        .collect();
    add_turned(&mut builder, &ball, DMat4::from_translation(DVec3::new(1.15, 0.0, 0.75)), WOOD);

    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(1.6, 1.5, 3.0);
    LoadedScene {
        name: "table".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (DVec3::new(0.05, 0.3, 0.0) - eye).normalize(),
            up: DVec3::Y,
            fov_y: 38_f64.to_radians(),
            near: Some(1.0),
            far: Some(8.0),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(-0.7, 1.0, 0.4) },
            LightSpec::Point { position: DVec3::new(-1.1, 1.9, 0.9), range: f64::INFINITY },
        ],
        left_out,
    }
}
