//! The serialised form of a light, checked when it is read.

use super::{DVec3, InputError, Plane, Shape, Within};

#[derive(serde::Deserialize)]
pub(super) struct Light {
    kind: Kind,
    within: Within,
}

#[derive(serde::Deserialize)]
enum Kind {
    Directional {
        direction_to_light: DVec3,
    },
    Local {
        position: DVec3,
        near: f64,
        #[serde(with = "crate::math::infinity")]
        range: f64,
        shape: Shape,
    },
}

impl TryFrom<Light> for super::Light {
    type Error = InputError;
    fn try_from(light: Light) -> Result<Self, InputError> {
        let plain = match light.kind {
            Kind::Directional { direction_to_light } => Self::directional(direction_to_light),
            Kind::Local { position, near, range, shape } => match shape {
                Shape::Point => Self::point(position, near, range),
                Shape::Spot { axis, half_angle, up } => {
                    let spot = Self::spot(position, axis, half_angle, near, range)?;
                    up.map_or(Ok(spot), |up| spot.with_up(up))
                }
                Shape::Pyramid { axis, up, tangents } => {
                    Self::pyramid(position, axis, up, tangents.to_array(), near, range)
                }
                Shape::Hemisphere { axis } => Self::hemisphere(position, axis, near, range),
                Shape::CubeFace { face, overlap, hemisphere } => match hemisphere {
                    None => Self::point(position, near, range),
                    Some(axis) => Self::hemisphere(position, axis, near, range),
                }?
                .cube_face(face, overlap),
            },
        }?;
        let (mut planes, mut count) = ([Plane::ONE; Self::MAX_WITHIN], 0);
        for plane in light.within.into_iter().flatten() {
            (planes[count], count) = (plane, count + 1);
        }
        plain.within(&planes[..count])
    }
}
