//! All lights of a scene, planned: what the plan says and why, and what comes of drawing just that.

use std::time::Duration;

use anyhow::{Context, Result, ensure};
use clap::builder::RangedU64ValueParser;
use serde::Serialize;
use shadowfit::{
    Light, Origin, Settings,
    plan::{Budget, LightPlan, Objects, Plan, plan as make_plan},
};

use crate::args::{FormatArg, ViewArgs};
use crate::fitted_maps::FittedMaps;
use crate::fitting::median_time;
use crate::gpu::{Filter, Gpu, Points};
use crate::opening::{choose_lights, open, output_directory, place_camera, say, sort};
use crate::planned;
use crate::report::{self, CameraReport};
use crate::run::{Times, run_fitted};
use crate::scene::Mesh;
use crate::stage::{Stage, StageLight};
use crate::table::{self, number, percent};
use crate::technique::Technique;
use crate::verdict::Verdict;

/// What is told after the options.
pub const HELP: &str = "\
What is planned: the least that is enough for each light, within a budget: a map or none, its kind, its size, what is
drawn into it, how depths are tested and how the map is read. What is drawn is that and no more.

The table:
  aliasing    the longest side of a texel over that of a pixel at its worst, as the plan estimates it; as it came out
              at its worst among the pixels; and the median
  drawn       objects drawn of all, over all passes; and triangles
  missing     pixels lit because a caster was clipped or culled, or because there is no map: must be none
  false       false shadow and false light, away from edges, in percent of what is compared
  edge        wrong within a texel's reach, or within a pixel, of the edge of a true shadow, in percent
  wrong       all of these together: how coarse a map is shows at edges
  map, test   times of the card's passes, medians over --frames

Written to --out: plan.json.";

/// What to plan.
#[derive(Clone, Debug, clap::Args)]
pub struct PlanArgs {
    /// The camera, the scene, the lights.
    #[command(flatten)]
    pub view: ViewArgs,

    /// What may be spent.
    #[command(flatten)]
    pub budget: BudgetArgs,

    /// What is drawn into the map for a point of a cloud
    #[arg(long, value_enum, default_value_t = Points::Discs)]
    pub points: Points,

    /// How often each map is drawn and read, for the median of the times
    #[arg(long, default_value_t = 3, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1000))]
    pub frames: u32,
}

/// What a plan may spend.
#[derive(Clone, Debug, clap::Args)]
pub struct BudgetArgs {
    /// The most texels along each side of a map
    #[arg(long, value_name = "TEXELS", default_value_t = 1024, value_parser = RangedU64ValueParser::<u32>::new().range(16..=16384))]
    pub size: u32,

    /// Bits of depth
    #[arg(long, value_enum, default_value_t = FormatArg::Unorm24)]
    pub format: FormatArg,

    /// The widest filter: nearest, hardware (2 x 2, blended), or pcfN for the mean over N x N texels
    #[arg(long, value_name = "FILTER", default_value = "hardware", value_parser = parse_filter)]
    pub filter: shadowfit::Filter,

    /// What maps may be warped by, where that is worth it
    #[arg(long, value_enum, default_value_t = Technique::Best)]
    pub warp: Technique,

    /// What is fine enough: the longest side of a texel over that of a pixel
    #[arg(long, value_name = "RATIO", default_value_t = 1.0)]
    pub aliasing: f64,

    /// The most texels of all maps together [default: as many as they need]
    #[arg(long, value_name = "TEXELS")]
    pub texels: Option<u64>,
}

impl BudgetArgs {
    /// The budget for an image so many pixels high.
    ///
    /// # Errors
    ///
    /// When it makes no sense.
    pub fn budget(&self, image_height: u32) -> Result<Budget> {
        let settings = self.warp.settings(Settings::new(self.size, image_height)?.with_origin(Origin::Eye));
        let budget = Budget::new(settings).with_format(self.format.into()).with_filter(self.filter);
        let budget = budget.with_aliasing(self.aliasing).context("nothing can be so fine")?;
        Ok(self.texels.map_or(budget, |texels| budget.with_texels(texels)))
    }
}

/// Reads a filter that a plan can choose: whether by virtual samples is its own choice.
fn parse_filter(text: &str) -> Result<shadowfit::Filter, String> {
    match text.parse()? {
        Filter::Nearest => Ok(shadowfit::Filter::Nearest),
        Filter::Hardware2x2 => Ok(shadowfit::Filter::Hardware2x2),
        // The harness reads at most 15 of them.
        Filter::Pcf(taps) => Ok(shadowfit::Filter::Pcf(taps as u8)),
        Filter::Virtual(_) => {
            Err("the plan says where virtual samples are needed: write nearest, hardware or pcfN".into())
        }
    }
}

/// All that is known after planning a scene.
#[derive(Clone, Debug, Serialize)]
pub struct PlanReport {
    /// The scene's name.
    pub scene: String,
    /// What drew it.
    pub adapter: String,
    /// Width and height of the camera's image, in pixels.
    pub image: [u32; 2],
    /// The camera.
    pub camera: CameraReport,
    /// What the maps were fitted to: the camera between the depths of the receivers in view.
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
    /// The light, as the command line spells it.
    pub light: String,
    /// The kind of its maps.
    pub kind: String,
    /// Which surface is drawn.
    pub test: String,
    /// How the maps are read.
    pub filter: Filter,
    /// Passes, a map each.
    pub passes: usize,
    /// Texels along each side of a map; nothing without one.
    pub map_size: Option<u32>,
    /// Texels of its maps.
    pub texels: u64,
    /// Objects drawn, over all passes.
    pub objects: usize,
    /// Objects there are.
    pub of_objects: usize,
    /// Triangles drawn, over all passes.
    pub triangles: u64,
    /// The plan's estimate of the longest side of a texel over that of a pixel, at its worst.
    pub aliasing: f64,
    /// Why it is so, in words.
    pub reasons: Vec<String>,
    /// What came of drawing it.
    pub drawn: DrawnReport,
}

/// What came of drawing what the plan says.
#[derive(Clone, Debug, Serialize)]
pub struct DrawnReport {
    /// How long it took; nothing where there was nothing to draw.
    pub times: Option<Times>,
    /// How it compares with the truth.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// All wrong pixels, as a part of those compared.
    pub wrong: f64,
}

/// Plans a scene, draws what the plan says and checks it.
///
/// # Errors
///
/// When nothing can be drawn, with a message that says what to do; and when a caster is missing from a map.
pub fn plan(args: &PlanArgs) -> Result<()> {
    let scene = open(&args.view)?;
    let out = output_directory(&args.view, &scene)?;
    let tracer = sort(&scene.mesh)?;
    let (_, view) = place_camera(&args.view, &scene, &tracer)?;
    let gpu = Gpu::new()?;
    say(&format!("drawn by {}", gpu.name()));

    let stage = Stage::new(&gpu, &tracer, &view, [args.view.width, args.view.height])?;
    let stage = stage.with_lamp_near(args.view.lamp_near);
    let specs = choose_lights(&args.view, &scene);
    let lights = specs.iter().map(|&spec| stage.light(spec)).collect::<Result<Vec<_>>>()?;
    let objects = planned::objects(&scene.mesh)?;
    let report = planned(&stage, &lights, &objects, args, scene.name)?;

    for (i, light) in report.lights.iter().enumerate() {
        say(&format!("\nlight {}: {}: {}", i + 1, light.light, light.kind));
        light.reasons.iter().for_each(|reason| say(&format!("  {reason}")));
    }
    say(&format!("\n{}", overview(&report)));
    say(&format!(
        "planned in {:.0} µs: {} passes, {} texels, {} triangles",
        report.plan_us, report.passes, report.texels, report.triangles
    ));
    report::write(&report, &out.join("plan.json"))?;
    say(&format!("wrote plan.json to {}", out.display()));
    let missing: usize = report.lights.iter().map(|light| light.drawn.verdict.counts.missing).sum();
    ensure!(
        missing == 0,
        "{missing} pixels are lit because a caster is missing from a map, or a map from the plan"
    );
    Ok(())
}

/// Plans lights on a stage and draws the plan.
fn planned(
    stage: &Stage<'_>,
    lights: &[StageLight],
    objects: &Objects,
    args: &PlanArgs,
    scene: String,
) -> Result<PlanReport> {
    let budget = args.budget.budget(stage.size[1])?;
    let fitted: Vec<Light> = lights.iter().map(|light| light.light).collect();
    let plan = make_plan(&stage.view, &fitted, objects, &budget);
    let plan_time = median_time(100, || make_plan(&stage.view, &fitted, objects, &budget));
    let of = |(light, of_light)| LightReport::new(stage, light, &plan, of_light, args);
    Ok(PlanReport {
        scene,
        adapter: stage.gpu.name().to_owned(),
        image: stage.size,
        camera: CameraReport::from(&stage.view),
        narrowed: CameraReport::from(plan.view()),
        plan_us: plan_time.as_secs_f64() * 1e6,
        passes: plan.passes(),
        texels: plan.texels(),
        triangles: plan.triangles(),
        lights: lights.iter().zip(plan.lights()).map(of).collect::<Result<_>>()?,
    })
}

impl LightReport {
    fn new(
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

fn overview(report: &PlanReport) -> comfy_table::Table {
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
