//! What all contenders have in common: a fit that is timed, and what it says of maps and casters.

use std::hint::black_box;
use std::time::Duration;

use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{Aabb, focus::Plane};

use super::case::{Case, farthest_corner, in_f64};
use crate::timing::taken;

/// What a contender makes of a case, in the terms that all are judged in.
#[derive(Clone, Debug)]
pub(crate) struct Fitted {
    /// World to clip space, x and y from −1 to 1; `None` where it makes no map.
    pub(crate) shadow_from_world: Option<DMat4>,
    /// What the map holds of casters, inside ≥ 0: they are clipped by these.
    pub(crate) clip: Vec<Plane>,
    /// Whom it draws.
    pub(crate) culling: Culling,
}

impl Fitted {
    /// Whether all of it is finite, and every plane has a normal.
    fn is_sound(&self) -> bool {
        let culling = if let Culling::Planes(planes) = &self.culling { &planes[..] } else { &[] };
        let is_plane = |plane: &Plane| plane.to_row().is_finite() && plane.normal != DVec3::ZERO;
        self.shadow_from_world.is_none_or(|matrix| matrix.is_finite())
            && self.clip.iter().chain(culling).all(is_plane)
    }
}

/// How casters are chosen.
#[derive(Clone, Debug)]
pub(crate) enum Culling {
    /// Boxes that are not wholly outside of a plane, as engines cull by a frustum.
    Planes(Vec<Plane>),
    /// Boxes that meet a body, by its own test.
    Body(Box<shadowfit::focus::ConvexBody>),
    /// None.
    Nobody,
}

impl Culling {
    /// Which boxes are drawn.
    pub(crate) fn drawn(&self, boxes: &[Aabb]) -> Vec<bool> {
        match self {
            Self::Planes(planes) => boxes.iter().map(|one| !is_outside(planes, one)).collect(),
            Self::Body(body) => {
                let mut drawn = vec![false; boxes.len()];
                body.culler().boxes(boxes, &mut drawn);
                drawn
            }
            Self::Nobody => vec![false; boxes.len()],
        }
    }
}

/// Whether a box lies wholly outside of a plane.
fn is_outside(planes: &[Plane], one: &Aabb) -> bool {
    let (min, max) = in_f64(one);
    planes.iter().any(|plane| plane.at(farthest_corner(min, max, plane.normal)) < 0.0)
}

/// What becomes of casters before the near plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NearSide {
    /// They are culled and clipped.
    Closed,
    /// They are kept: culling leaves the near plane out, and drawing does not clip depth.
    #[cfg_attr(not(feature = "bevy"), allow(dead_code, reason = "it is Bevy that leaves it open"))]
    Open,
}

/// The planes of a matrix's clip volume, with depth from 0 to 1: left, right, bottom, top, the far one and the near one.
pub(crate) fn clip_planes(shadow_from_world: &DMat4, reversed: bool, near: NearSide) -> Vec<Plane> {
    let [x, y, z, w] = [0, 1, 2, 3].map(|row| shadow_from_world.row(row));
    let (nearest, farthest) = if reversed { (w - z, z) } else { (z, w - z) };
    let mut rows = vec![w + x, w - x, w + y, w - y, farthest];
    if near == NearSide::Closed {
        rows.push(nearest);
    }
    rows.into_iter().map(|row| Plane::new(row.truncate(), row.w)).collect()
}

/// A frustum that culls and clips by the planes of its matrix.
pub(crate) fn frustum(shadow_from_world: DMat4, reversed: bool, near: NearSide) -> Fitted {
    let clip = clip_planes(&shadow_from_world, reversed, near);
    Fitted { shadow_from_world: Some(shadow_from_world), culling: Culling::Planes(clip.clone()), clip }
}

/// All fits of some cases, and how long they take together.
type Turn<'a> = Box<dyn Fn(&[Case<'_>]) -> Duration + 'a>;

/// One way to fit a map or a body.
pub(crate) struct Contender<'a> {
    /// What it is called in tables and plots.
    pub(crate) name: &'static str,
    turn: Turn<'a>,
    fit: Fit<'a>,
}

/// What comes of the fit of a case.
type Fit<'a> = Box<dyn Fn(&Case<'_>) -> Option<Fitted> + 'a>;

impl<'a> Contender<'a> {
    /// Of a fit, which is timed, and of what turns its result into the terms of the judge, which is not.
    pub(crate) fn new<T: 'a>(
        name: &'static str,
        fit: impl Fn(&Case<'_>) -> Option<T> + Copy + 'a,
        finish: impl Fn(&Case<'_>, T) -> Fitted + 'a,
    ) -> Self {
        let turn = move |cases: &[Case<'_>]| {
            taken(|| {
                for case in cases {
                    black_box(fit(black_box(case)));
                }
            })
        };
        Self::of_turns(name, turn, move |case| fit(case).map(|fit| finish(case, fit)))
    }

    /// Of what times the fits of all cases in its own way, and a fit.
    pub(crate) fn of_turns(
        name: &'static str,
        turn: impl Fn(&[Case<'_>]) -> Duration + 'a,
        fit: impl Fn(&Case<'_>) -> Option<Fitted> + 'a,
    ) -> Self {
        Self { name, turn: Box::new(turn), fit: Box::new(fit) }
    }

    /// How long one fit for each case takes.
    pub(crate) fn turn(&self, cases: &[Case<'_>]) -> Duration {
        (self.turn)(cases)
    }

    /// What comes of a fit; `None` where it fails, or is not finite.
    pub(crate) fn fitted(&self, case: &Case<'_>) -> Option<Fitted> {
        (self.fit)(case).filter(Fitted::is_sound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowfit::glam::Vec3;

    #[test]
    fn a_near_side_is_open_or_not() {
        // Depth 0 at z = 10, 1 at z = −10.
        let matrix =
            DMat4::from_scale(DVec3::new(0.1, 0.1, -0.05)) * DMat4::from_translation(DVec3::new(0.0, 0.0, -10.0));
        let boxes = [0.0, 20.0, -20.0].map(|z| {
            let middle = Vec3::new(0.0, 0.0, z);
            Aabb::new(middle - 1.0, middle + 1.0)
        });
        let drawn = |near| frustum(matrix, false, near).culling.drawn(&boxes);
        assert_eq!(drawn(NearSide::Closed), [true, false, false]);
        assert_eq!(drawn(NearSide::Open), [true, true, false]);
        assert!(!frustum(matrix * f64::INFINITY, false, NearSide::Open).is_sound());
        assert_eq!(Culling::Nobody.drawn(&boxes), [false; 3]);
    }
}
