//! Set-ups in fixed numbers: every kind of view, light and scene, and lights exactly where one case meets another.
//!
//! All numbers are halves of halves, so that the set-ups themselves are the same everywhere. The angles are not; what is
//! made of them is what the table is to show.

use shadowfit::glam::{DMat4, DVec3, DVec4, Vec3};
use shadowfit::{
    Aabb, ClipSpace, Effort, FocusForm, Light, Origin, Scene, Settings, View, Warp,
    focus::Plane,
    input::{ConvexScene, DepthRange, TextureOrigin, YAxis},
    omni::CubeFace,
    warp::Shift,
};

/// A view, a light, a scene and settings, named.
pub struct SetUp {
    pub name: String,
    pub view: View,
    pub light: Light,
    pub scene: SceneKind,
    pub settings: Settings,
}

/// Where a set-up stands, and how large it is.
#[derive(Clone, Copy)]
struct Place {
    name: &'static str,
    scale: f64,
    offset: DVec3,
}

const PLACES: [Place; 5] = [
    Place { name: "here", scale: 1.0, offset: DVec3::ZERO },
    Place { name: "tiny", scale: 1.0 / 4_194_304.0, offset: DVec3::ZERO },
    Place { name: "huge", scale: 65_536.0, offset: DVec3::ZERO },
    Place { name: "far out", scale: 1.0, offset: DVec3::new(1_048_576.0, -65_536.0, 4_194_304.0) },
    Place { name: "tiny and far out", scale: 0.015_625, offset: DVec3::new(-16_777_216.0, 1_024.0, 134_217_728.0) },
];

impl Place {
    fn at(&self, x: f64, y: f64, z: f64) -> DVec3 {
        DVec3::new(x, y, z) * self.scale + self.offset
    }
}

const VIEWS: [&str; 8] = ["lawn", "endless", "parallel", "matrices", "wide", "telescope", "lattice", "hanging"];

fn view(name: &str, place: &Place) -> View {
    let s = place.scale;
    let view = match name {
        // A person on a lawn, looking ahead.
        "lawn" => {
            let eye = place.at(0.0, 1.75, 8.0);
            View::perspective(eye, (0.0, -0.125, -1.0), DVec3::Y, 1.0, 1.5, 0.5 * s, 128.0 * s)
        }
        "endless" => {
            let eye = place.at(-6.0, 4.0, 5.0);
            View::perspective(eye, (1.0, -0.25, -0.5), DVec3::Y, 1.25, 1.75, 0.25 * s, f64::INFINITY)
        }
        "parallel" => {
            let eye = place.at(3.0, 2.0, 4.0);
            View::orthographic(eye, (-0.25, -0.5, -1.0), DVec3::Y, 6.0 * s, 1.25, -4.0 * s, 48.0 * s)
        }
        "matrices" => {
            // Looking along x, off axis, in OpenGL's depths.
            let eye = place.at(-12.0, 2.0, 0.0);
            let rows = [DVec3::Z, DVec3::Y, DVec3::NEG_X].map(|axis| axis.extend(-axis.dot(eye)));
            let eye_from_world = DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose();
            let clip_from_eye = DMat4::from_cols(
                DVec4::new(1.25, 0.0, 0.125, 0.0),
                DVec4::new(0.0, 1.5, -0.0625, 0.0),
                DVec4::new(0.0, 0.0, -1.015_625, -1.007_812_5 * s),
                DVec4::new(0.0, 0.0, -1.0, 0.0),
            );
            View::from_matrices(eye_from_world, clip_from_eye.transpose(), ClipSpace::OPENGL)
        }
        "wide" => {
            let eye = place.at(1.0, 5.0, 1.0);
            View::perspective(eye, (0.25, -1.0, -0.75), DVec3::Y, 3.0, 1.0, 0.015_625 * s, 1024.0 * s)
        }
        "telescope" => {
            let eye = place.at(24.0, 64.0, 512.0);
            View::perspective(eye, (-0.046_875, -0.125, -1.0), DVec3::Y, 0.007_812_5, 1.0, 64.0 * s, 4096.0 * s)
        }
        // A right angle along an axis: planes and corners of the view and of the scene coincide.
        "lattice" => {
            let eye = place.at(0.0, 2.0, 8.0);
            View::perspective(eye, DVec3::NEG_Z, DVec3::Y, core::f64::consts::FRAC_PI_2, 1.0, s, 16.0 * s)
        }
        // Straight down.
        "hanging" => {
            let eye = place.at(2.0, 16.0, -4.0);
            View::perspective(eye, DVec3::NEG_Y, DVec3::NEG_Z, 0.75, 1.25, 2.0 * s, 32.0 * s)
        }
        _ => unreachable!("a view of the list"),
    };
    view.expect(name)
}

const LIGHTS: [&str; 20] = [
    "sun above",
    "sun aslant",
    "sun behind the viewer",
    "sun along the view",
    "sun against the view",
    "sun in the camera plane",
    "lamp ahead",
    "lamp behind the viewer",
    "lamp at the eye",
    "lamp in the camera plane",
    "lamp on the floor",
    "lamp on an edge of the scene",
    "lamp among all",
    "lamp close by",
    "spot",
    "narrow spot",
    "widest spot",
    "wall lamp",
    "face of a lamp",
    "face of a wall lamp",
];

fn light(name: &str, view: &View, place: &Place) -> Light {
    let s = place.scale;
    let (near, endless) = (0.25 * s, f64::INFINITY);
    let (eye, forward, right, up) = (view.eye(), view.forward(), view.right(), view.up());
    let lamp = place.at(4.0, 12.0, -6.0);
    let light = match name {
        "sun above" => Light::directional(DVec3::Y),
        "sun aslant" => Light::directional((1.0, 2.0, 0.5)),
        "sun behind the viewer" => Light::directional(up * 0.5 + right * 0.25 - forward),
        "sun along the view" => Light::directional(-forward),
        "sun against the view" => Light::directional(forward),
        "sun in the camera plane" => Light::directional(up * 2.0 + right),
        "lamp ahead" => Light::point(lamp, near, endless),
        "lamp behind the viewer" => Light::point(eye - forward * (8.0 * s) + up * (3.0 * s), near, endless),
        "lamp at the eye" => Light::point(eye, near, endless),
        "lamp in the camera plane" => Light::point(eye + right * (4.0 * s) + up * (2.0 * s), near, 64.0 * s),
        "lamp on the floor" => Light::point(place.at(2.0, 0.0, -4.0), near, endless),
        "lamp on an edge of the scene" => Light::point(place.at(-16.0, 8.0, -4.0), near, endless),
        "lamp among all" => Light::point(place.at(1.0, 2.0, -3.0), near, 24.0 * s),
        "lamp close by" => Light::point(place.at(0.5, 1.5, 7.0), 0.015_625 * s, 16.0 * s),
        "spot" => Light::spot(lamp, (-0.5, -1.0, 0.25), 0.5, near, 48.0 * s),
        "narrow spot" => Light::spot(lamp, (-0.25, -1.0, 0.5), 0.003_906_25, near, endless),
        "widest spot" => Light::spot(lamp, (0.0, -1.0, 0.0), 1.570_312_5, near, endless),
        "wall lamp" => Light::hemisphere(place.at(0.0, 6.0, -20.0), DVec3::Z, near, 40.0 * s),
        "face of a lamp" => {
            Light::point(lamp, near, endless).and_then(|lamp| lamp.cube_face(CubeFace::NegativeY, 0.0625))
        }
        "face of a wall lamp" => Light::hemisphere(lamp, (0.5, -1.0, 0.25), near, 40.0 * s)
            .and_then(|lamp| lamp.cube_face(CubeFace::NegativeY, 0.0)),
        _ => unreachable!("a light of the list"),
    };
    light.expect(name)
}

/// A scene that owns what [`Scene`] borrows.
pub enum SceneKind {
    Box([DVec3; 2]),
    Convex(Box<ConvexScene>),
    Lists { casters: Vec<Aabb>, receivers: Vec<Aabb> },
}

impl SceneKind {
    pub fn scene(&self) -> Scene<'_> {
        match self {
            Self::Box([min, max]) => Scene::from_box(*min, *max).expect("a box"),
            Self::Convex(body) => Scene::from_convex(body),
            Self::Lists { casters, receivers } => Scene::new(casters, receivers).expect("lists"),
        }
    }
}

const SCENES: [&str; 4] = ["box", "plate", "house", "lists"];

fn scene(name: &str, place: &Place) -> SceneKind {
    let (min, max) = (place.at(-16.0, 0.0, -32.0), place.at(16.0, 8.0, 16.0));
    match name {
        "box" => SceneKind::Box([min, max]),
        "plate" => SceneKind::Box([min, DVec3::new(max.x, min.y, max.z)]),
        "house" => {
            let ridge = place.at(0.0, 8.0, 0.0);
            let roof = [1.0, -1.0].map(|side| Plane::through(DVec3::new(0.25 * side, -1.0, 0.0), ridge));
            let corner = Plane::through(DVec3::new(-1.0, -0.5, -0.75), place.at(12.0, 4.0, 12.0));
            let body = ConvexScene::new(min, max, &[roof[0], roof[1], corner]).expect("a house");
            SceneKind::Convex(Box::new(body))
        }
        "lists" => {
            let one = |low: DVec3, high: DVec3| Aabb::new(low.as_vec3(), high.as_vec3());
            let boxes = (0..9).map(|at| {
                let (x, z) = (f64::from(at % 3) * 8.0 - 10.0, f64::from(at / 3) * -9.0 + 4.0);
                let height = 0.5 + f64::from(at * 5 % 7);
                one(place.at(x, 0.0, z), place.at(x + 2.5, height, z + 1.25))
            });
            let ground = one(place.at(-16.0, -0.125, -32.0), place.at(16.0, 0.0, 16.0));
            let casters: Vec<_> = boxes.collect();
            SceneKind::Lists { receivers: casters.iter().copied().chain([ground]).collect(), casters }
        }
        _ => unreachable!("a scene of the list"),
    }
}

/// Every value of every setting, none in step with another.
fn settings(number: usize) -> Settings {
    let clips = [
        ClipSpace::WGPU,
        ClipSpace::OPENGL.reversed(),
        ClipSpace::VULKAN,
        ClipSpace::OPENGL,
        ClipSpace::WGPU.reversed(),
        ClipSpace::VULKAN.reversed(),
        ClipSpace {
            depth: DepthRange::NegativeOneToOne,
            y: YAxis::Down,
            texture_origin: TextureOrigin::BottomLeft,
        },
    ];
    let sizes = [(2048, 1080), (1000, 720), (512, 2160)];
    let (size, height) = sizes[number / 2 % sizes.len()];
    let shifts = [Shift::Back(FocusForm::ViewHull), Shift::Back(FocusForm::ReceiverHull), Shift::None];
    let settings = Settings::new(size, height).and_then(|settings| settings.with_border([1, 0, 4][number / 3 % 3]));
    settings
        .expect("settings")
        .with_warp(WARPS[number % WARPS.len()])
        .with_shift(shifts[number / 5 % shifts.len()])
        .with_clip(clips[number % clips.len()])
        .with_origin(if number % 5 > 2 { Origin::Eye } else { Origin::World })
}

const WARPS: [Warp; 7] = [
    Warp::Perspective,
    Warp::Best(Effort::Good),
    Warp::Uniform,
    Warp::LightSpace,
    Warp::Stable,
    Warp::Trapezoidal,
    Warp::Best(Effort::Thorough),
];

/// All set-ups: every light in every view, and two views of them in every other place.
pub fn setups() -> Vec<SetUp> {
    let mut all = Vec::new();
    for (at, place) in PLACES.iter().enumerate() {
        let views = if at == 0 { &VIEWS[..] } else { &[VIEWS[0], VIEWS[1 + at]] };
        for view_name in views {
            for light_name in LIGHTS {
                let number = all.len();
                let scene_name = SCENES[(number + number / LIGHTS.len()) % SCENES.len()];
                let view = view(view_name, place);
                all.push(SetUp {
                    name: format!("{number:03} {}, {view_name}, {light_name}, {scene_name}", place.name),
                    view,
                    light: light(light_name, &view, place),
                    scene: scene(scene_name, place),
                    settings: settings(number),
                });
            }
        }
    }
    all
}

/// Boxes and balls about a scene, to be tried against its body.
pub fn casters(view: &View) -> (Vec<Aabb>, Vec<[f32; 4]>) {
    let eye = view.eye().as_vec3();
    let step = view.near().abs().max(1.0 / 1024.0) as f32;
    (0..64_u8)
        .map(|at| {
            let [x, y, z] = [at % 4, at / 4 % 4, at / 16].map(|part| (f32::from(part) - 1.5) * 4.0 * step);
            let low = eye + Vec3::new(x, y, z);
            let ball = low.extend(step * (1.0 + f32::from(at % 5)));
            (Aabb::new(low, low + Vec3::splat(step * (0.5 + f32::from(at % 3)))), ball.to_array())
        })
        .unzip()
}
