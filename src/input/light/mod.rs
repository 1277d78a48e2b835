//! The light l, and L, what it can light.

mod cube;
#[cfg(feature = "serde")]
mod stored;

pub use cube::CubeFace;

use crate::convex::Plane;
use crate::error::{Expected, Hint, InputError, InputErrorKind, MIN_DISTANCE, check};
use crate::input::numbers::vector;
use crate::math::angle;
use crate::math::list::list;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DVec2, DVec3, DVec4};

/// A light: a homogeneous point l and a convex region L outside of which it lights nothing.
///
/// Directions of light point **towards** the light. The axis of a spot or a hemisphere is the axis of the region it
/// lights and points **away** from the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Light"))]
pub struct Light {
    kind: Kind,
    /// Planes of L besides those of its kind, inside ≥ 0, with unit normals.
    within: Within,
}

type Within = [Option<Plane>; Light::MAX_WITHIN];

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum Kind {
    Directional {
        direction_to_light: DVec3,
    },
    Local {
        position: DVec3,
        near: f64,
        #[cfg_attr(feature = "serde", serde(with = "crate::math::infinity"))]
        range: f64,
        shape: Shape,
    },
}

/// How a light at a position spreads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Shape {
    Point,
    /// `half_angle` in radians; the unit `up`, across the axis, where the pyramid around the cone is turned.
    Spot {
        axis: DVec3,
        half_angle: f64,
        #[cfg_attr(feature = "serde", serde(default))]
        up: Option<DVec3>,
    },
    /// Tangents of half the angles along `up`, across the axis and unit length, and across both.
    Pyramid {
        axis: DVec3,
        up: DVec3,
        tangents: DVec2,
    },
    Hemisphere {
        axis: DVec3,
    },
    /// What a point light or, with an axis, a hemisphere lights of a face.
    CubeFace {
        face: CubeFace,
        overlap: f64,
        hemisphere: Option<DVec3>,
    },
}

impl Light {
    /// A light infinitely far away, as the sun: `direction_to_light` points from the scene **towards** it and need not
    /// be unit length.
    ///
    /// # Errors
    ///
    /// Names `"direction_to_light"` when it is zero or not finite.
    pub fn directional<F: Into<f64>>(direction_to_light: impl Into<[F; 3]>) -> Result<Self, InputError> {
        let direction_to_light = check::direction("direction_to_light", vector(direction_to_light))?;
        Ok(Self { kind: Kind::Directional { direction_to_light }, within: [None; Self::MAX_WITHIN] })
    }

    /// A light at a position that shines all around.
    ///
    /// `near` is the distance from the light within which nothing need cast a shadow (the lamp's own bulb and shade): a map
    /// may hold what is nearer or not, since a frustum begins at a plane. `range` is the distance the light reaches. Both are
    /// in world units; `range` may be infinite.
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, not positive, or out of order.
    pub fn point<F: Into<f64>>(position: impl Into<[F; 3]>, near: f64, range: f64) -> Result<Self, InputError> {
        Self::local(vector(position), near, range, Shape::Point)
    }

    /// A light at a position that shines into a cone.
    ///
    /// `axis` points from the light along the middle of the cone, `half_angle` is the angle between the axis and the
    /// cone's side in radians, in (0, π/2). `near` and `range` are as for [`Self::point`].
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, outside its range, or out of order.
    pub fn spot<F: Into<f64>, G: Into<f64>>(
        position: impl Into<[F; 3]>,
        axis: impl Into<[G; 3]>,
        half_angle: f64,
        near: f64,
        range: f64,
    ) -> Result<Self, InputError> {
        let axis = check::direction("axis", vector(axis))?;
        // A cone narrower than the smallest field of view, or within rounding of a half space, is neither.
        const MARGIN: f64 = 1e-9;
        let half_angle = check::angle("half_angle", half_angle, MARGIN, FRAC_PI_2 - MARGIN).map_err(|error| {
            error.hinted(match half_angle {
                _ if (FRAC_PI_2..=PI).contains(&half_angle) => Some(Hint::FullAngle),
                _ if (PI..=180.0).contains(&half_angle) => Some(Hint::Degrees),
                _ => None,
            })
        })?;
        Self::local(vector(position), near, range, Shape::Spot { axis, half_angle, up: None })
    }

    /// A light at a position that shines into the half space that `axis` points into, as a wall lamp does. `near` and
    /// `range` are as for [`Self::point`].
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, not positive, or out of order.
    pub fn hemisphere<F: Into<f64>, G: Into<f64>>(
        position: impl Into<[F; 3]>,
        axis: impl Into<[G; 3]>,
        near: f64,
        range: f64,
    ) -> Result<Self, InputError> {
        let axis = check::direction("axis", vector(axis))?;
        Self::local(vector(position), near, range, Shape::Hemisphere { axis })
    }

    /// A light at a position that shines into a pyramid, as projectors and rectangular spots do.
    ///
    /// `axis` points from the light along the middle of the pyramid, and `up` to one of its sides: it need not be across the axis.
    /// `tangents` are those of half the angles between its sides: first across `up`, then along it, so that a picture w wide and
    /// h high at distance d has `[0.5 * w / d, 0.5 * h / d]`. `near` and `range` are as for [`Self::point`].
    ///
    /// ```
    /// use shadowfit::Light;
    ///
    /// // A projector's 16:9 picture, two metres wide on a wall four metres away.
    /// let beam = Light::pyramid((0.0, 2.5, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), [0.25, 0.140_625], 0.1, 10.0)?;
    /// let reaches = |x, y| beam.planes().iter().all(|plane| plane.at((x, y, -4.0).into()) >= 0.0);
    /// assert!(reaches(0.99, 2.5) && !reaches(1.01, 2.5) && reaches(0.0, 3.05) && !reaches(0.0, 3.07));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, without direction, parallel to the axis, not positive, or out of order; `"tangents"`
    /// when one is above [`Self::MAX_TANGENT`] or not positive.
    pub fn pyramid<F: Into<f64>, G: Into<f64>, U: Into<f64>>(
        position: impl Into<[F; 3]>,
        axis: impl Into<[G; 3]>,
        up: impl Into<[U; 3]>,
        tangents: [f64; 2],
        near: f64,
        range: f64,
    ) -> Result<Self, InputError> {
        let axis = check::direction("axis", vector(axis))?;
        let up = across(axis, vector(up))?;
        for (index, tangent) in tangents.into_iter().enumerate() {
            let allowed = Expected::Within { least: MIN_DISTANCE, most: Self::MAX_TANGENT };
            check::within("tangents", tangent, allowed).map_err(|error| error.of_list("tangents", index))?;
        }
        Self::local(vector(position), near, range, Shape::Pyramid { axis, up, tangents: tangents.into() })
    }

    /// The largest tangent of [`Self::pyramid`]: half an angle of 89.8°.
    pub const MAX_TANGENT: f64 = 256.0;

    /// A spot turned about its axis, so that a side of the pyramid around its cone, which a stable map keeps to, looks along `up`:
    /// the roll that a renderer's own shadow frustum has. `up` need not be across the axis.
    ///
    /// # Errors
    ///
    /// Names `"light"` when it is no spot, and `"up"` when it is not finite, zero, or parallel to the axis.
    pub fn with_up<F: Into<f64>>(self, up: impl Into<[F; 3]>) -> Result<Self, InputError> {
        let Kind::Local { position, near, range, shape: Shape::Spot { axis, half_angle, .. } } = self.kind else {
            return check::fail("light", InputErrorKind::NotASpot);
        };
        let up = Some(across(axis, vector(up))?);
        let shape = Shape::Spot { axis, half_angle, up };
        Ok(Self { kind: Kind::Local { position, near, range, shape }, ..self })
    }

    /// The same light where it reaches no farther than these planes, inside ≥ 0: barn doors, a window, the cell of a clustered
    /// renderer, the box of a local sun. They take the place of others of this call before. Any light may have them, and the
    /// faces of a cube inherit them.
    ///
    /// L is then that much smaller, for receivers and for casters alike: what a plane cuts off neither is lit nor casts.
    ///
    /// ```
    /// use shadowfit::{Light, focus::Plane};
    ///
    /// // A sun that shines in one room only.
    /// let (low, high) = (Plane::from([1.0, 0.0, 0.0, 4.0]), Plane::from([-1.0, 0.0, 0.0, 4.0]));
    /// let sun = Light::directional((0.3, 1.0, 0.2))?.within(&[low, high])?;
    /// assert_eq!(sun.planes().len(), 2);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"planes"` when there are more than [`Self::MAX_WITHIN`], or, with its index, when one is not finite or without
    /// direction.
    pub fn within(self, planes: &[Plane]) -> Result<Self, InputError> {
        if planes.len() > Self::MAX_WITHIN {
            return check::fail("planes", InputErrorKind::TooMany);
        }
        let mut within = [None; Self::MAX_WITHIN];
        for (index, (slot, plane)) in within.iter_mut().zip(planes).enumerate() {
            let checked = plane.checked("planes").map_err(|error| error.of_list("planes", index))?;
            // One with a unit normal stays as it is to the last bit.
            *slot = Some(if checked.normal == plane.normal { *plane } else { checked });
        }
        Ok(Self { within, ..self })
    }

    /// The most planes of [`Self::within`].
    pub const MAX_WITHIN: usize = 6;

    /// The part of a point light or a hemisphere that shines through a face of the cube around it: where one map is not
    /// enough, as within a room, six of these have one each.
    ///
    /// `overlap` widens the face, so that a filter next to a seam reads in one map what it should: the sides stand at
    /// tangent `1 + overlap` to the face's axis instead of 1. [`CubeFace::overlap`] says how much a filter needs. Which
    /// face a point is in does not depend on it: [`CubeFace::of`].
    ///
    /// # Errors
    ///
    /// Names `"light"` when it is directional, a spot, or a face already, and `"overlap"` when it is not in
    /// \[0, [`CubeFace::MAX_OVERLAP`]\].
    pub fn cube_face(&self, face: CubeFace, overlap: f64) -> Result<Self, InputError> {
        let overlap = check::part("overlap", overlap, CubeFace::MAX_OVERLAP)?;
        let Kind::Local { position, near, range, shape } = self.kind else {
            return check::fail("light", InputErrorKind::NotAllAround);
        };
        let hemisphere = match shape {
            Shape::Point => None,
            Shape::Hemisphere { axis } => Some(axis),
            Shape::Spot { .. } | Shape::Pyramid { .. } | Shape::CubeFace { .. } => {
                return check::fail("light", InputErrorKind::NotAllAround);
            }
        };
        let part = Self::local(position, near, range, Shape::CubeFace { face, overlap, hemisphere })?;
        Ok(Self { within: self.within, ..part })
    }

    fn local(position: DVec3, near: f64, range: f64, shape: Shape) -> Result<Self, InputError> {
        let position = check::point("position", position)?;
        let near = check::distance("near", near)?;
        let range = check::distance_or_infinity("range", range)
            .map_err(|error| error.hinted((range == 0.0).then_some(Hint::NoLimit)))?;
        check::above("range", range, "near", near)?;
        let within = [None; Self::MAX_WITHIN];
        Ok(Self { kind: Kind::Local { position, near, range, shape }, within })
    }

    /// The light as a homogeneous point l: (position, 1), or (unit direction towards the light, 0).
    #[must_use]
    pub const fn homogeneous(&self) -> DVec4 {
        match self.kind {
            Kind::Directional { direction_to_light: d } => DVec4::new(d.x, d.y, d.z, 0.0),
            Kind::Local { position: p, .. } => DVec4::new(p.x, p.y, p.z, 1.0),
        }
    }

    /// Where the light is, unless it is infinitely far away.
    #[must_use]
    pub const fn position(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Directional { .. } => None,
            Kind::Local { position, .. } => Some(position),
        }
    }

    /// The distance from a light at a position within which nothing casts, in world units; 0 for a directional light.
    #[must_use]
    pub const fn near(&self) -> f64 {
        match self.kind {
            Kind::Directional { .. } => 0.0,
            Kind::Local { near, .. } => near,
        }
    }

    /// The distance that a light at a position reaches, in world units; infinite for a directional light.
    #[must_use]
    pub const fn range(&self) -> f64 {
        match self.kind {
            Kind::Directional { .. } => f64::INFINITY,
            Kind::Local { range, .. } => range,
        }
    }

    /// The unit axis of a spot, a pyramid or a hemisphere, away from the light.
    pub(crate) const fn axis(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Local {
                shape: Shape::Spot { axis, .. } | Shape::Pyramid { axis, .. } | Shape::Hemisphere { axis },
                ..
            } => Some(axis),
            Kind::Directional { .. } | Kind::Local { shape: Shape::Point | Shape::CubeFace { .. }, .. } => None,
        }
    }

    /// The unit direction from a point towards the light.
    #[must_use]
    pub fn direction_from(&self, point: DVec3) -> DVec3 {
        match self.kind {
            Kind::Directional { direction_to_light } => direction_to_light,
            Kind::Local { position, .. } => (position - point).normalize_or_zero(),
        }
    }

    /// The planes of L in world space, inside ≥ 0; none for a light without bounds.
    ///
    /// A spot's are the four sides of the pyramid around its cone, its near plane and, with a finite range, its far
    /// plane; a hemisphere's its near plane and the rest of a box; a point light's the box around its range. A cube
    /// face's are those of a spot's pyramid, and a hemisphere's own plane. Those of [`Self::within`] come last.
    #[must_use]
    pub fn planes(&self) -> LightPlanes {
        let mut planes = LightPlanes { planes: [Plane::ONE; Self::MAX_PLANES], len: 0 };
        if let Kind::Local { position, near, range, shape } = self.kind {
            planes.push_shape(position, near, range, shape);
        }
        self.within.iter().flatten().for_each(|plane| planes.push(*plane));
        planes
    }

    /// The axes across and along the one frustum that is L, and the tangents of its sides: `[u, v, axis]`, of a spot, a
    /// pyramid or a cube's face; seen along the axis, v is up and u to the right.
    pub(crate) fn frustum(&self) -> Option<([DVec3; 3], DVec2)> {
        match self.kind {
            Kind::Local { shape: Shape::Spot { axis, half_angle, up }, .. } => {
                let (sine, cosine) = angle::sine_cosine(half_angle);
                let (u, v) = of_spot(axis, up);
                Some(([u, v, axis], DVec2::splat(sine / cosine)))
            }
            Kind::Local { shape: Shape::Pyramid { axis, up, tangents }, .. } => {
                Some(([axis.cross(up), up, axis], tangents))
            }
            Kind::Local { shape: Shape::CubeFace { face, overlap, .. }, .. } => {
                let axis = face.axis();
                let v = DVec3::new(axis.z, axis.x, axis.y);
                Some(([axis.cross(v), v, axis], DVec2::splat(1.0 + overlap)))
            }
            _ => None,
        }
    }

    /// The most planes that L can have: those of a hemisphere's cube face, and those it is within.
    pub(crate) const MAX_PLANES: usize = 7 + Self::MAX_WITHIN;
}

/// The unit direction across an axis towards `up`.
fn across(axis: DVec3, up: DVec3) -> Result<DVec3, InputError> {
    let up = check::direction("up", up)?;
    // One that is across already stays as it is to the last bit.
    let along = up.dot(axis);
    if along.abs() <= 4.0 * f64::EPSILON {
        return Ok(up);
    }
    let across = up - axis * along;
    // Nearer to the axis than this its direction is rounding.
    if across.length() < 1e-9 { check::fail("up", InputErrorKind::Parallel) } else { Ok(across.normalize()) }
}

/// The axes across a spot: those of any light with its axis, or turned to its own `up`.
fn of_spot(axis: DVec3, up: Option<DVec3>) -> (DVec3, DVec3) {
    up.map_or_else(|| crate::math::frame::of_light(axis), |up| (axis.cross(up), up))
}

/// Up to thirteen planes, as [`Light::planes`] returns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPlanes {
    planes: [Plane; Light::MAX_PLANES],
    len: usize,
}

impl LightPlanes {
    /// The planes of what a shape at a position lights.
    fn push_shape(&mut self, position: DVec3, near: f64, range: f64, shape: Shape) {
        match shape {
            Shape::Point => {
                for axis in DVec3::AXES {
                    self.push_slab(axis, position, -range, range);
                }
            }
            Shape::Spot { axis, half_angle, up } => {
                let (sine, cosine) = angle::sine_cosine(half_angle);
                let (u, v) = of_spot(axis, up);
                for side in [u, -u, v, -v] {
                    self.push(Plane::through(axis * sine - side * cosine, position));
                }
                // At the cone's side a point at distance `near` is only this far along the axis.
                self.push_slab(axis, position, near * cosine, range);
            }
            Shape::Pyramid { axis, up, tangents } => {
                for (side, tangent) in [(axis.cross(up), tangents.x), (up, tangents.y)] {
                    self.push(Plane::through(axis * tangent - side, position));
                    self.push(Plane::through(axis * tangent + side, position));
                }
                // At the pyramid's edges a point at distance `near` is only this far along the axis.
                self.push_slab(axis, position, near / tangents.extend(1.0).length(), range);
            }
            Shape::Hemisphere { axis } => {
                let (u, v) = crate::math::frame::of_light(axis);
                self.push_slab(axis, position, 0.0, range);
                self.push_slab(u, position, -range, range);
                self.push_slab(v, position, -range, range);
            }
            Shape::CubeFace { face, overlap, hemisphere } => {
                let (axis, tangent) = (face.axis(), 1.0 + overlap);
                // The next two axes of the world in turn, whichever way they point.
                let (u, v) = (DVec3::new(axis.z, axis.x, axis.y), DVec3::new(axis.y, axis.z, axis.x));
                for side in [u, -u, v, -v] {
                    self.push(Plane::through(axis * tangent - side, position));
                }
                // At the pyramid's edges a point at distance `near` is only this far along the axis.
                self.push_slab(axis, position, near / DVec3::new(1.0, tangent, tangent).length(), range);
                if let Some(axis) = hemisphere {
                    self.push(Plane::through(axis, position));
                }
            }
        }
    }

    fn push(&mut self, plane: Plane) {
        self.planes[self.len] = plane;
        self.len += 1;
    }

    /// Distances along `axis` from `position` between `min` and `max`, either of which may be infinite.
    fn push_slab(&mut self, axis: DVec3, position: DVec3, min: f64, max: f64) {
        let along = Plane::through(axis, position);
        if min.is_finite() {
            self.push(along - Plane::ONE * min);
        }
        if max.is_finite() {
            self.push(Plane::ONE * max - along);
        }
    }
}

list!(LightPlanes, Plane, planes, "planes");
