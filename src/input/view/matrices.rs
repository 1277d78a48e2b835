//! Views from the matrices of a renderer.

use super::{Axes, Lens, View};
use crate::error::{InputError, InputErrorKind, check};
use crate::input::clip_space::ClipSpace;
use crate::input::numbers::IntoMatrix;
use crate::input::view::decode::{self, EyeAxes, Frame};
use crate::input::view::frustum::{self, Rows};
use crate::math::bounds::most;
use glam::DMat4;

impl View {
    /// A camera from its view matrix and projection matrix, world → eye and eye → clip, for column vectors: `clip_from_eye ·
    /// eye_from_world · x`.
    ///
    /// Only the product counts. It may be mirrored, scaled, sheared, rotated in the image (swapchains of phones), off axis, along
    /// +z or −z, with an infinite far plane or an oblique near plane (Lengyel, *Oblique View Frustum Depth Projection and
    /// Clipping*, 2005), in any [`ClipSpace`] (its texture origin plays no part), made in f32 and by way of inverses. Eye and
    /// corners are those of the matrices, to the rounding of their entries. The eye of an orthographic camera is the point that
    /// `eye_from_world` takes to the origin.
    ///
    /// ```
    /// use shadowfit::{ClipSpace, View, glam::{DMat4, DQuat, DVec3, Mat4, Quat, Vec3, Vec4}};
    ///
    /// let pose = Mat4::from_rotation_translation(Quat::from_rotation_y(0.3), Vec3::new(1.0, 2.0, 3.0));
    /// let lens = Mat4::from_cols(Vec4::X, Vec4::Y * 1.5, Vec4::new(0.0, 0.0, -1.001, -1.0), Vec4::Z * -0.1001);
    /// let view = View::from_matrices(pose.inverse().as_dmat4(), lens.as_dmat4(), ClipSpace::WGPU)?;
    /// assert!((view.eye() - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-6);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// - The matrix that is not finite or is singular ([`InputErrorKind::Singular`]); `"clip_from_eye"` where the product is neither
    ///   perspective nor orthographic with positive w ([`InputErrorKind::NotAProjection`]).
    /// - The matrix that looks made for row vectors ([`InputErrorKind::LooksTransposed`]).
    /// - `"clip"`, where near and far are exchanged in its depth range but not in the reversed one
    ///   ([`InputErrorKind::LooksReversed`]).
    /// - `"near"`, `"far"`, `"frame"` or `"eye"` where the decoded value is out of order or out of range, and `"near"` where an
    ///   oblique near plane cuts all of the view off ([`InputErrorKind::OutsideView`]).
    #[doc(alias = "view_proj")]
    #[doc(alias = "projection matrix")]
    #[doc(alias = "oblique near plane")]
    pub fn from_matrices<A, B>(
        eye_from_world: impl IntoMatrix<A>,
        clip_from_eye: impl IntoMatrix<B>,
        clip: ClipSpace,
    ) -> Result<Self, InputError> {
        let (eye_from_world, clip_from_eye) = (eye_from_world.into_matrix(), clip_from_eye.into_matrix());
        decode::finite("eye_from_world", &eye_from_world)?;
        decode::finite("clip_from_eye", &clip_from_eye)?;
        if decode::is_transposed_affine(&eye_from_world) {
            return check::fail("eye_from_world", InputErrorKind::LooksTransposed);
        }
        if decode::is_transposed_perspective(&clip_from_eye) {
            return check::fail("clip_from_eye", InputErrorKind::LooksTransposed);
        }
        or_reversed(clip, |clip| Self::of_matrices(&eye_from_world, &clip_from_eye, clip))
    }

    fn of_matrices(eye_from_world: &DMat4, clip_from_eye: &DMat4, clip: ClipSpace) -> Result<Self, InputError> {
        let (Some(axes), Some(frame)) = (EyeAxes::of(eye_from_world), Frame::of(clip_from_eye, clip)) else {
            let Some(eye) = decode::origin(eye_from_world) else {
                return check::fail("eye_from_world", InputErrorKind::Singular);
            };
            let rounding = most(frustum::rounding(eye_from_world), frustum::rounding(clip_from_eye));
            let clip_from_world = *clip_from_eye * *eye_from_world;
            return Rows::new(&clip_from_world, clip, rounding, "clip_from_eye")?.view(Some(eye));
        };
        let forward = axes.backward * frame.forward_sign;
        let scale = axes.world_per_eye;
        let (unit, depth) = match frame.lens {
            Lens::Perspective => (1.0, scale),
            Lens::Orthographic => (scale, scale),
        };
        let axes_found = Axes { right: axes.right, up: axes.up, forward };
        let depths = [frame.near * depth, frame.far * depth];
        Self::framed(axes.eye, axes_found, frame.lens, [frame.min * unit, frame.max * unit], depths)
    }

    /// A camera from its view-projection matrix, world → clip: `clip_from_eye · eye_from_world`.
    ///
    /// Takes every product that [`Self::from_matrices`] takes. Eye and corners are those of the matrix, to the rounding of its
    /// entries; where all entries are f32 numbers, that is f32 rounding, of the size of a unit in the last place of the eye's
    /// coordinates. Far from the origin prefer the two matrices, or one in f64.
    ///
    /// An orthographic matrix has no eye: [`View::eye`] is then the middle of its near plane.
    ///
    /// ```
    /// use shadowfit::{ClipSpace, View};
    ///
    /// let view = View::perspective((4.0, 2.0, 9.0), (0.2, -0.3, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.5, 80.0)?;
    /// let again = View::from_clip_from_world(view.clip_from_world(), ClipSpace::OPENGL)?;
    /// assert!((again.eye() - view.eye()).length() < 1e-12 && (again.far() - 80.0).abs() < 1e-10);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// - `"clip_from_world"` where it is not finite, is singular ([`InputErrorKind::Singular`]), is neither perspective nor
    ///   orthographic with positive w ([`InputErrorKind::NotAProjection`]), or looks made for row vectors
    ///   ([`InputErrorKind::LooksTransposed`]).
    /// - `"clip"`, where near and far are exchanged in its depth range but not in the reversed one
    ///   ([`InputErrorKind::LooksReversed`]).
    /// - `"near"`, `"far"`, `"frame"` or `"eye"` where the decoded value is out of order or out of range, and `"near"` where an
    ///   oblique near plane cuts all of the view off ([`InputErrorKind::OutsideView`]).
    #[doc(alias = "view_proj")]
    #[doc(alias = "view-projection matrix")]
    pub fn from_clip_from_world<C>(
        clip_from_world: impl IntoMatrix<C>,
        clip: ClipSpace,
    ) -> Result<Self, InputError> {
        const FIELD: &str = "clip_from_world";
        let matrix = clip_from_world.into_matrix();
        decode::finite(FIELD, &matrix)?;
        let of = |matrix: &DMat4| {
            or_reversed(clip, |clip| Rows::new(matrix, clip, frustum::rounding(matrix), FIELD)?.view(None))
        };
        let view = of(&matrix);
        let is_upright = |view: &Result<Self, InputError>| view.is_ok_and(|view| view.is_upright());
        // A transposed matrix may decode as a camera too, with a sheared image, oblique planes or depth in odd units.
        if !is_upright(&view) && !decode::has_depth_in_units(&matrix) {
            let transposed = matrix.transpose();
            if decode::has_depth_in_units(&transposed) && is_upright(&of(&transposed)) {
                return check::fail(FIELD, InputErrorKind::LooksTransposed);
            }
        }
        view
    }

    /// Whether the image is not sheared and no plane is oblique.
    fn is_upright(&self) -> bool {
        self.lean == 0.0 && self.near_cut.is_none() && self.far_cut.is_none()
    }
}

/// A decoded view, or, where near and far are exchanged and are not in the reversed convention, an error that says so.
fn or_reversed(clip: ClipSpace, of: impl Fn(ClipSpace) -> Result<View, InputError>) -> Result<View, InputError> {
    of(clip).or_else(|error| {
        let is_depth = matches!(error.field, "near" | "far");
        if is_depth && of(clip.reversed()).is_ok() {
            check::fail("clip", InputErrorKind::LooksReversed)
        } else {
            Err(error)
        }
    })
}
