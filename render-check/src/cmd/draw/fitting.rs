//! Calls into `shadowfit`: its results for one light, and the time they take.

use std::hint::black_box;
use std::time::Duration;

use anyhow::Result;
use shadowfit::{
    Focus, FocusForm, Light, Outcome, Settings, View, fit,
    focus::ConvexBody,
    map::Report,
    warp::{LightClass, classify},
};

use crate::maps::Technique;
use crate::run::median_time;
use crate::scene::{LightSpec, Mesh};
use crate::stage::scene_box;

/// The result of one technique.
#[derive(Debug)]
pub(super) struct Fitted {
    /// The technique.
    pub technique: Technique,
    /// The map, or why there is none.
    pub outcome: Outcome,
    /// The report on the map.
    pub report: Option<Report>,
    /// The worst aliasing, texel size over pixel size, over the receiver volume.
    pub aliasing: Option<f64>,
    /// The median time of a fit on this machine.
    pub median_time: Duration,
}

/// The results for one light.
#[derive(Debug)]
pub(super) struct LightFit {
    /// The light, as given.
    pub spec: LightSpec,
    /// Its class: where the camera's perspective maps the light.
    pub class: LightClass,
    /// The caster volume H as in the paper.
    pub body: ConvexBody,
    /// The tight form of H, the hull of receivers and light.
    pub tight_body: ConvexBody,
    /// The results of the techniques, in their order.
    pub maps: Vec<Fitted>,
    /// The lower bound on the worst aliasing of any parameterization with this number of texels.
    pub limit: f64,
}

/// Fits a single map for one light with each of the techniques.
///
/// # Errors
///
/// When the light is invalid.
pub(super) fn fit_light(
    spec: LightSpec,
    view: &View,
    mesh: &Mesh,
    lamp_near: f64,
    settings: &Settings,
    techniques: &[Technique],
) -> Result<LightFit> {
    let scene = scene_box(mesh)?;
    let light: Light = spec.to_light(lamp_near)?;
    let focus = Focus::new(view, &light, &scene);
    let fitted = |&technique: &Technique| {
        let settings = technique.settings(*settings);
        let outcome = focus.fit(&settings);
        let median_time = median_time(2001, || fit(view, &light, &scene, black_box(&settings)));
        let report = outcome.map().map(|map| map.report(&focus));
        let aliasing = outcome.map().and_then(|map| map.aliasing_over(&focus)).map(|found| found.worst);
        Fitted { technique, outcome, report, aliasing, median_time }
    };
    Ok(LightFit {
        spec,
        class: classify(view, &light),
        body: focus.caster_volume(FocusForm::ViewHull),
        tight_body: focus.caster_volume(FocusForm::ReceiverHull),
        maps: techniques.iter().map(fitted).collect(),
        limit: focus.aliasing_lower_bound(settings),
    })
}

#[cfg(test)]
mod tests {
    use shadowfit::glam::DVec3;

    use super::*;
    use crate::scene;
    use crate::stage::lamp_near;
    use crate::trace::{Lens, Tracer};

    #[test]
    fn all_that_the_camera_sees_is_in_all_maps_of_every_light() {
        let scene = scene::load("chess-board".as_ref()).expect("built in");
        let tracer = Tracer::new(&scene.mesh).expect("it has triangles");
        let camera = scene.camera.expect("it has a camera");
        let view = View::perspective(camera.eye, camera.forward, camera.up, camera.fov_y, 1.6, 1.0, 28.0);
        let view = view.expect("a sound camera");
        let eye = Lens::of_view(&view).expect("invertible");
        let rays = (0..30)
            .flat_map(|y| (0..48).map(move |x| (x, y)))
            .filter_map(|(x, y)| eye.ray_through_pixel(x, y, 48, 30));
        let seen: Vec<DVec3> = rays.filter_map(|ray| tracer.first_hit(&ray)).map(|hit| hit.point).collect();
        assert!(seen.len() > 900, "{} points", seen.len());

        let settings = Settings::new(256, 600).expect("sound sizes");
        for &spec in scene.lights.iter().filter(|light| light.kind() != "spot") {
            let light_fit =
                fit_light(spec, &view, &scene.mesh, lamp_near(&tracer, &spec), &settings, &Technique::WARPS)
                    .expect("a sound light");
            assert!(!light_fit.body.is_empty());
            for fitted in &light_fit.maps {
                assert!(fitted.median_time > Duration::ZERO);
                let map = fitted.outcome.map().expect("one frustum does");
                let lens = Lens::new(map.clip_from_world()).expect("invertible");
                for &point in &seen {
                    let [x, y, z] = lens.project(point).to_array();
                    let inside = x.abs() <= 1.0 && y.abs() <= 1.0 && (0.0..=1.0).contains(&z);
                    assert!(inside && light_fit.body.contains(point), "{spec}: {point} at {x}, {y}, {z}");
                }
            }
        }
    }
}
