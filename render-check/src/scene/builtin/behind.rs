//! The built-in scene whose casters stand behind the eye: a square in a low sun, into which a figure and a lamp post
//! throw their shadows from behind the viewer. The viewer stands at x = z = 0 and looks along −z.

use std::f64::consts::PI;

use shadowfit::glam::{DMat4, DQuat, DVec2, DVec3};

use super::solids::{add_box, add_slab, add_turned};
use crate::scene::{Camera, LightSpec, LoadedScene, MeshBuilder};

/// Points towards the low sun, over the viewer's right shoulder.
const DIRECTION_TO_SUN: DVec3 = DVec3::new(0.22, 0.22, 1.0);

const EYE: DVec3 = DVec3::new(0.0, 2.0, 0.0);
const FIGURE_FOOT: DVec3 = DVec3::new(0.55, 0.0, 1.3);
const LAMP_POST_FOOT: DVec3 = DVec3::new(4.3, -0.02, 2.4);

/// Size of the square's slabs, and their numbers across and along.
const SLAB: f64 = 2.0;
const SLABS_ACROSS: u32 = 12;
const SLABS_ALONG: u32 = 10;
/// The z coordinate of the square's near edge, behind the viewer.
const NEAR_EDGE: f64 = 6.0;
const WALL_FRONT: f64 = -9.6;

const PALE_SLAB: [f32; 3] = [0.62, 0.56, 0.47];
const DARK_SLAB: [f32; 3] = [0.50, 0.44, 0.36];
const BED: [f32; 3] = [0.22, 0.20, 0.17];
const WALL: [f32; 3] = [0.66, 0.50, 0.36];
const COPING: [f32; 3] = [0.60, 0.57, 0.52];
const IRON: [f32; 3] = [0.06, 0.07, 0.08];
const WOOD: [f32; 3] = [0.36, 0.20, 0.09];
const CLAY: [f32; 3] = [0.52, 0.20, 0.10];
const LEAVES: [f32; 3] = [0.10, 0.24, 0.07];
const BALL: [f32; 3] = [0.65, 0.08, 0.06];
const LIMBS: [f32; 3] = [0.70, 0.52, 0.34];

/// The profiles of the figure and the lamp post, bottom to top, as (radius, height).
const TORSO: [(f64, f64); 11] = [
    (0.0, 0.80),
    (0.12, 0.82),
    (0.17, 0.90),
    (0.165, 1.00),
    (0.14, 1.12),
    (0.18, 1.30),
    (0.20, 1.40),
    (0.16, 1.47),
    (0.06, 1.51),
    (0.055, 1.60),
    (0.0, 1.61),
];
const HAT: [(f64, f64); 7] =
    [(0.0, 1.75), (0.22, 1.74), (0.22, 1.755), (0.115, 1.765), (0.105, 1.86), (0.08, 1.88), (0.0, 1.87)];
const LAMP_POST: [(f64, f64); 14] = [
    (0.0, 0.0),
    (0.18, 0.0),
    (0.18, 0.25),
    (0.08, 0.35),
    (0.05, 0.45),
    (0.04, 2.70),
    (0.09, 2.74),
    (0.09, 2.78),
    (0.13, 2.80),
    (0.21, 3.18),
    (0.27, 3.20),
    (0.06, 3.40),
    (0.03, 3.50),
    (0.0, 3.52),
];
const POT: [(f64, f64); 7] =
    [(0.0, 0.0), (0.26, 0.0), (0.38, 0.50), (0.43, 0.51), (0.43, 0.60), (0.36, 0.60), (0.0, 0.54)];

const CYPRESS: [(f64, f64); 9] = [
    (0.0, 0.0),
    (0.09, 0.0),
    (0.08, 0.35),
    (0.42, 0.55),
    (0.55, 1.00),
    (0.50, 1.80),
    (0.32, 2.70),
    (0.13, 3.40),
    (0.0, 3.75),
];

/// The figure's limbs: (from, to, radius there and there), upright, facing −z, its right arm raised.
const LIMB_ENDS: [(DVec3, DVec3, [f64; 2]); 6] = [
    (DVec3::new(0.09, 0.86, 0.0), DVec3::new(0.20, 0.07, 0.0), [0.095, 0.05]),
    (DVec3::new(-0.09, 0.86, 0.0), DVec3::new(-0.20, 0.07, 0.0), [0.095, 0.05]),
    (DVec3::new(0.19, 1.41, 0.0), DVec3::new(0.46, 1.46, 0.0), [0.06, 0.045]),
    (DVec3::new(0.46, 1.46, 0.0), DVec3::new(0.56, 1.80, 0.0), [0.045, 0.038]),
    (DVec3::new(-0.19, 1.41, 0.0), DVec3::new(-0.45, 1.20, 0.0), [0.06, 0.045]),
    (DVec3::new(-0.45, 1.20, 0.0), DVec3::new(-0.17, 1.00, 0.0), [0.045, 0.038]),
];

/// Makes the scene with its camera and its low sun.
pub(super) fn make() -> LoadedScene {
    let mut builder = MeshBuilder::default();
    add_square(&mut builder);
    add_wall(&mut builder);
    add_things_in_front(&mut builder);
    add_figure(&mut builder);
    add_upright(&mut builder, &LAMP_POST, LAMP_POST_FOOT, IRON);
    let (mesh, left_out) = builder.finish();
    LoadedScene {
        name: "behind".into(),
        mesh,
        camera: Some(Camera {
            eye: EYE,
            forward: (DVec3::new(0.0, 0.45, -6.0) - EYE).normalize(),
            up: DVec3::Y,
            fov_y: 48_f64.to_radians(),
            near: Some(1.0),
            far: Some(24.0),
        }),
        lights: vec![LightSpec::Sun { direction_to_light: DIRECTION_TO_SUN }],
        left_out,
    }
}

fn add_square(builder: &mut MeshBuilder) {
    let half_width = 0.5 * SLAB * f64::from(SLABS_ACROSS);
    let far_edge = NEAR_EDGE - SLAB * f64::from(SLABS_ALONG);
    let (min, max) = (DVec3::new(-half_width, -0.30, far_edge), DVec3::new(half_width, -0.08, NEAR_EDGE));
    add_box(builder, min - 0.1 * DVec3::X, max + 0.1 * DVec3::X, DMat4::IDENTITY, BED);
    for across in 0..SLABS_ACROSS {
        for along in 0..SLABS_ALONG {
            let colour = if (across + along) % 2 == 0 { PALE_SLAB } else { DARK_SLAB };
            let far_left =
                DVec3::new(SLAB * f64::from(across) - half_width, 0.0, far_edge + SLAB * f64::from(along));
            // The feet of the slabs sink into their bed.
            let (foot, top) = (far_left - 0.12 * DVec3::Y, far_left + SLAB * DVec3::new(1.0, 0.0, 1.0));
            add_slab(builder, foot, top, 0.02, colour);
        }
    }
}

/// The low wall along the far side, with a coping and a pillar at each end. Everything that stands is sunk a little
/// into the square, so that no two surfaces coincide.
fn add_wall(builder: &mut MeshBuilder) {
    let mut add = |min: [f64; 3], max: [f64; 3], colour| {
        add_box(builder, min.into(), max.into(), DMat4::IDENTITY, colour);
    };
    add([-5.9, -0.05, WALL_FRONT - 0.4], [5.9, 1.10, WALL_FRONT], WALL);
    add([-5.8, 1.08, WALL_FRONT - 0.45], [5.8, 1.20, WALL_FRONT + 0.05], COPING);
    for x in [-6.0, 6.0] {
        add([x - 0.35, -0.07, WALL_FRONT - 0.55], [x + 0.35, 1.60, WALL_FRONT + 0.15], WALL);
        add([x - 0.42, 1.58, WALL_FRONT - 0.62], [x + 0.42, 1.72, WALL_FRONT + 0.22], COPING);
    }
}

/// A bench, a pot with a shrub, a ball, and cypresses beyond the wall.
fn add_things_in_front(builder: &mut MeshBuilder) {
    let world_from_bench = DMat4::from_translation(DVec3::new(-4.4, 0.0, -8.2)) * DMat4::from_rotation_y(0.25);
    let mut add = |min: [f64; 3], max: [f64; 3], colour| {
        add_box(builder, min.into(), max.into(), world_from_bench, colour);
    };
    for x in [-0.7, 0.7] {
        add([x - 0.05, -0.02, -0.27], [x + 0.05, 0.42, 0.20], IRON);
        add([x - 0.04, 0.30, -0.30], [x + 0.04, 0.90, -0.25], IRON);
    }
    for z in [-0.16, 0.0, 0.16] {
        add([-0.9, 0.41, z - 0.06], [0.9, 0.46, z + 0.06], WOOD);
    }
    for y in [0.58, 0.76] {
        add([-0.9, y, -0.26], [0.9, y + 0.11, -0.21], WOOD);
    }

    let pot = DVec3::new(3.9, -0.02, -7.4);
    add_upright(builder, &POT, pot, CLAY);
    add_ball(builder, pot + DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.55, 0.55, 0.55), LEAVES);
    add_ball(builder, DVec3::new(1.9, 0.16, -6.2), DVec3::splat(0.17), BALL);
    for (x, z) in [(-6.9, -12.6), (-2.3, -12.2)] {
        add_upright(builder, &CYPRESS, DVec3::new(x, -0.03, z), LEAVES);
    }
}

/// The figure behind the viewer: a mannequin with a hat.
fn add_figure(builder: &mut MeshBuilder) {
    // Broad from the front, slender from the side.
    let flattened = DMat4::from_translation(FIGURE_FOOT) * DMat4::from_scale(DVec3::new(1.0, 1.0, 0.65));
    add_turned(builder, &TORSO.map(DVec2::from), flattened, LIMBS);
    add_ball(builder, FIGURE_FOOT + 1.68 * DVec3::Y, DVec3::new(0.10, 0.13, 0.11), LIMBS);
    add_upright(builder, &HAT, FIGURE_FOOT, IRON);
    for (from, to, radii) in LIMB_ENDS {
        add_limb(builder, FIGURE_FOOT + from, FIGURE_FOOT + to, radii);
    }
    for x in [-0.20, 0.20] {
        add_ball(builder, FIGURE_FOOT + DVec3::new(x, 0.05, -0.07), DVec3::new(0.06, 0.06, 0.15), LIMBS);
    }
}

/// A limb with round ends whose middles are `from` and `to`.
fn add_limb(builder: &mut MeshBuilder, from: DVec3, to: DVec3, radii: [f64; 2]) {
    let length = from.distance(to);
    let cap = |end: usize, angles: [f64; 3]| {
        angles.map(|angle| DVec2::new(0.0, length * end as f64) + radii[end] * DVec2::from_angle(angle))
    };
    let mut profile = vec![DVec2::new(0.0, -radii[0])];
    profile.extend(cap(0, [-PI / 3.0, -PI / 6.0, 0.0]));
    profile.extend(cap(1, [0.0, PI / 6.0, PI / 3.0]));
    profile.push(DVec2::new(0.0, length + radii[1]));
    let turn = DQuat::from_rotation_arc(DVec3::Y, (to - from).normalize_or(DVec3::Y));
    add_turned(builder, &profile, DMat4::from_rotation_translation(turn, from), LIMBS);
}

/// An ellipsoid.
fn add_ball(builder: &mut MeshBuilder, middle: DVec3, radii: DVec3, colour: [f32; 3]) {
    const STRETCHES: u32 = 8;
    let profile: Vec<DVec2> = (0..=STRETCHES)
        .map(|i| match i {
            // Exactly on the axis, as rounding would leave thin triangles there.
            0 => DVec2::NEG_Y,
            STRETCHES => DVec2::Y,
            _ => DVec2::from_angle(PI * (f64::from(i) / f64::from(STRETCHES) - 0.5)),
        })
        .collect();
    add_turned(builder, &profile, DMat4::from_translation(middle) * DMat4::from_scale(radii), colour);
}

fn add_upright(builder: &mut MeshBuilder, profile: &[(f64, f64)], foot: DVec3, colour: [f32; 3]) {
    let profile: Vec<DVec2> = profile.iter().copied().map(DVec2::from).collect();
    add_turned(builder, &profile, DMat4::from_translation(foot), colour);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Lens;

    #[test]
    fn the_square_reaches_from_behind_the_viewer_to_beyond_the_wall() {
        let scene = make();
        let (min, max) = scene.mesh.bounds();
        assert_eq!((min.x, max.x), (-12.1, 12.1));
        assert_eq!((min.y, max.y), (-0.30, 3.72));
        assert_eq!((min.z, max.z), (-14.0, 6.0));
        assert!(scene.left_out.is_nothing(), "{}", scene.left_out);
        assert!(scene.mesh.triangles.len() <= 20_000, "{}", scene.mesh.triangles.len());
    }

    #[test]
    fn the_figure_and_the_lamp_post_are_behind_the_eye_and_their_shadows_in_view() {
        let camera = make().camera.expect("the scene has a camera");
        let view = camera.view(1.6, 1.0, 24.0).expect("a sound camera");
        let lens = Lens::of_view(&view).expect("invertible");
        let mut figure = MeshBuilder::default();
        add_figure(&mut figure);
        let mut lamp_post = MeshBuilder::default();
        add_upright(&mut lamp_post, &LAMP_POST, LAMP_POST_FOOT, IRON);
        // The post's shadow climbs the wall, which stands in front of where its end would meet the ground.
        for (caster, least_share) in [(figure, 0.5), (lamp_post, 0.0)] {
            let vertices = caster.finish().0.vertices;
            assert!(vertices.iter().all(|&p| (p - camera.eye).dot(camera.forward) < 0.0));
            let in_view = vertices.iter().filter(|p| {
                let shadow = **p - p.y / DIRECTION_TO_SUN.y * DIRECTION_TO_SUN;
                let [x, y, z] = lens.project(shadow).to_array();
                x.abs() <= 1.0 && y.abs() <= 1.0 && (0.0..=1.0).contains(&z)
            });
            let share = in_view.count() as f64 / vertices.len() as f64;
            assert!(share > least_share, "{share}");
        }
    }
}
