//! A long straight street from a person's height, with near and far surfaces in one picture. One unit is a metre;
//! the street runs along the z axis, away from the camera towards −z.

use std::f64::consts::FRAC_PI_2;

use shadowfit::glam::{DMat4, DVec2, DVec3};

use super::solids::{add_bars, add_boxes, add_cut_out, add_turned, scattered};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

/// The z coordinates between which there are houses, lamps and trees.
const NEAR_END: f64 = 14.0;
const FAR_END: f64 = -300.0;
/// The two sides of the street, as the sign of x.
const SIDES: [f64; 2] = [-1.0, 1.0];
/// The plot on the right where no house stands: there the sun reaches the road, past the lamps and bollards.
const OPEN_PLOT: [f64; 2] = [-27.0, -5.0];
/// Half the widths of the road, of the road with its kerbs, with its pavements, and of the gap between the houses.
const ROAD: f64 = 3.4;
const KERB: f64 = 3.65;
const PAVEMENT: f64 = 6.0;
const HOUSE_FRONT: f64 = 8.2;
const GROUND: f64 = 60.0;
const PAVEMENT_HEIGHT: f64 = 0.13;
const GROUND_THICKNESS: f64 = 0.5;

const STOREY: f64 = 2.9;
const EYE_HEIGHT: f64 = 1.7;
const NEAR_PLANE: f64 = 0.3;
const FAR_PLANE: f64 = 400.0;

const GRASS: [f32; 3] = [0.17, 0.24, 0.07];
const ASPHALT: [f32; 3] = [0.30, 0.29, 0.28];
const PAINT: [f32; 3] = [0.75, 0.74, 0.70];
const KERB_STONE: [f32; 3] = [0.55, 0.54, 0.52];
const PAVING: [f32; 3] = [0.46, 0.42, 0.37];
const IRON: [f32; 3] = [0.045, 0.06, 0.055];
const BOLLARD: [f32; 3] = [0.07, 0.06, 0.06];
const BARK: [f32; 3] = [0.14, 0.09, 0.055];
const FENCE: [f32; 3] = [0.75, 0.73, 0.68];
const TRIM: [f32; 3] = [0.72, 0.69, 0.62];
const GLASS: [f32; 3] = [0.06, 0.08, 0.10];
const TOWER: [f32; 3] = [0.50, 0.44, 0.36];
const SLATE: [f32; 3] = [0.10, 0.11, 0.14];
const CROWNS: [[f32; 3]; 2] = [[0.10, 0.21, 0.05], [0.16, 0.25, 0.05]];
const WALLS: [[f32; 3]; 6] = [
    [0.66, 0.54, 0.38],
    [0.60, 0.28, 0.20],
    [0.70, 0.66, 0.58],
    [0.42, 0.50, 0.56],
    [0.70, 0.46, 0.28],
    [0.50, 0.54, 0.42],
];
const ROOFS: [[f32; 3]; 3] = [[0.32, 0.10, 0.06], SLATE, [0.24, 0.12, 0.08]];
const DOORS: [[f32; 3]; 3] = [[0.05, 0.14, 0.11], [0.30, 0.04, 0.03], [0.05, 0.08, 0.20]];

/// The profile of a tree's crown, bottom to top, as (radius, height).
const CROWN: [(f64, f64); 6] = [(0.0, 2.1), (0.9, 2.3), (1.5, 3.1), (1.45, 4.0), (0.85, 5.0), (0.0, 5.4)];

/// Makes the scene with its camera and two suns: one of the afternoon, from the right and ahead, and a lower one.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    add_ground(&mut builder);
    for side in SIDES {
        add_row_of_houses(&mut builder, side);
        add_furniture(&mut builder, side);
    }
    add_tower(&mut builder);
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(-1.3, EYE_HEIGHT, 0.0);
    let target = DVec3::new(0.0, 1.45, -16.0);
    LoadedScene {
        name: "street".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (target - eye).normalize(),
            up: DVec3::Y,
            fov_y: 50_f64.to_radians(),
            near: Some(NEAR_PLANE),
            far: Some(FAR_PLANE),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(0.62, 0.72, -0.42) },
            LightSpec::Sun { direction_to_light: DVec3::new(0.80, 0.42, -0.33) },
        ],
        left_out,
    }
}

/// Adds the ground. Where two things overlap, their tops, bottoms and ends differ by centimetres, so that no two
/// surfaces coincide.
fn add_ground(builder: &mut MeshBuilder) {
    let mut add_strip = |x: [f64; 2], top: f64, inset: f64, colour| {
        let min = DVec3::new(x[0].min(x[1]), -GROUND_THICKNESS + inset, FAR_END - 90.0 + inset);
        let max = DVec3::new(x[0].max(x[1]), top, NEAR_END + 4.0 - inset);
        add_boxes(builder, &[[min, max]], DMat4::IDENTITY, colour);
    };
    add_strip([-GROUND, GROUND], -0.05, 0.0, GRASS);
    add_strip([-ROAD - 0.1, ROAD + 0.1], 0.0, 0.1, ASPHALT);
    for side in SIDES {
        add_strip([side * ROAD, side * KERB], PAVEMENT_HEIGHT + 0.01, 0.2, KERB_STONE);
        add_strip([side * (KERB - 0.05), side * PAVEMENT], PAVEMENT_HEIGHT, 0.3, PAVING);
    }
    let dashes: Vec<[DVec3; 2]> = (0..37)
        .map(|i| DVec3::new(-0.06, -0.07, 8.0 - 8.0 * f64::from(i)))
        .map(|min| [min, min + DVec3::new(0.12, 0.08, 3.0)])
        .collect();
    add_boxes(builder, &dashes, DMat4::IDENTITY, PAINT);
}

fn add_row_of_houses(builder: &mut MeshBuilder, side: f64) {
    let (right, mut near) = (side > 0.0, NEAR_END);
    for house in if right { 0.. } else { 1000.. } {
        let width = 11.0 + 4.0 * scattered(house, 0);
        if right && near > OPEN_PLOT[0] && near - width < OPEN_PLOT[1] {
            let middle = DVec3::new(HOUSE_FRONT, 0.0, 0.5 * (OPEN_PLOT[0] + OPEN_PLOT[1]));
            let world_from_plot = DMat4::from_translation(middle) * DMat4::from_rotation_y(-FRAC_PI_2);
            add_fence(builder, OPEN_PLOT[1] - OPEN_PLOT[0], world_from_plot);
            near = OPEN_PLOT[0];
        }
        if near - width < FAR_END {
            break;
        }
        let front = DVec3::new(side * HOUSE_FRONT, 0.0, near - 0.5 * width);
        let world_from_house = DMat4::from_translation(front) * DMat4::from_rotation_y(-side * FRAC_PI_2);
        add_house(builder, house, width, world_from_house);
        if house % 3 == 1 && near > -80.0 {
            add_fence(builder, width, world_from_house);
        }
        near -= width + 1.8 + 9.0 * scattered(house, 1).powi(2);
    }
}

/// Adds a house whose front is the plane z = 0 of its own coordinates, seen from +z, with the door's side at x < 0.
fn add_house(builder: &mut MeshBuilder, house: u32, width: f64, world_from_house: DMat4) {
    let pick = |property: u32, count: usize| (scattered(house, property) * count as f64) as usize;
    let storeys = if scattered(house, 2) < 0.7 { 2 } else { 3 };
    let (half, depth, eaves) = (0.5 * width, 9.0, 0.4 + STOREY * f64::from(storeys));
    let wall = WALLS[pick(3, WALLS.len())];
    // The ridge runs away from the street, or along it: then the roof is made a quarter turn round.
    let gable_in_front = scattered(house, 4) < 0.5;
    let middle = world_from_house * DMat4::from_translation(DVec3::new(0.0, 0.0, -0.5 * depth));
    let (under_gable, along_ridge, world_from_roof) = if gable_in_front {
        (half, 0.5 * depth, middle)
    } else {
        (0.5 * depth, half, middle * DMat4::from_rotation_y(FRAC_PI_2))
    };
    let rise = 0.72 * under_gable;
    let row = |half_width: f64, y: f64| [DVec2::new(-half_width, y), DVec2::new(half_width, y)];
    let body = [row(under_gable, -0.3), row(under_gable, eaves), row(0.02, eaves + rise)];
    add_cut_out(builder, &body, [-along_ridge, along_ridge], world_from_roof, wall);
    let roof = [row(under_gable + 0.4, eaves - 0.15), row(0.05, eaves + rise + 0.2)];
    let roof_end = along_ridge - 0.25;
    add_cut_out(builder, &roof, [-roof_end, roof_end], world_from_roof, ROOFS[pick(5, ROOFS.len())]);

    let chimney =
        DVec3::new(0.35 * under_gable, eaves, if house.is_multiple_of(2) { 0.6 } else { -0.7 } * along_ridge);
    let chimney = [chimney, chimney + DVec3::new(0.8, rise + 0.9, 0.6)];
    add_boxes(builder, &[chimney], world_from_roof, wall);

    let door_x = -0.55 * half;
    let (mut trim, mut glass) = (vec![], vec![]);
    for storey in 0..storeys {
        let floor = 0.4 + STOREY * f64::from(storey);
        // On the ground floor the door takes the first window's place.
        for x in [door_x, 0.0, -door_x].into_iter().skip(usize::from(storey == 0)) {
            let corner = DVec3::new(x - 0.55, floor + 0.85, -0.1);
            glass.push([corner, corner + DVec3::new(1.1, 1.4, 0.12)]);
            trim.push([corner + DVec3::new(-0.12, -0.1, 0.04), corner + DVec3::new(1.22, 0.03, 0.28)]);
        }
        if storey > 0 {
            trim.push([DVec3::new(-half - 0.06, floor - 0.2, -0.1), DVec3::new(half + 0.06, floor, 0.1)]);
        }
    }
    // The doorstep and the canopy.
    trim.push([DVec3::new(door_x - 0.8, -0.2, -0.15), DVec3::new(door_x + 0.8, 0.2, 0.8)]);
    trim.push([DVec3::new(door_x - 0.75, 2.5, -0.1), DVec3::new(door_x + 0.75, 2.62, 0.7)]);
    add_boxes(builder, &trim, world_from_house, TRIM);
    add_boxes(builder, &glass, world_from_house, GLASS);
    let door = [DVec3::new(door_x - 0.5, 0.1, -0.1), DVec3::new(door_x + 0.5, 2.35, 0.05)];
    add_boxes(builder, &[door], world_from_house, DOORS[pick(6, DOORS.len())]);
}

/// Adds a picket fence before a house, in the house's coordinates, with a gap before the door.
fn add_fence(builder: &mut MeshBuilder, width: f64, world_from_house: DMat4) {
    let z = HOUSE_FRONT - PAVEMENT - 0.15;
    let (left, right) = (-0.275 * width + 0.8, 0.5 * width);
    let mut boards: Vec<[DVec3; 2]> = [0.35, 0.8]
        .map(|y| [DVec3::new(left - 0.08, y, z - 0.05), DVec3::new(right + 0.08, y + 0.08, z - 0.01)])
        .into();
    let pickets = ((right - left) / 0.3) as u32;
    boards.extend(
        (0..=pickets)
            .map(|i| left + (right - left) * f64::from(i) / f64::from(pickets))
            .map(|x| [DVec3::new(x - 0.05, -0.2, z - 0.02), DVec3::new(x + 0.05, 1.05, z + 0.02)]),
    );
    add_boxes(builder, &boards, world_from_house, FENCE);
}

/// Adds the lamps, bollards and trees along one kerb.
fn add_furniture(builder: &mut MeshBuilder, side: f64) {
    let at = |x: f64, z: f64| DMat4::from_translation(DVec3::new(side * x, PAVEMENT_HEIGHT, z));
    let bar = |[low, high]: [f64; 2], radii: [f64; 2]| [(low * DVec3::Y, radii[0]), (high * DVec3::Y, radii[1])];
    // Each bar begins inside the one below.
    let lamp = [
        bar([-0.2, 0.9], [0.13, 0.11]),
        bar([0.8, 3.8], [0.065, 0.045]),
        bar([3.7, 4.25], [0.10, 0.20]),
        bar([4.2, 4.5], [0.27, 0.04]),
        [(DVec3::new(0.0, 3.45, -0.35), 0.025), (DVec3::new(0.0, 3.45, 0.35), 0.025)],
    ];
    let mut z = if side > 0.0 { -9.5 } else { -17.7 };
    while z > FAR_END {
        add_bars(builder, &lamp, at(KERB + 0.4, z), IRON);
        z -= 32.0;
    }
    let bollard = [bar([-0.2, 0.8], [0.085, 0.07]), bar([0.76, 0.9], [0.10, 0.06])];
    for i in 0..9 {
        add_bars(builder, &bollard, at(KERB + 0.3, -5.7 - 1.6 * f64::from(i)), BOLLARD);
    }
    let crown: Vec<DVec2> = CROWN.iter().copied().map(DVec2::from).collect();
    let trunk = [bar([-0.2, 2.6], [0.16, 0.11])];
    for (i, z) in [-24.0, -55.0, -90.0, -160.0].into_iter().enumerate() {
        let world_from_tree = at(KERB + 0.8, z + 9.0 * side);
        add_bars(builder, &trunk, world_from_tree, BARK);
        add_turned(builder, &crown, world_from_tree, CROWNS[i % CROWNS.len()]);
    }
}

/// Adds a tower that ends the street.
fn add_tower(builder: &mut MeshBuilder) {
    let foot = DMat4::from_translation(DVec3::new(0.0, 0.0, FAR_END - 70.0));
    let stages = [(6.2, [-0.35, 24.0]), (6.6, [23.0, 24.6]), (5.0, [23.5, 34.0]), (5.4, [33.0, 34.6])];
    let stages = stages.map(|(half, [low, high])| [DVec3::new(-half, low, -half), DVec3::new(half, high, half)]);
    add_boxes(builder, &stages, foot, TOWER);
    let spire = [(0.0, 33.5), (4.6, 33.5), (3.0, 40.0), (0.0, 56.0)].map(DVec2::from);
    add_turned(builder, &spire, foot, SLATE);
}

#[cfg(test)]
mod tests {
    use super::super::solids::open_edges;
    use super::*;

    #[test]
    fn the_street_recedes_from_the_camera_to_the_tower() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        assert_eq!((min, max), (DVec3::new(-GROUND, -GROUND_THICKNESS, -390.0), DVec3::new(GROUND, 56.0, 18.0)));
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
        assert!((500..20_000).contains(&scene.mesh.triangles.len()), "{} triangles", scene.mesh.triangles.len());
    }

    #[test]
    fn what_is_seen_lies_over_a_thousand_times_as_deep_as_the_near_plane() {
        let scene = make();
        let camera = scene.camera.expect("the scene has a camera");
        let (min, _) = scene.mesh.bounds();
        let deepest = camera.eye.z - min.z;
        assert!(deepest > 1000.0 * NEAR_PLANE && deepest < FAR_PLANE, "{deepest}");
        assert!(camera.forward.z < -0.9);
    }

    #[test]
    fn everything_is_closed() {
        let mesh = make().mesh;
        for (i, object) in mesh.objects.iter().enumerate() {
            assert_eq!(open_edges(&mesh, object), 0, "object {i} from {} to {}", object.min, object.max);
        }
    }
}
