//! Decoding of view and projection matrices, in any clip convention.

use crate::error::{InputError, InputErrorKind};
use crate::input::clip_space::{ClipSpace, YAxis};
use crate::input::view::Lens;
use crate::input::view::frustum::{meet, rounding, rows};
use glam::{DMat4, DVec2, DVec3, DVec4};

/// Refuses a matrix with an entry that is NaN or infinite, and names the entry as glam does.
pub(crate) fn finite(field: &'static str, matrix: &DMat4) -> Result<(), InputError> {
    #[rustfmt::skip]
    const ENTRIES: [&str; 16] = [
        "x_axis.x", "x_axis.y", "x_axis.z", "x_axis.w", "y_axis.x", "y_axis.y", "y_axis.z", "y_axis.w",
        "z_axis.x", "z_axis.y", "z_axis.z", "z_axis.w", "w_axis.x", "w_axis.y", "w_axis.z", "w_axis.w",
    ];
    match matrix.to_cols_array().into_iter().zip(ENTRIES).find(|(entry, _)| !entry.is_finite()) {
        Some((entry, name)) => Err(InputError::new(field, InputErrorKind::NotFinite).got(entry).of_component(name)),
        None => Ok(()),
    }
}

/// Whether an affine matrix looks made for row vectors: its translation is in the last row.
pub(crate) fn is_transposed_affine(matrix: &DMat4) -> bool {
    let [x, y, z, w] = rows(matrix);
    // Rounding may disturb the last row (0, 0, 0, 1), but not by as much as 10⁻³.
    [x, y, z].iter().all(|row| row.offset == 0.0) && w.offset == 1.0 && w.normal.length() > 1e-3
}

/// Whether a perspective matrix looks made for row vectors: ±1 stands in the place of near · far.
pub(crate) fn is_transposed_perspective(matrix: &DMat4) -> bool {
    let [x, y, z, w] = rows(matrix);
    let depth_only = (x.normal.z, y.normal.z, w.normal.x, w.normal.y, w.offset) == (0.0, 0.0, 0.0, 0.0, 0.0);
    depth_only && z.offset.abs() == 1.0 && w.normal.z != 0.0 && w.normal.z.abs() != 1.0
}

/// Whether w of a matrix from world to clip space is depth in world units, as in the products of most cameras.
pub(crate) fn has_depth_in_units(clip_from_world: &DMat4) -> bool {
    let [.., w] = rows(clip_from_world);
    (w.normal.length_squared() - 1.0).abs() < 1e-3
}

/// The point that a matrix takes to the origin.
pub(crate) fn origin(eye_from_world: &DMat4) -> Option<DVec3> {
    let [x, y, z, _] = rows(eye_from_world);
    let point = meet(&x, &y, &z);
    point.is_finite().then_some(point)
}

/// A decoded view matrix; `backward` is the eye's +z in world space.
pub(crate) struct EyeAxes {
    pub(crate) eye: DVec3,
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    pub(crate) backward: DVec3,
    pub(crate) world_per_eye: f64,
}

impl EyeAxes {
    /// Decodes a view matrix that is, up to rounding, a rotation or reflection, a uniform scale and a translation.
    pub(crate) fn of(eye_from_world: &DMat4) -> Option<Self> {
        let rows = eye_from_world.transpose();
        let [right, up, backward] = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec4::truncate);
        let scale = backward.length();
        let tolerance = 16.0 * rounding(eye_from_world) * scale;
        let square = |a: DVec3, b: DVec3| a.dot(b).abs() <= tolerance * scale;
        let rigid = rows.w_axis == DVec4::W
            && scale > 0.0
            && (right.length() - scale).abs() <= tolerance
            && (up.length() - scale).abs() <= tolerance
            && square(right, up)
            && square(up, backward)
            && square(backward, right);
        if !rigid {
            return None;
        }
        // The matrix takes the eye to the origin: the rows x, y and z are planes through it, met by Cramer's rule.
        let translation = DVec3::new(rows.x_axis.w, rows.y_axis.w, rows.z_axis.w);
        let determinant = right.dot(up.cross(backward));
        let eye = -(up.cross(backward) * translation.x
            + backward.cross(right) * translation.y
            + right.cross(up) * translation.z)
            / determinant;
        // Orthonormal to the last bit: the view axis is kept, the others are made square to it and keep their handedness.
        let backward = backward / scale;
        let up = (up - backward * up.dot(backward)).normalize();
        let right = up.cross(backward) * determinant.signum();
        Some(Self { eye, right, up, backward, world_per_eye: scale.recip() })
    }
}

/// A decoded projection matrix, in eye units.
pub(crate) struct Frame {
    pub(crate) lens: Lens,
    /// The sign of z that the eye looks along.
    pub(crate) forward_sign: f64,
    pub(crate) min: DVec2,
    pub(crate) max: DVec2,
    pub(crate) near: f64,
    pub(crate) far: f64,
}

impl Frame {
    /// Decodes a projection without rotation in the image, shear or oblique planes: the entries that must be zero are.
    pub(crate) fn of(clip_from_eye: &DMat4, clip: ClipSpace) -> Option<Self> {
        let rows = clip_from_eye.transpose();
        let (mut x, mut y, mut z, mut w) = (rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis);
        if clip.y == YAxis::Down {
            y = -y;
        }
        let perspective = w.x == 0.0 && w.y == 0.0 && w.w == 0.0 && w.z != 0.0;
        let orthographic = w.x == 0.0 && w.y == 0.0 && w.z == 0.0 && w.w > 0.0;
        let facing = x.y == 0.0 && y.x == 0.0 && z.x == 0.0 && z.y == 0.0;
        if !(perspective || orthographic) || !facing {
            return None;
        }
        let unit = if perspective { w.z.abs() } else { w.w };
        (x, y, z, w) = (x / unit, y / unit, z / unit, w / unit);
        // A plane at depth d is `value + slope · d`, for z_eye = forward_sign · d.
        let [near_plane, far_plane] = clip.depth.ends(z, w);
        let (lens, forward_sign, centre);
        if perspective {
            // x_clip / w = (x.x · x_eye + x.z · z_eye) / depth, and depth = w.
            if x.w != 0.0 || y.w != 0.0 {
                return None;
            }
            lens = Lens::Perspective;
            forward_sign = w.z;
            centre = DVec2::new(x.z, y.z) * forward_sign;
        } else {
            if x.z != 0.0 || y.z != 0.0 {
                return None;
            }
            lens = Lens::Orthographic;
            forward_sign = if near_plane.z < 0.0 { -1.0 } else { 1.0 };
            centre = DVec2::new(x.w, y.w);
        }
        let depth = |plane: DVec4| -plane.w / (plane.z * forward_sign);
        let near = depth(near_plane);
        // The far plane is at infinity, or, by a rounding, beyond it.
        let endless = perspective && far_plane.w > 0.0 && far_plane.z * forward_sign >= 0.0;
        let far = if endless { f64::INFINITY } else { depth(far_plane) };
        // scale · value + centre = ±1; a negative scale mirrors the image and leaves the frame as it is.
        let edge = |scale: f64, centre: f64| {
            let (a, b) = ((-1.0 - centre) / scale, (1.0 - centre) / scale);
            (a.min(b), a.max(b))
        };
        let ((left, right), (bottom, top)) = (edge(x.x, centre.x), edge(y.y, centre.y));
        Some(Self { lens, forward_sign, min: DVec2::new(left, bottom), max: DVec2::new(right, top), near, far })
    }
}
