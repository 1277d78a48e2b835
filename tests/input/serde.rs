//! Views, lights, settings and results that are stored and read again.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, from_str, from_value, json, to_string, to_value};
use shadowfit::glam::{DMat4, DVec3, DVec4, Vec3};
use shadowfit::{
    Aabb, ClipSpace, DepthFormat, Effort, Empty, Focus, FocusForm, Light, Origin, Outcome, Scene, Settings, View,
    Warp, WarpFallback,
    cascades::{CascadeLayout, CascadeSplits, Cascades, SplitScheme},
    depth::{DepthBias, ReceiverOffset},
    focus::Plane,
    map::{DepthResolution, DepthSpan, Footprint, Window},
    omni::CubeFace,
    warp::{LightClass, NearCase, Shift, VirtualCamera, classify},
};

#[track_caller]
fn comes_back<T: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: T) {
    let text = to_string(&value).unwrap();
    assert_eq!(from_str::<T>(&text).unwrap(), value, "{text}");
}

/// Refused, with this in the message, after one place in the stored form is replaced.
#[track_caller]
fn tampered<T: Serialize + DeserializeOwned + core::fmt::Debug>(
    value: &T,
    place: &str,
    with: Value,
    message: &str,
) {
    let mut stored = to_value(value).unwrap();
    *stored.pointer_mut(place).expect(place) = with;
    let error = from_value::<T>(stored).expect_err("accepted").to_string();
    assert!(error.contains(message), "{error}");
}

/// Numbers that no decimal fraction is equal to, and axes that rounding has been at.
fn view(far: f64) -> View {
    View::perspective((0.1, 1.7, -3.3), (0.3, -0.21, -1.0), DVec3::Y, 1.0, 1.6, 0.1, far).unwrap()
}

fn spot() -> Light {
    Light::spot((0.1, 5.0, -9.7), (0.3, -1.0, 0.2), 0.7, 0.05, 33.3).unwrap()
}

#[test]
fn views() {
    comes_back(view(500.0));
    comes_back(view(f64::INFINITY));
    comes_back(View::orthographic(DVec3::ONE, DVec3::X, DVec3::Y, 5.0, 1.3, -4.0, 1.0 / 3.0).unwrap());
    // Mirrored, and off the axis.
    let mut clip_from_eye = DMat4::from_cols(DVec4::X, DVec4::Y, DVec4::NEG_W, DVec4::Z * 0.1);
    clip_from_eye.z_axis.x = 0.3;
    let mirror = DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)) * DMat4::from_rotation_x(0.4);
    comes_back(View::from_matrices(mirror, clip_from_eye, ClipSpace::WGPU.reversed()).unwrap());
    // Sheared, and with oblique planes.
    let mut rows = view(500.0).clip_from_world().transpose();
    rows.x_axis += rows.y_axis * 0.25;
    rows.z_axis += rows.y_axis * 0.125;
    let leaning = View::from_clip_from_world(rows.transpose(), ClipSpace::OPENGL).unwrap();
    assert!(leaning.planes().len() > 6 && leaning.right().dot(leaning.up()).abs() > 0.01);
    comes_back(leaning);
}

/// A rotation that came out of a matrix is orthonormal enough to be read again.
#[test]
fn views_of_every_rotation() {
    for step in 0..1000 {
        let angle = f64::from(step);
        let turn = DMat4::from_rotation_x(angle * 0.37) * DMat4::from_rotation_y(angle * 1.31);
        let turn = turn * DMat4::from_rotation_z(angle * 2.17);
        let clip_from_eye = DMat4::from_scale(DVec3::new(0.1, 0.1, -0.02));
        comes_back(View::from_matrices(turn, clip_from_eye, ClipSpace::WGPU).unwrap());
    }
}

#[test]
fn an_infinite_far_plane_is_stored_as_nothing() {
    assert_eq!(to_value(view(f64::INFINITY)).unwrap()["far"], Value::Null);
}

#[test]
fn tampered_views() {
    let view = view(500.0);
    tampered(&view, "/near", json!(-1.0), "near must lie in [2⁻⁴⁰, 2⁴⁰]");
    tampered(&view, "/near", json!(501.0), "far (500) must be greater than near (501)");
    tampered(&view, "/far", json!(1e300), "far must lie in [2⁻⁴⁰, 2⁴⁰]");
    tampered(&view, "/eye/0", json!(1e300), "eye.x must lie in [−2⁴⁰, 2⁴⁰]");
    tampered(&view, "/forward/0", json!(0.5), "forward and the other axes must be unit vectors");
    tampered(&view, "/up", json!([0.0, 0.0, 0.0]), "forward and the other axes must be unit vectors");
    // A ten-thousandth too long: far beyond rounding, and within what glam calls normalized.
    let long = (view.right() * 1.00005).to_array();
    tampered(&view, "/right", json!(long), "forward and the other axes must be unit vectors");
    tampered(&view, "/frame_min/0", json!(9.0), "must be greater than left (9)");
    tampered(&view, "/lean", json!(0.5), "forward and the other axes must be unit vectors");
    tampered(&view, "/lens", json!("Fisheye"), "unknown variant");
    tampered(&view, "/near", Value::Null, "null");
    // Only a perspective view sees infinitely far.
    let parallel = View::orthographic(DVec3::ONE, DVec3::X, DVec3::Y, 5.0, 1.3, -4.0, 9.0).unwrap();
    tampered(&parallel, "/far", Value::Null, "far must be finite");
}

#[test]
fn lights() {
    comes_back(Light::directional((0.3, 1.0, 0.2)).unwrap());
    comes_back(Light::point((0.3, 1.0, 0.2), 0.1, f64::INFINITY).unwrap());
    comes_back(spot());
    comes_back(spot().with_up((0.3, 0.2, 0.9)).unwrap());
    let pyramid =
        Light::pyramid((0.3, 1.0, 0.2), (0.2, -1.0, 0.7), (1.0, 0.5, 0.0), [0.5, 0.25], 0.1, 9.0).unwrap();
    comes_back(pyramid);
    let planes = [Plane::new(DVec3::new(0.6, 0.8, 0.0), 4.0), Plane::new(DVec3::NEG_Z, 2.0)];
    comes_back(pyramid.within(&planes).unwrap());
    let hemisphere = Light::hemisphere((0.3, 1.0, 0.2), (0.2, -1.0, 0.7), 0.1, 9.0).unwrap();
    comes_back(hemisphere);
    for face in CubeFace::ALL {
        comes_back(hemisphere.cube_face(face, 0.01).unwrap());
        comes_back(Light::point((0.3, 1.0, 0.2), 0.1, f64::INFINITY).unwrap().cube_face(face, 0.0).unwrap());
    }
}

/// A unit vector that is made unit length again may change by a rounding, and must not at the second reading.
#[test]
fn directions_do_not_creep() {
    for step in 0..1000 {
        let (sine, cosine) = f32::sin_cos(step as f32);
        let light = Light::directional((f64::from(sine), 0.3, f64::from(cosine))).unwrap();
        comes_back(light);
    }
}

#[test]
fn tampered_lights() {
    let place = |name: &str| format!("/kind/Local/{name}");
    let spot = spot();
    tampered(&spot, &place("near"), json!(0.0), "near must lie in [2⁻⁴⁰, 2⁴⁰]");
    tampered(&spot, &place("near"), json!(99.0), "must be greater than near (99)");
    tampered(&spot, &place("range"), json!(-1.0), "range must lie in");
    tampered(&spot, &place("position/1"), json!(1e200), "position.y must lie in");
    tampered(
        &spot,
        &place("shape/Spot/half_angle"),
        json!(1.6),
        "half_angle must lie in (1e-9, π/2 − 1e-9) radians; got 1.6",
    );
    tampered(&spot, &place("shape/Spot/axis"), json!([0.0, 0.0, 0.0]), "axis is the zero vector");
    let face = Light::point((0.3, 1.0, 0.2), 0.1, 9.0).unwrap().cube_face(CubeFace::PositiveZ, 0.01).unwrap();
    tampered(&face, &place("shape/CubeFace/overlap"), json!(-0.1), "overlap must lie in [0, 1]; got -0.1");
    tampered(&face, &place("shape/CubeFace/hemisphere"), json!([0.0, 0.0, 0.0]), "axis is the zero vector");
    let sun = Light::directional(DVec3::Y).unwrap();
    let place = "/kind/Directional/direction_to_light";
    tampered(&sun, place, json!([0.0, -0.0, 0.0]), "direction_to_light is the zero vector");
}

#[test]
fn cascades() {
    [SplitScheme::Uniform, SplitScheme::Logarithmic, SplitScheme::Practical(0.1)].into_iter().for_each(comes_back);
    [CascadeLayout::Array, CascadeLayout::Atlas].into_iter().for_each(comes_back);
    let scene = Scene::from_box((-50.0, -3.0, -90.0), (50.0, 5.0, 0.0)).unwrap();
    let cuts = CascadeSplits::Visible { count: 5, split: SplitScheme::Practical(0.1) };
    let cascades = Cascades::new(&view(100.0), &spot(), &scene, cuts, 0.1).unwrap();
    let maps = cascades.fit(&Settings::default());
    comes_back(maps.extent(CascadeLayout::Atlas));
    comes_back(maps.tile(4, CascadeLayout::Atlas).unwrap());
}

#[test]
fn settings() {
    comes_back(Settings::default());
    let settings = Settings::new(512, 720).unwrap().with_border(7).unwrap();
    let settings = settings.with_clip(ClipSpace::OPENGL.reversed()).with_origin(Origin::Eye);
    comes_back(settings.with_warp(Warp::Uniform).with_shift(Shift::Back(FocusForm::ReceiverHull)));
    for warp in [Warp::Stable, Warp::LightSpace, Warp::Trapezoidal, Warp::Best(Effort::Rough)] {
        comes_back(settings.with_warp(warp));
    }
    comes_back(settings.with_map_sides(512, 4096).unwrap());
    tampered(&settings, "/map_width", json!(0), "map_width must lie in [4, 65536]; got 0");
    tampered(&settings, "/map_height", json!(0), "map_height must lie in [4, 65536]; got 0");
    tampered(&settings, "/map_width", json!(-1), "expected u32");
    tampered(&settings, "/image_height", json!(1_000_000), "image_height must lie in [4, 65536]");
    tampered(&settings, "/border", json!(500), "border must lie in");
}

#[cfg(feature = "alloc")]
#[test]
fn budgets() {
    use shadowfit::Filter;
    use shadowfit::plan::{Budget, Object, Reason};

    let budget = Budget::new(Settings::default()).with_format(DepthFormat::Float32).with_texels(9);
    let budget = budget.with_filter(Filter::Pcf(5)).with_aliasing(0.5).unwrap();
    comes_back(budget);
    tampered(&budget, "/aliasing", json!(0.0), "aliasing is too small");
    tampered(&budget, "/settings/map_height", json!(0), "map_height must lie in [4, 65536]; got 0");
    comes_back(Object::new(Aabb::new(Vec3::NEG_ONE, Vec3::ONE)));
    comes_back([Reason::NoCasters, Reason::WarpFiner(0.5), Reason::Faces(3)]);
}

#[test]
fn results() {
    let (view, light) = (view(500.0), spot());
    comes_back::<LightClass>(classify(&view, &light));
    // Infinitely far from the eye.
    comes_back::<LightClass>(classify(&view, &Light::directional(DVec3::Y).unwrap()));
    let scene = Scene::from_box((-20.0, 0.0, -30.0), (20.0, 5.0, 9.0)).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let Outcome::Map(map) = focus.fit(&Settings::default()) else { panic!("no map") };
    let report = map.report(&focus);
    comes_back::<VirtualCamera>(report.camera);
    comes_back::<Window>(report.window);
    comes_back::<DepthSpan>(report.depth);
    comes_back::<DepthResolution>(report.depth_resolution);
    comes_back::<DepthBias>(map.bias(DepthFormat::Float32, 1.5).unwrap());
    comes_back(
        [ReceiverOffset::world(0.1), ReceiverOffset::relative(1e-3), ReceiverOffset::depth(1e-4)]
            .map(Result::unwrap),
    );
    comes_back(ReceiverOffset::world(0.1).unwrap().and_depth(1e-4).unwrap());
    tampered(
        &ReceiverOffset::relative(0.1).unwrap(),
        "/towards/Relative",
        json!(-2.0),
        "part must lie in [-0.5, 2⁴⁰]; got -2",
    );
    comes_back::<Footprint>(map.footprint(focus.receiver_volume().vertices()[0]).unwrap());
    comes_back::<Plane>(focus.caster_volume(FocusForm::ReceiverHull).planes().next().unwrap());
    comes_back(Aabb::new(Vec3::NEG_ONE, Vec3::ONE * 0.1));
    comes_back([Empty::NoReceivers, Empty::NoCasters]);
    let (min, max) = focus.receiver_volume().bounds().unwrap();
    let inside = Light::point(0.5 * (min + max), 0.1, 9.0).unwrap();
    let Outcome::Surrounded(surrounded) = Focus::new(&view, &inside, &scene).fit(&Settings::default()) else {
        panic!("a map");
    };
    comes_back(surrounded);
    comes_back([
        WarpFallback::NoPerspective,
        WarpFallback::AlongView,
        WarpFallback::FocusBehindLight,
        WarpFallback::FocusLarge,
    ]);
    comes_back([DepthFormat::Unorm8, DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32]);
    comes_back([NearCase::CameraPlane, NearCase::AlongView, NearCase::Eye, NearCase::InsideView]);
}
