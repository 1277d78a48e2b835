//! Bodies by their planes: exactly, and as they are naively made, every three planes for a vertex and an epsilon to decide
//! whether it is inside the others.

use super::arithmetic::{Big, Real};
use super::linear::{V3, V4, add, cross, dot, length, sub, times};
use shadowfit::glam::DVec3;

/// The vertices of an intersection of half-spaces as homogeneous points with w > 0, found by trying every three planes.
///
/// Signs are those of 512 bits. A plane through the vertex of three others, but for the rounding of a square root in 512
/// bits, counts as such.
pub fn vertices(planes: &[V4<Big>]) -> Vec<V4<Big>> {
    // 2⁻³⁶⁰ of the terms: far above the rounding of 512 bits, far below anything that f64 can tell apart.
    let touching = Big::of(f64::from_bits((1023 - 360) << 52));
    let mut found: Vec<V4<Big>> = Vec::new();
    for_each_triple(planes, |[x, y, z, w]| {
        let inside = planes.iter().all(|plane| {
            let terms = [x, y, z, w].into_iter().zip(plane).map(|(x, p)| x.clone() * p.clone());
            let (sum, size) = terms
                .fold((Big::of(0.0), Big::of(0.0)), |(sum, size), term| (sum + term.clone(), size + term.abs()));
            sum >= -(size * touching.clone())
        });
        if inside {
            found.push([x.clone(), y.clone(), z.clone(), w.clone()]);
        }
    });
    found
}

/// The common point of every three planes that have one, w > 0.
fn for_each_triple<T: Real>(planes: &[V4<T>], mut each: impl FnMut([&T; 4])) {
    let normal = |plane: &V4<T>| -> V3<T> {
        let [x, y, z, _] = plane.clone();
        [x, y, z]
    };
    for (i, a) in planes.iter().enumerate() {
        for (j, b) in planes.iter().enumerate().skip(i + 1) {
            for c in planes.iter().skip(j + 1) {
                let [na, nb, nc] = [a, b, c].map(normal);
                let (bc, ca, ab) = (cross(&nb, &nc), cross(&nc, &na), cross(&na, &nb));
                let volume = dot(&na, &bc);
                if volume == T::of(0.0) {
                    continue;
                }
                let sum = add(&add(&times(&bc, &a[3]), &times(&ca, &b[3])), &times(&ab, &c[3]));
                // −sum/volume, with a positive weight.
                let sign = if volume > T::of(0.0) { T::of(-1.0) } else { T::of(1.0) };
                let [x, y, z] = times(&sum, &sign);
                each([&x, &y, &z, &volume.abs()]);
            }
        }
    }
}

/// What is usually done: unit normals, a vertex for every three planes, kept if it is no farther than `epsilon` outside of
/// any plane.
pub fn naive<T: Real>(planes: &[V4<Big>], epsilon: f64) -> Vec<DVec3> {
    let planes: Vec<V4<T>> = planes
        .iter()
        .map(|plane| {
            let [x, y, z, d] = plane.each_ref().map(|x| T::of(x.to_f64()));
            let scale = length(&[x.clone(), y.clone(), z.clone()]);
            [x, y, z, d].map(|x| x / scale.clone())
        })
        .collect();
    let mut found = Vec::new();
    for_each_triple(&planes, |[x, y, z, w]| {
        let p = [x, y, z].map(|x| x.clone() / w.clone());
        if planes.iter().all(|plane| super::linear::at(plane, &p) >= T::of(-epsilon)) {
            let p = DVec3::from(p.map(|x| x.to_f64()));
            if p.is_finite() {
                found.push(p);
            }
        }
    });
    found
}

/// The half-spaces of the hull of a body and a light: those that the light is inside of, and for every two of which one
/// faces it and the other does not the one through their line and the light.
pub fn hull(planes: &[V4<Big>], l: &V4<Big>) -> Vec<V4<Big>> {
    let zero = Big::of(0.0);
    let mut hull: Vec<_> = planes.iter().filter(|plane| dot(plane, l) >= zero).cloned().collect();
    for towards in planes.iter().filter(|plane| dot(plane, l) > zero) {
        for away in planes.iter().filter(|plane| dot(plane, l) < zero) {
            let plane = sub(&times(away, &dot(towards, l)), &times(towards, &dot(away, l)));
            // Two that face each other make the plane at infinity under the sun.
            if plane[..3].iter().any(|x| *x != zero) {
                hull.push(plane);
            }
        }
    }
    hull
}

/// What a body lacks of the exact one and what it has beside it, as the largest distances, in any of some hundreds of
/// directions, between the planes that bound them. Where the exact one is empty, how far its points are outside of the
/// half-spaces that have none in common; where only the other one is, all is lost, an infinity.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    pub lost: f64,
    pub gained: f64,
}

impl Difference {
    pub fn new(exact: &[V4<Big>], planes: &[V4<Big>], body: &[DVec3]) -> Self {
        if body.is_empty() {
            return Self { lost: if exact.is_empty() { 0.0 } else { f64::INFINITY }, gained: 0.0 };
        }
        if exact.is_empty() {
            return Self { lost: 0.0, gained: outside(planes, body) };
        }
        let exact: Vec<V3<Big>> =
            exact.iter().map(|[x, y, z, w]| [x, y, z].map(|x| x.clone() / w.clone())).collect();
        let body: Vec<V3<Big>> = body.iter().map(|p| super::linear::vector(*p)).collect();
        let mut difference = Self { lost: 0.0, gained: 0.0 };
        for direction in directions(planes) {
            let reach = |points: &[V3<Big>]| {
                let along = points.iter().map(|p| dot(p, &direction));
                along.reduce(Big::most).expect("neither is empty")
            };
            let beyond = (reach(&body) - reach(&exact)).to_f64();
            difference.gained = difference.gained.max(beyond);
            difference.lost = difference.lost.max(-beyond);
        }
        difference
    }
}

/// The farthest that any point is outside of any plane.
fn outside(planes: &[V4<Big>], points: &[DVec3]) -> f64 {
    let of = |plane: &V4<Big>, p: &DVec3| {
        let [x, y, z, _] = plane.clone();
        (-super::linear::at(plane, &super::linear::vector(*p)) / length(&[x, y, z])).to_f64()
    };
    planes.iter().flat_map(|plane| points.iter().map(move |p| of(plane, p))).fold(0.0, f64::max)
}

/// Unit directions to measure in, all but exactly: outwards of every plane, and evenly all around.
fn directions(planes: &[V4<Big>]) -> Vec<V3<Big>> {
    let of_planes = planes.iter().map(|[x, y, z, _]| -DVec3::new(x.to_f64(), y.to_f64(), z.to_f64()).normalize());
    let around = (0..128).map(|i| {
        // Fibonacci's spiral on a sphere.
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 128.0;
        let (sin, cos) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    });
    of_planes.chain(around).map(super::linear::vector).collect()
}
