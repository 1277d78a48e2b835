//! How far a matrix is from another: differences of clip coordinates after the division, in parts of the clip volume.

use super::arithmetic::{Big, Real};
use super::linear::{M4, V4, dot, exactly, point, rows_of, sub, vector};
use super::ours::ours;
use super::setup::Setup;
use super::textbook::textbook;
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{ClipSpace, Origin, ShadowMap};

/// Half of a unit in the last place.
const F32: f64 = 1.0 / 16_777_216.0;
/// The roundings between the input and an entry of our f64 matrix, as in `tests/properties.rs`.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// What was measured of one matrix.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// The largest difference of x, y or z; infinite or NaN where an entry is not finite.
    pub most: f64,
    /// Test points that lie behind the light's image plane, w ≤ 0: they wrap around.
    pub wrapped: usize,
    /// Pairs of a caster and its receiver in the wrong order.
    pub disorder: usize,
}

/// The textbook's in f32 and in f64 and ours in f64 and in f32, each against its own construction in exact numbers.
pub struct Comparison {
    pub textbook: [Errors; 2],
    pub ours: Ours,
    /// Test points.
    pub points: usize,
}

/// Ours in f64 and in f32, and what the errors may be.
pub struct Ours {
    pub errors: [Errors; 2],
    pub bounds: [f64; 2],
}

/// How far from receivers casters stand, towards the light: see [`Setup::caster`].
const PARTS: [f64; 2] = [1.0 / 1024.0, 0.25];

impl Comparison {
    pub fn new(setup: &Setup) -> Self {
        let receivers = setup.receivers();
        let exact = textbook::<Big>(setup);
        let reversed = setup.lambda_w() < 0.0;
        let world = Points { setup, receivers: &receivers, origin: DVec3::ZERO };
        let matrices = [exactly(&textbook::<f32>(setup)), exactly(&textbook::<f64>(setup))];
        let textbook = matrices.map(|matrix| world.errors(matrix.as_ref(), &exact, reversed));
        Self { textbook, ours: Ours::new(setup), points: receivers.len() }
    }
}

impl Ours {
    pub fn new(setup: &Setup) -> Self {
        let map = setup.map();
        let receivers = setup.receivers();
        let exact = about_origin(setup, &ours(setup, &map));
        let points = Points { setup, receivers: &receivers, origin: origin(setup) };
        let matrices = [of_map(&map, setup), of_upload(&map)];
        let errors = matrices.map(|matrix| points.errors(Some(&matrix), &exact, false));
        Self { errors, bounds: bounds(setup, &map, &receivers) }
    }
}

/// Our f64 matrix, for positions relative to the origin.
fn of_map(map: &ShadowMap, setup: &Setup) -> M4<Big> {
    let rows = rows_of(&map.clip_from_world_in(ClipSpace::WGPU));
    about_origin(setup, &exactly(&rows).expect("our matrices are finite"))
}

/// What a renderer uploads.
fn of_upload(map: &ShadowMap) -> M4<Big> {
    let matrix: DMat4 = map.caster_matrix().as_dmat4();
    exactly(&rows_of(&matrix)).expect("our matrices are finite")
}

/// The origin that positions are relative to.
fn origin(setup: &Setup) -> DVec3 {
    match setup.origin {
        Origin::World => DVec3::ZERO,
        _ => setup.camera.eye,
    }
}

fn about_origin(setup: &Setup, rows: &M4<Big>) -> M4<Big> {
    let origin = point(&vector(origin(setup)));
    rows.each_ref().map(|row| {
        let [x, y, z, _] = row.clone();
        [x, y, z, dot(row, &origin)]
    })
}

/// A point after a matrix and after the division, and w.
fn project(matrix: &M4<Big>, p: &V4<Big>) -> ([Big; 3], Big) {
    let [x, y, z, w] = matrix.each_ref().map(|row| dot(row, p));
    ([x, y, z].map(|x| x / w.clone()), w)
}

/// Sides of the clip volume.
const SIDES: [f64; 3] = [2.0, 2.0, 1.0];

/// Where a matrix is tried, and what it takes positions relative to.
#[derive(Clone, Copy)]
struct Points<'a> {
    setup: &'a Setup,
    receivers: &'a [DVec3],
    origin: DVec3,
}

impl Points<'_> {
    /// Against the exact matrix; `reversed` where depth grows towards the light.
    fn errors(&self, matrix: Option<&M4<Big>>, exact: &M4<Big>, reversed: bool) -> Errors {
        let Some(matrix) = matrix else {
            return Errors { most: f64::NAN, wrapped: 0, disorder: 0 };
        };
        let mut errors = Errors { most: 0.0, wrapped: 0, disorder: 0 };
        let from_origin = |p: DVec3| point(&sub(&vector(p), &vector(self.origin)));
        let zero = Big::of(0.0);
        for &receiver in self.receivers {
            let (place, w) = project(matrix, &from_origin(receiver));
            let (expected, exact_w) = project(exact, &from_origin(receiver));
            if w <= zero {
                errors.wrapped += 1;
            }
            if w > zero && exact_w > zero {
                for i in 0..3 {
                    let off = (place[i].clone() - expected[i].clone()).abs().to_f64() / SIDES[i];
                    errors.most = errors.most.max(off);
                }
            }
            for part in PARTS {
                let (caster, caster_w) = project(matrix, &from_origin(self.setup.caster(receiver, part)));
                let is_nearer = if reversed { caster[2] > place[2] } else { caster[2] < place[2] };
                errors.disorder += usize::from(!(is_nearer && w > zero && caster_w > zero));
            }
        }
        errors
    }
}

/// What may be between our matrices and the exact one.
///
/// An entry of the f32 matrix is off by half of a unit in its last place; after the division a coordinate v by no more than
/// `u (Σ|row · X| + |v| Σ|w · X|) / w`. Rows of the f64 matrix are sums of covectors through the light, the eye and what
/// is visible: [`ROUNDINGS`] of terms as large as its normal times those.
fn bounds(setup: &Setup, map: &ShadowMap, receivers: &[DVec3]) -> [f64; 2] {
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    let origin = origin(setup);
    let light = map_light(setup);
    let reach = setup.camera.eye.abs() + light + setup.visible().iter().fold(DVec3::ZERO, |r, p| r.max(p.abs()));
    let mut worst = [0.0_f64; 2];
    for &receiver in receivers {
        let at = |row: usize| matrix.row(row).dot(receiver.extend(1.0));
        let normal = |row: usize| matrix.row(row).truncate();
        let in_f64 = |row: usize| ROUNDINGS * (normal(row).length() * reach.length() + at(row).abs());
        let in_f32 = |row: usize| {
            let entry = matrix.row(row).dot(origin.extend(1.0)).abs();
            F32 * (normal(row).abs().dot((receiver - origin).abs()) + entry)
        };
        let w = at(3);
        for (row, side) in SIDES.into_iter().enumerate() {
            let after = |of: &dyn Fn(usize) -> f64| (of(row) + (at(row) / w).abs() * of(3)) / (w - of(3)) / side;
            worst[0] = worst[0].max(after(&in_f64));
            worst[1] = worst[1].max(after(&in_f64) + after(&in_f32));
        }
    }
    worst
}

/// How far a lamp is from the world's origin.
fn map_light(setup: &Setup) -> DVec3 {
    setup.lamp.light().position().map_or(DVec3::ZERO, DVec3::abs)
}

/// A number of a table.
pub fn figure(value: f64) -> String {
    if value.is_nan() {
        "NaN".into()
    } else if value.is_infinite() {
        "inf".into()
    } else if value == 0.0 {
        "0".into()
    } else {
        format!("{value:.1e}")
    }
}
