//! Lights, placed where they are hard to handle: by the view, by its planes, and by the scene.

use proptest::prelude::*;
use shadowfit::glam::DVec3;
use shadowfit::{InputError, Light, View, omni::CubeFace};

use super::primitive::{almost_zero, direction, lattice_direction, magnitude, nudged};
use super::similarity::{Similarity, plane};

/// The arguments of one of the constructors of a [`Light`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightParams {
    Directional {
        direction_to_light: [f64; 3],
    },
    Point {
        position: [f64; 3],
        near: f64,
        range: Option<f64>,
    },
    Spot {
        position: [f64; 3],
        axis: [f64; 3],
        half_angle: f64,
        near: f64,
        range: Option<f64>,
    },
    Hemisphere {
        position: [f64; 3],
        axis: [f64; 3],
        near: f64,
        range: Option<f64>,
    },
    /// The face with an index, of a point light or, with an axis, of a hemisphere.
    CubeFace {
        position: [f64; 3],
        axis: Option<[f64; 3]>,
        near: f64,
        range: Option<f64>,
        face: usize,
        overlap: f64,
    },
    Pyramid {
        position: [f64; 3],
        axis: [f64; 3],
        up: [f64; 3],
        tangents: [f64; 2],
        near: f64,
        range: Option<f64>,
    },
    /// A point light within planes.
    Within {
        position: [f64; 3],
        near: f64,
        range: Option<f64>,
        planes: [[f64; 4]; 3],
    },
}

impl LightParams {
    pub fn build(&self) -> Result<Light, InputError> {
        let or_infinity = |range: Option<f64>| range.unwrap_or(f64::INFINITY);
        match *self {
            Self::Directional { direction_to_light } => Light::directional(direction_to_light),
            Self::Point { position, near, range } => Light::point(position, near, or_infinity(range)),
            Self::Spot { position, axis, half_angle, near, range } => {
                Light::spot(position, axis, half_angle, near, or_infinity(range))
            }
            Self::Hemisphere { position, axis, near, range } => {
                Light::hemisphere(position, axis, near, or_infinity(range))
            }
            Self::CubeFace { position, axis, near, range, face, overlap } => match axis {
                None => Light::point(position, near, or_infinity(range)),
                Some(axis) => Light::hemisphere(position, axis, near, or_infinity(range)),
            }
            .and_then(|light| light.cube_face(CubeFace::ALL[face], overlap)),
            Self::Pyramid { position, axis, up, tangents, near, range } => {
                Light::pyramid(position, axis, up, tangents, near, or_infinity(range))
            }
            Self::Within { position, near, range, planes } => {
                Light::point(position, near, or_infinity(range)).and_then(|light| light.within(&planes.map(plane)))
            }
        }
    }

    pub fn moved(&self, by: &Similarity) -> Self {
        let length = |range: Option<f64>| range.map(|range| by.length(range));
        match *self {
            Self::Directional { .. } => *self,
            Self::Point { position, near, range } => {
                Self::Point { position: by.point(position), near: by.length(near), range: length(range) }
            }
            Self::Spot { position, axis, half_angle, near, range } => Self::Spot {
                position: by.point(position),
                axis,
                half_angle,
                near: by.length(near),
                range: length(range),
            },
            Self::Hemisphere { position, axis, near, range } => {
                Self::Hemisphere { position: by.point(position), axis, near: by.length(near), range: length(range) }
            }
            Self::CubeFace { position, axis, near, range, face, overlap } => Self::CubeFace {
                position: by.point(position),
                axis,
                near: by.length(near),
                range: length(range),
                face,
                overlap,
            },
            Self::Pyramid { position, axis, up, tangents, near, range } => Self::Pyramid {
                position: by.point(position),
                axis,
                up,
                tangents,
                near: by.length(near),
                range: length(range),
            },
            Self::Within { position, near, range, planes } => Self::Within {
                position: by.point(position),
                near: by.length(near),
                range: length(range),
                planes: planes.map(|plane| by.plane(plane)),
            },
        }
    }
}

/// A light in terms of a view and a scene yet to be known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// A directional light.
    Sun(Sun),
    /// A light at a position.
    Lamp { at: Position, lamp: Lamp },
}

/// Where a directional light shines from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sun {
    /// Towards this direction in world space.
    World([f64; 3]),
    /// Towards these amounts of the view's right, up and forward.
    View([f64; 3]),
}

/// Where a lamp hangs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Position {
    /// At the view's right, up and forward from the eye, in units of the scene's size.
    View([f64; 3]),
    /// At a depth in that unit and at these parts of the frame there: 0 is the left or bottom side
    /// of V, 1 the right or top one.
    Frame { depth: f64, across: [f64; 2] },
    /// At these parts of V's depth range and frame: 0 and 1 are its planes.
    InView { depth: f64, across: [f64; 2] },
    /// At these parts of the scene's bounds.
    InScene([f64; 3]),
    /// At this distance from the eye, in world units.
    FarOut { direction: [f64; 3], distance: f64 },
}

/// What a lamp is, with lengths in units of the scene's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lamp {
    shape: Shape,
    /// Which way it shines: at the middle of the scene, or anywhere.
    axis: Option<[f64; 3]>,
    near: f64,
    range: Option<f64>,
    /// Steps of the position's coordinates away from where it was put.
    nudge: [i8; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    Point,
    Spot { half_angle: f64 },
    Hemisphere,
    CubeFace { face: usize, overlap: f64, of_hemisphere: bool },
}

impl Place {
    /// The light, by a view and the bounds of a scene.
    pub(super) fn about(&self, view: &View, bounds: ([f64; 3], [f64; 3])) -> LightParams {
        let in_view = |[x, y, z]: [f64; 3]| view.right() * x + view.up() * y + view.forward() * z;
        let (min, max) = (DVec3::from(bounds.0), DVec3::from(bounds.1));
        let size = (max - min).length().max(view.near().abs());
        let (at, lamp) = match *self {
            Self::Sun(Sun::World(direction_to_light)) => {
                return LightParams::Directional { direction_to_light };
            }
            Self::Sun(Sun::View(direction)) => {
                return LightParams::Directional { direction_to_light: in_view(direction).to_array() };
            }
            Self::Lamp { at, lamp } => (at, lamp),
        };
        let position = match at {
            Position::View(offset) => view.eye() + in_view(offset) * size,
            Position::Frame { depth, across } => in_frame(view, depth * size, across),
            Position::InView { depth, across } => {
                let far = if view.far().is_finite() { view.far() } else { view.near() + size };
                in_frame(view, view.near() + (far - view.near()) * depth, across)
            }
            Position::InScene(part) => min + (max - min) * DVec3::from(part),
            Position::FarOut { direction, distance } => view.eye() + DVec3::from(direction) * distance,
        };
        let position = std::array::from_fn(|i| nudged(position[i], lamp.nudge[i]));
        let to_scene = (min + max) * 0.5 - DVec3::from(position);
        let axis =
            lamp.axis.unwrap_or(if to_scene.length() > 0.0 { to_scene.to_array() } else { [0.0, -1.0, 0.0] });
        let near = lamp.near * size;
        let range = lamp.range.map(|range| range * size);
        match lamp.shape {
            Shape::Point => LightParams::Point { position, near, range },
            Shape::Spot { half_angle } => LightParams::Spot { position, axis, half_angle, near, range },
            Shape::Hemisphere => LightParams::Hemisphere { position, axis, near, range },
            Shape::CubeFace { face, overlap, of_hemisphere } => {
                let axis = of_hemisphere.then_some(axis);
                LightParams::CubeFace { position, axis, near, range, face, overlap }
            }
        }
    }
}

/// The point at a depth and a part of the frame there.
fn in_frame(view: &View, depth: f64, across: [f64; 2]) -> DVec3 {
    // Sides of the frame at that depth, from planes 0 and 2: left and bottom, at a point on the view axis.
    let on_axis = view.eye() + view.forward() * depth;
    let planes = view.planes();
    let reach = |plane: usize, axis: DVec3| planes[plane].at(on_axis) / planes[plane].normal.dot(axis);
    let (left, right) = (reach(0, view.right()), reach(1, view.right()));
    let (bottom, top) = (reach(2, view.up()), reach(3, view.up()));
    let mix = |low: f64, high: f64, part: f64| -low + (low - high) * part;
    on_axis + view.right() * mix(left, right, across[0]) + view.up() * mix(bottom, top, across[1])
}

/// Any light.
pub(super) fn light_place() -> impl Strategy<Value = Place> {
    prop_oneof![
        1 => sun().prop_map(Place::Sun),
        1 => (position(), lamp()).prop_map(|(at, lamp)| Place::Lamp { at, lamp }),
    ]
}

/// Lights at small integers, shining along and between the axes.
pub(super) fn lattice_light() -> impl Strategy<Value = LightParams> {
    let position = prop::array::uniform3(-6..=6_i8).prop_map(|position| position.map(f64::from));
    let range = prop_oneof![Just(None), (4..12_u8).prop_map(|range| Some(f64::from(range)))];
    prop_oneof![
        2 => lattice_direction().prop_map(|direction_to_light| LightParams::Directional { direction_to_light }),
        2 => (position.clone(), range.clone())
            .prop_map(|(position, range)| LightParams::Point { position, near: 0.25, range }),
        1 => (position.clone(), lattice_direction(), range.clone()).prop_map(|(position, axis, range)| {
            LightParams::Spot { position, axis, half_angle: std::f64::consts::FRAC_PI_4, near: 0.25, range }
        }),
        1 => (position.clone(), lattice_direction(), range.clone())
            .prop_map(|(position, axis, range)| LightParams::Hemisphere { position, axis, near: 0.25, range }),
        1 => (position, prop::option::of(lattice_direction()), range, 0..6_usize).prop_map(
            |(position, axis, range, face)| {
                LightParams::CubeFace { position, axis, near: 0.25, range, face, overlap: 0.0 }
            }
        ),
    ]
}

fn sun() -> impl Strategy<Value = Sun> {
    prop_oneof![
        // The sun over a landscape.
        3 => (direction(), 0.05..1.0).prop_map(|([x, _, z], height)| Sun::World([x, height, z])),
        1 => direction().prop_map(Sun::World),
        1 => lattice_direction().prop_map(Sun::World),
        // In the camera plane, or almost.
        3 => (0.0..std::f64::consts::TAU, almost_zero())
            .prop_map(|(angle, depth): (f64, f64)| Sun::View([angle.cos(), angle.sin(), depth])),
        // Along the view or against it, or almost.
        2 => (almost_zero(), almost_zero(), any::<bool>())
            .prop_map(|(x, y, behind)| Sun::View([x, y, if behind { -1.0 } else { 1.0 }])),
    ]
}

fn position() -> impl Strategy<Value = Position> {
    let part = || prop_oneof![3 => -0.5..1.5, 1 => Just(0.0), 1 => Just(1.0), 1 => almost_zero()];
    let offset = || -2.0..2.0;
    prop_oneof![
        3 => (offset(), 0.1..2.0, offset()).prop_map(|(x, y, z)| Position::View([x, y, z])),
        // At the eye, or almost: a miner's lamp.
        1 => prop::array::uniform3(almost_zero()).prop_map(Position::View),
        1 => Just(Position::View([0.0; 3])),
        // In the camera plane, or almost.
        2 => (offset(), offset(), almost_zero()).prop_map(|(x, y, z)| Position::View([x, y, z])),
        // Behind the viewer.
        1 => (offset(), offset(), -2.0..-0.01).prop_map(|(x, y, z)| Position::View([x, y, z])),
        // In planes of V, on its edges and corners, inside it.
        2 => (-1.0..2.0, [part(), part()]).prop_map(|(depth, across)| Position::Frame { depth, across }),
        3 => (part(), [part(), part()]).prop_map(|(depth, across)| Position::InView { depth, across }),
        3 => [part(), part(), part()].prop_map(Position::InScene),
        1 => (direction(), prop::sample::select(vec![1e3, 1e6, 1e9]))
            .prop_map(|(direction, distance)| Position::FarOut { direction, distance }),
    ]
}

fn lamp() -> impl Strategy<Value = Lamp> {
    let half_angle = prop_oneof![3 => 0.1..1.2, 1 => magnitude(1e-3, 1.55), 1 => Just(1e-3), 1 => Just(1.55)];
    let overlap = prop_oneof![Just(0.0), 0.0..0.1, Just(CubeFace::MAX_OVERLAP)];
    let shape = prop_oneof![
        3 => Just(Shape::Point),
        3 => half_angle.prop_map(|half_angle| Shape::Spot { half_angle }),
        1 => Just(Shape::Hemisphere),
        2 => (0..6_usize, overlap, any::<bool>())
            .prop_map(|(face, overlap, of_hemisphere)| Shape::CubeFace { face, overlap, of_hemisphere }),
    ];
    let axis = prop_oneof![
        2 => Just(None),
        1 => direction().prop_map(Some),
        1 => lattice_direction().prop_map(Some),
    ];
    let range = prop_oneof![Just(None), magnitude(0.3, 1e3).prop_map(Some)];
    let nudge = prop_oneof![3 => Just([0; 3]), 1 => prop::array::uniform3(-2..=2_i8)];
    (shape, axis, magnitude(1e-4, 0.2), range, nudge).prop_map(|(shape, axis, near, range, nudge)| Lamp {
        shape,
        axis,
        near,
        range,
        nudge,
    })
}
