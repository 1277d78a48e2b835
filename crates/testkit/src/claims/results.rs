//! Everything that the crate says of a fit is a number.

use shadowfit::{
    DepthFormat, Focus, FocusForm, Light, Outcome, Scene, Settings, View, Warp, depth::ReceiverOffset,
    map::DepthResolution, warp::classify,
};

/// Everything there is to know about a fit; none of it may be NaN.
pub fn exercise(view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) {
    let focus = Focus::new(view, light, scene);
    for body in [
        focus.receiver_volume(),
        focus.caster_volume(FocusForm::ViewHull),
        focus.caster_volume(FocusForm::ReceiverHull),
    ] {
        assert!(body.vertices().iter().all(|vertex| vertex.is_finite()), "vertices {:?}", body.vertices());
        assert!(body.volume().is_finite(), "volume {}", body.volume());
        assert_eq!(body.is_empty(), body.bounds().is_none());
        for face in body.faces() {
            assert!(face.indices().len() >= 3 && face.vertices().all(|corner| corner.is_finite()));
        }
        assert!(body.edges().all(|(a, b)| a.is_finite() && b.is_finite()));
    }
    let class = classify(view, light);
    assert!(class.position.is_finite() && class.sine_to_camera_plane.is_finite() && !class.eye_distance.is_nan());
    let Outcome::Map(map) = focus.fit(settings) else { return };
    assert!(map.caster_matrix().is_finite(), "{}", map.caster_matrix());
    assert!(map.receiver_matrix().is_finite(), "{}", map.receiver_matrix());
    assert!(map.clip_from_world().is_finite(), "{}", map.clip_from_world());
    // What was refused is the uniform map, and nothing else says that it was.
    let refusable = matches!(settings.warp(), Warp::LightSpace | Warp::Trapezoidal | Warp::Stable);
    assert!(map.fallback().is_none() || refusable && map.weakening() == 1.0, "{:?}", map.fallback());
    for &point in focus.receiver_volume().vertices() {
        let position = map.clip_from_world() * point.extend(1.0);
        assert!(position.is_finite(), "{point} is at {position}");
    }
    for offset in [ReceiverOffset::world(1.0), ReceiverOffset::relative(0.1), ReceiverOffset::depth(1e-3)] {
        let matrix = map.receiver_matrix_with(&offset.expect("a legal offset"));
        assert!(matrix.is_finite(), "{matrix}");
    }
    let bias = map.bias(DepthFormat::Float32, 1.0).expect("a legal reach");
    let report = map.report(&focus);
    let DepthResolution { unorm8, unorm16, unorm24, float32 } = report.depth_resolution;
    let (window, depth, camera) = (report.window, report.depth, report.camera);
    let finite = [
        ("warp ratio", report.warp_ratio),
        ("weakening", map.weakening()),
        ("width", window.width),
        ("height", window.height),
        ("padding x", window.padding.0),
        ("padding y", window.padding.1),
        ("window rounding", window.rounding),
        ("slope", bias.slope_scale.into()),
        ("receiver", bias.receiver),
        ("relative", bias.relative),
        ("most of both", bias.most),
        ("linear depth", map.linear_depth().normal.length()),
        ("depth rounding", depth.rounding),
        ("shift", camera.shift),
        ("camera near", camera.near),
        ("camera far", camera.far),
    ];
    for (name, value) in finite {
        assert!(value.is_finite(), "{name} is {value}");
    }
    // What no texel, no depth, no near or no far plane limits may be infinite.
    let numbers = [
        ("depth near", depth.near),
        ("depth far", depth.far),
        ("texel", report.texel),
        ("aliasing", report.aliasing),
        ("unorm8", unorm8),
        ("unorm16", unorm16),
        ("unorm24", unorm24),
        ("float32", float32),
        ("linear unorm8", report.linear_depth_resolution.unorm8),
        ("linear float32", report.linear_depth_resolution.float32),
    ];
    for (name, value) in numbers {
        assert!(!value.is_nan(), "{name} is NaN");
    }
}
