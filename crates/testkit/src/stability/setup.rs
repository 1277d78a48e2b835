//! What is fitted: a camera, a light and a box, as plain numbers that f32 holds exactly, so that no construction loses
//! anything before it begins.

use super::arithmetic::Real;
use super::linear::{V3, V4, cross, dot, through, times, unit, vector};
use shadowfit::glam::DVec3;
use shadowfit::{Focus, Light, Origin, Scene, Settings, ShadowMap, View, Warp, warp::Shift};

/// A symmetric perspective camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub eye: DVec3,
    pub forward: DVec3,
    pub up: DVec3,
    pub fov_y: f64,
    pub aspect: f64,
    pub near: f64,
    pub far: f64,
}

/// A camera's axes, slopes and covectors in some arithmetic.
pub struct Frame<T> {
    pub eye: V3<T>,
    pub up: V3<T>,
    pub forward: V3<T>,
    /// x and y before they are divided by depth, −1 to 1 in the image.
    pub across: [V4<T>; 2],
    pub depth: V4<T>,
}

impl Camera {
    pub fn view(&self) -> View {
        View::perspective(self.eye, self.forward, self.up, self.fov_y, self.aspect, self.near, self.far)
            .expect("a legal view")
    }

    pub fn frame<T: Real>(&self) -> Frame<T> {
        let (eye, forward) = (vector(self.eye), unit(&vector(self.forward)));
        let right = unit(&cross(&forward, &unit(&vector(self.up))));
        let up = cross(&right, &forward);
        let slope = (T::of(self.fov_y) / T::of(2.0)).tan();
        let width = slope.clone() * T::of(self.aspect);
        let row = |axis: &V3<T>, slope: &T| times(&through(axis, &eye), &(T::of(1.0) / slope.clone()));
        let across = [row(&right, &width), row(&up, &slope)];
        let depth = through(&forward, &eye);
        Frame { eye, up, forward, across, depth }
    }
}

/// A light.
#[derive(Clone, Copy, Debug)]
pub enum Lamp {
    /// Towards the light, of any length.
    Sun(DVec3),
    At(DVec3),
}

impl Lamp {
    /// The distance from a lamp within which nothing casts.
    pub const NEAR: f64 = 0.125;

    pub fn light(&self) -> Light {
        match *self {
            Self::Sun(direction) => Light::directional(direction),
            Self::At(position) => Light::point(position, Self::NEAR, f64::INFINITY),
        }
        .expect("a legal light")
    }

    /// As a homogeneous point.
    pub fn homogeneous<T: Real>(&self) -> V4<T> {
        let (Self::Sun(v) | Self::At(v)) = *self;
        let [x, y, z] = vector(v);
        [x, y, z, T::of(f64::from(u8::from(matches!(self, Self::At(_)))))]
    }
}

#[derive(Clone, Copy, Debug)]
pub struct Setup {
    pub camera: Camera,
    pub lamp: Lamp,
    /// The scene's box.
    pub min: DVec3,
    pub max: DVec3,
    pub origin: Origin,
}

impl Setup {
    /// A person's camera, along an axis of the world so that λw is what the light's third number says, exactly; the box
    /// holds all that it sees.
    pub fn outdoors(lamp: Lamp) -> Self {
        let camera = Camera {
            eye: DVec3::ZERO,
            forward: DVec3::NEG_Z,
            up: DVec3::Y,
            fov_y: 1.0,
            aspect: 1.5,
            near: 1.0,
            far: 100.0,
        };
        Self { camera, lamp, min: DVec3::splat(-256.0), max: DVec3::splat(256.0), origin: Origin::World }
    }

    /// The perspective warp of the camera in its own place, without a back-shift: what the textbook has too.
    pub fn settings(&self) -> Settings {
        Settings::default().with_warp(Warp::Perspective).with_shift(Shift::None).with_origin(self.origin)
    }

    pub fn scene(&self) -> Scene<'static> {
        Scene::from_box(self.min, self.max).expect("a legal scene")
    }

    pub fn map(&self) -> ShadowMap {
        Focus::new(&self.camera.view(), &self.lamp.light(), &self.scene())
            .fit(&self.settings())
            .into_map()
            .expect("one map does")
    }

    /// The vertices of R.
    pub fn visible(&self) -> Vec<DVec3> {
        Focus::new(&self.camera.view(), &self.lamp.light(), &self.scene()).receiver_volume().vertices().to_vec()
    }

    /// Test points: the vertices of R, the middle of it, and points between.
    pub fn receivers(&self) -> Vec<DVec3> {
        let vertices = self.visible();
        let middle = vertices.iter().sum::<DVec3>() / vertices.len() as f64;
        let between = vertices.iter().map(|vertex| vertex.lerp(middle, 0.375));
        vertices.iter().copied().chain(between).chain([middle]).collect()
    }

    /// Something on the ray from the light to a receiver: so much of the scene's size, or of the way to a lamp if that is
    /// less, towards the light.
    pub fn caster(&self, receiver: DVec3, part: f64) -> DVec3 {
        let size = part * (self.max - self.min).max_element();
        match self.lamp {
            Lamp::Sun(direction) => receiver + direction.normalize() * size,
            Lamp::At(position) => {
                let arm = position - receiver;
                receiver + arm * part.min(size / arm.length())
            }
        }
    }

    /// λw, to f64's rounding.
    pub fn lambda_w(&self) -> f64 {
        dot(&self.camera.frame::<f64>().depth, &self.lamp.homogeneous())
    }
}
