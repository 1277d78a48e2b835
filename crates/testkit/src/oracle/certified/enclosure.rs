//! Whether the hull of points holds a body, from planes that the body is beyond.
//!
//! Of a computed body it is known that the exact one E is in {π ≥ m} for each of its planes π. Let Σ be a closed surface
//! of triangles between computed vertices, each of which is in {π < m} for one of the planes. Then Σ misses E. E is
//! connected, so that Σ winds around all of its points equally often; and a point that it winds around is in the hull of
//! the vertices, since out of that hull there is a ray that misses Σ. What is needed is one point that Σ winds around and
//! that is in the convex set of all x with π(x) > π(p), for these planes and the vertices p of their triangles: that set
//! misses Σ too, and holds E. The faces of the computed body are taken for Σ, and nothing of them is taken on trust: that
//! Σ is closed, that each triangle lies beyond a plane, and that it winds around the point is all found out here.
//!
//! The sides of the scene's box are not moved outwards, and vertices lie on them. There the argument holds for vertices
//! moved outwards by any small amount along the sides that they are exactly on, and in the limit for the vertices
//! themselves. Where the box is flat, E and all vertices are in the plane that it lies in, and Σ is a closed polygon there;
//! on a line it is two points.

use std::cmp::Ordering;

use shadowfit::focus::Plane;
use shadowfit::glam::DVec3;

use super::precise::admits;
use crate::oracle::loss::Shape;
use crate::oracle::scalar::{Bounded, Scalar};

/// A plane of a computed body.
#[derive(Clone, Copy)]
pub struct Side {
    pub plane: Plane,
    /// A number that the plane's value is certainly not below in the exact body.
    pub least: f64,
    /// Whether it is a side of the scene's box, and which: the axis, and whether of the largest coordinates.
    pub of_box: Option<(usize, bool)>,
    /// What the slack of planes is measured in: ε times the largest magnitude of the terms of its value in the box.
    pub unit: f64,
}

impl Side {
    /// The plane's value, and how far it may be off.
    fn at(&self, point: DVec3) -> (f64, f64) {
        let value = self.plane.normal * point;
        let magnitude = value.x.abs() + value.y.abs() + value.z.abs() + self.plane.offset.abs();
        // Four roundings of terms of the sum, and one of this bound.
        (value.x + value.y + value.z + self.plane.offset, 2.5 * f64::EPSILON * magnitude)
    }

    /// How far beyond the plane's least value a point is, at least; of a side of the box, whether it is on it or beyond.
    fn beyond(&self, point: DVec3, (min, max): (DVec3, DVec3)) -> Option<f64> {
        match self.of_box {
            Some((axis, false)) => (point[axis] <= min[axis]).then_some(f64::INFINITY),
            Some((axis, true)) => (point[axis] >= max[axis]).then_some(f64::INFINITY),
            None => {
                let (value, error) = self.at(point);
                let beyond = self.least - value - error * (1.0 + f64::EPSILON);
                (beyond > 0.0).then(|| beyond.next_down())
            }
        }
    }

    /// Whether the plane's value is certainly larger at one point than at another.
    fn rises(&self, from: DVec3, to: DVec3) -> bool {
        match self.of_box {
            Some((axis, false)) => to[axis] > from[axis],
            Some((axis, true)) => to[axis] < from[axis],
            None => {
                let ((low, low_error), (high, high_error)) = (self.at(from), self.at(to));
                (high - low) * (1.0 - 4.0 * f64::EPSILON) > low_error + high_error
            }
        }
    }
}

/// Directions that are tried for a ray; any would do.
const RAYS: [DVec3; 6] = [
    DVec3::new(0.31, 0.83, 0.47),
    DVec3::new(0.89, -0.23, 0.41),
    DVec3::new(-0.37, 0.29, 0.88),
    DVec3::new(0.53, 0.61, -0.59),
    DVec3::new(-0.71, -0.43, -0.56),
    DVec3::new(0.07, 0.99, -0.13),
];

/// Why it was not certain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// The box is flat, and a vertex not in its plane.
    OutsideBox,
    /// There are too few different vertices.
    Degenerate,
    /// The surface has gaps.
    NotClosed,
    /// A piece of it is not certainly beyond one plane.
    NotBeyond,
    /// No ray met it in a way that was certain.
    NoRay,
    /// The middle of the vertices is not certainly inside.
    NotInside,
}

/// The argument for one body.
pub struct Enclosure<'a> {
    shape: &'a Shape,
    points: &'a [DVec3],
    sides: &'a [Side],
    /// For each side and point by how much the point is beyond, in the side's unit; below zero where it is not.
    beyond: Vec<Vec<f64>>,
    /// Of the box.
    bounds: (DVec3, DVec3),
}

/// A triangle of the surface, an edge of the polygon or an end of the line, and the side it is beyond.
struct Piece<const N: usize> {
    corners: [usize; N],
    side: usize,
    margin: f64,
}

impl<'a> Enclosure<'a> {
    pub fn new(shape: &'a Shape, sides: &'a [Side], bounds: (DVec3, DVec3)) -> Self {
        let points = &shape.vertices;
        let beyond = |side: &Side| {
            let by = |point: &DVec3| side.beyond(*point, bounds).map_or(f64::NEG_INFINITY, |by| by / side.unit);
            points.iter().map(by).collect()
        };
        Self { shape, points, sides, beyond: sides.iter().map(beyond).collect(), bounds }
    }

    /// Whether the body is certainly in the hull: the smallest part of a plane's slack that was left of a vertex beyond it.
    pub fn margin(&self) -> Result<f64, Doubt> {
        let (min, max) = self.bounds;
        let wide: Vec<usize> = (0..3).filter(|&axis| min[axis] < max[axis]).collect();
        for axis in (0..3).filter(|axis| !wide.contains(axis)) {
            if self.points.iter().any(|point| point[axis] != min[axis]) {
                return Err(Doubt::OutsideBox);
            }
        }
        match wide[..] {
            [] => Ok(f64::INFINITY),
            [axis] => self.on_line(axis),
            [x, y] => self.in_plane([x, y]),
            _ => self.in_space(),
        }
    }

    /// The piece with these corners, beyond a side other than those that a flat box lies in: the one it is farthest beyond.
    fn piece<const N: usize>(&self, corners: [usize; N]) -> Result<Piece<N>, Doubt> {
        let margin =
            |side: usize| corners.map(|corner| self.beyond[side][corner]).into_iter().fold(f64::INFINITY, f64::min);
        let margins = (0..self.sides.len()).filter(|side| !self.is_flat(*side)).map(|side| (side, margin(side)));
        let (side, margin) = margins.max_by(|a, b| a.1.total_cmp(&b.1)).ok_or(Doubt::NotBeyond)?;
        if margin > 0.0 { Ok(Piece { corners, side, margin }) } else { Err(Doubt::NotBeyond) }
    }

    /// Whether a side is one that a flat box lies in.
    fn is_flat(&self, side: usize) -> bool {
        let (min, max) = self.bounds;
        self.sides[side].of_box.is_some_and(|(axis, _)| min[axis] == max[axis])
    }

    /// The smallest margin of pieces beyond their sides, given a point that is to be inside of all these sides.
    fn checked<const N: usize>(&self, inside: DVec3, pieces: &[Piece<N>]) -> Result<f64, Doubt> {
        let mut margin = f64::INFINITY;
        for piece in pieces {
            let side = &self.sides[piece.side];
            margin = margin.min(piece.margin);
            for point in piece.corners.map(|corner| self.points[corner]) {
                if !side.rises(point, inside) {
                    return Err(Doubt::NotInside);
                }
            }
        }
        Ok(margin)
    }

    /// The middle of the vertices.
    fn inside(&self) -> Result<DVec3, Doubt> {
        let middle = self.points.iter().sum::<DVec3>() / self.points.len() as f64;
        if admits(&middle.to_array()) { Ok(middle) } else { Err(Doubt::Degenerate) }
    }

    fn on_line(&self, axis: usize) -> Result<f64, Doubt> {
        let by = |a: &usize, b: &usize| self.points[*a][axis].total_cmp(&self.points[*b][axis]);
        let ends = (0..self.points.len()).min_by(by).zip((0..self.points.len()).max_by(by));
        let (low, high) = ends.ok_or(Doubt::Degenerate)?;
        let inside = self.inside()?;
        if !(self.points[low][axis] < inside[axis] && inside[axis] < self.points[high][axis]) {
            return Err(Doubt::Degenerate);
        }
        self.checked(inside, &[self.piece([low])?, self.piece([high])?])
    }

    fn in_plane(&self, [x, y]: [usize; 2]) -> Result<f64, Doubt> {
        let flat = DVec3::AXES[3 - x - y];
        let face = self.shape.faces.iter().find(|(plane, _)| plane.normal == flat);
        let (_, polygon) = face.ok_or(Doubt::Degenerate)?;
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        let pieces: Vec<Piece<2>> = edges.map(|(&from, &to)| self.piece([from, to])).collect::<Result<_, _>>()?;

        let inside = self.inside()?;
        let margin = self.checked(inside, &pieces)?;
        let arms = self.arms(inside);
        self.winds_around(&pieces, |ray, Piece { corners: [from, to], side, .. }| {
            let ray = ray * (DVec3::ONE - flat);
            let bounded = ray.to_array().map(Bounded::new);
            let sign = |arm: &[Bounded; 3]| bounded[x].times(&arm[y]).minus(bounded[y].times(&arm[x])).sign();
            // The ray's line passes between two ends on different sides of it.
            let to = sign(&arms[*to]).map(Ordering::reverse);
            self.crossing([sign(&arms[*from]), to, to], *side, ray)
        })
        .map(|()| margin)
    }

    fn in_space(&self) -> Result<f64, Doubt> {
        let mut pieces = Vec::new();
        let mut open: Vec<[usize; 2]> = Vec::new();
        for (_, corners) in &self.shape.faces {
            self.push_fan(corners, &mut pieces)?;
            for (&from, &to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                match open.iter().position(|edge| *edge == [to, from]) {
                    Some(opposite) => drop(open.swap_remove(opposite)),
                    None => open.push([from, to]),
                }
            }
        }
        // Where faces do not fit together, more triangles fill the gaps.
        while let Some([first, mut at]) = open.pop() {
            let mut ring = vec![first];
            while at != first {
                ring.push(at);
                let next = open.iter().position(|edge| edge[0] == at).ok_or(Doubt::NotClosed)?;
                at = open.swap_remove(next)[1];
            }
            ring.reverse();
            self.push_fan(&ring, &mut pieces)?;
        }
        if pieces.is_empty() {
            return Err(Doubt::Degenerate);
        }

        let inside = self.inside()?;
        let margin = self.checked(inside, &pieces)?;
        let arms = self.arms(inside);
        self.winds_around(&pieces, |ray, Piece { corners: [a, b, c], side, .. }| {
            let bounded = ray.to_array().map(Bounded::new);
            let sign = |from: &usize, to: &usize| triple(&bounded, &arms[*from], &arms[*to]).sign();
            self.crossing([sign(a, b), sign(b, c), sign(c, a)], *side, ray)
        })
        .map(|()| margin)
    }

    /// The triangles of a polygon.
    fn push_fan(&self, corners: &[usize], pieces: &mut Vec<Piece<3>>) -> Result<(), Doubt> {
        for pair in corners.get(1..).unwrap_or_default().windows(2) {
            pieces.push(self.piece([corners[0], pair[0], pair[1]])?);
        }
        Ok(())
    }

    /// From a point to the vertices.
    fn arms(&self, from: DVec3) -> Vec<[Bounded; 3]> {
        self.points.iter().map(|point| (*point - from).to_array().map(Bounded::new)).collect()
    }

    /// Whether the pieces go around the point inside: the crossings of any one ray from there tell.
    fn winds_around<const N: usize>(
        &self,
        pieces: &[Piece<N>],
        crossing: impl Fn(DVec3, &Piece<N>) -> Option<i32>,
    ) -> Result<(), Doubt> {
        let turns =
            |ray: DVec3| pieces.iter().try_fold(0, |turns, piece| crossing(ray, piece).map(|one| turns + one));
        match RAYS.into_iter().find_map(turns) {
            Some(0) => Err(Doubt::NotInside),
            Some(_) => Ok(()),
            None => Err(Doubt::NoRay),
        }
    }

    /// What a piece adds to the number of times that the surface goes around the point inside, by the signs of the
    /// determinants of a ray and its edges; none where that is not certain.
    fn crossing(&self, signs: [Option<Ordering>; 3], side: usize, ray: DVec3) -> Option<i32> {
        if signs.contains(&Some(Ordering::Greater)) && signs.contains(&Some(Ordering::Less)) {
            return Some(0);
        }
        let turn = match signs {
            [Some(Ordering::Greater), Some(Ordering::Greater), Some(Ordering::Greater)] => 1,
            [Some(Ordering::Less), Some(Ordering::Less), Some(Ordering::Less)] => -1,
            _ => return None,
        };
        // The ray's line passes through the piece. The ray does if the side's value falls along it, for the point inside
        // has a larger one than the piece.
        let normal = self.sides[side].plane.normal.to_array().map(Bounded::new);
        let [p, q, r] = std::array::from_fn(|i| normal[i].times(&Bounded::new(ray[i])));
        match p.plus(q).plus(r).sign()? {
            Ordering::Less => Some(turn),
            Ordering::Greater => Some(0),
            Ordering::Equal => None,
        }
    }
}

/// a · (b × c).
fn triple(a: &[Bounded; 3], b: &[Bounded; 3], c: &[Bounded; 3]) -> Bounded {
    let minor = |i: usize, j: usize| b[i].times(&c[j]).minus(b[j].times(&c[i]));
    a[0].times(&minor(1, 2)).plus(a[1].times(&minor(2, 0))).plus(a[2].times(&minor(0, 1)))
}
