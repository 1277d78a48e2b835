//! The convex region that bodies are clipped from.

use super::ConvexScene;
use crate::convex::{Plane, PlaneId, Polyhedron, box_planes};
use glam::DVec3;

/// A convex bound of casters or of receivers; bodies are clipped from it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Region<'a> {
    Box { min: DVec3, max: DVec3 },
    Convex(&'a ConvexScene),
}

impl Region<'_> {
    /// Names of planes of any region are below this.
    pub(crate) const MAX_PLANES: PlaneId = ConvexScene::MAX_PLANES as PlaneId;

    /// Names of planes of this region are below this.
    pub(crate) const fn plane_count(&self) -> PlaneId {
        match self {
            Self::Box { .. } => 6,
            Self::Convex(scene) => scene.plane_count as PlaneId,
        }
    }

    /// Sets a body to the region, ready to be clipped.
    pub(crate) fn fill(&self, body: &mut Polyhedron) {
        match self {
            Self::Box { min, max } => body.set_box(*min, *max),
            Self::Convex(scene) => body.clone_from(&scene.body),
        }
    }

    /// Calls `each` with every plane of the region and its name.
    pub(crate) fn for_each_plane(&self, mut each: impl FnMut(Plane, PlaneId)) {
        let mut pass = |planes: &[Plane]| (0..).zip(planes).for_each(|(id, plane)| each(*plane, id));
        match self {
            Self::Box { min, max } => pass(&box_planes(*min, *max)),
            Self::Convex(scene) => pass(scene.planes()),
        }
    }

    /// The largest absolute coordinates in the region.
    pub(crate) fn extent(&self) -> DVec3 {
        match self {
            Self::Box { min, max } => min.abs().max(max.abs()),
            Self::Convex(scene) => scene.extent(),
        }
    }
}
