//! Axis-aligned bounding boxes in f32 and f64.

use crate::error::{Expected, Hint, InputError, InputErrorKind, MAX_COORDINATE, check};
use crate::input::numbers::vector;
use glam::{DVec3, Vec3};

/// An axis-aligned bounding box in f32.
///
/// It is empty with `min` above [`MAX_COORDINATE`] and `max` below its negative on all axes, such as [`Self::EMPTY`].
#[doc(alias = "bounding box")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Aabb {
    /// The least coordinates, in world units.
    pub min: Vec3,
    /// The largest coordinates, in world units.
    pub max: Vec3,
}

impl Aabb {
    /// The empty box.
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// A box from its least and largest coordinates. f64 coordinates are rounded outwards, so that the box loses nothing: at 6·10⁶
    /// from the origin, f32 has steps of half a unit.
    ///
    /// ```
    /// use shadowfit::Aabb;
    ///
    /// let rounded = Aabb::new([6e6 + 0.1, 0.0, 0.0], [6e6 + 0.7, 1.0, 1.0]);
    /// assert_eq!((rounded.min.x, rounded.max.x), (6e6, 6e6 + 1.0));
    /// assert_eq!(rounded.max.y, 1.0); // f32 numbers stay as they are
    /// ```
    #[must_use]
    pub fn new<F: Into<f64>, G: Into<f64>>(min: impl Into<[F; 3]>, max: impl Into<[G; 3]>) -> Self {
        let (min, max) = (vector(min), vector(max));
        let below =
            |value: f64| if f64::from(value as f32) > value { (value as f32).next_down() } else { value as f32 };
        let above =
            |value: f64| if f64::from(value as f32) < value { (value as f32).next_up() } else { value as f32 };
        Self { min: min.to_array().map(below).into(), max: max.to_array().map(above).into() }
    }
}

/// An axis-aligned bounding box in f64, for worlds too large for f32.
///
/// It is empty with `min` above [`MAX_COORDINATE`] and `max` below its negative on all axes, such as [`Self::EMPTY`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DAabb {
    /// The least coordinates, in world units.
    pub min: DVec3,
    /// The largest coordinates, in world units.
    pub max: DVec3,
}

impl DAabb {
    /// The empty box.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// A box from its least and largest coordinates, as they are.
    ///
    /// ```
    /// use shadowfit::{Aabb, input::DAabb};
    ///
    /// let precise = DAabb::new([6e6 + 0.1, 0.0, 0.0], [6e6 + 0.7, 1.0, 1.0]);
    /// assert_eq!(precise.min.x, 6e6 + 0.1);
    /// assert_eq!(DAabb::from(Aabb::from(precise)).max.x, 6e6 + 1.0); // rounded outwards on the way
    /// ```
    #[must_use]
    pub fn new<F: Into<f64>, G: Into<f64>>(min: impl Into<[F; 3]>, max: impl Into<[G; 3]>) -> Self {
        Self { min: vector(min), max: vector(max) }
    }
}

impl From<Aabb> for DAabb {
    fn from(single: Aabb) -> Self {
        Self { min: single.min.as_dvec3(), max: single.max.as_dvec3() }
    }
}

/// Rounded outwards.
impl From<DAabb> for Aabb {
    fn from(double: DAabb) -> Self {
        Self::new(double.min, double.max)
    }
}

/// The boxes of a scene's lists: [`Aabb`] or [`DAabb`].
pub trait Bounding: Copy + Into<DAabb> + sealed::Listed {}

impl Bounding for Aabb {}
impl Bounding for DAabb {}

mod sealed {
    use super::{Aabb, DAabb, List};

    pub trait Listed: Sized {
        fn list(boxes: &[Self]) -> List<'_>;
    }

    impl Listed for Aabb {
        fn list(boxes: &[Self]) -> List<'_> {
            List::Single(boxes)
        }
    }

    impl Listed for DAabb {
        fn list(boxes: &[Self]) -> List<'_> {
            List::Double(boxes)
        }
    }
}

/// A list of boxes in f32 or f64.
#[derive(Clone, Copy, Debug)]
pub enum List<'a> {
    Single(&'a [Aabb]),
    Double(&'a [DAabb]),
}

/// A list of boxes relative to a point of the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Boxes<'a> {
    list: List<'a>,
    origin: DVec3,
}

impl<'a> Boxes<'a> {
    pub(crate) fn new<B: Bounding>(boxes: &'a [B], origin: DVec3) -> Self {
        Self { list: B::list(boxes), origin }
    }

    /// The list, if every box is finite and in order.
    pub(crate) fn checked(self, field: &'static str) -> Result<Self, InputError> {
        let mut wrong = Ok(());
        self.for_each(|index, one| {
            if wrong.is_ok() && checked_box(one.min, one.max).is_err() {
                wrong = checked_box(one.min, one.max).map(|_| ()).map_err(|error| of_boxes(error, field, index));
            }
        });
        wrong.map(|()| self)
    }

    pub(crate) fn len(&self) -> usize {
        match self.list {
            List::Single(list) => list.len(),
            List::Double(list) => list.len(),
        }
    }

    /// A box in world space; `None` past the end and for an empty one.
    pub(crate) fn get(&self, index: usize) -> Option<DAabb> {
        let one = match self.list {
            List::Single(list) => DAabb::from(*list.get(index)?),
            List::Double(list) => *list.get(index)?,
        };
        (!is_empty(&one)).then(|| moved(one, self.origin))
    }

    /// Calls `each` with the index and the world-space box of every box that is not empty.
    pub(crate) fn for_each(&self, mut each: impl FnMut(usize, DAabb)) {
        let mut pass = |index: usize, one: DAabb| {
            if !is_empty(&one) {
                each(index, moved(one, self.origin));
            }
        };
        match self.list {
            List::Single(list) => list.iter().enumerate().for_each(|(index, one)| pass(index, DAabb::from(*one))),
            List::Double(list) => list.iter().enumerate().for_each(|(index, one)| pass(index, *one)),
        }
    }

    /// The largest absolute coordinates.
    pub(crate) fn extent(&self) -> DVec3 {
        let mut extent = DVec3::ZERO;
        self.for_each(|_, one| extent = extent.max(one.min.abs()).max(one.max.abs()));
        extent
    }
}

/// A box moved by the origin of its list and rounded outwards.
fn moved(one: DAabb, origin: DVec3) -> DAabb {
    if origin == DVec3::ZERO {
        return one;
    }
    DAabb { min: (one.min + origin).map(f64::next_down), max: (one.max + origin).map(f64::next_up) }
}

/// Whether a box is marked as empty.
fn is_empty(one: &DAabb) -> bool {
    one.min.cmpgt(DVec3::splat(MAX_COORDINATE)).all() && one.max.cmplt(DVec3::splat(-MAX_COORDINATE)).all()
}

/// A box that is finite and in order, or `None` for one that is marked as empty.
pub(crate) fn checked_box(min: DVec3, max: DVec3) -> Result<Option<(DVec3, DVec3)>, InputError> {
    let one = DAabb { min, max };
    if is_empty(&one) {
        return Ok(None);
    }
    // Engines mark objects without bounds like this.
    let unbounded = min.cmplt(DVec3::splat(-MAX_COORDINATE)).all() && max.cmpgt(DVec3::splat(MAX_COORDINATE)).all();
    let hinted = |error: InputError| error.hinted(unbounded.then_some(Hint::Unbounded));
    let (min, max) = (check::point("min", min).map_err(hinted)?, check::point("max", max)?);
    for (axis, (least, most)) in min.to_array().into_iter().zip(max.to_array()).enumerate() {
        if least > most {
            let field = ["min.x", "min.y", "min.z"][axis];
            let expected = Expected::AtLeast { field, value: least };
            let error =
                InputError::new("max", InputErrorKind::OutOfOrder).of_axis(axis).got(most).expected(expected);
            return Err(error.hinted(min.cmpge(max).all().then_some(Hint::Swapped)));
        }
    }
    Ok(Some((min, max)))
}

/// An error of [`checked_box`] as one about a box in a list.
pub(crate) fn of_boxes(error: InputError, field: &'static str, index: usize) -> InputError {
    let component = match (error.field, error.component) {
        ("min", Some("x")) => Some("min.x"),
        ("min", Some("y")) => Some("min.y"),
        ("min", Some("z")) => Some("min.z"),
        ("max", Some("x")) => Some("max.x"),
        ("max", Some("y")) => Some("max.y"),
        ("max", Some("z")) => Some("max.z"),
        (_, other) => other,
    };
    InputError { component, ..error }.of_list(field, index)
}
