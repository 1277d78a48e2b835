//! Ablation of plans: each effect that a plan can do without is drawn with it and without it and compared with
//! ray-traced truth, for one light where the plan uses it and one where it does not.

mod args;
mod cases;
mod effect;
mod setup;
mod sides;

use anyhow::{Context, Result, ensure};
use serde::Serialize;

pub use args::AblationArgs;
pub(crate) use args::HELP;
pub use cases::{CASES, Case};
pub use effect::{Buys, Effect};

use crate::gpu::Gpu;
use crate::output::progress::bar;
use crate::output::table::{number, percent};
use crate::output::{make_directory, say, table, write_json};
use crate::run::{MapRun, planned};
use crate::scene;
use crate::stage::{Stage, StageLight};
use crate::trace::Tracer;
use crate::verdict::{Aliasing, Verdict, share};
use setup::{Maps, Setup};
use sides::Sides;

/// Where a plan does without an effect: the largest increase of wrong pixels allowed, as a fraction of the compared
/// pixels. Twice the largest that was measured, 0.1 %, where a map of 512² texels replaces one of 4096² in an image
/// 240 pixels wide.
pub const MOST_COST: f64 = 0.002;

/// Where a plan uses an effect: the smallest factor by which wrong pixels, texel size or work (whichever the effect
/// is for) must grow without it.
pub const LEAST_GAIN: f64 = 1.1;

/// One case, drawn with its effect and without.
#[derive(Clone, Debug, Serialize)]
pub struct Ablation {
    /// The effect.
    pub effect: Effect,
    /// What it is for.
    pub buys: Buys,
    /// The scene, by its name.
    pub scene: &'static str,
    /// The light, in the command line's spelling.
    pub light: String,
    /// Whether the plan uses it.
    pub is_asked_for: bool,
    /// The plan's reasons.
    pub reasons: Vec<String>,
    /// With the effect.
    pub with: Side,
    /// Without it.
    pub without: Side,
}

/// The result of drawing with the effect or without it.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Side {
    /// Pixels compared.
    pub compared: usize,
    /// Wrong pixels, those at edges included.
    pub wrong: usize,
    /// False shadow and false light away from edges.
    pub false_pixels: usize,
    /// Pixels that are lit because a caster or a whole map is missing.
    pub missing: usize,
    /// Wrong pixels at edges.
    pub edge: usize,
    /// Texel size over pixel size; `None` without a map.
    pub aliasing: Option<Aliasing>,
    /// Maps drawn.
    pub passes: usize,
    /// Texels of all of them.
    pub texels: usize,
    /// Triangles drawn into all of them.
    pub triangles: usize,
    /// Time of the maps' passes, in milliseconds; `None` on a GPU without timestamps.
    pub map_ms: Option<f64>,
    /// Time of the shadow test.
    pub test_ms: Option<f64>,
}

impl Side {
    /// Wrong pixels as a fraction of those compared.
    #[must_use]
    pub fn wrong_share(&self) -> f64 {
        share(self.wrong, self.compared)
    }

    fn new(verdict: &Verdict, run: Option<&MapRun>) -> Self {
        let counts = &verdict.counts;
        Self {
            compared: counts.compared,
            wrong: counts.wrong(),
            false_pixels: counts.false_shadow + counts.false_light,
            missing: counts.missing,
            edge: counts.edges(),
            aliasing: verdict.aliasing,
            passes: run.map_or(0, |run| run.depths.len()),
            texels: run.map_or(0, |run| run.depths.iter().map(Vec::len).sum()),
            triangles: run.map_or(0, |run| run.drawn.triangles),
            map_ms: run.map_or(Some(0.0), |run| run.times.shadow_map_ms),
            test_ms: run.map_or(Some(0.0), |run| run.times.shadow_test_ms),
        }
    }

    fn draw(setup: &Setup<'_>, maps: Option<Maps>) -> Result<Self> {
        Ok(match maps {
            Some(maps) => {
                let run = setup.draw(maps)?;
                Self::new(&run.verdict, Some(&run))
            }
            None => Self::new(&Verdict::without_map(&setup.light.truth), None),
        })
    }
}

impl Ablation {
    /// Increase of wrong pixels without the effect, as a fraction of those compared; negative where there are
    /// fewer.
    #[must_use]
    pub fn cost_of_leaving_out(&self) -> f64 {
        self.without.wrong_share() - self.with.wrong_share()
    }

    /// The gain of the effect: the factor by which wrong pixels or texel size, or for effects that save work
    /// passes, texels or triangles, grow without it.
    #[must_use]
    pub fn gain(&self) -> f64 {
        let ratio = |of: &dyn Fn(&Side) -> f64| match (of(&self.without), of(&self.with)) {
            (without, with) if without == with => 1.0,
            (without, with) => without / with,
        };
        let p95 = |side: &Side| side.aliasing.map_or(f64::NAN, |aliasing| aliasing.p95);
        let gains = match self.buys {
            Buys::Accuracy => vec![ratio(&|side| side.wrong as f64), ratio(&p95)],
            Buys::Work => vec![
                ratio(&|side| side.passes as f64),
                ratio(&|side| side.texels as f64),
                ratio(&|side| side.triangles as f64),
            ],
        };
        gains.into_iter().fold(0.0, f64::max)
    }

    /// The plan's mistake by [`MOST_COST`] and [`LEAST_GAIN`], if it made one.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        let planned = if self.is_asked_for { &self.with } else { &self.without };
        let cost = match (self.buys, self.is_asked_for) {
            // Saved work must not cost pixels either.
            (Buys::Work, _) => -self.cost_of_leaving_out(),
            (Buys::Accuracy, true) => 0.0,
            (Buys::Accuracy, false) => self.cost_of_leaving_out(),
        };
        if planned.missing > 0 {
            Some(format!("{} pixels miss a caster", planned.missing))
        } else if cost > MOST_COST {
            Some(format!("{} more of the pixels are wrong as planned", percent(cost)))
        } else if self.is_asked_for && self.gain() < LEAST_GAIN {
            Some(format!("it gains no more than a factor of {}", number(self.gain())))
        } else {
            None
        }
        .map(|complaint| format!("{}, {}, {}: {complaint}", self.effect, self.scene, self.light))
    }

    /// Draws a case with its effect and without it, `frames` times each, in an image `width` pixels wide.
    ///
    /// # Errors
    ///
    /// When it cannot be drawn, or the plan has no place for its effect.
    pub fn of(gpu: &Gpu, case: &Case, width: u32, frames: u32) -> Result<Self> {
        let scene = scene::load(case.scene.as_ref())?;
        let tracer = Tracer::new(&scene.mesh)?;
        let size = [width, width * 5 / 8];
        let view = case.view(&scene, f64::from(size[0]) / f64::from(size[1]))?;
        let stage = Stage::new(gpu, &tracer, &view, size)?;
        let light: StageLight = stage.light(case.light()?)?;
        let objects = planned::objects(&scene.mesh)?;
        let setup = Setup::new(&stage, &light, &objects, case.budget(size[1])?, frames);
        let Sides { is_asked_for, with, without } = Sides::new(case.effect, &setup)?;
        Ok(Self {
            effect: case.effect,
            buys: case.effect.buys(),
            scene: case.scene,
            light: light.spec.to_string(),
            is_asked_for,
            reasons: setup.of_light().reasons().iter().map(ToString::to_string).collect(),
            with: Side::draw(&setup, with)?,
            without: Side::draw(&setup, without)?,
        })
    }
}

/// Draws all cases, or those of the effects that the arguments name.
///
/// # Errors
///
/// When one cannot be drawn, with a hint.
pub fn ablation(args: &AblationArgs) -> Result<()> {
    let is_asked_for = |case: &Case| {
        let name = case.effect.to_string();
        args.effects.is_empty() || args.effects.iter().any(|word| name.contains(word))
    };
    let cases: Vec<&Case> = CASES.iter().filter(|case| is_asked_for(case)).collect();
    ensure!(!cases.is_empty(), "no effect is called that");
    make_directory(&args.out)?;
    let gpu = Gpu::new()?;
    say(&format!("drawn by {}", gpu.name()));
    let bar = bar("drawing", cases.len());
    let mut all = Vec::new();
    for case in cases {
        let of = Ablation::of(&gpu, case, args.width, args.frames);
        all.push(of.with_context(|| format!("{}, {}, {}", case.effect, case.scene, case.light))?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    say(&overview(&all).to_string());
    write_json(&all, &args.out.join("ablation.json"))?;
    say(&format!("wrote ablation.json to {}", args.out.display()));
    let complaints: Vec<String> = all.iter().filter_map(Ablation::complaint).collect();
    ensure!(complaints.is_empty(), "the plan does not pay: {}", complaints.join("; "));
    Ok(())
}

fn overview(all: &[Ablation]) -> comfy_table::Table {
    let header = [
        "effect",
        "scene, light",
        "asked",
        "wrong",
        "false",
        "aliasing",
        "passes",
        "Mtexels",
        "triangles",
        "map",
        "test",
    ];
    let mut table = table::new(header, 3..header.len());
    for ablation in all {
        let both = |of: &dyn Fn(&Side) -> String| format!("{} / {}", of(&ablation.with), of(&ablation.without));
        let part = |side: &Side, count: usize| percent(share(count, side.compared));
        let ms = |time: Option<f64>| time.map_or_else(|| "-".into(), |ms| format!("{ms:.2}"));
        table.add_row([
            ablation.effect.to_string(),
            format!("{}, {}", ablation.scene, ablation.light),
            if ablation.is_asked_for { "yes" } else { "no" }.to_owned(),
            both(&|side| part(side, side.wrong)),
            both(&|side| part(side, side.false_pixels + side.missing)),
            both(&|side| side.aliasing.map_or_else(|| "-".into(), |aliasing| number(aliasing.p95))),
            both(&|side| side.passes.to_string()),
            both(&|side| format!("{:.2}", side.texels as f64 * 1e-6)),
            both(&|side| side.triangles.to_string()),
            both(&|side| ms(side.map_ms)),
            both(&|side| ms(side.test_ms)),
        ]);
    }
    table
}
