//! The planes of a view.

use super::{Lens, View};
use crate::convex::Plane;
use crate::math::list::list;

impl View {
    /// The planes of V in world space, inside ≥ 0: left, right, bottom, top, near, then the near and the far plane that are
    /// oblique, and, unless it is infinite, far. The sides are those of the image, near and far across
    /// [`View::forward`].
    ///
    /// ```
    /// use shadowfit::{View, glam::DVec3};
    ///
    /// let view = View::perspective((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
    /// assert_eq!(view.planes().len(), 6);
    /// assert!(view.planes().iter().all(|plane| plane.at(DVec3::new(0.1, 0.2, -5.0)) > 0.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn planes(&self) -> FrustumPlanes {
        let (depth, one) = (self.depth_row(), self.frame_unit());
        let (x, y) = (Plane::through(self.right, self.eye), Plane::through(self.up, self.eye));
        let near = depth - Plane::ONE * self.near;
        // An infinite one is the plane at infinity. Any multiple would do: this one scales with the scene as others do.
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

    /// What the frame's numbers are multiples of: depth for slopes, 1 for offsets. It is also the row C₃ of the
    /// camera's matrix.
    pub(super) fn frame_unit(&self) -> Plane {
        match self.lens {
            Lens::Perspective => self.depth_row(),
            Lens::Orthographic => Plane::ONE,
        }
    }
}

/// Up to eight planes, as [`View::planes`] returns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrustumPlanes {
    planes: [Plane; 8],
    /// With the plane at infinity, and without.
    count: usize,
    len: usize,
}

impl FrustumPlanes {
    /// All of them, with the plane at infinity at the end for an infinite far plane.
    pub(crate) fn with_infinity(&self) -> &[Plane] {
        &self.planes[..self.count]
    }

    /// The most there may be.
    pub(crate) const MAX: usize = 8;
}

list!(FrustumPlanes, Plane, planes, "planes");
