//! Checks of the certificates against the exact oracle.

use dashu_int::IBig;
use glam::DVec3;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadowfit::focus::Plane;

use super::random::Random;
use super::shapes::{cuboid, tetrahedron};
use crate::oracle::long_run::half_spaces;
use testkit::arbitrary::{Case, case};
use testkit::oracle::body::Body;
use testkit::oracle::certified::half_spaces::HalfSpaces;
use testkit::oracle::certified::precise::{Precise, admits};
use testkit::oracle::certified::{Uncertain, certify};
use testkit::oracle::exact::{integers, scale};
use testkit::oracle::focus::Input;
use testkit::oracle::loss::{Shape, losses};
use testkit::oracle::scalar::{cross, dot, minors};

/// The exact value lies within the bound around a determinant, and the bound is small.
#[test]
fn precise_numbers_hold_the_exact_ones() {
    let mut random = Random::new(8);
    for _ in 0..2000 {
        let mut vector = || -> [f64; 4] { std::array::from_fn(|_| scale(random.signed(), -random.integer(0, 40))) };
        let [a, b, c, mut d] = std::array::from_fn(|_| vector());
        if random.integer(0, 1) == 0 {
            // Dependent up to rounding.
            d = std::array::from_fn(|i| 0.7 * a[i] - 1.3 * b[i] + 0.1 * c[i]);
        }
        let precise = {
            let [a, b, c, d] = [a, b, c, d].map(|v| v.map(Precise::new));
            dot(&cross(&minors(&a, &b), &c), &d)
        };
        // All values times a power of two that makes the exact ones whole.
        let (whole, exponent) = integers([a, b, c, d].concat().try_into().expect("sixteen numbers"));
        let whole: [IBig; 16] = whole;
        let row = |i: usize| -> [IBig; 4] { std::array::from_fn(|k| whole[4 * i + k].clone()) };
        let exact = dot(&cross(&minors(&row(0), &row(1)), &row(2)), &row(3));
        // A bound as an integer and its exponent against the exact value and its own.
        let at_most = |low: f64, high: &IBig| {
            let ([low], low_exponent) = integers([low]);
            let (low_up, high_up) = ((low_exponent - 4 * exponent).max(0), (4 * exponent - low_exponent).max(0));
            (low << low_up as usize) <= (high << high_up as usize)
        };
        assert!(at_most(precise.lower(), &exact), "{a:?} {b:?} {c:?} {d:?}");
        assert!(at_most(-precise.upper(), &-&exact), "{a:?} {b:?} {c:?} {d:?}");
        let size: f64 = [a, b, c, d].map(|v| v.into_iter().map(f64::abs).sum::<f64>()).into_iter().product();
        assert!(precise.error() <= 1e-27 * size);
    }
    assert!(admits(&[0.0, -1.0, 1e40, -1e-40]));
    assert!(!admits(&[1e-50]) && !admits(&[1e50]) && !admits(&[f64::NAN]));
}

/// What bounds a hull holds every point of it, known as a combination of points of the body and the light.
#[test]
fn half_spaces_hold_the_hull() {
    let light = [3.0, 1.0, 0.5, 1.0];
    let (min, max) = (DVec3::splat(-4.0), DVec3::splat(4.0));
    let mut hull = HalfSpaces::new(min, max, &[]);
    hull.meet_hull(&tetrahedron(), light);
    // The farthest points of the hull along an axis are corners of the tetrahedron or the light.
    for (plane, least) in [
        ([1.0, 0.0, 0.0, 0.0], 0.0),
        ([-1.0, 0.0, 0.0, 0.0], -3.0),
        ([0.0, -1.0, 0.0, 0.0], -1.0),
        ([0.0, 0.0, -1.0, 0.0], -1.0),
        ([-1.0, -1.0, -1.0, 0.0], -4.5),
        ([1.0, 1.0, 1.0, 0.0], 0.0),
    ] {
        let found = hull.least(plane, f64::INFINITY);
        assert!((found - least).abs() < 1e-12 && found <= least, "{plane:?}: {found}");
    }
    assert!(!hull.is_certainly_empty());
    let mut apart = HalfSpaces::new(min, max, &[[-1.0, 0.0, 0.0, -1e-9]]);
    assert!(!apart.is_certainly_empty());
    apart.meet_hull(&tetrahedron(), light);
    assert!(apart.is_certainly_empty());
    // They touch, and are not empty.
    let mut touching = HalfSpaces::new(min, max, &[[-1.0, 0.0, 0.0, 0.0]]);
    touching.meet_hull(&tetrahedron(), light);
    assert!(!touching.is_certainly_empty());
}

/// The cube from −1 to 1, each of its planes moved outwards by as much, and the surface of the moved one.
fn cube(slack: f64) -> Shape {
    let size = 1.0 + slack;
    let corner = |bits: usize| {
        DVec3::from(std::array::from_fn::<f64, 3, _>(|axis| if bits >> axis & 1 == 1 { size } else { -size }))
    };
    let planes: Vec<Plane> = (0..3)
        .flat_map(|axis| [Plane::new(DVec3::AXES[axis], size), Plane::new(-DVec3::AXES[axis], size)])
        .collect();
    let face = |index: usize| {
        let (axis, upper) = (index / 2, index % 2);
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let start = if upper == 1 { 1 << axis } else { 0 };
        let ring = [start, start + u, start + u + v, start + v];
        if upper == 1 { ring.to_vec() } else { ring.into_iter().rev().collect() }
    };
    Shape {
        faces: planes.iter().copied().zip((0..6).map(face)).collect(),
        planes,
        vertices: (0..8).map(corner).collect(),
    }
}

/// A cube around a cube, with each way in which it could leave something out.
#[test]
fn enclosures_of_a_cube() {
    let slack = 1e-14;
    let exact = HalfSpaces::new(DVec3::splat(-2.0), DVec3::splat(2.0), &cuboid([-1.0; 3], [1.0; 3]));
    let whole = cube(slack);
    assert!(certify(&whole, &exact).is_ok());
    // Without slack nothing is lost, but nothing is certain either.
    assert!(certify(&cube(0.0), &exact).is_err());
    assert_eq!(certify(&cube(-slack), &exact).unwrap_err(), Uncertain::Plane);
    for index in 0..8 {
        let mut shape = whole.clone();
        shape.vertices[index] *= 1.0 - 2.0 * slack;
        assert!(certify(&shape, &exact).is_err(), "a corner is short");
        let mut shape = whole.clone();
        shape.vertices[index] = DVec3::ZERO;
        assert!(certify(&shape, &exact).is_err(), "a corner is dented");
    }
    for index in 0..6 {
        let mut shape = whole.clone();
        shape.faces.remove(index);
        // The other faces leave a gap, which is found to be beyond the same plane.
        assert!(certify(&shape, &exact).is_ok());
        let mut shape = whole.clone();
        shape.planes[index].offset -= 2.0 * slack;
        assert!(certify(&shape, &exact).is_err(), "a plane cuts");
    }
    // The surface is closed and beyond the planes, but it is somewhere else.
    let mut shape = whole;
    for vertex in &mut shape.vertices {
        vertex.x += 5.0;
    }
    assert!(certify(&shape, &exact).is_err());
}

/// What is done to a body.
#[derive(Clone, Copy, Debug)]
enum Tampering {
    Nothing,
    /// One plane moved inwards by this many ε of its magnitude.
    Plane(f64),
    /// One vertex moved towards the middle by this part of the way.
    Vertex(f64),
    /// All vertices.
    Vertices(f64),
    /// Nothing left.
    Empty,
}

impl Tampering {
    fn apply(self, shape: &Shape, extent: DVec3, random: &mut Random) -> Shape {
        let mut shape = shape.clone();
        if shape.is_empty() {
            return shape;
        }
        let middle = shape.vertices.iter().sum::<DVec3>() / shape.vertices.len() as f64;
        let mut any = |len: usize| random.integer(0, len as i64 - 1) as usize;
        match self {
            Self::Nothing => {}
            Self::Plane(by) => {
                let plane = any(shape.planes.len());
                let plane = &mut shape.planes[plane];
                plane.offset -= by * f64::EPSILON * (plane.normal.abs().dot(extent) + plane.offset.abs());
            }
            Self::Vertex(part) => {
                let vertex = any(shape.vertices.len());
                let vertex = &mut shape.vertices[vertex];
                *vertex += (middle - *vertex) * part;
            }
            Self::Vertices(part) => {
                for vertex in &mut shape.vertices {
                    *vertex += (middle - *vertex) * part;
                }
            }
            Self::Empty => shape = Shape { planes: Vec::new(), vertices: Vec::new(), faces: Vec::new() },
        }
        shape
    }
}

/// Bodies as they are, and shrunk by amounts from a few roundings upwards: what is certified has lost nothing, and
/// where the exact oracle finds that something is lost nothing is certified.
#[test]
fn certificates_never_contradict_the_exact_oracle() {
    let all = [
        Tampering::Nothing,
        Tampering::Plane(100.0),
        Tampering::Plane(194.0),
        Tampering::Plane(1e6),
        Tampering::Vertex(1e-13),
        Tampering::Vertex(1e-6),
        Tampering::Vertices(1e-13),
        Tampering::Empty,
    ];
    let mut random = Random::new(9);
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[13; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = case();
    // Of each tampering: how many were certified, were left open, and did lose something.
    let mut counts = [[0_usize; 3]; 8];
    let mut taken = 0;
    while taken < 1000 {
        let case: Case = strategy.new_tree(&mut runner).expect("few cases are refused").current();
        let Some(input) = Input::of(&case) else { continue };
        let Some(exact) = half_spaces(&input, &case) else { continue };
        taken += 1;
        for (i, computed) in input.computed(&case).iter().enumerate() {
            let body: Body = input.exact_body(i);
            let shape = Shape::of(computed);
            // An empty body cannot be tampered with, and there are many.
            if shape.is_empty() && random.integer(0, 9) != 0 {
                continue;
            }
            for (tampering, [certified, open, lost]) in all.into_iter().zip(&mut counts) {
                let shape = tampering.apply(&shape, input.extent, &mut random);
                let is_lost = !losses(&shape, &body).is_empty();
                let is_certified = certify(&shape, &exact[i]).is_ok();
                assert!(!(is_lost && is_certified), "{i} {tampering:?} {case:?}");
                *certified += usize::from(is_certified);
                *open += usize::from(!is_certified && !is_lost);
                *lost += usize::from(is_lost);
            }
        }
    }
    for (tampering, [certified, open, lost]) in all.iter().zip(counts) {
        println!("{tampering:?}: {certified} certified, {open} open, {lost} with something lost");
    }
    let [untouched, .., shrunk, nothing] = counts;
    assert!(untouched[0] > 20 * untouched[1], "most bodies are certified");
    assert!(shrunk[2] > shrunk[0], "and the tampering matters");
    assert!(nothing[2] > nothing[1], "that a body is not empty is found");
}
