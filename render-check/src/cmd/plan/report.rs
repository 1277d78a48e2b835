//! The report of a plan, as JSON and as a table.

use std::time::Duration;

use anyhow::Result;
use serde::Serialize;
use shadowfit::plan::{LightPlan, Plan};

use super::args::PlanArgs;
use crate::gpu::Filter;
use crate::output::table::{self, number, percent};
use crate::run::{CameraReport, FittedMaps, Times, planned, run_fitted};
use crate::scene::Mesh;
use crate::stage::{Stage, StageLight};
use crate::verdict::Verdict;

/// The report of a plan.
#[derive(Clone, Debug, Serialize)]
pub struct PlanReport {
    /// The scene's name.
    pub scene: String,
    /// The graphics adapter.
    pub adapter: String,
    /// Width and height of the camera's image, in pixels.
    pub image: [u32; 2],
    /// The camera.
    pub camera: CameraReport,
    /// The camera narrowed to the depth range of the receivers in view, which the maps were fitted to.
    pub narrowed: CameraReport,
    /// The median time of planning all lights, in microseconds.
    pub plan_us: f64,
    /// Passes of all lights.
    pub passes: usize,
    /// Texels of all maps.
    pub texels: u64,
    /// Triangles drawn in all passes.
    pub triangles: u64,
    /// The lights, in their order.
    pub lights: Vec<LightReport>,
}

/// One light.
#[derive(Clone, Debug, Serialize)]
pub struct LightReport {
    /// The light, in the command line's spelling.
    pub light: String,
    /// The kind of its maps.
    pub kind: String,
    /// Which surface is drawn.
    pub test: String,
    /// How the maps are read.
    pub filter: Filter,
    /// Passes, one map each.
    pub passes: usize,
    /// Texels along each side of a map; `None` without one.
    pub map_size: Option<u32>,
    /// Texels of its maps.
    pub texels: u64,
    /// Objects drawn, over all passes.
    pub objects: usize,
    /// Objects there are.
    pub of_objects: usize,
    /// Triangles drawn, over all passes.
    pub triangles: u64,
    /// The plan's estimate of the worst aliasing: the longest side of a texel over that of a pixel.
    pub aliasing: f64,
    /// The plan's reasons.
    pub reasons: Vec<String>,
    /// The result of drawing it.
    pub drawn: DrawnReport,
}

/// The result of drawing a light as planned.
#[derive(Clone, Debug, Serialize)]
pub struct DrawnReport {
    /// The times; `None` where there was nothing to draw.
    pub times: Option<Times>,
    /// The comparison with ray-traced truth.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// All wrong pixels, as a fraction of those compared.
    pub wrong: f64,
}

impl LightReport {
    pub(super) fn new(
        stage: &Stage<'_>,
        light: &StageLight,
        plan: &Plan,
        of_light: &LightPlan,
        args: &PlanArgs,
    ) -> Result<Self> {
        let options = planned::options(of_light, args.budget.format.into(), args.points, args.frames);
        let mesh: &Mesh = stage.tracer.mesh();
        let drawn = match FittedMaps::planned(stage, plan, &light.light, of_light, &options)? {
            Some(fitted) => {
                let run = run_fitted(stage, light, &options, fitted, Duration::ZERO)?;
                DrawnReport::new(Some(run.times), run.verdict)
            }
            None => DrawnReport::new(None, Verdict::without_map(&light.truth)),
        };
        let passes = of_light.passes();
        Ok(Self {
            light: light.spec.to_string(),
            kind: planned::kind_in_words(of_light.kind()).to_owned(),
            test: planned::test_in_words(of_light).to_owned(),
            filter: options.filter,
            passes: passes.len(),
            map_size: passes.first().map(|pass| pass.map_size()),
            texels: of_light.texels(),
            objects: passes.iter().map(|pass| plan.casters(pass).len()).sum(),
            of_objects: mesh.objects.len(),
            triangles: passes.iter().map(|pass| pass.triangles()).sum(),
            aliasing: of_light.aliasing(),
            reasons: of_light.reasons().iter().map(ToString::to_string).collect(),
            drawn,
        })
    }
}

impl DrawnReport {
    fn new(times: Option<Times>, verdict: Verdict) -> Self {
        let wrong = verdict.counts.fraction(verdict.counts.wrong());
        Self { times, verdict, wrong }
    }
}

const COLUMNS: [&str; 12] = [
    "light",
    "kind",
    "test",
    "filter",
    "maps",
    "drawn",
    "aliasing",
    "missing",
    "false",
    "edge",
    "wrong",
    "map, test",
];

/// A row for each light.
pub(super) fn overview(report: &PlanReport) -> comfy_table::Table {
    let mut table = table::new(COLUMNS, 4..COLUMNS.len());
    for light in &report.lights {
        let maps = light.map_size.map_or_else(|| "-".into(), |size| format!("{} x {size}²", light.passes));
        let mut row =
            vec![light.light.clone(), light.kind.clone(), light.test.clone(), light.filter.to_string(), maps];
        row.push(format!("{} of {}, {}", light.objects, light.of_objects, light.triangles));
        row.extend(drawn_cells(light, &light.drawn));
        row.resize(COLUMNS.len(), "-".into());
        table.add_row(row);
    }
    table
}

fn drawn_cells(light: &LightReport, drawn: &DrawnReport) -> [String; 6] {
    let counts = &drawn.verdict.counts;
    let share = |count: usize| percent(counts.fraction(count));
    let aliasing = drawn
        .verdict
        .aliasing
        .map_or_else(|| "-".into(), |found| [light.aliasing, found.worst, found.median].map(number).join(", "));
    let ms = |time: Option<f64>| time.map_or_else(|| "-".into(), |ms| format!("{ms:.2}"));
    let times = drawn.times.map_or_else(
        || "-".into(),
        |times| format!("{}, {} ms", ms(times.shadow_map_ms), ms(times.shadow_test_ms)),
    );
    [
        aliasing,
        counts.missing.to_string(),
        share(counts.false_shadow + counts.false_light),
        share(counts.edges()),
        share(counts.wrong()),
        times,
    ]
}
