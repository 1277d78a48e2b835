//! The planes of a view.

use super::{Lens, View};
use crate::convex::Plane;
use crate::math::list::list;

impl View {
    /// The planes of V in world space, inside ≥ 0: left, right, bottom, top, near, then oblique near and far planes if any, then
    /// far unless it is infinite. Near and far are across [`View::forward`].
    ///
    /// ```
    /// use shadowfit::{View, glam::DVec3};
    ///
    /// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
    /// assert_eq!(view.planes().len(), 6);
    /// assert_eq!(view.planes()[4].at(DVec3::new(0.0, 0.0, -2.0)), 1.5); // near, with a unit normal
    /// assert!(view.planes().iter().all(|plane| plane.at(DVec3::new(0.1, 0.2, -5.0)) > 0.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn planes(&self) -> FrustumPlanes {
        let (depth, one) = (self.depth_row(), self.frame_unit());
        let (x, y) = (Plane::through(self.right, self.eye), Plane::through(self.up, self.eye));
        let near = depth - Plane::ONE * self.near;
        // An infinite far plane is the plane at infinity, in a multiple that scales with the scene as the other planes do.
        let far = if self.far.is_finite() { Plane::ONE * self.far - depth } else { Plane::ONE * self.near };
        let mut planes = [
            x - one * self.frame_min.x,
            one * self.frame_max.x - x,
            y - one * self.frame_min.y,
            one * self.frame_max.y - y,
            near,
            far,
            far,
            far,
        ];
        let mut count = 5;
        for cut in [self.near_cut, self.far_cut].into_iter().flatten() {
            planes[count] = cut;
            count += 1;
        }
        FrustumPlanes { planes, count: count + 1, len: count + usize::from(self.far.is_finite()) }
    }

    /// Depth before the eye as a covector.
    pub(crate) fn depth_row(&self) -> Plane {
        Plane::through(self.forward, self.eye)
    }

    /// The unit of the frame: depth for slopes, 1 for offsets. It is also the row C₃ of the camera's matrix.
    pub(super) fn frame_unit(&self) -> Plane {
        match self.lens {
            Lens::Perspective => self.depth_row(),
            Lens::Orthographic => Plane::ONE,
        }
    }
}

/// The planes of a view, up to eight, in the order of [`View::planes`].
///
/// ```
/// use shadowfit::View;
///
/// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, f64::INFINITY)?;
/// let planes = view.planes();
/// assert_eq!((planes.len(), planes.as_slice().len(), planes.is_empty()), (5, 5, false)); // no far plane
/// assert!(planes.iter().all(|plane| plane.at(view.eye() + view.forward()) > 0.0));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrustumPlanes {
    planes: [Plane; 8],
    /// The number of planes with the plane at infinity, and without.
    count: usize,
    len: usize,
}

impl FrustumPlanes {
    /// All planes; an infinite far plane is the plane at infinity, at the end.
    pub(crate) fn with_infinity(&self) -> &[Plane] {
        &self.planes[..self.count]
    }

    /// The largest number of planes.
    pub(crate) const MAX: usize = 8;
}

list!(FrustumPlanes, Plane, planes, "planes");
