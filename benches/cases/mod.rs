//! The cases that both benchmarks measure: one view of a town, three lights, and the fit that most engines use.

use shadowfit::glam::{DMat4, DVec3, Mat4, Vec3};
use shadowfit::{Aabb, ConvexScene, Form, InputError, Light, Plane, Scene, Settings, Shift, View, Warp};

/// A street seen from a standing person's eyes.
pub fn view() -> Result<View, InputError> {
    View::perspective((0.0, 1.7, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)
}

/// The bounds of the town.
pub fn scene() -> Result<Scene<'static>, InputError> {
    Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))
}

/// The bounds of the town with `cuts` more planes.
pub fn cut_scene(cuts: usize) -> Result<ConvexScene, InputError> {
    let planes: Vec<Plane> = (0..cuts)
        .map(|cut| {
            let angle = 0.4 + cut as f64;
            let inwards = DVec3::new(angle.cos(), 0.1, angle.sin());
            Plane::through(inwards, -190.0 * inwards)
        })
        .collect();
    ConvexScene::new((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0), &planes)
}

/// A sun, a lamp over the street, and a spot over it.
pub fn lights() -> Result<[(&'static str, Light); 3], InputError> {
    Ok([
        ("directional", Light::directional((0.3, 1.0, 0.4))?),
        ("point", Light::point((10.0, 40.0, -10.0), 0.1, f64::INFINITY)?),
        ("spot", Light::spot((10.0, 40.0, -40.0), (0.0, -1.0, 0.0), 0.6, 0.1, 100.0)?),
    ])
}

/// The maps that are fitted.
pub fn settings() -> [(&'static str, Settings); 4] {
    let settings = Settings::default();
    [
        ("uniform", settings.with_warp(Warp::Uniform).with_shift(Shift::None)),
        ("psm", settings.with_shift(Shift::None)),
        ("psm shifted by the paper's H", settings.with_shift(Shift::Back(Form::Paper))),
        ("psm shifted by the tight H", settings.with_shift(Shift::Back(Form::Tight))),
    ]
}

/// Objects scattered over the town.
pub fn boxes(count: usize) -> Vec<Aabb> {
    (0..count)
        .map(|index| {
            // Multiples of two irrational numbers fill a square evenly.
            let at = |step: f64| 400.0 * (index as f64 * step).fract() - 200.0;
            let min = Vec3::new(at(0.754_877_666) as f32, 0.0, at(0.569_840_29) as f32);
            Aabb::new(min, min + Vec3::new(2.0, 3.0, 2.0))
        })
        .collect()
}

/// What most engines do for a directional light: the light-space box around the corners of the view's frustum.
///
/// It holds no caster before the near plane and knows nothing of the scene.
pub fn naive_fit(corners: &[DVec3; 8], direction_to_light: DVec3) -> Mat4 {
    let (right, up) = direction_to_light.any_orthonormal_pair();
    let light_from_world = DMat4::from_cols(
        DVec3::new(right.x, up.x, -direction_to_light.x).extend(0.0),
        DVec3::new(right.y, up.y, -direction_to_light.y).extend(0.0),
        DVec3::new(right.z, up.z, -direction_to_light.z).extend(0.0),
        DVec3::ZERO.extend(1.0),
    );
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for &corner in corners {
        let seen = light_from_world.transform_point3(corner);
        (min, max) = (min.min(seen), max.max(seen));
    }
    let size = max - min;
    let centre = 0.5 * (min + max);
    let scale = DVec3::new(2.0 / size.x, 2.0 / size.y, 1.0 / size.z);
    let offset = DVec3::new(-centre.x, -centre.y, -min.z) * scale;
    (DMat4::from_translation(offset) * DMat4::from_scale(scale) * light_from_world).as_mat4()
}
