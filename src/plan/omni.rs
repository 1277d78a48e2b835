//! Lights that see more than a frustum holds: paraboloids and the faces of a cube.

use super::light::{Candidate, Found, Planner, Reach, WORTH};
use super::reason::Reason;
use super::{Kind, Projection};
use crate::fit::Empty;
use crate::focus::Focus;
use crate::input::light::CubeFace;
use crate::input::scene::{Aabb, Scene};
use crate::math::angle;
use crate::omni::{Paraboloid, Paraboloids};
use alloc::vec::Vec;
use glam::DVec3;

/// How far, in texels, a paraboloid map may bend an edge.
const BENT: f64 = 0.5;

impl Planner<'_> {
    /// A paraboloid in place of a frustum that is too wide.
    pub(super) fn instead_of_wide(
        &self,
        focus: &Focus<'_>,
        points: &[DVec3],
        frustum: &Candidate,
        reach: &Reach,
        reasons: &mut Vec<Reason>,
    ) -> Found {
        if frustum.aliasing <= self.budget.aliasing() || focus.light().position().is_none() {
            return Ok(None);
        }
        let found = self.sized(|size, _| self.paraboloids(focus, points, size), &mut Vec::new())?;
        Ok(found.filter(|candidate| {
            let is_better = candidate.kind == Kind::Paraboloid
                && candidate.aliasing * WORTH < frustum.aliasing
                && self.are_cut_finely(candidate, reach);
            if is_better {
                reasons.clear();
                let times = frustum.aliasing / candidate.aliasing;
                reasons.extend([Reason::WideFrustum(times), Reason::OneHemisphere]);
            }
            is_better
        }))
    }

    /// Paraboloids or cube faces, for a light that stands among its receivers.
    pub(super) fn omni(
        &self,
        focus: &Focus<'_>,
        points: &[DVec3],
        reach: &Reach,
        reasons: &mut Vec<Reason>,
    ) -> Result<Candidate, Empty> {
        reasons.push(Reason::Surrounded);
        let mut ignored = Vec::new();
        let faces = self.sized(|size, _| Ok(self.faces(focus, points, size, reach)), &mut ignored)?;
        let paraboloids = self.sized(|size, _| self.paraboloids(focus, points, size), &mut ignored)?;
        let paraboloids = match (faces, paraboloids) {
            (None, None) => return Err(Empty::NoCasters),
            (Some(faces), None) => return Ok(faces),
            (Some(faces), Some(paraboloids)) if paraboloids.projections.len() >= faces.projections.len() => {
                return Ok(faces);
            }
            (Some(faces), Some(paraboloids)) if !self.are_cut_finely(&paraboloids, reach) => {
                reasons.push(Reason::CoarseCasters);
                return Ok(faces);
            }
            // A spot, which has no cube.
            (_, Some(paraboloids)) => paraboloids,
        };
        reasons.push(match paraboloids.kind {
            Kind::Paraboloid => Reason::OneHemisphere,
            _ => Reason::TwoHemispheres,
        });
        Ok(paraboloids)
    }

    fn paraboloids(&self, focus: &Focus<'_>, points: &[DVec3], size: u32) -> Found {
        let (kind, paraboloids) = match focus.paraboloids(&self.settings(size)) {
            Paraboloids::One(one) => (Kind::Paraboloid, alloc::vec![one]),
            Paraboloids::Two(two) => (Kind::DualParaboloid, two.to_vec()),
            Paraboloids::Empty(empty) => return Err(empty),
            Paraboloids::Directional => return Ok(None),
        };
        let projections = paraboloids.into_iter().map(Projection::Paraboloid).collect();
        Ok(Some(Candidate::new(kind, projections, points)))
    }

    /// The cube faces that have receivers and casters.
    fn faces(&self, focus: &Focus<'_>, points: &[DVec3], size: u32, reach: &Reach) -> Option<Candidate> {
        let position = focus.light().position()?;
        let overlap = CubeFace::overlap(self.budget.filter().reach(), size, self.settings(size).border());
        let (mut projections, mut aliasing) = (Vec::new(), 0.0_f64);
        for face in CubeFace::ALL {
            let Ok(light) = focus.light().cube_face(face, overlap) else { continue };
            let scene = Scene::of_checked(&reach.casters, &reach.receivers);
            let part = Focus::new(focus.view(), &light, &scene);
            let seen: Vec<DVec3> =
                points.iter().copied().filter(|point| CubeFace::of(point - position) == face).collect();
            if let Ok(Some(found)) = self.frustum(&part, &seen, size, &mut Vec::new()) {
                aliasing = aliasing.max(found.aliasing);
                projections.extend(found.projections.into_iter().map(|projection| match projection {
                    Projection::Frustum(map) => Projection::Face(face, map),
                    other => other,
                }));
            }
        }
        (!projections.is_empty()).then_some(Candidate::faces(projections, aliasing))
    }

    /// Whether a paraboloid map of the candidate bends no edge of any caster by more than [`BENT`] texels.
    fn are_cut_finely(&self, candidate: &Candidate, reach: &Reach) -> bool {
        candidate.projections.iter().all(|projection| match projection {
            Projection::Paraboloid(paraboloid) => reach
                .casters
                .iter()
                .zip(&reach.ids)
                .all(|(one, &id)| is_short(self.objects.get(id).longest_edge.into(), one, paraboloid)),
            _ => true,
        })
    }
}

/// Whether an edge of this length anywhere in a box is bent by no more than [`BENT`] texels.
fn is_short(edge: f64, one: &Aabb, paraboloid: &Paraboloid) -> bool {
    let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
    let position = paraboloid.position();
    // Nothing casts within the near distance.
    let distance = position.distance(position.clamp(min, max)).max(paraboloid.near());
    // Seen from a distance d to its nearest point, an edge of length e subtends at most 2 · atan(e/2d).
    let angle = 2.0 * angle::of_vector(2.0 * distance, edge);
    paraboloid.edge_error(angle) <= BENT
}
