//! The receivers that take most of the image, which stand for what is seen where nothing else is known.

use crate::input::scene::DAabb;
use crate::input::view::{Lens, View};
use glam::DVec3;

/// The largest receivers in the image.
#[derive(Clone, Debug)]
pub(crate) struct Standing {
    /// Each with a measure of its size in the image.
    boxes: [(f64, DAabb); Self::MAX],
    len: usize,
}

/// A place where a line of sight meets a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    /// The parameter of the line.
    pub(crate) depth: f64,
    /// The normal towards the eye.
    pub(crate) normal: DVec3,
}

impl Standing {
    const MAX: usize = 16;

    const NOTHING: DAabb = DAabb { min: DVec3::ZERO, max: DVec3::ZERO };

    pub(crate) const NONE: Self = Self { boxes: [(0.0, Self::NOTHING); Self::MAX], len: 0 };

    /// Includes a receiver, if it is among the largest.
    pub(crate) fn include(&mut self, view: &View, one: DAabb) {
        let across = (one.max - one.min).length_squared();
        let size = match view.lens() {
            Lens::Orthographic => across,
            Lens::Perspective => {
                let apart = view.eye().clamp(one.min, one.max).distance_squared(view.eye());
                // A box around the eye is as large as can be.
                if apart > 0.0 { across / apart } else { f64::INFINITY }
            }
        };
        if self.len < Self::MAX {
            self.boxes[self.len] = (size, one);
            self.len += 1;
            return;
        }
        let (mut smallest, mut of) = (f64::INFINITY, 0);
        for (index, &(its, _)) in self.boxes.iter().enumerate() {
            if its < smallest {
                (smallest, of) = (its, index);
            }
        }
        if size > smallest {
            self.boxes[of] = (size, one);
        }
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Where a line of sight first enters a box, beyond the depth `near`; `None` where it enters none.
    pub(crate) fn hit(&self, from: DVec3, step: DVec3, near: f64) -> Option<Hit> {
        let inverse = inverse(step);
        let mut found: Option<Hit> = None;
        for (_, DAabb { min, max }) in &self.boxes[..self.len] {
            let (a, b) = ((*min - from) * inverse, (*max - from) * inverse);
            let (enter, leave) = (a.min(b), a.max(b));
            let depth = enter.max_element();
            if depth > near && depth <= leave.min_element() && found.is_none_or(|found| depth < found.depth) {
                let axis = if enter.x == depth {
                    DVec3::X
                } else if enter.y == depth {
                    DVec3::Y
                } else {
                    DVec3::Z
                };
                let normal = if axis.dot(step) > 0.0 { -axis } else { axis };
                found = Some(Hit { depth, normal });
            }
        }
        found
    }
}

/// One over each component; huge for those that are zero, so that nothing becomes NaN.
fn inverse(step: DVec3) -> DVec3 {
    DVec3::select(step.cmpeq(DVec3::ZERO), DVec3::splat(1e30), step.recip())
}
