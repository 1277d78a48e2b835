//! The cases that both benchmarks measure: one view of a town and three lights.

use shadowfit::{Effort, FocusForm, InputError, Light, Scene, Settings, View, Warp, warp::Shift};

/// A street seen from a standing person's eyes.
pub(crate) fn view() -> Result<View, InputError> {
    View::perspective((0.0, 1.7, 0.0), (0.3, -0.1, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)
}

/// The bounds of the town.
pub(crate) fn scene() -> Result<Scene<'static>, InputError> {
    Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))
}

/// A sun, a lamp over the street, and a spot over it.
pub(crate) fn lights() -> Result<[(&'static str, Light); 3], InputError> {
    Ok([
        ("directional", Light::directional((0.3, 1.0, 0.4))?),
        ("point", Light::point((10.0, 40.0, -10.0), 0.1, f64::INFINITY)?),
        ("spot", Light::spot((10.0, 40.0, -40.0), (0.0, -1.0, 0.0), 0.6, 0.1, 100.0)?),
    ])
}

/// The maps that are fitted.
pub(crate) fn settings() -> [(&'static str, Settings); 10] {
    let settings = Settings::default().with_warp(Warp::Perspective).with_shift(Shift::Back(FocusForm::ViewHull));
    [
        ("uniform", settings.with_warp(Warp::Uniform)),
        ("psm", settings.with_shift(Shift::None)),
        ("psm shifted by the paper's H", settings),
        ("light-space", settings.with_warp(Warp::LightSpace)),
        ("trapezoidal", settings.with_warp(Warp::Trapezoidal)),
        ("best, closed forms", settings.with_warp(Warp::Best(Effort::ClosedForms))),
        ("best, rough", settings.with_warp(Warp::Best(Effort::Rough))),
        ("best, good", settings.with_warp(Warp::Best(Effort::Good))),
        ("best, thorough", settings.with_warp(Warp::Best(Effort::Thorough))),
        ("stable", settings.with_warp(Warp::Stable)),
    ]
}
