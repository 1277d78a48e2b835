//! The matrices of named set-ups, one for each class of light and warp, and one for each convention, as they are
//! uploaded. A change of any is a change that users see.

use shadowfit::glam::{DVec3, Mat4};
use shadowfit::{
    ClipSpace, FocusForm, Light, Origin, Scene, Settings, ShadowMap, View, Warp, fit,
    warp::{Shift, classify},
};

/// Eye height of a person on a lawn, looking ahead.
fn view() -> View {
    View::perspective((0.0, 1.75, 8.0), (0.0, -0.125, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).unwrap()
}

fn scene() -> Scene<'static> {
    Scene::from_box((-16.0, 0.0, -32.0), (16.0, 4.0, 16.0)).unwrap()
}

/// A light of each class.
fn lights() -> [Light; 5] {
    let lamp = |x, y, z| Light::point((x, y, z), 0.25, f64::INFINITY).unwrap();
    let sun = |x, y, z| Light::directional((x, y, z)).unwrap();
    [
        lamp(4.0, 12.0, -16.0),
        lamp(4.0, 8.0, 32.0),
        // In the plane of the eye: at right angles to where it looks.
        sun(0.0, 1.0, -0.125),
        sun(0.25, 1.0, -1.0),
        sun(0.25, 1.0, 1.0),
    ]
}

fn fitted(light: &Light, settings: Settings) -> ShadowMap {
    fit(&view(), light, &scene(), &settings).into_map().expect("a map")
}

/// Six significant digits, and no sign of zero.
fn number(value: f32) -> String {
    let magnitude = f64::from(value).abs();
    if magnitude < 1e-12 {
        return "0".into();
    }
    let rounded: f64 = format!("{value:.5e}").parse().unwrap();
    rounded.to_string()
}

fn table(matrix: &Mat4) -> String {
    let row = |row| matrix.row(row).to_array().map(|entry| format!("{:>15}", number(entry))).concat();
    [0, 1, 2, 3].map(row).join("\n")
}

#[test]
fn classes_and_warps() {
    let mut text = String::new();
    for light in lights() {
        let kind = classify(&view(), &light).kind;
        let base = Settings::default().with_warp(Warp::Perspective);
        let uniform = fitted(&light, base.with_warp(Warp::Uniform));
        text += &format!("{kind}, uniform\n{}\n\n", table(&uniform.caster_matrix()));
        for shift in [Shift::None, Shift::Back(FocusForm::ViewHull)] {
            let map = fitted(&light, base.with_shift(shift));
            let (back, ratio) = (number(map.camera().shift as f32), number(map.warp_ratio() as f32));
            // Where H lies before the eye the two are the same.
            if shift == Shift::None || map.camera().shift > 1e-9 {
                text +=
                    &format!("{kind}, warp ratio {ratio}, moved back {back}\n{}\n\n", table(&map.caster_matrix()));
            }
        }
    }
    insta::assert_snapshot!(text);
}

#[test]
fn other_warps() {
    let mut text = String::new();
    for light in lights() {
        let kind = classify(&view(), &light).kind;
        for warp in [Warp::LightSpace, Warp::Trapezoidal, Warp::default()] {
            let map = fitted(&light, Settings::default().with_warp(warp));
            let refused = map.fallback().map_or_else(String::new, |why| format!(", refused: {why}"));
            let ratio = number(map.warp_ratio() as f32);
            text += &format!("{kind}, {warp:?}, warp ratio {ratio}{refused}\n{}\n\n", table(&map.caster_matrix()));
        }
    }
    insta::assert_snapshot!(text);
}

#[test]
fn conventions() {
    let sun = lights()[4];
    let base = Settings::default().with_warp(Warp::Perspective).with_shift(Shift::None);
    let matrix = |clip| fitted(&sun, base.with_clip(clip)).caster_matrix();
    let tables = [
        ("reversed depth", matrix(ClipSpace::WGPU.reversed())),
        ("Vulkan", matrix(ClipSpace::VULKAN)),
        ("OpenGL", matrix(ClipSpace::OPENGL)),
        ("texture", fitted(&sun, base).receiver_matrix()),
        ("OpenGL texture", fitted(&sun, base.with_clip(ClipSpace::OPENGL)).receiver_matrix()),
        ("relative to the eye", fitted(&sun, base.with_origin(Origin::Eye)).caster_matrix()),
    ];
    let text: String = tables.iter().map(|(name, matrix)| format!("{name}\n{}\n\n", table(matrix))).collect();
    insta::assert_snapshot!(text);
}
