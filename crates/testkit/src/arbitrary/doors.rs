//! Cases through the wider doors: pyramids, lights within planes, convex scenes of many planes.
//!
//! They are made of other cases, so that a strategy for these changes none of those, nor what fuzzing has kept of them.

use proptest::prelude::*;
use shadowfit::glam::DVec3;

use super::primitive::direction;
use super::{Case, LightParams, SceneParams, case};

/// Cases with no more than so many planes that cut the scene.
pub fn wide_door(most_cuts: usize) -> impl Strategy<Value = Case> {
    let cuts = prop::collection::vec((direction(), 0.2..1.0), 1..=most_cuts);
    let light = (direction(), prop::array::uniform2(0.25..4.0), prop::array::uniform3((direction(), 0.0..2.0)));
    (case(), cuts, light)
        .prop_map(|(case, cuts, (up, parts, bounds))| {
            let (min, max) = case.scene.bounds();
            let (middle, half) =
                ((DVec3::from(min) + DVec3::from(max)) * 0.5, (DVec3::from(max) - DVec3::from(min)) * 0.5);
            // Planes that face the middle from this part of the way to where they would touch the box.
            let plane = |(normal, part): ([f64; 3], f64)| {
                let normal = DVec3::from(normal);
                normal.extend(normal.abs().dot(half) * part - normal.dot(middle)).to_array()
            };
            let light = match case.light {
                LightParams::Spot { position, axis, half_angle, near, range } => {
                    let tangents = parts.map(|part: f64| (half_angle.tan() * part).clamp(1e-6, 200.0));
                    LightParams::Pyramid { position, axis, up, tangents, near, range }
                }
                LightParams::Point { position, near, range } => {
                    LightParams::Within { position, near, range, planes: bounds.map(plane) }
                }
                other => other,
            };
            let scene = match case.scene {
                SceneParams::Bounds { min, max } => {
                    SceneParams::Cut { min, max, planes: cuts.into_iter().map(plane).collect() }
                }
                other => other,
            };
            Case { view: case.view, light, scene }
        })
        .prop_filter("refused at the door", Case::is_accepted)
}
