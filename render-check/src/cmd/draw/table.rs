//! The table that is printed: a row for each light.

use std::time::Duration;

use comfy_table::Table;
use shadowfit::glam::DVec3;
use shadowfit::{focus::ConvexBody, map::Report};

use super::fitting::{Fitted, LightFit};
use crate::maps::Technique;
use crate::output::table::{self, number};

/// The table of all lights. `bounds` are those of the scene.
#[must_use]
pub(super) fn table(fits: &[LightFit], bounds: (DVec3, DVec3)) -> Table {
    let header = ["", "light", "class", "s", "H", "map", "window", "aliasing", "limit", "fit"];
    let mut table = table::new(header, [0, 3, 7, 8, 9]);
    for (i, fit) in fits.iter().enumerate() {
        table.add_row([
            (i + 1).to_string(),
            fit.spec.to_string(),
            fit.class.kind.to_string(),
            shift(fit),
            body(fit, bounds),
            each_map(fit, |fitted| fitted.technique.to_string()),
            each_map(fit, |fitted| {
                of(fitted, |report| format!("{} x {}", number(report.window.width), number(report.window.height)))
            }),
            each_map(fit, |fitted| fitted.aliasing.map_or_else(|| "-".into(), number)),
            number(fit.limit),
            each_map(fit, |fitted| microseconds(fitted.median_time)),
        ]);
    }
    table
}

/// A value of one map, or a dash without a map.
fn of(fitted: &Fitted, figure: impl Fn(&Report) -> String) -> String {
    fitted.report.as_ref().map_or_else(|| "-".into(), figure)
}

/// How far the virtual camera of the perspective shadow map moves back.
fn shift(fit: &LightFit) -> String {
    let perspective = fit.maps.iter().find(|fitted| fitted.technique == Technique::Psm);
    perspective.map_or_else(|| "-".into(), |fitted| of(fitted, |report| number(report.camera.shift)))
}

/// A line for each map of a light.
fn each_map(fit: &LightFit, figure: impl Fn(&Fitted) -> String) -> String {
    fit.maps.iter().map(figure).collect::<Vec<_>>().join("\n")
}

fn body(fit: &LightFit, (min, max): (DVec3, DVec3)) -> String {
    if fit.body.is_empty() {
        return "empty".into();
    }
    let extent = max - min;
    let share = |body: &ConvexBody| match extent.x * extent.y * extent.z {
        scene if scene > 0.0 => format!("{:.1} %", 100.0 * body.volume() / scene),
        _ => "flat".into(),
    };
    let counts = |body: &ConvexBody| format!("{} v, {} f", body.vertices().len(), body.faces().count());
    format!(
        "{}, {} of S\ntight: {}, {}",
        counts(&fit.body),
        share(&fit.body),
        counts(&fit.tight_body),
        share(&fit.tight_body)
    )
}

fn microseconds(time: Duration) -> String {
    format!("{:.1} µs", time.as_secs_f64() * 1e6)
}
