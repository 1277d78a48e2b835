//! Any numbers at all as a view, as a light, and as a scene.

use proptest::prelude::*;
use shadowfit::Settings;

use super::results::exercise;
use crate::arbitrary::{Case, Frame, LightParams, Pose, SceneParams, ViewParams, clip_space, number_bits};

/// Cases of any numbers, most of which some constructor refuses.
pub fn anything() -> impl Strategy<Value = Case> {
    let number = || prop_oneof![3 => -5.0..5.0, 1 => number_bits()];
    let triple = move || [number(), number(), number()];
    let pose = (triple(), triple(), triple()).prop_map(|(eye, forward, up)| Pose { eye, forward, up });
    let maybe = move || prop::option::of(number());
    let view = prop_oneof![
        (pose.clone(), number(), number(), number(), maybe()).prop_map(|(pose, fov_y, aspect, near, far)| {
            ViewParams::Perspective { pose, fov_y, aspect, near, far }
        }),
        (pose.clone(), number(), number(), number(), number()).prop_map(
            |(pose, half_height, aspect, near, far)| {
                ViewParams::Orthographic { pose, half_height, aspect, near, far }
            }
        ),
        (
            pose.clone(),
            any::<bool>(),
            number(),
            [number(), number(), number(), number()],
            (number(), maybe()),
            clip_space()
        )
            .prop_map(|(pose, mirrored, scale, slopes, (near, far), clip)| ViewParams::Matrices {
                pose,
                mirrored,
                scale,
                frame: Frame { slopes, near, far },
                clip,
            }),
        (
            pose,
            any::<bool>(),
            prop::option::of([number(), number(), number(), number()]),
            [number(), number(), number(), number()],
            (number(), maybe()),
            clip_space()
        )
            .prop_map(|(pose, mirrored, near_plane, slopes, (near, far), clip)| {
                ViewParams::Combined { pose, mirrored, frame: Frame { slopes, near, far }, near_plane, clip }
            }),
    ];
    let light =
        prop_oneof![
            triple().prop_map(|direction_to_light| LightParams::Directional { direction_to_light }),
            (triple(), number(), maybe()).prop_map(|(position, near, range)| LightParams::Point {
                position,
                near,
                range
            }),
            (triple(), triple(), number(), number(), maybe()).prop_map(
                |(position, axis, half_angle, near, range)| {
                    LightParams::Spot { position, axis, half_angle, near, range }
                }
            ),
            (triple(), triple(), number(), maybe())
                .prop_map(|(position, axis, near, range)| LightParams::Hemisphere { position, axis, near, range }),
            (triple(), prop::option::of(triple()), number(), maybe(), 0..6_usize, number()).prop_map(
                |(position, axis, near, range, face, overlap)| {
                    LightParams::CubeFace { position, axis, near, range, face, overlap }
                }
            ),
        ];
    let planes = prop::collection::vec([number(), number(), number(), number()], 0..14);
    let boxes = move || {
        prop::collection::vec([triple(), triple()].prop_map(|ends| ends.map(|end| end.map(|x| x as f32))), 0..3)
    };
    let scene = prop_oneof![
        (triple(), triple()).prop_map(|(min, max)| SceneParams::Bounds { min, max }),
        (triple(), triple(), planes).prop_map(|(min, max, planes)| SceneParams::Cut { min, max, planes }),
        (boxes(), boxes()).prop_map(|(casters, receivers)| SceneParams::Lists { casters, receivers }),
    ];
    (view.boxed(), light.boxed(), scene.boxed()).prop_map(|(view, light, scene)| Case { view, light, scene })
}

/// Asserts that each part of any case, beside the parts of a legal one, makes a fit or a typed error, and all of it too.
pub fn makes_a_fit_or_a_typed_error(any: &Case, legal: &Case, settings: &Settings) {
    let (view, light) = legal.build();
    let (any_view, any_light, any_scene) = (any.view.build(), any.light.build(), any.scene.store());
    let store = legal.scene.store();
    let scene = store.scene().expect("the scene is accepted");
    if let Ok(view) = &any_view {
        exercise(view, &light, &scene, settings);
    }
    if let Ok(light) = &any_light {
        exercise(&view, light, &scene, settings);
    }
    if let Ok(scene) = &any_scene.scene() {
        exercise(&view, &light, scene, settings);
    }
    if let (Ok(view), Ok(light), Ok(scene)) = (&any_view, &any_light, &any_scene.scene()) {
        exercise(view, light, scene, settings);
    }
}
