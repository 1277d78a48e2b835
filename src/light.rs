//! The light l, and L, what it can light.

use crate::angle;
use crate::convex::Plane;
use crate::cube::CubeFace;
use crate::error::{Hint, InputError, Problem, check};
use crate::numbers::vector;
use core::f64::consts::{FRAC_PI_2, PI};
use glam::{DVec3, DVec4};

/// A light: a homogeneous point l and a convex region L outside of which it lights nothing.
///
/// Directions of light point **towards** the light. The axis of a spot or a hemisphere is the axis of the region it
/// lights and points **away** from the light.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "stored::Light"))]
pub struct Light {
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum Kind {
    Directional {
        direction_to_light: DVec3,
    },
    Local {
        position: DVec3,
        near: f64,
        #[cfg_attr(feature = "serde", serde(with = "crate::infinity"))]
        range: f64,
        shape: Shape,
    },
}

/// How a light at a position spreads.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Shape {
    Point,
    /// `half_angle` in radians.
    Spot {
        axis: DVec3,
        half_angle: f64,
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
        Ok(Self { kind: Kind::Directional { direction_to_light } })
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
        Self::local(vector(position), near, range, Shape::Spot { axis, half_angle })
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
            return check::fail("light", Problem::NotAllAround);
        };
        let hemisphere = match shape {
            Shape::Point => None,
            Shape::Hemisphere { axis } => Some(axis),
            Shape::Spot { .. } | Shape::CubeFace { .. } => return check::fail("light", Problem::NotAllAround),
        };
        Self::local(position, near, range, Shape::CubeFace { face, overlap, hemisphere })
    }

    fn local(position: DVec3, near: f64, range: f64, shape: Shape) -> Result<Self, InputError> {
        let position = check::point("position", position)?;
        let near = check::distance("near", near)?;
        let range = check::distance_or_infinity("range", range)
            .map_err(|error| error.hinted((range == 0.0).then_some(Hint::NoLimit)))?;
        check::above("range", range, "near", near)?;
        Ok(Self { kind: Kind::Local { position, near, range, shape } })
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

    /// The unit axis of a spot or a hemisphere, away from the light.
    pub(crate) const fn axis(&self) -> Option<DVec3> {
        match self.kind {
            Kind::Local { shape: Shape::Spot { axis, .. } | Shape::Hemisphere { axis }, .. } => Some(axis),
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
    /// face's are those of a spot's pyramid, and a hemisphere's own plane.
    #[must_use]
    pub fn planes(&self) -> LightPlanes {
        let mut planes = LightPlanes { planes: [Plane::ONE; Self::MAX_PLANES], len: 0 };
        let Kind::Local { position, near, range, shape } = self.kind else {
            return planes;
        };
        match shape {
            Shape::Point => {
                for axis in DVec3::AXES {
                    planes.push_slab(axis, position, -range, range);
                }
            }
            Shape::Spot { axis, half_angle } => {
                let (sine, cosine) = angle::sine_cosine(half_angle);
                let (u, v) = crate::frame::of_light(axis);
                for side in [u, -u, v, -v] {
                    planes.push(Plane::through(axis * sine - side * cosine, position));
                }
                // At the cone's side a point at distance `near` is only this far along the axis.
                planes.push_slab(axis, position, near * cosine, range);
            }
            Shape::Hemisphere { axis } => {
                let (u, v) = crate::frame::of_light(axis);
                planes.push_slab(axis, position, 0.0, range);
                planes.push_slab(u, position, -range, range);
                planes.push_slab(v, position, -range, range);
            }
            Shape::CubeFace { face, overlap, hemisphere } => {
                let (axis, tangent) = (face.axis(), 1.0 + overlap);
                // The next two axes of the world in turn, whichever way they point.
                let (u, v) = (DVec3::new(axis.z, axis.x, axis.y), DVec3::new(axis.y, axis.z, axis.x));
                for side in [u, -u, v, -v] {
                    planes.push(Plane::through(axis * tangent - side, position));
                }
                // At the pyramid's edges a point at distance `near` is only this far along the axis.
                planes.push_slab(axis, position, near / DVec3::new(1.0, tangent, tangent).length(), range);
                if let Some(axis) = hemisphere {
                    planes.push(Plane::through(axis, position));
                }
            }
        }
        planes
    }

    /// The axes across and along the one frustum that is L, and the tangent of its sides: `[u, v, axis]`, of a spot or a
    /// cube's face; seen along the axis, v is up and u to the right.
    pub(crate) fn frustum(&self) -> Option<([DVec3; 3], f64)> {
        match self.kind {
            Kind::Local { shape: Shape::Spot { axis, half_angle }, .. } => {
                let (sine, cosine) = angle::sine_cosine(half_angle);
                let (u, v) = crate::frame::of_light(axis);
                Some(([u, v, axis], sine / cosine))
            }
            Kind::Local { shape: Shape::CubeFace { face, overlap, .. }, .. } => {
                let axis = face.axis();
                let v = DVec3::new(axis.z, axis.x, axis.y);
                Some(([axis.cross(v), v, axis], 1.0 + overlap))
            }
            _ => None,
        }
    }

    /// The most planes that L can have: those of a hemisphere's cube face.
    pub(crate) const MAX_PLANES: usize = 7;
}

/// Up to seven planes, as [`Light::planes`] returns them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPlanes {
    planes: [Plane; Light::MAX_PLANES],
    len: usize,
}

impl LightPlanes {
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

impl core::ops::Deref for LightPlanes {
    type Target = [Plane];
    fn deref(&self) -> &[Plane] {
        &self.planes[..self.len]
    }
}

/// A light as it is stored: the same numbers, checked again when they are read.
#[cfg(feature = "serde")]
mod stored {
    use super::{DVec3, InputError, Shape};

    #[derive(serde::Deserialize)]
    pub(super) struct Light {
        kind: Kind,
    }

    #[derive(serde::Deserialize)]
    enum Kind {
        Directional {
            direction_to_light: DVec3,
        },
        Local {
            position: DVec3,
            near: f64,
            #[serde(with = "crate::infinity")]
            range: f64,
            shape: Shape,
        },
    }

    impl TryFrom<Light> for super::Light {
        type Error = InputError;
        fn try_from(light: Light) -> Result<Self, InputError> {
            match light.kind {
                Kind::Directional { direction_to_light } => Self::directional(direction_to_light),
                Kind::Local { position, near, range, shape } => match shape {
                    Shape::Point => Self::point(position, near, range),
                    Shape::Spot { axis, half_angle } => Self::spot(position, axis, half_angle, near, range),
                    Shape::Hemisphere { axis } => Self::hemisphere(position, axis, near, range),
                    Shape::CubeFace { face, overlap, hemisphere } => match hemisphere {
                        None => Self::point(position, near, range),
                        Some(axis) => Self::hemisphere(position, axis, near, range),
                    }?
                    .cube_face(face, overlap),
                },
            }
        }
    }
}
