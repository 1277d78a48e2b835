//! Views: outdoors and indoors, narrow and wide, deep, infinite, orthographic, off axis.

use proptest::prelude::*;
use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{
    ClipSpace, InputError, View,
    input::{DepthRange, TextureOrigin, YAxis},
};

use super::primitive::{direction, lattice_direction, magnitude};
use super::similarity::Similarity;

/// The arguments of one of the constructors of a [`View`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ViewParams {
    Perspective {
        pose: Pose,
        fov_y: f64,
        aspect: f64,
        near: f64,
        far: Option<f64>,
    },
    Orthographic {
        pose: Pose,
        half_height: f64,
        aspect: f64,
        near: f64,
        far: f64,
    },
    /// A perspective view by its two matrices; `mirrored` exchanges left and right, `scale` is the
    /// eye's units per world unit.
    Matrices {
        pose: Pose,
        mirrored: bool,
        scale: f64,
        frame: Frame,
        clip: ClipSpace,
    },
    /// A perspective view by its one matrix. A near plane, normal and offset in eye space, takes the place of the frame's own
    /// where it is oblique, as a mirror's does.
    Combined {
        pose: Pose,
        mirrored: bool,
        frame: Frame,
        near_plane: Option<[f64; 4]>,
        clip: ClipSpace,
    },
}

/// Where a camera is and which way it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    pub eye: [f64; 3],
    pub forward: [f64; 3],
    pub up: [f64; 3],
}

/// Slopes of the sides of a perspective view, left, right, bottom and top, and its depth range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub slopes: [f64; 4],
    pub near: f64,
    pub far: Option<f64>,
}

impl ViewParams {
    pub fn build(&self) -> Result<View, InputError> {
        match *self {
            Self::Perspective { pose: Pose { eye, forward, up }, fov_y, aspect, near, far } => {
                View::perspective(eye, forward, up, fov_y, aspect, near, far.unwrap_or(f64::INFINITY))
            }
            Self::Orthographic { pose: Pose { eye, forward, up }, half_height, aspect, near, far } => {
                View::orthographic(eye, forward, up, half_height, aspect, near, far)
            }
            Self::Matrices { pose, mirrored, scale, frame, clip } => {
                View::from_matrices(pose.eye_from_world(mirrored, scale), frame.clip_from_eye(scale, clip), clip)
            }
            Self::Combined { pose, mirrored, frame, near_plane, clip } => {
                let mut clip_from_eye = frame.clip_from_eye(1.0, clip);
                if let Some(plane) = near_plane {
                    clip_from_eye = oblique(clip_from_eye, plane.into(), clip.depth);
                }
                View::from_clip_from_world(clip_from_eye * pose.eye_from_world(mirrored, 1.0), clip)
            }
        }
    }

    pub fn moved(&self, by: &Similarity) -> Self {
        match *self {
            Self::Perspective { pose, fov_y, aspect, near, far } => Self::Perspective {
                pose: pose.moved(by),
                fov_y,
                aspect,
                near: by.length(near),
                far: far.map(|far| by.length(far)),
            },
            Self::Orthographic { pose, half_height, aspect, near, far } => Self::Orthographic {
                pose: pose.moved(by),
                half_height: by.length(half_height),
                aspect,
                near: by.length(near),
                far: by.length(far),
            },
            Self::Matrices { pose, mirrored, scale, frame, clip } => {
                Self::Matrices { pose: pose.moved(by), mirrored, scale, frame: frame.moved(by), clip }
            }
            Self::Combined { pose, mirrored, frame, near_plane, clip } => Self::Combined {
                pose: pose.moved(by),
                mirrored,
                frame: frame.moved(by),
                near_plane: near_plane.map(|[x, y, z, offset]| [x, y, z, by.length(offset)]),
                clip,
            },
        }
    }
}

impl Pose {
    fn moved(&self, by: &Similarity) -> Self {
        Self { eye: by.point(self.eye), ..*self }
    }

    /// World to eye, the eye looking along its −z axis.
    fn eye_from_world(&self, mirrored: bool, scale: f64) -> DMat4 {
        let forward = DVec3::from(self.forward).normalize();
        let right = forward.cross(self.up.into()).normalize();
        let up = right.cross(forward);
        let right = if mirrored { -right } else { right };
        let eye = DVec3::from(self.eye);
        let row = |axis: DVec3| (axis * scale).extend(-axis.dot(eye) * scale);
        DMat4::from_cols(row(right), row(up), row(-forward), DVec4::W).transpose()
    }
}

/// A projection with another near plane, in eye space, and the far plane as near as it can be and still hold the corner of
/// the frustum that lies farthest beyond (Lengyel 2005).
fn oblique(clip_from_eye: DMat4, plane: DVec4, depth: DepthRange) -> DMat4 {
    let mut rows = clip_from_eye.transpose();
    let sign = |value: f64| if value < 0.0 { -1.0 } else { 1.0 };
    let far = match depth {
        DepthRange::ZeroToOne | DepthRange::NegativeOneToOne => 1.0,
        DepthRange::ZeroToOneReversed => 0.0,
        DepthRange::NegativeOneToOneReversed => -1.0,
    };
    let from_clip = clip_from_eye.inverse();
    let [x, y] = [from_clip.x_axis, from_clip.y_axis].map(|axis| sign(plane.truncate().dot(axis.truncate())));
    let corner = from_clip * DVec4::new(x, y, far, 1.0);
    let w = rows.w_axis;
    // In units of w, from 0 at the near plane to 1 at that corner.
    let part = plane * (w.dot(corner) / plane.dot(corner));
    rows.z_axis = match depth {
        DepthRange::ZeroToOne => part,
        DepthRange::ZeroToOneReversed => w - part,
        DepthRange::NegativeOneToOne => part * 2.0 - w,
        DepthRange::NegativeOneToOneReversed => w - part * 2.0,
    };
    rows.transpose()
}

impl Frame {
    fn moved(&self, by: &Similarity) -> Self {
        Self { near: by.length(self.near), far: self.far.map(|far| by.length(far)), ..*self }
    }

    /// Eye to clip, for eye coordinates in which a world unit is `scale` long.
    fn clip_from_eye(&self, scale: f64, clip: ClipSpace) -> DMat4 {
        let [left, right, bottom, top] = self.slopes;
        let row = |low: f64, high: f64| (2.0 / (high - low), (high + low) / (high - low));
        let ((x, x_centre), (y, y_centre)) = (row(left, right), row(bottom, top));
        let sign = if clip.y == YAxis::Down { -1.0 } else { 1.0 };
        let w = DVec4::NEG_Z;
        // Depth 0 to 1: f (d − n)/((f − n) d) for a depth d, with d = −z.
        let near = self.near * scale;
        let ratio = self.far.map_or(0.0, |far| self.near / far);
        let zero_to_one = DVec4::new(0.0, 0.0, -1.0, -near) / (1.0 - ratio);
        let z = match clip.depth {
            DepthRange::ZeroToOne => zero_to_one,
            DepthRange::ZeroToOneReversed => w - zero_to_one,
            DepthRange::NegativeOneToOne => zero_to_one * 2.0 - w,
            DepthRange::NegativeOneToOneReversed => w - zero_to_one * 2.0,
        };
        DMat4::from_cols(DVec4::new(x, 0.0, x_centre, 0.0), DVec4::new(0.0, y, y_centre, 0.0) * sign, z, w)
            .transpose()
    }
}

/// Any view.
pub(super) fn view() -> impl Strategy<Value = ViewParams> {
    prop_oneof![
        4 => outdoor_view(),
        3 => indoor_view(),
        1 => extreme_view(),
        1 => orthographic_view(),
        2 => off_axis_view(),
        1 => combined_view(),
        2 => lattice_view(),
    ]
}

/// A walker's camera: level to within a third of a right angle, far plane at the horizon.
fn outdoor_view() -> impl Strategy<Value = ViewParams> {
    let pose = ((-100.0..100.0, 1.0..30.0, -100.0..100.0), 0.0..std::f64::consts::TAU, -0.6..0.4).prop_map(
        |((x, y, z), yaw, pitch): (_, f64, f64)| Pose {
            eye: [x, y, z],
            forward: [yaw.sin(), pitch, -yaw.cos()],
            up: [0.0, 1.0, 0.0],
        },
    );
    let far = prop_oneof![3 => (50.0..2000.0).prop_map(Some), 1 => Just(None)];
    (pose, 0.5..1.8, 0.5..2.5, magnitude(0.05, 2.0), far)
        .prop_map(|(pose, fov_y, aspect, near, far)| ViewParams::Perspective { pose, fov_y, aspect, near, far })
}

/// A camera in a room: any way round, everything near.
fn indoor_view() -> impl Strategy<Value = ViewParams> {
    (any_pose(5.0), 0.5..1.8, 0.5..2.5, magnitude(0.01, 0.5), 2.0..20.0).prop_map(
        |(pose, fov_y, aspect, near, far)| ViewParams::Perspective { pose, fov_y, aspect, near, far: Some(far) },
    )
}

/// Fields of view from 1e-3 to 3 radians and depth ratios from 1.001 to 1e6.
fn extreme_view() -> impl Strategy<Value = ViewParams> {
    let fov = prop_oneof![magnitude(1e-3, 3.0), Just(1e-3), Just(3.0)];
    (any_pose(5.0), fov, 0.5..2.5, magnitude(1e-3, 1.0), magnitude(1.001, 1e6)).prop_map(
        |(pose, fov_y, aspect, near, ratio)| ViewParams::Perspective {
            pose,
            fov_y,
            aspect,
            near,
            far: Some(near * ratio),
        },
    )
}

/// Parallel lines of sight.
fn orthographic_view() -> impl Strategy<Value = ViewParams> {
    (any_pose(10.0), magnitude(0.1, 50.0), 0.5..2.5, -5.0..5.0, magnitude(0.1, 100.0)).prop_map(
        |(pose, half_height, aspect, near, depth)| ViewParams::Orthographic {
            pose,
            half_height,
            aspect,
            near,
            far: near + depth,
        },
    )
}

/// Views by their matrices in every convention, off axis.
fn off_axis_view() -> impl Strategy<Value = ViewParams> {
    let slopes = (-1.0..1.0, 0.1..2.0, -1.0..1.0, 0.1..2.0).prop_map(
        |(left, width, bottom, height): (f64, f64, f64, f64)| [left, left + width, bottom, bottom + height],
    );
    let far = prop_oneof![3 => magnitude(2.0, 1e4).prop_map(Some), 1 => Just(None)];
    let frame = (slopes, magnitude(0.01, 1.0), far).prop_map(|(slopes, near, far)| Frame { slopes, near, far });
    (any_pose(5.0), any::<bool>(), prop::sample::select(vec![1.0, 100.0, 1e-3]), frame, clip_space()).prop_map(
        |(pose, mirrored, scale, frame, clip)| ViewParams::Matrices { pose, mirrored, scale, frame, clip },
    )
}

/// Views by one matrix in every convention, every other one with an oblique near plane that leaves something of it.
fn combined_view() -> impl Strategy<Value = ViewParams> {
    let plane = prop::option::of((-1.5..1.5, -1.5..1.5, magnitude(1e-3, 1.0)));
    (off_axis_view(), plane).prop_map(|(view, plane)| match view {
        ViewParams::Matrices { pose, mirrored, frame, clip, .. } => {
            let near_plane = plane.map(|(x, y, part)| {
                let [left, right, bottom, top] = frame.slopes;
                // How fast the line of sight that runs away from the plane fastest does.
                let fastest = |x: f64, y: f64| 1.0 + (x * left).max(x * right) + (y * bottom).max(y * top);
                let (x, y) = if fastest(x, y) > 0.1 { (x, y) } else { (0.0, 0.0) };
                let distance = 0.5 * part * frame.far.map_or(5.0, |far| far.min(5.0)) * fastest(x, y);
                [x, y, -1.0, -distance]
            });
            ViewParams::Combined { pose, mirrored, frame, near_plane, clip }
        }
        other => other,
    })
}

/// Small integers: the planes of such a view have exact coordinates, and sides at 45°.
pub(super) fn lattice_view() -> impl Strategy<Value = ViewParams> {
    let axes = (0..3_usize, 0..2_usize, any::<[bool; 2]>()).prop_map(|(forward, up, signs)| {
        let signed = |axis: usize, negative: bool| {
            let mut direction = [0.0; 3];
            direction[axis] = if negative { -1.0 } else { 1.0 };
            direction
        };
        (signed(forward, signs[0]), signed((forward + 1 + up) % 3, signs[1]))
    });
    let slopes = prop::sample::select(vec![[-1.0, 1.0, -1.0, 1.0], [-0.5, 0.5, -1.0, 1.0], [0.0, 1.0, -1.0, 0.0]]);
    let far = prop_oneof![3 => (2..9_u8).prop_map(|far| Some(f64::from(far))), 1 => Just(None)];
    (prop::array::uniform3(-3..=3_i8), axes, slopes, far).prop_map(|(eye, (forward, up), slopes, far)| {
        ViewParams::Matrices {
            pose: Pose { eye: eye.map(f64::from), forward, up },
            mirrored: false,
            scale: 1.0,
            frame: Frame { slopes, near: 1.0, far },
            clip: ClipSpace::OPENGL,
        }
    })
}

/// Anywhere near the origin, looking anywhere, straight up and down included.
fn any_pose(reach: f64) -> impl Strategy<Value = Pose> {
    let forward = prop_oneof![3 => direction(), 1 => lattice_direction()];
    let eye = prop_oneof![prop::array::uniform3(-reach..reach), Just([0.0; 3])];
    (eye, forward, direction()).prop_map(|(eye, forward, any)| {
        // Square to the view at least as far as two of the axes are, so that it is never along it.
        let f = DVec3::from(forward).normalize();
        let up = if f.cross(DVec3::Y).length() > 0.1 { DVec3::Y } else { DVec3::X };
        let up = up + DVec3::from(any) * 0.05;
        Pose { eye, forward, up: up.to_array() }
    })
}

/// Every convention.
pub fn clip_space() -> impl Strategy<Value = ClipSpace> {
    let depths = [
        DepthRange::ZeroToOne,
        DepthRange::ZeroToOneReversed,
        DepthRange::NegativeOneToOne,
        DepthRange::NegativeOneToOneReversed,
    ];
    (prop::sample::select(depths.to_vec()), any::<[bool; 2]>()).prop_map(|(depth, [down, bottom])| ClipSpace {
        depth,
        y: if down { YAxis::Down } else { YAxis::Up },
        texture_origin: if bottom { TextureOrigin::BottomLeft } else { TextureOrigin::TopLeft },
    })
}
