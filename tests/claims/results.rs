//! Everything that the crate says of a fit is a number.

use shadowfit::{
    DepthFormat, DepthResolution, Focus, Form, Light, Offset, Outcome, Scene, Settings, View, Warp, classify,
};

/// Everything there is to know about a fit; none of it may be NaN.
pub(crate) fn exercise(view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) {
    let focus = Focus::new(view, light, scene);
    for body in [focus.visible(), focus.body(Form::Paper), focus.body(Form::Tight)] {
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
    assert!(map.matrix().is_finite(), "{}", map.matrix());
    assert!(map.texture_matrix().is_finite(), "{}", map.texture_matrix());
    assert!(map.shadow_from_world().is_finite(), "{}", map.shadow_from_world());
    // What was refused is the uniform map, and nothing else says that it was.
    let refusable = matches!(settings.warp(), Warp::LightSpace | Warp::Trapezoidal | Warp::Stable);
    assert!(map.refusal().is_none() || refusable && map.weakening() == 1.0, "{:?}", map.refusal());
    for &point in focus.visible().vertices() {
        let position = map.shadow_from_world() * point.extend(1.0);
        assert!(position.is_finite(), "{point} is at {position}");
    }
    for offset in [Offset::world(1.0), Offset::relative(0.1), Offset::depth(1e-3)] {
        let matrix = map.texture_matrix_with(&offset.expect("a legal offset"));
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
        ("slope", bias.slope.into()),
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
