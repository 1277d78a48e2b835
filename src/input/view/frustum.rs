//! The frustum of any matrix from world to clip space.
//!
//! Such a matrix says all there is to say of a camera by its rows, whatever they were multiplied from. The sides, the near
//! plane and the far plane are sums and differences of rows; w is depth before the eye; and the eye is the point at which
//! the rows x, y and w vanish. Nothing has to be taken apart into a pose and a lens, so that rotations of the image,
//! shears, scales and oblique near planes are no cases of their own.
//!
//! Two things alone need to know how the matrix was rounded: whether lines of sight are parallel, and whether a plane
//! stands across them. Both hold up to the rounding of the entries.

use crate::convex::Plane;
use crate::error::{InputError, InputErrorKind, MAX_COORDINATE, check};
use crate::input::clip_space::{ClipSpace, DepthRange, YAxis};
use crate::input::view::{Lens, View};
use crate::math::bounds::{Interval, least, most};
use glam::{DMat4, DVec2, DVec3};

/// How many roundings of its terms a number may be from zero and count as zero.
const ROUNDINGS: f64 = 16.0;

/// Room for the roundings of the depths between which oblique planes end a view.
const ROOM: f64 = 1.0 / 1_099_511_627_776.0;

/// Half a unit in the last place of what a matrix was made in: of f32 where all of its entries are numbers of f32.
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

/// A volume determinant: of the normals of three planes.
fn determinant(a: &Plane, b: &Plane, c: &Plane) -> f64 {
    a.normal.dot(b.normal.cross(c.normal))
}

/// The point that three planes share; not finite where there is none.
pub(crate) fn meet(a: &Plane, b: &Plane, c: &Plane) -> DVec3 {
    let (bc, ca, ab) = (b.normal.cross(c.normal), c.normal.cross(a.normal), a.normal.cross(b.normal));
    -(bc * a.offset + ca * b.offset + ab * c.offset) / a.normal.dot(bc)
}

/// What a matrix from world to clip space says, with all rows over the same number.
pub(crate) struct Rows {
    x: Plane,
    y: Plane,
    /// From −1 to 1 over w.
    z: Plane,
    w: Plane,
    /// Not negative inside.
    near: Plane,
    far: Plane,
    /// How far roundings may turn the normals of those two.
    near_off: f64,
    far_off: f64,
    /// Half a unit in the last place of the entries, times [`ROUNDINGS`].
    tolerance: f64,
    field: &'static str,
}

impl Rows {
    /// The rows of a finite matrix that was rounded by so much; errors name `field`.
    pub(crate) fn new(
        clip_from_world: &DMat4,
        clip: ClipSpace,
        rounding: f64,
        field: &'static str,
    ) -> Result<Self, InputError> {
        let rows = rows(clip_from_world);
        // All entries may be of any size: what is homogeneous has none.
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
        Ok(Self { x, y, z: near - far, w, near, far, near_off, far_off, tolerance, field })
    }

    /// The view; `origin` is what depths of an orthographic one count from, or the middle of its near plane.
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
        // What of a row is across the view, and its slope along it.
        let across = |row: Plane| {
            let along = row.normal.dot(forward);
            (row - w * along, along)
        };
        let whole = DVec2::new(x.normal.length(), y.normal.length());
        let ((x, x_along), (y, y_along)) = (across(x), across(y));
        let eye = meet(&x, &y, &w);
        if !eye.is_finite() {
            return check::fail(self.field, InputErrorKind::NotAProjection);
        }
        let image = self.image([&x, &y], forward, whole)?;
        let (min, max) = image.edges(DVec2::new(x_along, y_along));
        let (near, far) = (self.near * scale, self.far * scale);
        let (near_off, far_off) = (self.near_off * scale, self.far_off * scale);

        // Depth is 0 at the eye and 1 at the end of an edge's direction.
        // The planes' sum is a multiple of w, which vanishes there, so that they have one value but for the sign: that of the
        // one with the smaller terms has the smaller roundings.
        let size = |plane: &Plane| plane.normal.abs().dot(eye.abs()) + plane.offset.abs();
        let (before, size) =
            if size(&far) < size(&near) { (far.at(eye), size(&far)) } else { (-near.at(eye), size(&near)) };
        let lost = self.tolerance * size;
        // A near plane that rounding may have brought behind an eye far out stands next to it.
        let before = if before.abs() <= lost { most(before, lost / 256.0) } else { before };
        if before <= 0.0 {
            return check::fail("near", InputErrorKind::OutOfOrder);
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
            // The near plane leaves nothing of the view.
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
            // So far out no plane is told from the one at infinity.
            far: if far_depth > MAX_COORDINATE { f64::INFINITY } else { far_depth },
            near_cut: near_cut.then_some(near),
            far_cut: far_cut.then_some(far),
        }
        .checked()
    }

    fn orthographic(&self, origin: Option<DVec3>) -> Result<View, InputError> {
        let sight = self.x.normal.cross(self.y.normal).normalize_or_zero();
        let forward = if self.near.normal.dot(sight) < 0.0 { -sight } else { sight };
        let whole = DVec2::new(self.x.normal.length(), self.y.normal.length());
        let image = self.image([&self.x, &self.y], forward, whole)?;
        let middle = meet(&self.x, &self.y, &self.z);
        let size = self.w.at(middle);
        if size.is_nan() || size <= 0.0 {
            return check::fail(self.field, InputErrorKind::NotAProjection);
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

/// Whether a plane does not stand across a unit direction, where its normal may be off by so much.
fn is_oblique(plane: &Plane, forward: DVec3, off: f64) -> bool {
    (plane.normal - forward * plane.normal.dot(forward)).length() > off
}

/// The corners of a rectangle.
fn corners(min: DVec2, max: DVec2) -> impl Iterator<Item = DVec2> {
    [min, DVec2::new(max.x, min.y), DVec2::new(min.x, max.y), max].into_iter()
}

/// The axes of an image: across its sides, and so at right angles only where it is not sheared.
struct Image {
    right: DVec3,
    up: DVec3,
    /// The cosine of the angle between them, 0 where it is no more than rounding.
    lean: f64,
    /// How long the rows are along them.
    size: DVec2,
}

impl Rows {
    /// The axes along two rows whose normals are across the view, and were so long before what lies along it was taken off.
    fn image(&self, [x, y]: [&Plane; 2], forward: DVec3, whole: DVec2) -> Result<Image, InputError> {
        let size = DVec2::new(x.normal.length(), y.normal.length());
        let (right, up) = (x.normal / size.x, y.normal / size.y);
        let lean = right.dot(up);
        // A sine that is all rounding would make no image.
        if lean.is_nan() || 1.0 - lean * lean <= 1e-12 {
            return check::fail(self.field, InputErrorKind::Singular);
        }
        if lean.abs() > self.tolerance * (whole / size).element_sum() {
            return Ok(Image { right, up, lean, size });
        }
        // Orthonormal to the last bit, each on the side it was on.
        let up = (up - forward * up.dot(forward)).normalize();
        let square = up.cross(forward);
        let right = if square.dot(right) < 0.0 { -square } else { square };
        Ok(Image { right, up, lean: 0.0, size })
    }
}

impl Image {
    /// Where the rows have the values −1 and 1 on the axes, if they have these where the axes begin.
    fn edges(&self, begin: DVec2) -> (DVec2, DVec2) {
        ((-1.0 - begin) / self.size, (1.0 - begin) / self.size)
    }

    fn steps(&self) -> [DVec3; 2] {
        steps(self.right, self.up, self.lean)
    }
}

/// The steps in the image that go along one of two axes by 1, and along the other by nothing.
pub(crate) fn steps(right: DVec3, up: DVec3, lean: f64) -> [DVec3; 2] {
    if lean == 0.0 {
        return [right, up];
    }
    let scale = (1.0 - lean * lean).recip();
    [(right - up * lean) * scale, (up - right * lean) * scale]
}
