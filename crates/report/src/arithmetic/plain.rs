//! The focus body as one would write it down, in any of the numbers: hull(V, l) by its half-spaces, and a scene's body that
//! they cut one after another. Nothing decides but the signs of numbers as they come.
//!
//! A half-space of V that the light is inside of bounds the hull too. Two that meet in an edge, a with the light inside and b
//! with the light outside, make the one through their edge and the light,
//!
//! ```text
//!     a(l) · b − b(l) · a
//! ```
//!
//! for lights at a position (l = (p, 1)) and at infinity (l = (d, 0)) alike, without a division.

use shadowfit::{Light, View, focus::Plane};

use super::number::{Number, Row, on};
use super::polyhedron::Polyhedron;

/// What planes are moved outwards by where they are moved, in ε of the magnitudes of their terms: the crate's slack.
const GROWTH: f64 = 96.0;

/// The construction, with its memory.
pub(crate) struct Plain<T> {
    /// What planes are moved outwards by, in parts of the magnitudes of their terms; none where they stay.
    slack: Option<T>,
    body: Polyhedron<T>,
    hull: Vec<Row<T>>,
}

/// What a fit begins with, made when the scene is: its body, and its largest coordinates.
pub(crate) struct PlainScene<T> {
    body: Polyhedron<T>,
    extent: [T; 3],
}

impl<T: Number> PlainScene<T> {
    /// A box, cut by planes.
    pub(crate) fn new(min: [f64; 3], max: [f64; 3], cuts: &[Plane], grown: bool) -> Self {
        let mut scene = Self {
            body: Polyhedron::from_box(min, max),
            extent: std::array::from_fn(|axis| T::of(min[axis].abs().max(max[axis].abs()))),
        };
        let slack = slack(grown);
        for plane in cuts {
            scene.body.clip(&loosened(row(plane), &scene.extent, slack.as_ref()));
        }
        scene
    }
}

impl<T: Number> Plain<T> {
    /// With planes as they are or, `grown`, moved outwards by 96 ε of the magnitudes of their terms.
    pub(crate) fn new(grown: bool) -> Self {
        Self { slack: slack(grown), body: Polyhedron::from_box([0.0; 3], [0.0; 3]), hull: Vec::new() }
    }

    /// hull(V, l) ∩ S ∩ L.
    pub(crate) fn focus_body(&mut self, view: &View, light: &Light, scene: &PlainScene<T>) -> &Polyhedron<T> {
        self.make_hull(view, light);
        self.body.become_like(&scene.body);
        let slack = self.slack.as_ref();
        for plane in light.planes().iter() {
            self.body.clip(&loosened(row(plane), &scene.extent, slack));
        }
        for plane in &self.hull {
            self.body.clip(&loosened(plane.clone(), &scene.extent, slack));
        }
        &self.body
    }

    /// The half-spaces of hull(V, l). Planes 0 and 1, 2 and 3, 4 and 5 of a frustum face each other, and all others meet.
    fn make_hull(&mut self, view: &View, light: &Light) {
        let l: Row<T> = light.homogeneous().to_array().map(T::of);
        let zero = T::of(0.0);
        let given = view.planes();
        // A far plane at infinity is one of V's too: a light at a position is inside of it.
        let infinity = Plane::new((0.0, 0.0, 0.0).into(), view.near());
        let planes: [Row<T>; 6] = std::array::from_fn(|i| row(given.as_slice().get(i).unwrap_or(&infinity)));
        let values = planes.each_ref().map(|plane| on(plane, &l));
        self.hull.clear();
        let bounds = planes[..given.len()].iter().zip(&values).filter(|(_, value)| **value >= zero);
        self.hull.extend(bounds.map(|(plane, _)| plane.clone()));
        for (i, (towards, at_towards)) in planes.iter().zip(&values).enumerate() {
            for (j, (away, at_away)) in planes.iter().zip(&values).enumerate() {
                if *at_towards > zero && *at_away < zero && i / 2 != j / 2 {
                    let combine =
                        |k: usize| at_towards.clone() * away[k].clone() - at_away.clone() * towards[k].clone();
                    self.hull.push(std::array::from_fn(combine));
                }
            }
        }
    }
}

fn row<T: Number>(plane: &Plane) -> Row<T> {
    plane.to_row().to_array().map(T::of)
}

fn slack<T: Number>(grown: bool) -> Option<T> {
    grown.then(|| T::of(GROWTH * T::EPSILON))
}

/// A plane moved outwards by a part of the magnitude of its terms.
fn loosened<T: Number>(plane: Row<T>, extent: &[T; 3], slack: Option<&T>) -> Row<T> {
    let Some(slack) = slack else { return plane };
    let [x, y, z, offset] = plane;
    let terms = [(&x, 0), (&y, 1), (&z, 2)].map(|(n, axis)| n.clone().magnitude() * extent[axis].clone());
    let magnitude = terms.into_iter().fold(offset.clone().magnitude(), |sum, term| sum + term);
    [x, y, z, offset + slack.clone() * magnitude]
}
