//! Points that stand for the surfaces in view: given ones, or guessed from boxes or from R alone.

use crate::convex::{Plane, Polyhedron};
use crate::focus::Focus;
use crate::input::scene::Region;
use crate::math::bounds::{least, most};
use crate::seen::SeenPoint;
use glam::{DVec2, DVec3};

/// Lines of sight through the image, across and down, where boxes stand for the surfaces.
const LINES: [usize; 2] = [12, 8];

/// Lines of sight where nothing is known but R, and the parts of the way through R where a surface may be: most often towards the
/// end.
const FEW_LINES: [usize; 2] = [6, 4];
const PARTS: [f64; 3] = [1.0, 0.5, 0.25];

impl Focus<'_> {
    /// The most points that [`Self::for_each_surface`] passes.
    pub(crate) const MAX_SURFACES: usize = 256;

    /// Calls `each` with points that stand for the receivers in view, weighted by the pixels that they stand for.
    ///
    /// What is known decides: seen points; the receivers' boxes, met by lines of sight; or R, in which a line of sight may end
    /// anywhere.
    pub(crate) fn for_each_surface(&self, mut each: impl FnMut(SeenPoint)) {
        let (mut found, planes) = (false, Planes::of(self));
        let mut pass = |point: SeenPoint| {
            if planes.hold(point.position) {
                found = true;
                each(point);
            }
        };
        if let Some(seen) = &self.seen {
            seen.for_each_sample(Self::MAX_SURFACES, &mut pass);
        } else if !self.standing.is_empty() {
            let view = &self.view;
            for place in places(LINES) {
                let (from, step) = view.ray(place);
                if let Some(hit) = self.standing.hit(from, step, view.near()) {
                    pass(SeenPoint { position: from + step * hit.depth, normal: Some(hit.normal), pixels: 1.0 });
                }
            }
        }
        if !found {
            self.for_each_part(each);
        }
    }

    /// Calls `each` with points on lines of sight through R.
    fn for_each_part(&self, mut each: impl FnMut(SeenPoint)) {
        let view = &self.view;
        for place in places(FEW_LINES) {
            let (from, step) = view.ray(place);
            let (mut near, mut far) = (view.near(), view.far());
            let mut cut = |plane: Plane| {
                let (at, change) = (plane.at(from), plane.normal.dot(step));
                // Without change the line of sight is inside at all depths or at none.
                let depth = -at / change;
                if change > 0.0 {
                    near = most(near, depth);
                } else if change < 0.0 {
                    far = least(far, depth);
                } else if at < 0.0 {
                    far = near;
                }
            };
            self.for_each_plane(&mut cut);
            [view.near_cut, view.far_cut].into_iter().flatten().for_each(cut);
            // It fades as the line of sight leaves R.
            let pixels = (far - near) / (far.abs() + near.abs());
            for part in PARTS {
                let position = from + step * (near + (far - near) * part);
                if pixels > 0.0 && position.is_finite() {
                    each(SeenPoint { position, normal: None, pixels });
                }
            }
        }
    }
}

/// The planes of R, moved outwards by the rounding of what lies on them.
struct Planes {
    planes: [Plane; Polyhedron::MAX_PLANES],
    len: usize,
}

impl Planes {
    fn of(focus: &Focus<'_>) -> Self {
        let mut all = Self { planes: [Plane::ONE; Polyhedron::MAX_PLANES], len: 0 };
        let extent = focus.receivers.as_ref().map_or(DVec3::ZERO, Region::extent);
        let mut push = |plane: Plane| {
            if let Some(slot) = all.planes.get_mut(all.len) {
                let size = plane.normal.abs().dot(extent) + plane.offset.abs();
                *slot = plane + Plane::ONE * (size * ROUNDING);
                all.len += 1;
            }
        };
        focus.for_each_plane(&mut push);
        focus.view_planes.iter().for_each(|plane| push(*plane));
        all
    }

    fn hold(&self, point: DVec3) -> bool {
        self.planes[..self.len].iter().all(|plane| plane.at(point) >= 0.0)
    }
}

/// The rounding of points that come from depth buffers in f32, relative to the terms of a plane.
const ROUNDING: f64 = 1.0 / 1_048_576.0;

/// Places spread evenly over the image, from 0 to 1.
fn places([across, down]: [usize; 2]) -> impl Iterator<Item = DVec2> {
    (0..across * down).map(move |i| {
        DVec2::new(((i % across) as f64 + 0.5) / across as f64, ((i / across) as f64 + 0.5) / down as f64)
    })
}
