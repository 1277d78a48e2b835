//! The receivers in view, found once for all lights.

use super::groups::{Groups, loosened};
use super::objects::Objects;
use crate::convex::Polyhedron;
use crate::focus::{Focus, VIEW_IDS, clip_all, farthest_corner};
use crate::input::scene::{Aabb, Region};
use crate::input::view::View;
use crate::math::bounds::Interval;
use alloc::vec::Vec;
use glam::DVec3;

/// The receivers in view, and the view narrowed to them.
pub(super) struct Seen {
    pub(super) view: View,
    pub(super) receivers: Groups,
}

impl Seen {
    pub(super) fn new(view: &View, objects: &Objects) -> Self {
        let mut visible = Vec::new();
        let planes = loosened(view.planes().as_slice(), objects.extent);
        objects.receivers.for_each_inside(&planes, |id, one| visible.push((id, *one)));
        let view = narrowed(view, &visible, objects.extent).unwrap_or(*view);
        // They come sorted.
        Self { view, receivers: Groups::new(visible.into_iter()) }
    }
}

/// The view between the nearest and the farthest point of the receivers in it.
///
/// A warp follows the view from its near plane on, so that a near plane in the air before all receivers wastes texels
/// there. The boxes stand in for a depth read-back (PSM §6), less exactly.
fn narrowed(view: &View, visible: &[(u32, Aabb)], extent: DVec3) -> Option<View> {
    let forward = view.forward();
    let mut depths: Vec<(Interval, &Aabb)> = visible
        .iter()
        .map(|(_, one)| {
            let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
            let depth = |along| view.depth(farthest_corner(min, max, along));
            (Interval { min: depth(-forward), max: depth(forward) }, one)
        })
        .collect();
    depths.sort_by(|(a, _), (b, _)| a.min.total_cmp(&b.min));
    // The nearest corner of a box may be out of view. Boxes are cut one after another until the rest are all farther.
    let (mut body, mut found) = (Polyhedron::EMPTY, Interval::EMPTY);
    for (depth, one) in &depths {
        found.max = found.max.max(depth.max);
        if depth.min < found.min {
            body.set_box(one.min.as_dvec3(), one.max.as_dvec3());
            clip_all(&mut body, view.planes().as_slice(), VIEW_IDS, extent, |_, _| ());
            body.positions().for_each(|point| found.min = found.min.min(view.depth(point)));
        }
    }
    // Room for the rounding of all this and of the planes at these depths.
    let slack = 64.0 * f64::EPSILON * (forward.abs().dot(extent) + view.eye().abs().element_sum());
    let (near, far) = (view.near().max(found.min - slack), view.far().min(found.max + slack));
    view.narrowed(near, far).ok()
}

/// How many receivers stand for all that a light can reach, see [`points`].
const STANDING: usize = 8;

/// The points where maps are compared: the corners of the largest receivers in the image, cut by the view and by the
/// light's reach.
///
/// Corners of R alone would include those of the view in the air, where nobody looks.
pub(super) fn points(focus: &Focus<'_>, receivers: &[Aabb]) -> Vec<DVec3> {
    let eye = focus.view().eye().as_vec3();
    let size = |one: &Aabb| {
        let nearest = eye.clamp(one.min, one.max);
        // A box around the eye is as large as can be.
        (one.max - one.min).length_squared() / (nearest - eye).length_squared()
    };
    let mut largest: Vec<(f32, usize)> = receivers.iter().map(size).zip(0..).collect();
    if largest.len() > STANDING {
        largest.select_nth_unstable_by(STANDING, |(a, i), (b, j)| b.total_cmp(a).then(i.cmp(j)));
        largest.truncate(STANDING);
    }
    let (mut body, mut points) = (Polyhedron::EMPTY, Vec::new());
    for (_, index) in largest {
        let Aabb { min, max } = receivers[index];
        let region = Region::Box { min: min.as_dvec3(), max: max.as_dvec3() };
        focus.cut_visible_part(&mut body, &region, |_, _| ());
        points.extend(body.positions());
    }
    // Points nearer to a light than anything casts need not be right.
    let light = focus.light();
    points.retain(|&point| light.position().is_none_or(|position| position.distance(point) >= light.near()));
    points
}
