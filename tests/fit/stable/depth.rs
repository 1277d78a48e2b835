//! The depth range: it changes rarely.

use super::cameras::{
    Form, Lens, Pose, form, lens, off_whole, rows, sides, stable, texels, texels_in_f32, two_poses,
};
use glam::{DQuat, DVec3};
use shadowfit::{Light, Origin, Settings, ShadowMap, Warp, fit};
use testkit::arbitrary::{self, run};

/// Both ends of the depth range are whole steps from the world's origin, a sixteenth of the window each.
#[test]
fn depth_ranges_of_a_sun_move_in_steps() {
    let cases = (lens(), two_poses(), form(), arbitrary::rotation(), stable());
    run(1000, &cases, |(lens, poses, form, sun, settings)| {
        let settings = settings.with_origin(Origin::Eye);
        let light = Light::directional(sun * DVec3::Y).expect("a legal light");
        form.with(DVec3::ZERO, |scene| {
            let maps = poses.map(|pose| fit(&lens.view(DVec3::ZERO, &pose), &light, scene, &settings).into_map());
            let [Some(one), Some(other)] = maps else { return };
            let ends = |map: &ShadowMap| {
                let row = rows(map).z_axis;
                let length = row.truncate().length().recip();
                [-row.w * length, (1.0 - row.w) * length]
            };
            let step = one.window().width.max(one.window().height) / 16.0;
            // A step is made of 13 bits, a little more than that part of the window.
            let steps = |step: f64| [ends(&one), ends(&other)].concat().into_iter().map(move |end| end / step);
            let step = rounded_up(step);
            for steps in steps(step) {
                assert!((steps - steps.round()).abs() <= 1e-9 * steps.abs().max(1.0), "{steps}");
            }
            if ends(&one) == ends(&other) {
                assert_eq!(rows(&one).z_axis, rows(&other).z_axis);
            }
        });
    });
}

/// To 13 bits.
fn rounded_up(number: f64) -> f64 {
    let unit = 2.0_f64.powi(number.log2().floor() as i32 - 12);
    (number / unit).ceil() * unit
}

/// A walk of six units while turning by a radian, a thousand kilometres out: the light's depth is the same in most frames, and
/// texels are in all.
///
/// The ball around V has a radius of 103 and its middle is 100 before the eye, so that the depth of what is visible, and the
/// place of the window, move by 106 at most: 8 steps of a sixteenth of the window, and one begun. Casters in the window
/// begin at the top of the scene, which slants by 0.45 across the light: 4 steps, and one begun.
#[test]
fn a_walk_changes_depth_rarely_and_texels_never() {
    let middle = DVec3::new(1e6, 0.0, -1e6);
    let lens = Lens { fov_y: 1.0, aspect: 1.6, near: 0.1, far: 100.0, orthographic: false };
    let settings = Settings::default().with_warp(Warp::Stable).with_origin(Origin::Eye);
    let light = Light::directional((0.4, 1.0, 0.2)).expect("sound");
    let maps: Vec<(ShadowMap, DVec3)> = (0..100)
        .map(|frame| {
            let frame = f64::from(frame);
            let turn = DQuat::from_rotation_y(0.01 * frame) * DQuat::from_rotation_x(-0.1);
            let pose = Pose { eye: [0.05 * frame, 1.7, -0.03 * frame], turn };
            let view = lens.view(middle, &pose);
            let fitted = Form::Block.with(middle, |scene| fit(&view, &light, scene, &settings));
            (fitted.into_map().expect("one map does"), view.eye())
        })
        .collect();
    let (first, first_eye) = &maps[0];
    let at = middle + DVec3::new(3.0, 0.0, -20.0);
    let in_f32 = |map: &ShadowMap, eye: DVec3| texels_in_f32(map, (at - eye).as_vec3());
    for (map, eye) in &maps {
        assert_eq!(sides(map), sides(first));
        // A row's terms are 3·10⁷ texels, with four roundings of 2⁻⁵² in either map.
        assert!(off_whole(texels(map, at) - texels(first, at)) < 1e-7);
        // As said above, with d and half about the radius of the ball: 2¹⁰ · 2⁻²¹ · 7.5 for either map.
        assert!(off_whole(in_f32(map, *eye) - in_f32(first, *first_eye)) < 0.008);
    }
    let depths: Vec<_> = maps.iter().map(|(map, _)| rows(map).z_axis).collect();
    let changes = depths.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(changes <= 14, "{changes} changes");
}
