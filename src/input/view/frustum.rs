//! The frustum of any matrix from world to clip space, read from its rows.
//!
//! The planes of the frustum are sums and differences of rows, w is depth before the eye, and the eye is the point where the rows
//! x, y and w vanish. The matrix is not decomposed into a pose and a lens, so that rotations of the image, shears, scales and
//! oblique near planes are no special cases.
//!
//! Two decisions depend on the rounding of the entries: whether lines of sight are parallel, and whether the near or far plane is
//! oblique.

use crate::convex::{Plane, matrix_from_rows};
use crate::error::{Expected, Hint, InputError, InputErrorKind, MAX_COORDINATE, check};
use crate::input::clip_space::{ClipSpace, DepthRange, YAxis};
use crate::input::view::{Lens, View};
use crate::math::bounds::{Interval, least, most};
use glam::{DMat4, DVec2, DVec3};

/// A sum this many roundings of its terms from zero counts as zero.
const ROUNDINGS: f64 = 16.0;

/// Relative slack for the rounding of the near and far depths of a view with oblique planes.
const ROOM: f64 = 1.0 / 1_099_511_627_776.0;

/// Half a unit in the last place of the precision that a matrix was made in: f32 where every entry is an f32 number.
pub(crate) fn rounding(matrix: &DMat4) -> f64 {
    const SINGLE: f64 = 0.5 * f32::EPSILON as f64;
    const DOUBLE: f64 = 0.5 * f64::EPSILON;
    let is_single = |entry: f64| f64::from(entry as f32) == entry;
    if matrix.to_cols_array().into_iter().all(is_single) { SINGLE } else { DOUBLE }
}

/// The rows of a matrix as covectors.
pub(crate) fn rows(matrix: &DMat4) -> [Plane; 4] {
    [0, 1, 2, 3].map(|row| matrix.row(row)).map(|row| Plane::new(row.truncate(), row.w))
}

/// The determinant of the normals of three planes.
fn determinant(a: &Plane, b: &Plane, c: &Plane) -> f64 {
    a.normal.dot(b.normal.cross(c.normal))
}

/// The intersection of three planes; not finite where there is none.
pub(crate) fn meet(a: &Plane, b: &Plane, c: &Plane) -> DVec3 {
    let (bc, ca, ab) = (b.normal.cross(c.normal), c.normal.cross(a.normal), a.normal.cross(b.normal));
    -(bc * a.offset + ca * b.offset + ab * c.offset) / a.normal.dot(bc)
}

/// The rows of a matrix from world to clip space, divided by a common factor.
pub(crate) struct Rows {
    x: Plane,
    y: Plane,
    /// Depth from −1 to 1 after the division by w.
    z: Plane,
    w: Plane,
    /// Not negative inside.
    near: Plane,
    far: Plane,
    /// How far rounding may turn the normals of the near and the far plane.
    near_off: f64,
    far_off: f64,
    /// Half a unit in the last place of the entries, times [`ROUNDINGS`].
    tolerance: f64,
    /// The factor that the rows were divided by.
    largest: f64,
    field: &'static str,
}

impl Rows {
    /// The rows of a finite matrix with entries off by `rounding` of themselves; errors name `field`.
    pub(crate) fn new(
        clip_from_world: &DMat4,
        clip: ClipSpace,
        rounding: f64,
        field: &'static str,
    ) -> Result<Self, InputError> {
        let rows = rows(clip_from_world);
        // A homogeneous matrix has no scale: normalise it.
        let largest = rows.iter().map(|row| row.normal.abs().max_element()).fold(0.0, most);
        if largest == 0.0 {
            return check::fail(field, InputErrorKind::Singular);
        }
        let [x, y, z, w] = rows.map(|row| row * largest.recip());
        let y = if clip.y == YAxis::Down { -y } else { y };
        let tolerance = ROUNDINGS * rounding;
        let (of_z, of_w) = (z.normal.length(), w.normal.length());
        let (alone, both) = (tolerance * of_z, tolerance * (of_z + of_w));
        let [near, far] = clip.depth.ends(z, w);
        let (near_off, far_off) = match clip.depth {
            DepthRange::ZeroToOne => (alone, both),
            DepthRange::ZeroToOneReversed => (both, alone),
            DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed => (both, both),
        };
        Ok(Self { x, y, z: near - far, w, near, far, near_off, far_off, tolerance, largest, field })
    }

    /// The view. Depths of an orthographic view count from `origin`, by default the middle of its near plane.
    pub(crate) fn view(&self, origin: Option<DVec3>) -> Result<View, InputError> {
        let Self { x, y, z, w, .. } = self;
        // The last row of the inverse, up to a factor: w⁻¹ of the corners of the clip volume is d + (a, b, c) · corner.
        let (a, b) = (determinant(y, z, w), determinant(x, z, w));
        let (c, d) = (determinant(x, y, w), determinant(x, y, z));
        if a.abs() + b.abs() + c.abs() <= self.tolerance * d.abs() {
            self.orthographic(origin)
        } else {
            self.perspective()
        }
    }

    fn perspective(&self) -> Result<View, InputError> {
        let scale = self.w.normal.length().recip();
        let [x, y, w] = [self.x, self.y, self.w].map(|row| row * scale);
        let forward = w.normal;
        // A row's part across the view, and its slope along the view.
        let across = |row: Plane| {
            let along = row.normal.dot(forward);
            (row - w * along, along)
        };
        let whole = DVec2::new(x.normal.length(), y.normal.length());
        let ((x, x_along), (y, y_along)) = (across(x), across(y));
        let eye = meet(&x, &y, &w);
        if !eye.is_finite() {
            return Err(self.not_a_projection());
        }
        let image = self.image([&x, &y], forward, whole).map_err(|error| {
            // An invertible matrix without an image has parallel lines of sight, and w varies across them.
            let rows = [self.x, self.y, self.z, self.w];
            let size = rows.iter().map(|row| row.to_row().length()).product::<f64>();
            let is_invertible = matrix_from_rows(rows).determinant().abs() > 1e-9 * size;
            if is_invertible { self.not_a_projection() } else { error }
        })?;
        let (min, max) = image.edges(DVec2::new(x_along, y_along));
        let (near, far) = (self.near * scale, self.far * scale);
        let (near_off, far_off) = (self.near_off * scale, self.far_off * scale);

        // Depth is 0 at the eye and 1 at the end of an edge's direction. The sum of the near and the far plane is a multiple of
        // w, which vanishes at the eye, so that their values there are opposite: the one with the smaller terms is more precise.
        let size = |plane: &Plane| plane.normal.abs().dot(eye.abs()) + plane.offset.abs();
        let (before, size) =
            if size(&far) < size(&near) { (far.at(eye), size(&far)) } else { (-near.at(eye), size(&near)) };
        let lost = self.tolerance * size;
        // For an eye far out, rounding may carry the near plane behind it: then the near plane is put next to the eye.
        let before = if before.abs() <= lost { most(before, lost / 256.0) } else { before };
        if before <= 0.0 {
            let error = InputError::new("near", InputErrorKind::OutOfOrder).got(before / near.normal.dot(forward));
            return Err(error.expected(Expected::Above { field: "the eye's depth", value: 0.0 }));
        }
        let directions = |cut: bool| {
            let [right, up] = image.steps();
            corners(min, max).map(
                move |corner| {
                    if cut { forward + right * corner.x + up * corner.y } else { forward }
                },
            )
        };
        let (near_cut, far_cut) = (is_oblique(&near, forward, near_off), is_oblique(&far, forward, far_off));
        let mut depths = Interval::EMPTY;
        for direction in directions(near_cut) {
            let slope = near.normal.dot(direction);
            if slope > 0.0 {
                depths.min = least(depths.min, before / slope);
            }
        }
        for direction in directions(far_cut) {
            let slope = -far.normal.dot(direction);
            depths.max = most(depths.max, if slope > far_off { before / slope } else { f64::INFINITY });
        }
        if depths.min == f64::INFINITY {
            // The oblique near plane cuts all of the view off.
            return check::fail("near", InputErrorKind::OutsideView);
        }
        let near_depth = if near_cut { depths.min * (1.0 - ROOM) } else { depths.min };
        let far_depth = if far_cut { depths.max * (1.0 + ROOM) } else { depths.max };
        View {
            eye,
            right: image.right,
            up: image.up,
            forward,
            lean: image.lean,
            lens: Lens::Perspective,
            frame_min: min,
            frame_max: max,
            near: near_depth,
            // Beyond MAX_COORDINATE a far plane is as good as infinite.
            far: if far_depth > MAX_COORDINATE { f64::INFINITY } else { far_depth },
            near_cut: near_cut.then_some(near),
            far_cut: far_cut.then_some(far),
        }
        .checked()
    }

    /// The error of a matrix with parallel lines of sight whose w varies across them: a shadow map of a sun, warped.
    const fn not_a_projection(&self) -> InputError {
        InputError::new(self.field, InputErrorKind::NotAProjection).hinted(Some(Hint::WarpedMap))
    }

    fn orthographic(&self, origin: Option<DVec3>) -> Result<View, InputError> {
        let sight = self.x.normal.cross(self.y.normal).normalize_or_zero();
        let forward = if self.near.normal.dot(sight) < 0.0 { -sight } else { sight };
        let whole = DVec2::new(self.x.normal.length(), self.y.normal.length());
        let image = self.image([&self.x, &self.y], forward, whole)?;
        let middle = meet(&self.x, &self.y, &self.z);
        let size = self.w.at(middle);
        if size.is_nan() || size <= 0.0 {
            // Lines of sight are parallel, so that w is the last row's last entry all over.
            let error = InputError::new(self.field, InputErrorKind::NotAProjection);
            let error = error.got(self.w.offset * self.largest).of_component("w_axis.w");
            return Err(error.expected(Expected::Between { above: 0.0, below: f64::INFINITY }));
        }
        let scale = size.recip();
        let [x, y, near, far] = [self.x, self.y, self.near, self.far].map(|row| row * scale);
        let image = Image { size: image.size * scale, ..image };
        let eye = origin.unwrap_or_else(|| meet(&x, &y, &near));
        let (min, max) = image.edges(DVec2::new(x.at(eye), y.at(eye)));
        let near_cut = is_oblique(&near, forward, self.near_off * scale);
        let far_cut = is_oblique(&far, forward, self.far_off * scale);
        let [right, up] = image.steps();
        let mut depths = Interval::EMPTY;
        for corner in corners(min, max) {
            let base = |cut: bool| if cut { eye + right * corner.x + up * corner.y } else { eye };
            depths.min = least(depths.min, -near.at(base(near_cut)) / near.normal.dot(forward));
            depths.max = most(depths.max, -far.at(base(far_cut)) / far.normal.dot(forward));
        }
        let room = (depths.max - depths.min) * ROOM;
        View {
            eye,
            right: image.right,
            up: image.up,
            forward,
            lean: image.lean,
            lens: Lens::Orthographic,
            frame_min: min,
            frame_max: max,
            near: if near_cut { depths.min - room } else { depths.min },
            far: if far_cut { depths.max + room } else { depths.max },
            near_cut: near_cut.then_some(near),
            far_cut: far_cut.then_some(far),
        }
        .checked()
    }
}

/// Whether a plane is oblique to a unit direction, by more than the error `off` of its normal.
fn is_oblique(plane: &Plane, forward: DVec3, off: f64) -> bool {
    (plane.normal - forward * plane.normal.dot(forward)).length() > off
}

/// The corners of a rectangle.
fn corners(min: DVec2, max: DVec2) -> impl Iterator<Item = DVec2> {
    [min, DVec2::new(max.x, min.y), DVec2::new(min.x, max.y), max].into_iter()
}

/// The axes of an image, normal to its sides: at right angles to each other only where the image is not sheared.
struct Image {
    right: DVec3,
    up: DVec3,
    /// The cosine of the angle between them, 0 where it is no more than rounding.
    lean: f64,
    /// The lengths of the rows along them.
    size: DVec2,
}

impl Rows {
    /// The axes along two rows with normals across the view; `whole` are the lengths of the normals before their parts along the
    /// view were taken off.
    fn image(&self, [x, y]: [&Plane; 2], forward: DVec3, whole: DVec2) -> Result<Image, InputError> {
        let size = DVec2::new(x.normal.length(), y.normal.length());
        let (right, up) = (x.normal / size.x, y.normal / size.y);
        let lean = right.dot(up);
        // The sine of the angle between the axes is all rounding: there is no image.
        if lean.is_nan() || 1.0 - lean * lean <= 1e-12 {
            return check::fail(self.field, InputErrorKind::Singular);
        }
        if lean.abs() > self.tolerance * (whole / size).element_sum() {
            return Ok(Image { right, up, lean, size });
        }
        // Orthonormal to the last bit, with the handedness kept.
        let up = (up - forward * up.dot(forward)).normalize();
        let square = up.cross(forward);
        let right = if square.dot(right) < 0.0 { -square } else { square };
        Ok(Image { right, up, lean: 0.0, size })
    }
}

impl Image {
    /// Where the rows are −1 and 1 on the axes, with the values `begin` at the origin of the axes.
    fn edges(&self, begin: DVec2) -> (DVec2, DVec2) {
        ((-1.0 - begin) / self.size, (1.0 - begin) / self.size)
    }

    fn steps(&self) -> [DVec3; 2] {
        steps(self.right, self.up, self.lean)
    }
}

/// The steps in the image that go by 1 along one of two axes and by 0 along the other.
pub(crate) fn steps(right: DVec3, up: DVec3, lean: f64) -> [DVec3; 2] {
    if lean == 0.0 {
        return [right, up];
    }
    let scale = (1.0 - lean * lean).recip();
    [(right - up * lean) * scale, (up - right * lean) * scale]
}
