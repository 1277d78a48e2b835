//! The scene as the planner takes it: objects with bounds and the kind of their surface.

use super::groups::Groups;
use crate::error::{InputError, InputErrorKind, check};
use crate::input::scene::{Aabb, checked_box, of_boxes};
use crate::mesh::{OpenShape, Solidity, SolidityReport};
use alloc::vec::Vec;
use glam::DVec3;

/// The kind of an object's surface, which decides how its shadow can be tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Surface {
    /// Triangles, see [`Solidity::of`].
    Mesh(Solidity),
    /// An open mesh, each part of which lies in a plane: a card, a leaf, a pane.
    FlatSheets,
    /// Points or discs, drawn as splats.
    Points,
}

impl Default for Surface {
    /// An unknown mesh, which is treated as an open mesh that curves.
    fn default() -> Self {
        Self::Mesh(Solidity::Open)
    }
}

impl From<&SolidityReport> for Surface {
    fn from(report: &SolidityReport) -> Self {
        match report.sheet {
            Some(OpenShape { is_flat: true, .. }) => Self::FlatSheets,
            _ => Self::Mesh(report.solidity),
        }
    }
}

/// An object of a scene: what a renderer culls and draws as one.
///
/// ```
/// use shadowfit::{Aabb, plan::{Object, Surface}};
///
/// let tree = Object { triangles: 4000, longest_edge: 0.3, ..Object::new(Aabb::new([0.0, 0.0, 0.0], [3.0, 9.0, 3.0])) };
/// assert!(tree.casts && tree.receives);
/// assert_eq!(tree.surface, Surface::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Object {
    /// Its bounds in world space.
    pub bounds: Aabb,
    /// Whether it casts shadows.
    pub casts: bool,
    /// Whether shadows fall on it.
    pub receives: bool,
    /// The kind of its surface.
    pub surface: Surface,
    /// The number of triangles, or points, it is drawn with.
    pub triangles: u32,
    /// A length that none of its edges exceeds, in world units; infinite if unknown. Paraboloid maps bend lines and need
    /// short edges.
    pub longest_edge: f32,
}

impl Object {
    /// An object that casts and receives, of which nothing else is known: an open mesh of one triangle as large as its box.
    ///
    /// ```
    /// use shadowfit::{Aabb, plan::Object};
    ///
    /// let unknown = Object::new(Aabb::new([0.0, 0.0, 0.0], [2.0, 2.0, 1.0]));
    /// assert_eq!((unknown.triangles, unknown.longest_edge), (1, 3.0));
    /// ```
    #[must_use]
    pub fn new(bounds: Aabb) -> Self {
        let longest_edge = (bounds.max - bounds.min).length();
        Self { bounds, casts: true, receives: true, surface: Surface::default(), triangles: 1, longest_edge }
    }
}

/// The objects of a scene, sorted so that those far from a light are skipped together.
///
/// Made once, and again when objects move; [`plan`](super::plan()) reads it for every view.
#[derive(Clone, Debug)]
pub struct Objects {
    objects: Vec<Object>,
    pub(super) casters: Groups,
    pub(super) receivers: Groups,
    /// The largest absolute coordinates in the scene.
    pub(super) extent: DVec3,
}

impl Objects {
    /// Sorts the objects of a scene. Objects that neither cast nor receive, and those with an empty box, are left out.
    ///
    /// # Errors
    ///
    /// Names `"objects"` when there are more than 2³² − 1, or the bounds of one are not finite, too large or out of
    /// order, or its longest edge is negative or NaN.
    ///
    /// ```
    /// use shadowfit::{Aabb, plan::{Object, Objects, plan}};
    ///
    /// let object = Object::new(Aabb::new([0.0, 0.0, 0.0], [2.0, 2.0, 1.0]));
    /// assert!(Objects::new(&[object]).is_ok());
    /// assert!(Objects::new(&[Object { longest_edge: -1.0, ..object }]).is_err());
    /// ```
    pub fn new(objects: &[Object]) -> Result<Self, InputError> {
        const FIELD: &str = "objects";
        if u32::try_from(objects.len()).is_err() {
            return check::fail(FIELD, InputErrorKind::TooMany);
        }
        let mut extent = DVec3::ZERO;
        for (index, object) in objects.iter().enumerate() {
            let Aabb { min, max } = object.bounds;
            let bounds =
                checked_box(min.as_dvec3(), max.as_dvec3()).map_err(|error| of_boxes(error, FIELD, index))?;
            if let Some((min, max)) = bounds {
                extent = extent.max(min.abs()).max(max.abs());
            }
            let longest = object.longest_edge;
            if longest.is_nan() || longest < 0.0 {
                let problem = if longest.is_nan() { InputErrorKind::NotFinite } else { InputErrorKind::TooSmall };
                let error = InputError { component: Some("longest_edge"), ..InputError::new(FIELD, problem) };
                return Err(error.got(longest.into()).of_list(FIELD, index));
            }
        }
        let those = |are: fn(&Object) -> bool| {
            let is_somewhere = |object: &Object| object.bounds.min.cmple(object.bounds.max).all();
            let those = (0..).zip(objects).filter(|(_, object)| are(object) && is_somewhere(object));
            Groups::sorted(those.map(|(id, object)| (id, object.bounds)).collect())
        };
        Ok(Self {
            casters: those(|object| object.casts),
            receivers: those(|object| object.receives),
            objects: objects.to_vec(),
            extent,
        })
    }

    /// An object by its index in the slice that was sorted.
    pub(super) fn get(&self, id: u32) -> &Object {
        &self.objects[id as usize]
    }
}
