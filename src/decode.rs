//! What view and projection matrices encode, in any convention.

use crate::clip_space::{ClipSpace, DepthRange, YAxis};
use crate::error::{InputError, Problem, check};
use crate::view::Lens;
use glam::{DMat4, DVec2, DVec3, DVec4};

/// What a view matrix encodes; `backward` is the world-space image of the eye's +z.
pub(crate) struct EyeAxes {
    pub(crate) eye: DVec3,
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    pub(crate) backward: DVec3,
    pub(crate) world_per_eye: f64,
}

impl EyeAxes {
    /// The world-space axes and position of the eye that a view matrix encodes.
    pub(crate) fn of(eye_from_world: &DMat4) -> Result<Self, InputError> {
        const FIELD: &str = "eye_from_world";
        if !eye_from_world.is_finite() {
            return check::fail(FIELD, Problem::NotFinite);
        }
        let rows = eye_from_world.transpose();
        let [right, up, backward] = [rows.x_axis, rows.y_axis, rows.z_axis].map(DVec4::truncate);
        let scale = backward.length();
        // Matrices arrive rounded to f32 and after long chains of products, so exactness cannot be asked for.
        let tolerance = 1e-3 * scale;
        let square = |a: DVec3, b: DVec3| a.dot(b).abs() <= tolerance * scale;
        let rigid = rows.w_axis == DVec4::W
            && scale > 0.0
            && (right.length() - scale).abs() <= tolerance
            && (up.length() - scale).abs() <= tolerance
            && square(right, up)
            && square(up, backward)
            && square(backward, right);
        if !rigid {
            return check::fail(FIELD, Problem::NotRigid);
        }
        // The eye is the point that the matrix takes to the origin: three planes through it, met by Cramer's rule.
        let translation = DVec3::new(rows.x_axis.w, rows.y_axis.w, rows.z_axis.w);
        let determinant = right.dot(up.cross(backward));
        let eye = -(up.cross(backward) * translation.x
            + backward.cross(right) * translation.y
            + right.cross(up) * translation.z)
            / determinant;
        // Orthonormal to the last bit: the view axis as given, the others square to it, on the side they were on.
        let backward = backward / scale;
        let up = (up - backward * up.dot(backward)).normalize();
        let right = up.cross(backward) * determinant.signum();
        Ok(Self { eye, right, up, backward, world_per_eye: scale.recip() })
    }
}

/// What a projection matrix encodes, in eye units.
pub(crate) struct Frame {
    pub(crate) lens: Lens,
    /// The eye looks along this end of its z axis.
    pub(crate) forward_sign: f64,
    pub(crate) min: DVec2,
    pub(crate) max: DVec2,
    pub(crate) near: f64,
    pub(crate) far: f64,
}

impl Frame {
    pub(crate) fn of(clip_from_eye: &DMat4, clip: ClipSpace) -> Result<Self, InputError> {
        const FIELD: &str = "clip_from_eye";
        if !clip_from_eye.is_finite() {
            return check::fail(FIELD, Problem::NotFinite);
        }
        let rows = clip_from_eye.transpose();
        let (mut x, mut y, mut z, mut w) = (rows.x_axis, rows.y_axis, rows.z_axis, rows.w_axis);
        // Depth from −1 to 1 and y up, whatever it was.
        z = match clip.depth {
            DepthRange::ZeroToOne => z * 2.0 - w,
            DepthRange::ZeroToOneReversed => w - z * 2.0,
            DepthRange::NegativeOneToOne => z,
            DepthRange::NegativeOneToOneReversed => -z,
        };
        if clip.y == YAxis::Down {
            y = -y;
        }
        let perspective = w.x == 0.0 && w.y == 0.0 && w.w == 0.0 && w.z != 0.0;
        let orthographic = w.x == 0.0 && w.y == 0.0 && w.z == 0.0 && w.w > 0.0;
        let facing = x.y == 0.0 && y.x == 0.0 && z.x == 0.0 && z.y == 0.0;
        if !(perspective || orthographic) || !facing {
            return check::fail(FIELD, Problem::NotAProjection);
        }
        let unit = if perspective { w.z.abs() } else { w.w };
        (x, y, z, w) = (x / unit, y / unit, z / unit, w / unit);
        let (lens, forward_sign, centre, near, far);
        if perspective {
            // x_clip / w = (x.x · x_eye + x.z · z_eye) / depth, with z_eye = forward_sign · depth and depth = w.
            if x.w != 0.0 || y.w != 0.0 {
                return check::fail(FIELD, Problem::NotAProjection);
            }
            lens = Lens::Perspective;
            forward_sign = w.z;
            centre = DVec2::new(x.z, y.z) * forward_sign;
            // z_clip / w = slope + z.w / depth, −1 at near and 1 at far; it may reach 1 at infinity only, or, by a
            // rounding, not even there.
            let slope = z.z * forward_sign;
            near = z.w / (-1.0 - slope);
            far = if z.w < 0.0 && slope <= 1.0 { f64::INFINITY } else { z.w / (1.0 - slope) };
        } else {
            if x.z != 0.0 || y.z != 0.0 {
                return check::fail(FIELD, Problem::NotAProjection);
            }
            lens = Lens::Orthographic;
            forward_sign = if z.z < 0.0 { -1.0 } else { 1.0 };
            centre = DVec2::new(x.w, y.w);
            let slope = z.z * forward_sign;
            near = (-1.0 - z.w) / slope;
            far = (1.0 - z.w) / slope;
        }
        // (scale · value + centre) = ±1; a negative scale mirrors, which leaves the same frame.
        let edge = |scale: f64, centre: f64| {
            let (a, b) = ((-1.0 - centre) / scale, (1.0 - centre) / scale);
            (a.min(b), a.max(b))
        };
        let ((left, right), (bottom, top)) = (edge(x.x, centre.x), edge(y.y, centre.y));
        Ok(Self { lens, forward_sign, min: DVec2::new(left, bottom), max: DVec2::new(right, top), near, far })
    }
}
