//! Random poses and projections, made into matrices in every way that renderers do.
//!
//! `SHADOWFIT_CASES=100000 cargo test --release --test input accepted -- --nocapture` prints the share of cameras that are
//! accepted and how far their corners are from where the matrices have them, beside the rounding of the entries.

use glam::{DMat4, DQuat, DVec3, DVec4, Mat4};
use proptest::prelude::*;
use shadowfit::{
    ClipSpace, InputError, View,
    input::{DepthRange, YAxis},
};
use std::cell::RefCell;
use testkit::arbitrary::{clip_space, rotation, run};

/// A camera in exact numbers.
#[derive(Clone, Debug)]
struct Camera {
    eye: DVec3,
    turn: DQuat,
    /// Half of the image across and up, and its middle: slopes, or lengths of an orthographic one.
    half: [f64; 2],
    middle: [f64; 2],
    near: f64,
    far: f64,
    orthographic: bool,
    /// Quarter turns of the image.
    quarters: u8,
    clip: ClipSpace,
}

impl Camera {
    fn world_from_eye(&self) -> DMat4 {
        DMat4::from_rotation_translation(self.turn, self.eye)
    }

    fn clip_from_eye(&self) -> DMat4 {
        let ([sx, sy], [mx, my]) = (self.half, self.middle);
        let sign = if self.clip.y == YAxis::Down { -1.0 } else { 1.0 };
        let (near, far) = (self.near, self.far);
        let (x, y, zero_to_one, w);
        if self.orthographic {
            x = DVec4::new(1.0, 0.0, 0.0, -mx) / sx;
            y = DVec4::new(0.0, 1.0, 0.0, -my) / sy;
            zero_to_one = DVec4::new(0.0, 0.0, -1.0, -near) / (far - near);
            w = DVec4::W;
        } else {
            x = DVec4::new(1.0, 0.0, mx, 0.0) / sx;
            y = DVec4::new(0.0, 1.0, my, 0.0) / sy;
            zero_to_one = DVec4::new(0.0, 0.0, -1.0, -near) / (1.0 - near / far);
            w = DVec4::NEG_Z;
        }
        let z = match self.clip.depth {
            DepthRange::ZeroToOne => zero_to_one,
            // Small numbers where w − z would leave a rounding of 1.
            DepthRange::ZeroToOneReversed if self.orthographic => DVec4::new(0.0, 0.0, 1.0, far) / (far - near),
            DepthRange::ZeroToOneReversed if far.is_infinite() => DVec4::W * near,
            DepthRange::ZeroToOneReversed => DVec4::new(0.0, 0.0, near, near * far) / (far - near),
            DepthRange::NegativeOneToOne => zero_to_one * 2.0 - w,
            DepthRange::NegativeOneToOneReversed => w - zero_to_one * 2.0,
        };
        let (x, y) = match self.quarters {
            0 => (x, y),
            1 => (-y, x),
            2 => (-x, -y),
            _ => (y, -x),
        };
        DMat4::from_cols(x, y * sign, z, w).transpose()
    }
}

/// How the matrices are made. All but the first go by f32.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    /// In f64, with the inverse of the pose by cofactors.
    Double,
    /// The inverse of the pose in f32.
    Inverse,
    /// A view in f64 rounded to f32.
    Rounded,
    /// The view as P⁻¹ · (P V).
    ViewOfProduct,
    /// The projection as (P V) · V⁻¹.
    LensOfProduct,
    /// The projection turned by 180° about y and by a quarter about z, in f32, and the view turned back.
    Turned,
    /// One matrix in f32.
    Combined,
    /// One matrix in f64, of two rounded to f32.
    CombinedInDouble,
}

const WAYS: [Way; 8] = [
    Way::Double,
    Way::Inverse,
    Way::Rounded,
    Way::ViewOfProduct,
    Way::LensOfProduct,
    Way::Turned,
    Way::Combined,
    Way::CombinedInDouble,
];

/// What comes of a way: the view, the product of the matrices that were given, and half a unit in the last place of the
/// magnitudes that each entry of it is a sum of.
struct Made {
    view: Result<View, InputError>,
    clip_from_world: DMat4,
    rounding: DMat4,
}

fn absolute(matrix: &DMat4) -> DMat4 {
    DMat4::from_cols_array(&matrix.to_cols_array().map(f64::abs))
}

impl Way {
    fn make(self, camera: &Camera) -> Made {
        let (pose, lens) = (camera.world_from_eye(), camera.clip_from_eye());
        let (pose32, lens32) = (pose.as_mat4(), lens.as_mat4());
        let view32 = pose.inverse().as_mat4();
        let two = |view: Mat4, lens: Mat4| (view.as_dmat4(), lens.as_dmat4());
        let (view, lens) = match self {
            Self::Double => (pose.inverse(), lens),
            Self::Inverse => two(pose32.inverse(), lens32),
            Self::Rounded => two(view32, lens32),
            Self::ViewOfProduct => two(lens32.inverse() * (lens32 * view32), lens32),
            Self::LensOfProduct => two(view32, lens32 * view32 * view32.inverse()),
            Self::Turned => {
                let turn = Mat4::from_rotation_y(std::f32::consts::PI)
                    * Mat4::from_rotation_z(std::f32::consts::FRAC_PI_2);
                two(turn.inverse() * view32, lens32 * turn)
            }
            Self::Combined => (DMat4::IDENTITY, (lens32 * view32).as_dmat4()),
            Self::CombinedInDouble => (DMat4::IDENTITY, lens32.as_dmat4() * view32.as_dmat4()),
        };
        let half = match self {
            Self::Double | Self::CombinedInDouble => 0.5 * f64::EPSILON,
            _ => 0.5 * f64::from(f32::EPSILON),
        };
        let clip_from_world = lens * view;
        let made = match self {
            Self::Combined | Self::CombinedInDouble => View::from_clip_from_world(clip_from_world, camera.clip),
            _ => View::from_matrices(view, lens, camera.clip),
        };
        let rounding = absolute(&lens) * absolute(&view) * (2.0 * half);
        Made { view: made, clip_from_world, rounding }
    }
}

/// Where a matrix has a corner of the clip volume, and how far roundings of its entries can move it; none where that is all
/// the way to infinity.
fn corner(made: &Made, at: DVec3) -> Option<(DVec3, f64)> {
    let inverse = made.clip_from_world.inverse();
    let at = inverse * at.extend(1.0);
    let size = absolute(&inverse) * (made.rounding * (at / at.w).abs());
    let point = at.truncate() / at.w;
    let moved = size.truncate().length() + size.w * point.length();
    // Where w may change by half of itself that says nothing.
    (at.w > 0.0 && size.w < 0.25).then_some((point, 2.0 * moved))
}

fn ends(depth: DepthRange) -> [f64; 2] {
    match depth {
        DepthRange::ZeroToOne => [0.0, 1.0],
        DepthRange::ZeroToOneReversed => [1.0, 0.0],
        DepthRange::NegativeOneToOne => [-1.0, 1.0],
        DepthRange::NegativeOneToOneReversed => [1.0, -1.0],
    }
}

/// How far from a point the nearest place is where three of the planes of a view meet.
fn to_corner(view: &View, point: DVec3) -> f64 {
    let planes = view.planes();
    let mut nearest = f64::INFINITY;
    for (i, a) in planes.iter().enumerate() {
        for (j, b) in planes.iter().enumerate().skip(i + 1) {
            for c in planes.iter().skip(j + 1) {
                let across = b.normal.cross(c.normal);
                let volume = a.normal.dot(across);
                let sum = across * a.at(point)
                    + c.normal.cross(a.normal) * b.at(point)
                    + a.normal.cross(b.normal) * c.at(point);
                if volume != 0.0 {
                    nearest = nearest.min((sum / volume).length());
                }
            }
        }
    }
    nearest
}

fn camera() -> impl Strategy<Value = Camera> {
    let size = || prop_oneof![4 => -100.0..100.0, 1 => -1e4..1e4];
    let slopes = (
        prop_oneof![8 => 0.2..2.0, 1 => 0.008..0.2, 1 => 2.0..12.0],
        0.4..2.5,
        prop_oneof![2 => Just([0.0; 2]), 1 => prop::array::uniform2(-0.004..0.004), 1 => prop::array::uniform2(-1.0..1.0)],
    );
    let depths = (-2.0_f64..0.5, 1.0_f64..4.5).prop_map(|(near, ratio)| (10_f64.powf(near), 10_f64.powf(ratio)));
    let kind = (any::<bool>(), prop::sample::select(vec![true, false, false]), 0..4_u8);
    (prop::array::uniform3(size()), rotation(), slopes, depths, kind, clip_space()).prop_map(
        |(eye, turn, (half, aspect, middle), (near, ratio), (endless, orthographic, quarters), clip)| {
            let scale = if orthographic { 20.0 } else { 1.0 };
            Camera {
                eye: eye.into(),
                turn,
                half: [half * aspect * scale, half * scale],
                middle: middle.map(|part| part * half * scale),
                near,
                far: if endless && !orthographic { f64::INFINITY } else { near * ratio },
                orthographic,
                quarters,
                clip,
            }
        },
    )
}

/// What was found for a way.
#[derive(Clone, Copy, Default)]
struct Found {
    cameras: usize,
    accepted: usize,
    /// The farthest that a corner is off, of what roundings of the entries can move it by.
    corner: f64,
    /// The farthest an eye is off, likewise.
    eye: f64,
    corners: usize,
}

#[test]
fn all_are_accepted_with_corners_where_the_matrices_have_them() {
    let found = RefCell::new([Found::default(); WAYS.len()]);
    run(20_000, &camera(), |camera| {
        for (way, found) in WAYS.into_iter().zip(found.borrow_mut().iter_mut()) {
            let made = way.make(&camera);
            found.cameras += 1;
            let view = made.view.as_ref().unwrap_or_else(|error| panic!("{way:?} {camera:?}: {error}"));
            found.accepted += 1;
            if !camera.orthographic
                && let Some((eye, bound)) = eye(&made)
            {
                let off = (view.eye() - eye).length();
                found.eye = found.eye.max(off / bound);
                assert!(off <= 2.0 * bound, "{way:?} {camera:?}: eye at {}, not {eye}, by {bound:e}", view.eye());
            }
            for (x, y, z) in (0..8).map(|at| (at & 1, at >> 1 & 1, at >> 2)) {
                let sign = |side: usize| if side == 0 { -1.0 } else { 1.0 };
                let at = DVec3::new(sign(x), sign(y), ends(camera.clip.depth)[z]);
                let Some((point, bound)) = corner(&made, at) else { continue };
                let off = to_corner(view, point);
                found.corner = found.corner.max(off / bound);
                found.corners += 1;
                assert!(
                    off <= 4.0 * bound,
                    "{way:?} {camera:?}: corner {at} is {off:e} from {point}, by {bound:e}"
                );
            }
        }
    });
    for (way, Found { cameras, accepted, corner, eye, corners }) in WAYS.into_iter().zip(found.into_inner()) {
        println!(
            "{way:?}: {accepted} of {cameras} accepted; eyes off by {eye:.3}, {corners} corners by {corner:.3} of the \
             rounding of the entries"
        );
        assert_eq!(accepted, cameras);
    }
}

/// Where x, y and w of a matrix vanish, and how far roundings of its entries can move that.
fn eye(made: &Made) -> Option<(DVec3, f64)> {
    let rows = [0, 1, 3].map(|row| made.clip_from_world.row(row));
    let solved = DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose();
    let inverse = solved.inverse();
    let eye = inverse * DVec4::W;
    let roundings = [0, 1, 3].map(|row| made.rounding.row(row));
    let rounding = DMat4::from_cols(roundings[0], roundings[1], roundings[2], DVec4::ZERO).transpose();
    let moved = absolute(&inverse) * (rounding * eye.abs());
    eye.is_finite().then(|| (eye.truncate(), 2.0 * moved.truncate().length()))
}
