//! The light l and the region L that it reaches.

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

/// A light: a homogeneous point l and the convex region L that it reaches.
///
/// Directions of light point **towards** the light. The axis of a spot, a pyramid or a hemisphere points **away** from the light,
/// along the middle of its region.
///
/// ```
/// use shadowfit::{Light, glam::{DVec3, DVec4}};
///
/// let sun = Light::directional((0.0, 2.0, 0.0))?;
/// assert_eq!((sun.homogeneous(), sun.position()), (DVec4::Y, None));
/// assert_eq!((sun.near(), sun.range()), (0.0, f64::INFINITY));
///
/// let bulb = Light::point((0.0, 3.0, 0.0), 0.1, 20.0)?;
/// assert_eq!((bulb.homogeneous(), bulb.position()), (DVec4::new(0.0, 3.0, 0.0, 1.0), Some(DVec3::Y * 3.0)));
/// assert_eq!((bulb.near(), bulb.range()), (0.1, 20.0));
/// assert_eq!(bulb.direction_from(DVec3::ZERO), DVec3::Y);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "lamp")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Light"))]
pub struct Light {
    kind: Kind,
    /// Planes of L from [`Light::within`], inside ≥ 0, with unit normals.
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

/// The shape of a local light's region.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Shape {
    Point,
    /// `half_angle` in radians; a unit `up` across the axis where [`Light::with_up`] rolls the pyramid around the cone.
    Spot {
        axis: DVec3,
        half_angle: f64,
        up: Option<DVec3>,
    },
    /// Tangents of the half angles: across `up`, then along it. `up` is a unit vector across the axis.
    Pyramid {
        axis: DVec3,
        up: DVec3,
        tangents: DVec2,
    },
    Hemisphere {
        axis: DVec3,
    },
    /// The part of a point light or, with an axis, of a hemisphere within a face.
    CubeFace {
        face: CubeFace,
        overlap: f64,
        hemisphere: Option<DVec3>,
    },
}

impl Light {
    /// A directional light, infinitely far away, such as the sun. `direction_to_light` points from the scene **towards** the light,
    /// in world space, and may have any length.
    ///
    /// ```
    /// use shadowfit::{Light, glam::DVec3};
    ///
    /// let light_travels = [0.0, -1.0, 0.0]; // many engines keep this direction: negate it
    /// let sun = Light::directional(light_travels.map(|x: f64| -x))?;
    /// assert_eq!(sun.direction_from(DVec3::new(5.0, 0.0, 7.0)), DVec3::Y);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"direction_to_light"` when it is zero or not finite.
    #[doc(alias = "sun")]
    #[doc(alias = "distant light")]
    pub fn directional<F: Into<f64>>(direction_to_light: impl Into<[F; 3]>) -> Result<Self, InputError> {
        let direction_to_light = check::direction("direction_to_light", vector(direction_to_light))?;
        Ok(Self { kind: Kind::Directional { direction_to_light }, within: [None; Self::MAX_WITHIN] })
    }

    /// A point light: it shines from a position in all directions.
    ///
    /// `position` is in world space. Casters nearer than `near` may be left out of the map (the bulb and its shade); since a
    /// frustum begins at a plane, some are in it. `range` is the distance that the light reaches. Both are in world units; `range`
    /// may be infinite. One map serves only receivers within half a space ([`Surrounded`](crate::Surrounded)); for all around see
    /// [`Self::cube_face`] and `docs/lights-all-around.md`.
    ///
    /// ```
    /// use shadowfit::Light;
    ///
    /// let bulb = Light::point([0.0_f32, 3.0, 0.0], 0.1, 20.0)?;
    /// assert_eq!(bulb.planes().len(), 6); // the box around its range
    /// let error = Light::point([0.0_f32, 3.0, 0.0], 0.1, 0.0).unwrap_err();
    /// assert_eq!(error.to_string(), "range must lie in [2⁻⁴⁰, 2⁴⁰]; got 0. No limit? That is f64::INFINITY.");
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, not positive, or out of order.
    #[doc(alias = "omni")]
    #[doc(alias = "lamp")]
    #[doc(alias = "bulb")]
    pub fn point<F: Into<f64>>(position: impl Into<[F; 3]>, near: f64, range: f64) -> Result<Self, InputError> {
        Self::local(vector(position), near, range, Shape::Point)
    }

    /// A spot: it shines from a position into a cone.
    ///
    /// `axis` is a direction in world space, of any length, from the light along the middle of the cone. `half_angle` is the angle
    /// between axis and side in radians, in (0, π/2). `near` and `range` are distances as for [`Self::point`].
    ///
    /// ```
    /// use shadowfit::Light;
    ///
    /// let spot = |half_angle| Light::spot((0.0, 5.0, 0.0), (0.0, -1.0, 0.0), half_angle, 0.1, 30.0);
    /// let light = spot(0.5)?;
    /// let reaches = |x| light.planes().iter().all(|plane| plane.at((x, 1.0, 0.0).into()) >= 0.0);
    /// assert!(reaches(4.0 * 0.49_f64.tan()) && !reaches(4.0 * 0.51_f64.tan()));
    /// assert!(spot(30.0).unwrap_err().to_string().ends_with("radians; got 30. Degrees?"));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, the zero vector, outside its range, or out of order.
    #[doc(alias = "cone")]
    #[doc(alias = "spotlight")]
    pub fn spot<F: Into<f64>, G: Into<f64>>(
        position: impl Into<[F; 3]>,
        axis: impl Into<[G; 3]>,
        half_angle: f64,
        near: f64,
        range: f64,
    ) -> Result<Self, InputError> {
        let axis = check::direction("axis", vector(axis))?;
        // Narrower cones have no frustum, and wider ones are a half space but for rounding.
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

    /// A hemisphere light: it shines from a position into the half space around `axis`, as a light on a wall does. `near` and
    /// `range` are distances as for [`Self::point`]. Paraboloid maps serve it: [`Focus::paraboloids`](crate::Focus::paraboloids).
    ///
    /// ```
    /// use shadowfit::Light;
    ///
    /// let sconce = Light::hemisphere((0.0, 2.0, 0.0), (1.0, 0.0, 0.0), 0.05, 10.0)?;
    /// let reaches = |x| sconce.planes().iter().all(|plane| plane.at((x, 0.0, 0.0).into()) >= 0.0);
    /// assert!(reaches(1.0) && !reaches(-1.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names the field that is not finite, the zero vector, not positive, or out of order.
    #[doc(alias = "wall lamp")]
    pub fn hemisphere<F: Into<f64>, G: Into<f64>>(
        position: impl Into<[F; 3]>,
        axis: impl Into<[G; 3]>,
        near: f64,
        range: f64,
    ) -> Result<Self, InputError> {
        let axis = check::direction("axis", vector(axis))?;
        Self::local(vector(position), near, range, Shape::Hemisphere { axis })
    }

    /// A pyramid light: it shines from a position into a rectangular frustum, as projectors do.
    ///
    /// `axis` is a direction from the light along the middle of the pyramid, and `up` one towards the upper side; it need not be
    /// across the axis. `tangents` are those of the half angles, across `up` and along it: `[0.5 * w / d, 0.5 * h / d]` for a
    /// picture w wide and h high at distance d. `near` and `range` are distances as for [`Self::point`].
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
    /// Names the field that is not finite, the zero vector, parallel to the axis, not positive, or out of order; `"tangents"` when
    /// one is above [`Self::MAX_TANGENT`] or not positive.
    #[doc(alias = "projector")]
    #[doc(alias = "rectangular spot")]
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

    /// The largest tangent of [`Self::pyramid`]: a half angle of 89.8°.
    pub const MAX_TANGENT: f64 = 256.0;

    /// The spot with a roll about its axis: a side of the pyramid around its cone faces `up`, as in a renderer's own shadow
    /// frustum. Stabilised maps ([`Warp::Stable`](crate::Warp::Stable)) are aligned with that pyramid. `up` need not be across the
    /// axis.
    ///
    /// ```
    /// use shadowfit::{Light, glam::DVec3};
    ///
    /// let spot = Light::spot((0.0, 5.0, 0.0), (0.0, -1.0, 0.0), 0.5, 0.1, 30.0)?.with_up((1.0, 0.0, 1.0))?;
    /// let side = DVec3::new(1.0, 0.0, 1.0).normalize();
    /// assert!(spot.planes().iter().any(|plane| plane.normal.dot(side) > 0.87)); // cos 0.5
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
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

    /// The light with its region cut by planes, inside ≥ 0: barn doors, a window, the cell of a clustered renderer, the box of a
    /// local sun. Any light may have them; they replace those of an earlier call, and faces of a cube inherit them.
    ///
    /// They bound L for receivers and casters alike: beyond a plane nothing is lit and nothing casts.
    ///
    /// ```
    /// use shadowfit::{Light, focus::Plane};
    ///
    /// // A sun in one room only.
    /// let (low, high) = (Plane::from([1.0, 0.0, 0.0, 4.0]), Plane::from([-1.0, 0.0, 0.0, 4.0]));
    /// let sun = Light::directional((0.3, 1.0, 0.2))?.within(&[low, high])?;
    /// assert_eq!(sun.planes().len(), 2);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"planes"` when there are more than [`Self::MAX_WITHIN`], or, with its index, when one is not finite or has a zero
    /// normal.
    #[doc(alias = "barn doors")]
    #[doc(alias = "light volume")]
    pub fn within(self, planes: &[Plane]) -> Result<Self, InputError> {
        if planes.len() > Self::MAX_WITHIN {
            let expected = Expected::Within { least: 0.0, most: Self::MAX_WITHIN as f64 };
            let error = InputError::new("planes", InputErrorKind::TooMany).got(planes.len() as f64);
            return Err(error.expected(expected));
        }
        let mut within = [None; Self::MAX_WITHIN];
        for (index, (slot, plane)) in within.iter_mut().zip(planes).enumerate() {
            let checked = plane.checked("planes").map_err(|error| error.of_list("planes", index))?;
            // A plane with a unit normal keeps its bits.
            *slot = Some(if checked.normal == plane.normal { *plane } else { checked });
        }
        Ok(Self { within, ..self })
    }

    /// The largest number of planes for [`Self::within`].
    pub const MAX_WITHIN: usize = 6;

    /// The part of a point light or a hemisphere within a face of the cube around it: six of them, with a map each, serve
    /// receivers all around (`docs/lights-all-around.md`).
    ///
    /// `overlap` widens the face, so that a filter next to a seam stays in one map: the sides have the tangent `1 + overlap` to the
    /// face's axis instead of 1. [`CubeFace::overlap`] is the overlap that a filter needs; [`CubeFace::of`] is the face of a
    /// direction, whatever the overlap.
    ///
    /// ```
    /// use shadowfit::{Light, Scene, Settings, View, fit, omni::CubeFace};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let room = Scene::from_box((-5.0, 0.0, -8.0), (5.0, 3.0, 8.0))?;
    /// let bulb = Light::point((0.0, 1.5, -4.0), 0.05, 20.0)?;
    /// assert!(fit(&view, &bulb, &room, &Settings::default()).map().is_none()); // receivers all around
    /// let down = bulb.cube_face(CubeFace::NegativeY, CubeFace::overlap(1.0, 2048, 1))?;
    /// assert!(fit(&view, &down, &room, &Settings::default()).map().is_some());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Names `"light"` when it is directional, a spot, or a face already, and `"overlap"` when it is not in
    /// \[0, [`CubeFace::MAX_OVERLAP`]\].
    #[doc(alias = "cube map")]
    #[doc(alias = "omnidirectional shadow map")]
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

    /// The light as a homogeneous point l in world space: (position, 1), or (unit direction towards the light, 0).
    #[must_use]
    pub const fn homogeneous(&self) -> DVec4 {
        match self.kind {
            Kind::Directional { direction_to_light: d } => DVec4::new(d.x, d.y, d.z, 0.0),
            Kind::Local { position: p, .. } => DVec4::new(p.x, p.y, p.z, 1.0),
        }
    }

    /// The position of the light in world space; `None` for a directional light.
    #[must_use]
    pub const fn position(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Directional { .. } => None,
            Kind::Local { position, .. } => Some(position),
        }
    }

    /// The near distance of a local light, within which casters may be left out, in world units; 0 for a directional light.
    #[must_use]
    pub const fn near(&self) -> f64 {
        match self.kind {
            Kind::Directional { .. } => 0.0,
            Kind::Local { near, .. } => near,
        }
    }

    /// The distance that a local light reaches, in world units; infinite for a directional light.
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

    /// The unit direction from a world-space point towards the light; zero at the light's own position.
    #[must_use]
    pub fn direction_from(&self, point: DVec3) -> DVec3 {
        match self.kind {
            Kind::Directional { direction_to_light } => direction_to_light,
            Kind::Local { position, .. } => (position - point).normalize_or_zero(),
        }
    }

    /// The planes of L in world space, inside ≥ 0; none for an unbounded light.
    ///
    /// A spot has the four sides of the pyramid around its cone, a near plane and, with a finite range, a far plane; a point light
    /// the box around its range; a hemisphere the half of that box before its plane; a cube face the planes of a pyramid, and its
    /// hemisphere's plane. Those of [`Self::within`] come last.
    ///
    /// ```
    /// use shadowfit::{Light, focus::Plane};
    ///
    /// let sun = Light::directional((0.3, 1.0, 0.2))?;
    /// assert!(sun.planes().is_empty());
    /// let door = Plane::from([0.0, 0.0, 1.0, 4.0]);
    /// let spot = Light::spot((0.0, 5.0, 0.0), (0.0, -1.0, 0.0), 0.5, 0.1, 30.0)?.within(&[door])?;
    /// assert_eq!((spot.planes().len(), spot.planes()[6]), (7, door));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn planes(&self) -> LightPlanes {
        let mut planes = LightPlanes { planes: [Plane::ONE; Self::MAX_PLANES], len: 0 };
        if let Kind::Local { position, near, range, shape } = self.kind {
            planes.push_shape(position, near, range, shape);
        }
        self.within.iter().flatten().for_each(|plane| planes.push(*plane));
        planes
    }

    /// The axes `[u, v, axis]` of the frustum that bounds L, and the tangents of its sides, for a spot, a pyramid or a cube face;
    /// seen along the axis, v is up and u to the right.
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

    /// The largest number of planes of L: a hemisphere's cube face has seven, besides those of [`Self::within`].
    pub(crate) const MAX_PLANES: usize = 7 + Self::MAX_WITHIN;
}

/// The unit direction across an axis towards `up`.
fn across(axis: DVec3, up: DVec3) -> Result<DVec3, InputError> {
    let up = check::direction("up", up)?;
    // A direction across the axis keeps its bits.
    let along = up.dot(axis);
    if along.abs() <= 4.0 * f64::EPSILON {
        return Ok(up);
    }
    let across = up - axis * along;
    // Closer to the axis, the part across it is mostly rounding.
    if across.length() < 1e-9 {
        let error = InputError::new("up", InputErrorKind::Parallel);
        return Err(error.expected(Expected::NotParallel { field: "axis" }));
    }
    Ok(across.normalize())
}

/// The axes across a spot: the default for its axis, or rolled to its own `up`.
fn of_spot(axis: DVec3, up: Option<DVec3>) -> (DVec3, DVec3) {
    up.map_or_else(|| crate::math::frame::of_light(axis), |up| (axis.cross(up), up))
}

/// The planes of a light's region L, up to thirteen, in the order of [`Light::planes`].
///
/// ```
/// use shadowfit::{Light, glam::DVec3};
///
/// let bulb = Light::point((0.0, 3.0, 0.0), 0.1, 20.0)?;
/// let planes = bulb.planes();
/// assert_eq!((planes.len(), planes.as_slice().len(), planes.is_empty()), (6, 6, false));
/// assert!(planes.iter().all(|plane| plane.at(DVec3::ZERO) > 0.0));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPlanes {
    planes: [Plane; Light::MAX_PLANES],
    len: usize,
}

impl LightPlanes {
    /// Adds the planes of the region of a shape.
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
                // A point on the cone's side at distance `near` is only this far along the axis.
                self.push_slab(axis, position, near * cosine, range);
            }
            Shape::Pyramid { axis, up, tangents } => {
                for (side, tangent) in [(axis.cross(up), tangents.x), (up, tangents.y)] {
                    self.push(Plane::through(axis * tangent - side, position));
                    self.push(Plane::through(axis * tangent + side, position));
                }
                // A point on the pyramid's edge at distance `near` is only this far along the axis.
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
                // The other two axes of the world, of either sign.
                let (u, v) = (DVec3::new(axis.z, axis.x, axis.y), DVec3::new(axis.y, axis.z, axis.x));
                for side in [u, -u, v, -v] {
                    self.push(Plane::through(axis * tangent - side, position));
                }
                // A point on the pyramid's edge at distance `near` is only this far along the axis.
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

    /// Adds the planes that keep distances along `axis` from `position` between `min` and `max`; either may be infinite.
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
