//! Small changes to the numbers of a case: what coincides, what is a few ulps off, what has another size.

use super::primitive::nudged;
use super::{Case, LightParams, Pose, SceneParams, ViewParams};

/// The case after as many changes as there are fours of bytes: which number, what is done to it, by how much or with
/// which other number.
pub(super) fn edited(case: &Case, edits: &[u8]) -> Case {
    let mut numbers = numbers(case);
    for &[which, what, with, sign] in edits.as_chunks::<4>().0.iter().take(8) {
        let (which, other) = (usize::from(which) % numbers.len(), numbers[usize::from(with) % numbers.len()]);
        let number = numbers[which];
        let steps = if sign % 2 == 0 { with as i8 } else { (with % 8) as i8 - 4 };
        numbers[which] = match what % 6 {
            0 => other,
            1 => nudged(number, steps),
            2 => -number,
            3 => number * f64::powi(2.0, i32::from(steps) / 8),
            4 => 0.5 * (number + other),
            _ => 0.0,
        };
    }
    let (mut case, mut changed) = (case.clone(), numbers.into_iter());
    each_number(&mut case, &mut |number| *number = changed.next().unwrap_or(*number));
    case
}

/// All numbers of a case.
pub fn numbers(case: &Case) -> Vec<f64> {
    let mut numbers = Vec::new();
    each_number(&mut case.clone(), &mut |number| numbers.push(*number));
    numbers
}

fn each_number(case: &mut Case, change: &mut impl FnMut(&mut f64)) {
    of_view(&mut case.view, change);
    of_light(&mut case.light, change);
    of_scene(&mut case.scene, change);
}

fn of_view(view: &mut ViewParams, change: &mut impl FnMut(&mut f64)) {
    let mut of_pose =
        |Pose { eye, forward, up }: &mut Pose| [eye, forward, up].into_iter().flatten().for_each(&mut *change);
    match view {
        ViewParams::Perspective { pose, fov_y, aspect, near, far } => {
            of_pose(pose);
            [fov_y, aspect, near].into_iter().chain(far).for_each(change);
        }
        ViewParams::Orthographic { pose, half_height, aspect, near, far } => {
            of_pose(pose);
            [half_height, aspect, near, far].into_iter().for_each(change);
        }
        ViewParams::Matrices { pose, scale, frame, .. } => {
            of_pose(pose);
            change(scale);
            frame.slopes.iter_mut().chain([&mut frame.near]).chain(&mut frame.far).for_each(change);
        }
        ViewParams::Combined { pose, frame, near_plane, .. } => {
            of_pose(pose);
            let frame = frame.slopes.iter_mut().chain([&mut frame.near]).chain(&mut frame.far);
            frame.chain(near_plane.iter_mut().flatten()).for_each(change);
        }
    }
}

fn of_light(light: &mut LightParams, change: &mut impl FnMut(&mut f64)) {
    match light {
        LightParams::Directional { direction_to_light } => direction_to_light.iter_mut().for_each(change),
        LightParams::Point { position, near, range } => {
            position.iter_mut().chain([near]).chain(range).for_each(change)
        }
        LightParams::Spot { position, axis, half_angle, near, range } => {
            position.iter_mut().chain(axis).chain([half_angle, near]).chain(range).for_each(change);
        }
        LightParams::Hemisphere { position, axis, near, range } => {
            position.iter_mut().chain(axis).chain([near]).chain(range).for_each(change);
        }
        LightParams::Pyramid { position, axis, up, tangents, near, range } => {
            position.iter_mut().chain(axis).chain(up).chain(tangents).chain([near]).chain(range).for_each(change);
        }
        LightParams::Within { position, near, range, planes } => {
            position.iter_mut().chain(planes.iter_mut().flatten()).chain([near]).chain(range).for_each(change);
        }
        LightParams::CubeFace { position, axis, near, range, overlap, .. } => {
            position
                .iter_mut()
                .chain(axis.iter_mut().flatten())
                .chain([near, overlap])
                .chain(range)
                .for_each(change);
        }
    }
}

fn of_scene(scene: &mut SceneParams, change: &mut impl FnMut(&mut f64)) {
    match scene {
        SceneParams::Bounds { min, max } => min.iter_mut().chain(max).for_each(change),
        SceneParams::Cut { min, max, planes } => {
            min.iter_mut().chain(max).chain(planes.iter_mut().flatten()).for_each(change);
        }
        SceneParams::Lists { casters, receivers } => {
            for number in casters.iter_mut().chain(receivers).flatten().flatten() {
                let mut wide = f64::from(*number);
                change(&mut wide);
                *number = wide as f32;
            }
        }
    }
}
