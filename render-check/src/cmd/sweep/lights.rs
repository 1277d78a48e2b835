//! Lights on paths through the boundaries between light classes.

use shadowfit::View;
use shadowfit::glam::{DQuat, DVec3};

use crate::scene::LightSpec;

/// A light and its description.
pub(super) type NamedLight = (String, LightSpec);

/// Samples of a path through a boundary at 0: the steps, 0 itself, and powers of ten on both sides.
fn through_zero(steps: &[f64]) -> Vec<f64> {
    let near = (1..=8).map(|k| 10_f64.powi(-k)).flat_map(|small| [-small, small]);
    let mut all: Vec<f64> = steps.iter().copied().chain([0.0]).chain(near).collect();
    all.sort_by(f64::total_cmp);
    all
}

fn sun(direction_to_light: DVec3) -> LightSpec {
    LightSpec::Sun { direction_to_light }
}

fn lamp(position: DVec3) -> LightSpec {
    LightSpec::Point { position, range: f64::INFINITY }
}

/// Suns on an arc from low in front of the viewer, through the image plane, where the class changes, to low behind,
/// slightly to the side.
pub(super) fn suns_across(view: &View) -> Vec<NamedLight> {
    let forward = view.forward();
    let ahead = DVec3::new(forward.x, 0.0, forward.z).normalize();
    let across = (ahead + 0.4 * ahead.cross(DVec3::Y)).normalize();
    // The elevation at which the sun's direction lies in the image plane; angles are measured from there.
    let in_plane = forward.dot(across).atan2(-forward.y);
    let degrees: Vec<f64> = (-12..=12).filter(|&i| i != 0).map(|i| 8.0 * f64::from(i)).collect();
    through_zero(&degrees)
        .into_iter()
        .map(|angle| {
            let elevation = in_plane + angle.to_radians();
            (angle, elevation.cos() * across + elevation.sin() * DVec3::Y)
        })
        .filter(|(_, direction)| direction.y > 0.1)
        .map(|(angle, direction)| (format!("{angle:+e} degrees from the image plane"), sun(direction)))
        .collect()
}

/// Point lights to the right of the camera, from in front of its image plane to behind.
pub(super) fn lamps_through_the_plane(view: &View) -> Vec<NamedLight> {
    let beside = view.eye() + 5.0 * view.right() + 4.0 * view.up();
    let steps: Vec<f64> = (-8..=8).filter(|&i| i != 0).map(f64::from).collect();
    through_zero(&steps)
        .into_iter()
        .map(|ahead| {
            let position = beside + ahead * view.forward();
            (format!("{ahead:+e} before the camera's plane"), lamp(position))
        })
        .collect()
}

/// Suns and point lights behind the viewer, across the view axis.
pub(super) fn through_the_back(view: &View) -> Vec<NamedLight> {
    let steps = through_zero(&[-2.0, -1.0, -0.5, 0.5, 1.0, 2.0]);
    let suns = steps.iter().map(|&aside| {
        let turn = DQuat::from_axis_angle(view.up(), (5.0 * aside).to_radians());
        (format!("sun {:+e} degrees from straight behind", 5.0 * aside), sun(turn * -view.forward()))
    });
    let lamps = steps.iter().map(|&aside| {
        let position = view.eye() + aside * view.right() - 6.0 * view.forward();
        (format!("lamp {aside:+e} beside the axis behind the eye"), lamp(position))
    });
    suns.chain(lamps).collect()
}

#[cfg(test)]
mod tests {
    use shadowfit::warp::{ClassKind, classify};

    use super::*;

    fn view() -> View {
        let (eye, forward) = (DVec3::new(0.9, 2.1, 2.6), DVec3::new(-1.0, -2.0, -7.0));
        View::perspective(eye, forward, DVec3::Y, 0.73, 1.6, 1.0, 28.0).expect("sound")
    }

    fn classes(lights: &[NamedLight]) -> Vec<ClassKind> {
        let mut kinds: Vec<ClassKind> = Vec::new();
        for (_, spec) in lights {
            let kind = classify(&view(), &spec.to_light(0.01).expect("sound")).kind;
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
        kinds
    }

    #[test]
    fn suns_and_lamps_pass_through_every_class() {
        let suns = classes(&suns_across(&view()));
        let lamps = classes(&lamps_through_the_plane(&view()));
        assert!(suns.len() >= 2 && lamps.len() >= 2, "{suns:?} {lamps:?}");
        let all: Vec<_> = suns.into_iter().chain(lamps).map(|kind| kind.to_string()).collect();
        for class in ["point", "inverted", "infinity plane"] {
            assert!(all.iter().any(|kind| kind.contains(class)), "no {class} in {all:?}");
        }
    }
}
