//! A tree over a bench on a paved square. Its leaves are single flat sheets without a thickness, thousands of them:
//! casters that have no inside, seen and lit from both faces. One unit is a metre; the trunk stands at the origin.

use shadowfit::glam::{DMat4, DVec2, DVec3};

use super::solids::{add_bars, add_boxes, add_turned, scattered};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder, Part};

const BRANCHES: u32 = 8;
const TWIGS: u32 = 5;
const LEAVES_ON_TWIG: u32 = 90;
const LEAF_LENGTH: f64 = 0.25;
const LEAF_WIDTH: f64 = 0.17;
/// How far from its twig's end a leaf may hang.
const TUFT_RADIUS: f64 = 0.75;

/// Paving slabs along each side of the square.
const SLABS: u32 = 14;
const SLAB: f64 = 1.5;
const JOINT: f64 = 0.03;
const BED_THICKNESS: f64 = 0.3;

const STONES: [[f32; 3]; 3] = [[0.58, 0.54, 0.47], [0.53, 0.49, 0.43], [0.62, 0.58, 0.50]];
const SAND: [f32; 3] = [0.24, 0.21, 0.17];
const RIM: [f32; 3] = [0.40, 0.38, 0.35];
const EARTH: [f32; 3] = [0.12, 0.075, 0.045];
const BARK: [f32; 3] = [0.16, 0.105, 0.065];
const GREENS: [[f32; 3]; 4] = [[0.13, 0.27, 0.04], [0.17, 0.31, 0.05], [0.10, 0.23, 0.04], [0.21, 0.34, 0.06]];
const BENCH_WOOD: [f32; 3] = [0.38, 0.16, 0.06];
const BENCH_IRON: [f32; 3] = [0.05, 0.055, 0.06];

/// The profiles, bottom to top, as (radius, height).
const TRUNK: [(f64, f64); 8] =
    [(0.0, -0.1), (0.52, -0.1), (0.37, 0.15), (0.29, 0.5), (0.25, 1.2), (0.24, 2.0), (0.20, 2.5), (0.0, 2.6)];
const BED_RIM: [(f64, f64); 8] =
    [(0.0, -0.2), (1.5, -0.2), (1.5, 0.16), (1.46, 0.2), (1.24, 0.2), (1.2, 0.16), (1.2, 0.02), (0.0, 0.02)];
const BED_EARTH: [(f64, f64); 4] = [(0.0, -0.05), (1.22, -0.05), (1.22, 0.08), (0.0, 0.12)];

/// Makes the scene with its camera and two lights: a high sun and a spot beside the tree.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    add_square(&mut builder);
    for (profile, colour) in [(&BED_RIM[..], RIM), (&BED_EARTH[..], EARTH), (&TRUNK[..], BARK)] {
        let profile: Vec<DVec2> = profile.iter().copied().map(DVec2::from).collect();
        add_turned(&mut builder, &profile, DMat4::IDENTITY, colour);
    }
    for branch in 0..BRANCHES {
        add_branch(&mut builder, branch);
    }
    let bench = DMat4::from_translation(DVec3::new(2.7, 0.0, 1.5)) * DMat4::from_rotation_y(0.5);
    add_bench(&mut builder, bench);
    let (mesh, left_out) = builder.finish();
    let eye = DVec3::new(5.2, 5.2, 13.0);
    let target = DVec3::new(0.9, 2.75, 0.0);
    LoadedScene {
        name: "leaves".into(),
        mesh,
        camera: Some(Camera {
            eye,
            forward: (target - eye).normalize(),
            up: DVec3::Y,
            fov_y: 42_f64.to_radians(),
            near: Some(1.0),
            far: Some(40.0),
        }),
        lights: vec![
            LightSpec::Sun { direction_to_light: DVec3::new(-0.55, 1.0, -0.25) },
            LightSpec::Spot {
                position: DVec3::new(-4.0, 8.5, 1.0),
                target: DVec3::new(1.2, 2.0, 0.6),
                cone_degrees: 64.0,
                range: f64::INFINITY,
            },
        ],
        left_out,
    }
}

fn add_square(builder: &mut MeshBuilder) {
    let half = 0.5 * f64::from(SLABS) * SLAB;
    let bed = [DVec3::new(-half, -BED_THICKNESS, -half), DVec3::new(half, -0.02, half)];
    add_boxes(builder, &[bed], DMat4::IDENTITY, SAND);
    for row in 0..SLABS {
        // Every stone of a row that has the same shade is one object.
        let mut slabs = STONES.map(|_| Vec::new());
        for column in 0..SLABS {
            let shade = (scattered(row, column) * STONES.len() as f64) as usize;
            let min = DVec3::new(f64::from(column) * SLAB - half, -0.08, f64::from(row) * SLAB - half);
            let max = min + DVec3::new(SLAB, 0.08, SLAB);
            let joint = DVec3::new(0.5 * JOINT, 0.0, 0.5 * JOINT);
            slabs[shade].push([min + joint, max - joint]);
        }
        for (slabs, colour) in slabs.iter().zip(STONES) {
            add_boxes(builder, slabs, DMat4::IDENTITY, colour);
        }
    }
}

/// Adds a branch, its twigs and, as one more object, its leaves.
fn add_branch(builder: &mut MeshBuilder, branch: u32) {
    let chance = |property: u32| scattered(branch, property);
    // Turned by the golden angle from one to the next, branches spread around the trunk without a pattern; the last
    // ones are the steepest.
    let (sin, cos) = (2.399_963 * f64::from(branch)).sin_cos();
    let steep = f64::from(branch) / f64::from(BRANCHES - 1);
    let outward = DVec3::new(cos, 0.0, sin) * (2.2 - 1.7 * steep * steep + 0.3 * chance(0));
    let fork = DVec3::Y * (1.7 + 0.7 * steep);
    let bend = fork + 0.45 * outward + DVec3::Y * (0.5 + 0.6 * steep);
    let end = fork + outward + DVec3::Y * (1.5 + 1.9 * steep + 0.4 * chance(1));
    let mut bars = vec![[(fork, 0.13), (bend, 0.085)], [(bend, 0.085), (end, 0.03)]];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for twig in 0..TWIGS {
        let number = BRANCHES + branch * TWIGS + twig;
        let foot = bend.lerp(end, 0.35 + 0.6 * f64::from(twig) / f64::from(TWIGS - 1));
        let tip = foot + 1.15 * (direction(number, 0) + 0.35 * DVec3::Y + 0.2 * outward);
        bars.push([(foot, 0.04), (tip, 0.012)]);
        for leaf in 0..LEAVES_ON_TWIG {
            let first = positions.len() as u32;
            positions.extend(leaf_corners(tip, 1000 + number * LEAVES_ON_TWIG + leaf));
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    add_bars(builder, &bars, DMat4::IDENTITY, BARK);
    let colour = GREENS[branch as usize % GREENS.len()];
    builder.add(&Part { positions: &positions, normals: &[], triangles: &triangles, colour }, DMat4::IDENTITY);
}

/// The corners of a leaf near a twig's tip: stalk, right, tip, left.
fn leaf_corners(twig_tip: DVec3, leaf: u32) -> [DVec3; 4] {
    // The cube root would fill the ball evenly; a smaller exponent gathers the leaves around the twig's end.
    let stalk = twig_tip + TUFT_RADIUS * scattered(leaf, 2).sqrt() * direction(leaf, 0);
    // Most leaves turn their upper side to the sky.
    let up = (direction(leaf, 3) + 0.6 * DVec3::Y).normalize_or(DVec3::Y);
    let along = up.cross(direction(leaf, 5)).normalize_or(up.any_orthonormal_vector());
    let size = 0.75 + 0.5 * scattered(leaf, 7);
    let half_width = 0.5 * LEAF_WIDTH * size * along.cross(up);
    let widest = stalk + size * 0.45 * LEAF_LENGTH * along;
    [stalk, widest + half_width, stalk + size * LEAF_LENGTH * along, widest - half_width]
}

/// A pseudo-random direction, uniformly distributed. It uses up two properties.
fn direction(thing: u32, property: u32) -> DVec3 {
    let y = 2.0 * scattered(thing, property) - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * scattered(thing, property + 1)).sin_cos();
    let radius = (1.0 - y * y).sqrt();
    DVec3::new(radius * cos, y, radius * sin)
}

/// Adds a bench that faces the z axis of its own coordinates.
fn add_bench(builder: &mut MeshBuilder, world_from_bench: DMat4) {
    let mut slats: Vec<[DVec3; 2]> = (0..4)
        .map(|i| DVec3::new(-0.9, 0.43, 0.13 * f64::from(i)))
        .map(|min| [min, min + DVec3::new(1.8, 0.035, 0.1)])
        .collect();
    slats.extend(
        (0..3)
            .map(|i| DVec3::new(-0.9, 0.56 + 0.13 * f64::from(i), -0.08))
            .map(|min| [min, min + DVec3::new(1.8, 0.1, 0.03)]),
    );
    add_boxes(builder, &slats, world_from_bench, BENCH_WOOD);
    for x in [-0.7, 0.7] {
        let frame = [
            ([-0.03, -0.01, -0.13], [0.03, 0.93, -0.075]),
            ([-0.03, -0.01, 0.42], [0.03, 0.44, 0.47]),
            ([-0.025, 0.39, -0.1], [0.025, 0.435, 0.46]),
        ];
        let frame = frame.map(|corners| <[[f64; 3]; 2]>::from(corners).map(DVec3::from));
        add_boxes(builder, &frame, world_from_bench * DMat4::from_translation(x * DVec3::X), BENCH_IRON);
    }
}

#[cfg(test)]
mod tests {
    use super::super::solids::open_edges;
    use super::*;

    #[test]
    fn the_crown_hangs_over_the_square() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        assert_eq!((min.x, max.x, min.z, max.z), (-10.5, 10.5, -10.5, 10.5));
        assert_eq!(min.y, -BED_THICKNESS);
        assert!((6.0..9.0).contains(&max.y), "the crown ends at {}", max.y);
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
        let leaves = scene.mesh.objects.iter().filter(|object| open_edges(&scene.mesh, object) > 0);
        assert!(leaves.fold(f64::INFINITY, |lowest, object| lowest.min(object.min.y)) > 1.5);
    }

    #[test]
    fn only_the_leaves_are_open_and_they_are_thousands() {
        let scene = make();
        let mut leaves = 0;
        for object in &scene.mesh.objects {
            match open_edges(&scene.mesh, object) {
                0 => {}
                // A leaf is open along all of its four edges.
                open => {
                    assert_eq!(open, 2 * object.triangles.len());
                    leaves += open / 4;
                }
            }
        }
        assert_eq!(leaves, (BRANCHES * TWIGS * LEAVES_ON_TWIG) as usize);
        assert!(leaves > 3000);
    }
}
