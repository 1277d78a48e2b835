//! One camera in every convention is one view; one map in every convention is one map.

use approx::assert_relative_eq;
use shadowfit::glam::{DMat4, DVec3, DVec4, Mat4, Vec3, dcamera};
use shadowfit::{
    ClipSpace, Focus, FocusForm, Light, Origin, Scene, Settings, ShadowMap, View, Warp, fit,
    input::{DepthRange, Lens, TextureOrigin, YAxis},
    warp::{ClassKind, classify},
};

const DEPTHS: [DepthRange; 4] = [
    DepthRange::ZeroToOne,
    DepthRange::ZeroToOneReversed,
    DepthRange::NegativeOneToOne,
    DepthRange::NegativeOneToOneReversed,
];

fn clip_spaces() -> impl Iterator<Item = ClipSpace> {
    DEPTHS.into_iter().flat_map(|depth| {
        [YAxis::Up, YAxis::Down].into_iter().flat_map(move |y| {
            [TextureOrigin::TopLeft, TextureOrigin::BottomLeft].into_iter().map(move |texture_origin| ClipSpace {
                depth,
                y,
                texture_origin,
            })
        })
    })
}

/// A camera by its numbers, to make matrices of by hand.
#[derive(Clone, Copy, Debug)]
struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    lens: Lens,
    /// Left, right, bottom, top.
    frame: [f64; 4],
    near: f64,
    far: f64,
}

impl Camera {
    /// Off axis, looking down a little.
    fn new(lens: Lens, far: f64) -> Self {
        let forward = DVec3::new(0.2, -0.3, -1.0).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let frame = match lens {
            Lens::Perspective => [-0.7, 0.5, -0.3, 0.6],
            Lens::Orthographic => [-7.0, 5.0, -3.0, 6.0],
        };
        let eye = DVec3::new(3.0, 6.0, 15.0);
        Self { eye, right, up: right.cross(forward), forward, lens, frame, near: 0.25, far }
    }

    /// World to eye, scaled. The eye looks along this end of its z axis.
    fn eye_from_world(&self, looks_along: f64, scale: f64) -> DMat4 {
        let rows = [self.right, self.up, self.forward * looks_along]
            .map(|axis| (axis * scale).extend(-axis.dot(self.eye) * scale));
        DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose()
    }

    /// Eye to clip, for an eye space of this scale.
    fn clip_from_eye(&self, looks_along: f64, scale: f64, clip: ClipSpace) -> DMat4 {
        let unit = match self.lens {
            Lens::Perspective => DVec4::new(0.0, 0.0, looks_along, 0.0),
            Lens::Orthographic => DVec4::W,
        };
        let size = if self.lens == Lens::Perspective { 1.0 } else { scale };
        let [left, right, bottom, top] = self.frame.map(|edge| edge * size);
        let across = |axis: DVec4, low: f64, high: f64| (axis * 2.0 - unit * (low + high)) / (high - low);
        let x = across(DVec4::X, left, right);
        let y = across(DVec4::Y, bottom, top);
        // Depth from 0 to 1, divided through by far so that it may be infinite.
        let (near, ratio) = (self.near * scale, self.near / self.far);
        let depth = DVec4::new(0.0, 0.0, looks_along, 0.0);
        let z = match self.lens {
            Lens::Perspective => (depth - DVec4::W * near) / (1.0 - ratio),
            Lens::Orthographic => (depth - DVec4::W * near) / ((self.far - self.near) * scale),
        };
        let y = if clip.y == YAxis::Up { y } else { -y };
        let z = match clip.depth {
            DepthRange::ZeroToOne => z,
            DepthRange::ZeroToOneReversed => unit - z,
            DepthRange::NegativeOneToOne => z * 2.0 - unit,
            DepthRange::NegativeOneToOneReversed => unit - z * 2.0,
        };
        DMat4::from_cols(x, y, z, unit).transpose()
    }

    fn view(&self, looks_along: f64, scale: f64, clip: ClipSpace) -> View {
        let eye_from_world = self.eye_from_world(looks_along, scale);
        let clip_from_eye = self.clip_from_eye(looks_along, scale, clip);
        View::from_matrices(eye_from_world, clip_from_eye, clip).unwrap()
    }

    /// What a matrix keeps of the far distance is 1 − n/f, or n/f at best.
    fn rounding(&self) -> f64 {
        let ratio = if self.far.is_finite() { self.far / self.near } else { 1.0 };
        16.0 * f64::EPSILON * ratio
    }

    #[track_caller]
    fn assert_is(&self, view: &View) {
        let close = |a: f64, b: f64| (a - b).abs() <= self.rounding() * b.abs().max(1.0);
        assert_eq!(view.lens(), self.lens);
        let axes = [(view.right(), self.right), (view.up(), self.up), (view.forward(), self.forward)];
        for (ours, theirs) in axes.into_iter().chain([(view.eye(), self.eye)]) {
            assert!((ours - theirs).length() <= 64.0 * f64::EPSILON * theirs.length(), "{ours} is not {theirs}");
        }
        assert!(close(view.near(), self.near), "near {}", view.near());
        if self.far.is_finite() {
            assert!((view.far() - self.far).abs() <= self.rounding() * self.far, "far {}", view.far());
        } else {
            assert_eq!(view.far(), self.far);
        }
        // The frame, by the planes of V, which pass through its edges.
        let planes = view.planes();
        let edges = [(self.right, 1.0), (self.right, -1.0), (self.up, 1.0), (self.up, -1.0)];
        for ((plane, (axis, sign)), edge) in planes.iter().zip(edges).zip(self.frame) {
            for depth in [1.0, 20.0] {
                let unit = if self.lens == Lens::Perspective { depth } else { 1.0 };
                let point = self.eye + self.forward * depth + axis * (edge * unit);
                let inside = point + axis * sign;
                let off = plane.at(point).abs();
                assert!(off <= 256.0 * f64::EPSILON * depth.max(10.0) && plane.at(inside) > 0.5, "{off:e}");
            }
        }
    }
}

#[test]
fn one_camera_in_every_convention() {
    for lens in [Lens::Perspective, Lens::Orthographic] {
        for far in [5.0, 100.0, 1e4, f64::INFINITY] {
            if lens == Lens::Orthographic && far == f64::INFINITY {
                continue;
            }
            let camera = Camera::new(lens, far);
            for clip in clip_spaces() {
                // Right-handed eye spaces look along −z, left-handed ones along +z. Some engines scale.
                for looks_along in [-1.0, 1.0] {
                    for scale in [1.0, 2.5, 1e-3] {
                        camera.assert_is(&camera.view(looks_along, scale, clip));
                    }
                }
            }
        }
    }
}

/// The most that a body reaches in each of 26 directions: what it is, whatever its vertices are called.
fn reaches(focus: &Focus<'_>, form: Option<FocusForm>) -> Vec<f64> {
    let body = form.map_or_else(|| focus.receiver_volume(), |form| focus.caster_volume(form));
    let sides = [-1.0, 0.0, 1.0];
    sides
        .into_iter()
        .flat_map(|x| sides.into_iter().flat_map(move |y| sides.map(|z| DVec3::new(x, y, z))))
        .map(|direction| {
            body.vertices().iter().map(|point| direction.dot(*point)).fold(f64::NEG_INFINITY, f64::max)
        })
        .collect()
}

/// Hard case 26: equivalent cameras have one H. Mirrored ones see the same too, the other way round.
#[test]
fn one_focus_body_in_every_convention() {
    let scene = Scene::from_box(DVec3::new(-20.0, -1.0, -40.0), DVec3::new(20.0, 9.0, 12.0)).unwrap();
    let lights = [
        Light::directional(DVec3::new(0.3, 1.0, 0.4)).unwrap(),
        Light::directional(DVec3::new(0.1, 0.4, -1.0)).unwrap(),
        Light::spot(DVec3::new(2.0, 8.0, -9.0), DVec3::new(0.2, -1.0, 0.3), 0.8, 0.1, 60.0).unwrap(),
    ];
    for camera in [
        Camera::new(Lens::Perspective, 100.0),
        Camera::new(Lens::Perspective, f64::INFINITY),
        Camera::new(Lens::Orthographic, 100.0),
    ] {
        let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let flip = DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0));
        let mut views = Vec::new();
        for clip in clip_spaces() {
            for looks_along in [-1.0, 1.0] {
                views.push(camera.view(looks_along, 1.0, clip));
                // Mirrored twice, in the view (det < 0) and in the projection; and turned over in clip space.
                let eye_from_world = camera.eye_from_world(looks_along, 1.0);
                let clip_from_eye = camera.clip_from_eye(looks_along, 1.0, clip);
                for (before, after) in [(mirror, DMat4::IDENTITY), (DMat4::IDENTITY, mirror * flip), (flip, mirror)]
                {
                    let view = View::from_matrices(before * eye_from_world, after * clip_from_eye * before, clip);
                    views.push(view.unwrap());
                }
            }
        }
        for light in &lights {
            let first = Focus::new(&views[0], light, &scene);
            assert!(
                !first.receiver_volume().is_empty() && !first.caster_volume(FocusForm::ReceiverHull).is_empty()
            );
            for view in &views[1..] {
                let focus = Focus::new(view, light, &scene);
                for form in [None, Some(FocusForm::ReceiverHull), Some(FocusForm::ViewHull)] {
                    for (ours, theirs) in reaches(&focus, form).into_iter().zip(reaches(&first, form)) {
                        // A vertex between two planes at an angle of 0.1 moves ten times as far as they do.
                        let tolerance = 10.0 * camera.rounding() * 100.0;
                        assert!((ours - theirs).abs() <= tolerance, "{form:?} {view:?}: {ours} {theirs}");
                    }
                }
                let map = |view: &View| {
                    let outcome = fit(view, light, &scene, &Settings::default().with_warp(Warp::Perspective));
                    outcome.into_map().expect("a map")
                };
                assert_relative_eq!(map(view).warp_ratio(), map(&views[0]).warp_ratio(), max_relative = 1e-9);
            }
        }
    }
}

/// A mirror image has a left-handed image plane.
#[test]
fn a_mirrored_view_is_mirrored() {
    let camera = Camera::new(Lens::Perspective, 100.0);
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    let eye_from_world = mirror * camera.eye_from_world(-1.0, 1.0);
    assert!(eye_from_world.determinant() < 0.0);
    let clip_from_eye = camera.clip_from_eye(-1.0, 1.0, ClipSpace::WGPU);
    let view = View::from_matrices(eye_from_world, clip_from_eye, ClipSpace::WGPU).unwrap();
    let [left, right, bottom, top] = camera.frame;
    assert!(view.right().cross(view.up()).dot(view.forward()) > 0.0, "left-handed");
    // The frame is the same in the mirrored eye space.
    Camera { right: -camera.right, frame: [left, right, bottom, top], ..camera }.assert_is(&view);
}

/// glam's own cameras, those that 0.33.12 and 0.34 agree on.
#[test]
fn cameras_of_glam() {
    use dcamera::{lh, rh};
    let (eye, forward, up) = (DVec3::new(3.0, 6.0, 15.0), DVec3::new(0.2, -0.3, -1.0).normalize(), DVec3::Y);
    let (fov, aspect, near, far) = (1.1, 1.6, 0.25, 400.0);
    let right_handed = rh::view::look_to_mat4(eye, forward, up);
    let left_handed = lh::view::look_to_mat4(eye, forward, up);
    let expected = View::perspective(eye, forward, up, fov, aspect, near, far).unwrap();
    let endless = View::perspective(eye, forward, up, fov, aspect, near, f64::INFINITY).unwrap();
    let (wgpu, vulkan, opengl) = (ClipSpace::WGPU, ClipSpace::VULKAN, ClipSpace::OPENGL);
    let cases = [
        (right_handed, rh::proj::directx::perspective(fov, aspect, near, far), wgpu, expected),
        (left_handed, lh::proj::directx::perspective(fov, aspect, near, far), wgpu, expected),
        (right_handed, rh::proj::vulkan::perspective(fov, aspect, near, far), vulkan, expected),
        (left_handed, lh::proj::vulkan::perspective(fov, aspect, near, far), vulkan, expected),
        (right_handed, rh::proj::opengl::perspective(fov, aspect, near, far), opengl, expected),
        (left_handed, lh::proj::opengl::perspective(fov, aspect, near, far), opengl, expected),
        (right_handed, rh::proj::directx::perspective_infinite(fov, aspect, near), wgpu, endless),
        (
            right_handed,
            rh::proj::directx::perspective_infinite_reverse(fov, aspect, near),
            wgpu.reversed(),
            endless,
        ),
        (
            left_handed,
            lh::proj::vulkan::perspective_infinite_reverse(fov, aspect, near),
            vulkan.reversed(),
            endless,
        ),
    ];
    for (eye_from_world, clip_from_eye, clip, expected) in cases {
        let view = View::from_matrices(eye_from_world, clip_from_eye, clip).unwrap();
        // In a left-handed world right is on the other side of the same forward and up.
        let side = if eye_from_world == left_handed { -1.0 } else { 1.0 };
        assert!((view.eye() - expected.eye()).length() < 64.0 * f64::EPSILON * eye.length());
        assert!((view.right() * side - expected.right()).length() < 8.0 * f64::EPSILON);
        assert!((view.up() - expected.up()).length() < 8.0 * f64::EPSILON);
        assert_relative_eq!(view.near(), expected.near(), max_relative = 16.0 * f64::EPSILON);
        // What a matrix keeps of the far distance is 1 − n/f.
        assert_relative_eq!(view.far(), expected.far(), max_relative = 16.0 * f64::EPSILON * far / near);
        // The sides of V, left and right by where they are.
        let order = if side > 0.0 { [0, 1, 2, 3] } else { [1, 0, 2, 3] };
        for (&ours, theirs) in view.planes().iter().zip(order.map(|plane| expected.planes()[plane])) {
            assert!((ours.normal - theirs.normal).length() < 16.0 * f64::EPSILON);
        }
    }
}

/// Hard case 26: without perspective every light keeps its kind.
#[test]
fn orthographic_views_change_no_light() {
    let view = Camera::new(Lens::Orthographic, 100.0).view(-1.0, 1.0, ClipSpace::WGPU);
    for direction in [DVec3::X, DVec3::Y, DVec3::NEG_Z, view.forward(), -view.forward()] {
        let sun = Light::directional(direction).unwrap();
        assert_eq!(classify(&view, &sun).kind, ClassKind::Directional);
        assert_eq!(classify(&view, &sun).position.w, 0.0);
        let lamp = Light::point(view.eye() + direction * 40.0, 0.1, f64::INFINITY).unwrap();
        assert_eq!(classify(&view, &lamp).kind, ClassKind::Point);
    }
}

/// What a map is fitted for.
struct Setup {
    view: View,
    light: Light,
    scene: Scene<'static>,
}

impl Setup {
    /// Lights from above, from before the viewer and in a lamp, around a point of the world.
    fn around(middle: DVec3) -> [Self; 3] {
        let camera = Camera::new(Lens::Perspective, 100.0);
        let view = Camera { eye: camera.eye + middle, ..camera }.view(-1.0, 1.0, ClipSpace::WGPU);
        let (min, max) = (DVec3::new(-20.0, -1.0, -40.0), DVec3::new(20.0, 9.0, 12.0));
        let lamp = middle + DVec3::new(2.0, 28.0, -9.0);
        [
            Light::directional(DVec3::new(0.3, 1.0, 0.4)),
            Light::directional(DVec3::new(0.1, 0.6, -1.0)),
            Light::spot(lamp, DVec3::new(0.2, -1.0, 0.3), 0.8, 0.1, 60.0),
        ]
        .map(|light| Self {
            view,
            light: light.unwrap(),
            scene: Scene::from_box(min + middle, max + middle).unwrap(),
        })
    }

    fn map(&self, settings: &Settings) -> ShadowMap {
        fit(&self.view, &self.light, &self.scene, settings).into_map().expect("a map")
    }

    fn visible(&self) -> Vec<DVec3> {
        Focus::new(&self.view, &self.light, &self.scene).receiver_volume().vertices().to_vec()
    }
}

fn project(matrix: &DMat4, point: DVec3) -> DVec3 {
    let clip = *matrix * point.extend(1.0);
    clip.truncate() / clip.w
}

fn settings(warp: Warp) -> Settings {
    Settings::default().with_warp(warp)
}

/// Roundings of a handful of operations on coordinates of at most a hundred, in a clip space of two.
const EXACT: f64 = 1e-12;

#[test]
fn matrices_of_every_convention() {
    for setup in Setup::around(DVec3::ZERO) {
        for warp in [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal] {
            let map = setup.map(&settings(warp));
            let wgpu = map.clip_from_world_in(ClipSpace::WGPU);
            for clip in clip_spaces() {
                let matrix = map.clip_from_world_in(clip);
                assert_eq!(setup.map(&settings(warp).with_clip(clip)).clip_from_world(), matrix);
                assert_eq!(setup.map(&settings(warp).with_clip(clip)).caster_matrix(), matrix.as_mat4());
                for point in setup.visible() {
                    let (base, ours) = (project(&wgpu, point), project(&matrix, point));
                    let y = if clip.y == YAxis::Up { base.y } else { -base.y };
                    let z = match clip.depth {
                        DepthRange::ZeroToOne => base.z,
                        DepthRange::ZeroToOneReversed => 1.0 - base.z,
                        DepthRange::NegativeOneToOne => 2.0 * base.z - 1.0,
                        DepthRange::NegativeOneToOneReversed => 1.0 - 2.0 * base.z,
                    };
                    assert!(
                        (ours - DVec3::new(base.x, y, z)).abs().max_element() < EXACT,
                        "{clip:?}: {ours} {base}"
                    );
                    assert!((0.0..=1.0).contains(&base.z), "{base}");
                }
            }
            // Those with a name, entry by entry.
            let [vulkan, opengl, reversed] = [ClipSpace::VULKAN, ClipSpace::OPENGL, ClipSpace::WGPU.reversed()]
                .map(|clip| map.clip_from_world_in(clip));
            let of_rows = |rows: [DVec4; 4]| DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
            let [x, y, z, w] = [0, 1, 2, 3].map(|row| wgpu.row(row));
            assert_eq!(vulkan, of_rows([x, -y, z, w]));
            assert_eq!(opengl, of_rows([x, y, z * 2.0 - w, w]));
            assert_eq!(reversed, of_rows([x, y, w - z, w]));
        }
    }
}

/// What is visible reaches as far to the left as to the right, up to the border and the stated padding.
#[test]
fn the_middle_of_what_is_visible_is_the_middle_of_the_map() {
    for setup in Setup::around(DVec3::ZERO) {
        for warp in [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal] {
            let map = setup.map(&settings(warp).with_border(5).unwrap());
            let inner = 1.0 - 2.0 * 5.0 / f64::from(map.settings().map_size());
            let matrix = map.clip_from_world();
            let seen: Vec<DVec3> = setup.visible().iter().map(|point| project(&matrix, *point)).collect();
            let min = seen.iter().fold(DVec3::INFINITY, |min, point| min.min(*point));
            let max = seen.iter().fold(DVec3::NEG_INFINITY, |max, point| max.max(*point));
            let (x, y) = map.window().padding;
            for (low, high, padding) in [(min.x, max.x, x), (min.y, max.y, y)] {
                assert!((low + high).abs() < EXACT, "{low} {high}");
                assert_relative_eq!(high, inner * (1.0 - padding), max_relative = EXACT);
            }
        }
    }
}

/// The near and far distances of the report are where depth begins and ends.
#[test]
fn near_and_far_planes_have_the_depths_of_their_convention() {
    for setup in Setup::around(DVec3::ZERO) {
        for clip in clip_spaces() {
            let map = setup.map(&settings(Warp::Uniform).with_clip(clip));
            let matrix = map.clip_from_world();
            // A uniform map's w is the distance along its axis from a light at a position.
            let (axis, origin) = match setup.light.position() {
                Some(position) => (matrix.row(3).truncate().normalize(), position),
                None => (-setup.light.homogeneous().truncate(), setup.view.eye()),
            };
            let (near, far) = match clip.depth {
                DepthRange::ZeroToOne => (0.0, 1.0),
                DepthRange::ZeroToOneReversed => (1.0, 0.0),
                DepthRange::NegativeOneToOne => (-1.0, 1.0),
                DepthRange::NegativeOneToOneReversed => (1.0, -1.0),
            };
            assert!(map.depth().near < map.depth().far, "{:?}", map.depth());
            for point in setup.visible() {
                let at = |distance: f64| point + axis * (distance - axis.dot(point - origin));
                let (first, last) = (project(&matrix, at(map.depth().near)), project(&matrix, at(map.depth().far)));
                // The distance to a lamp is one of a few units next to coordinates of tens.
                assert!((first.z - near).abs() < 100.0 * EXACT && (last.z - far).abs() < 100.0 * EXACT);
            }
        }
    }
}

/// The texture coordinate at which a renderer finds the texel that a point was drawn to, by the API's own rules: a
/// viewport transform, rows counted from the first one in memory, and a texture coordinate that is 0 there.
#[test]
fn texture_matrices_find_the_texel_that_was_drawn() {
    for setup in Setup::around(DVec3::ZERO) {
        for clip in clip_spaces() {
            let map = setup.map(&settings(Warp::Perspective).with_clip(clip));
            let (clip_from_world, texture_from_world) = (map.clip_from_world(), map.texture_from_world());
            assert_eq!(map.receiver_matrix(), texture_from_world.as_mat4());
            for point in setup.visible() {
                let drawn = project(&clip_from_world, point);
                // wgpu, Direct3D and Metal: the viewport turns y over. Vulkan and OpenGL: it does not.
                let turned = clip.y == YAxis::Up && clip.texture_origin == TextureOrigin::TopLeft;
                let row = if turned { 0.5 - 0.5 * drawn.y } else { 0.5 + 0.5 * drawn.y };
                // OpenGL's depth range maps −1 … 1 to 0 … 1; the others store z as it is.
                let stored = match clip.depth {
                    DepthRange::ZeroToOne | DepthRange::ZeroToOneReversed => drawn.z,
                    DepthRange::NegativeOneToOne | DepthRange::NegativeOneToOneReversed => 0.5 + 0.5 * drawn.z,
                };
                let expected = DVec3::new(0.5 + 0.5 * drawn.x, row, stored);
                let found = project(&texture_from_world, point);
                assert!((found - expected).abs().max_element() < EXACT, "{clip:?}: {found} {expected}");
                assert!(found.cmpge(DVec3::ZERO).all() && found.cmple(DVec3::ONE).all(), "{found}");
            }
        }
    }
}

#[test]
fn matrices_about_the_eye_take_positions_relative_to_it() {
    for setup in Setup::around(DVec3::ZERO) {
        let about_eye = settings(Warp::Perspective).with_origin(Origin::Eye);
        let map = setup.map(&about_eye);
        let translation = DMat4::from_translation(setup.view.eye());
        assert_eq!(map.caster_matrix(), (map.clip_from_world() * translation).as_mat4());
        assert_eq!(map.receiver_matrix(), (map.texture_from_world() * translation).as_mat4());
        for point in setup.visible() {
            let world = project(&map.clip_from_world(), point);
            let relative = project(&(map.clip_from_world() * translation), point - setup.view.eye());
            assert!((world - relative).abs().max_element() < EXACT);
        }
    }
}

/// Where a renderer's f32 puts a position relative to the eye.
fn project_in_f32(matrix: &Mat4, relative: DVec3) -> Vec3 {
    let clip = *matrix * relative.as_vec3().extend(1.0);
    clip.truncate() / clip.w
}

/// Hard case 25: far from the origin of the world f32 keeps what it keeps near it, a small part of a texel.
#[test]
fn far_away_positions_relative_to_the_eye_keep_their_texel() {
    let far = DVec3::new(1e7, -2e7, 0.7e7);
    for (here, there) in Setup::around(DVec3::ZERO).into_iter().zip(Setup::around(far)) {
        for warp in [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal] {
            let off = |setup: &Setup| {
                let map = setup.map(&settings(warp).with_origin(Origin::Eye));
                let exact = map.clip_from_world();
                let texels = f64::from(map.settings().map_size()) / 2.0;
                let points = setup.visible();
                points.iter().fold(0.0, |most: f64, &point| {
                    let found = project_in_f32(&map.caster_matrix(), point - setup.view.eye());
                    assert!(found.abs().max_element() <= 1.0 && found.z >= 0.0, "{found}");
                    let off = found.as_dvec3().truncate() - project(&exact, point).truncate();
                    most.max(off.abs().max_element() * texels)
                })
            };
            let (here, there) = (off(&here), off(&there));
            // Eight roundings of terms up to ten times as large as w, in texels of 1/1024.
            assert!(here < 8.0 * 10.0 / 16_777_216.0 * 1024.0, "{here} texels");
            // f64 coordinates of 2e7 are good to 4e-9 units, which is nothing beside that.
            assert!(there < 8.0 * 10.0 / 16_777_216.0 * 1024.0, "{there} texels");
        }
    }
}
