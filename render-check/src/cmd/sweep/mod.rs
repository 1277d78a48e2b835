//! The hard cases, as small images of built-in scenes: drawn with every technique and compared with ray-traced
//! truth.

mod args;
mod cases;
mod faults;
mod groups;
mod lights;
mod shot;
mod surfaces;

use std::fmt;

use anyhow::{Context, Result, ensure};
use comfy_table::Table;
use serde::Serialize;
use shadowfit::Origin;

pub(crate) use args::HELP;
pub use args::SweepArgs;
pub use groups::{GROUPS, Group};
pub use shot::{IMAGE, Shot};

use crate::gpu::Gpu;
use crate::output::progress::bar;
use crate::output::table::percent;
use crate::output::{make_directory, say, table, write_json};
use crate::run::{RunReport, RunResult, run};
use crate::stage::Stage;
use crate::trace::Tracer;
use crate::verdict::share;

/// A run of a sweep.
#[derive(Clone, Debug, Serialize)]
pub struct SweepRun {
    /// The group it belongs to.
    pub group: &'static str,
    /// Description of shot and light.
    pub case: String,
    /// The result.
    #[serde(flatten)]
    pub run: RunReport,
}

/// Builds the cases of a group.
type Shots<'a> = Box<dyn Fn() -> Result<Vec<Shot>> + 'a>;

/// Sweeps over the groups that the arguments name, or over all.
///
/// # Errors
///
/// When nothing can be drawn, with a hint; when a caster is missing from a map; and when false light reaches farther
/// behind a caster than the map's bias does.
pub fn sweep(args: &SweepArgs) -> Result<()> {
    let is_asked_for = |name: &str| args.groups.is_empty() || args.groups.iter().any(|word| name.contains(word));
    let groups = GROUPS.iter().filter(|group| args.through.is_none() && is_asked_for(group.name));
    let mut cases: Vec<(&str, Shots)> = groups.map(|group| (group.name, Box::new(group.shots) as Shots)).collect();
    if let Some(scene) = &args.through {
        cases.push(("through-all", Box::new(|| surfaces::through_all_of(scene))));
    }
    ensure!(!cases.is_empty(), "no group is called that: there are {}", GROUPS.map(|group| group.name).join(", "));
    make_directory(&args.out)?;
    let gpu = Gpu::new()?;
    say(&format!("drawn by {}", gpu.name()));

    let mut runs = Vec::new();
    let mut summaries = Vec::new();
    for (name, shots) in cases {
        let shots = shots()?;
        let bar = bar(name, shots.iter().map(Shot::runs).sum());
        let of_group = run_shots(&gpu, name, &shots, || bar.inc(1))?;
        bar.finish_and_clear();
        summaries.push(Summary::of(name, &of_group));
        runs.extend(of_group);
    }
    say(&overview(&summaries).to_string());
    for summary in &summaries {
        if let Some(worst) = &summary.worst {
            say(&format!("{}: {} false at worst: {worst}", summary.group, percent(summary.worst_false)));
        }
    }
    write_json(&runs, &args.out.join("sweep.json"))?;
    say(&format!("wrote sweep.json to {}", args.out.display()));
    let missing: usize = summaries.iter().map(|summary| summary.missing).sum();
    ensure!(missing == 0, "{missing} pixels are lit because a caster is missing from a map");
    let beyond: usize = summaries.iter().map(|summary| summary.beyond_bias).sum();
    ensure!(beyond == 0, "{beyond} pixels are lit farther behind their casters than the map's bias reaches");
    Ok(())
}

/// Runs all shots of a group; `done` is called after each run.
///
/// # Errors
///
/// When a case cannot be drawn.
pub fn run_shots(gpu: &Gpu, group: &'static str, shots: &[Shot], done: impl Fn()) -> Result<Vec<SweepRun>> {
    let mut runs = Vec::new();
    for shot in shots {
        let tracer = Tracer::new(&shot.scene.mesh)?;
        let stage = Stage::new(gpu, &tracer, &shot.view, shot.image)?;
        let stage = match shot.origin {
            Origin::World => stage.in_world_space()?,
            _ => stage,
        };
        for (words, spec) in &shot.lights {
            let light = stage.light(*spec).with_context(|| format!("{group}: {}, {words}", shot.name))?;
            for options in &shot.options {
                let run = RunReport::new(&shot.view, &light, options, &run(&stage, &light, options)?);
                runs.push(SweepRun { group, case: format!("{}, {words}", shot.name), run });
                done();
            }
        }
    }
    Ok(runs)
}

/// Summary of a group.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// The group.
    pub group: &'static str,
    /// Runs with maps.
    pub maps: usize,
    /// Runs that need no map.
    pub none: usize,
    /// Pixels compared in all of them.
    pub compared: usize,
    /// Pixels lit because a caster is missing.
    pub missing: usize,
    /// False shadow and false light.
    pub faults: usize,
    /// Pixels with false light farther behind their casters than the bias reaches.
    pub beyond_bias: usize,
    /// Wrong pixels at edges.
    pub edges: usize,
    /// The largest share of false pixels in a run, 0 to 1.
    pub worst_false: f64,
    /// That run, if there is any false pixel.
    pub worst: Option<String>,
}

impl Summary {
    /// Sums up the runs of a group.
    #[must_use]
    pub fn of(group: &'static str, runs: &[SweepRun]) -> Self {
        let mut summary = Self { group, ..Self::default() };
        for sweep_run in runs {
            summary.missing += sweep_run.run.missing();
            let RunResult::Maps(maps) = &sweep_run.run.result else {
                summary.none += 1;
                continue;
            };
            let counts = &maps.verdict.counts;
            summary.maps += 1;
            summary.compared += counts.compared;
            summary.faults += counts.faults();
            summary.beyond_bias += maps.verdict.beyond_bias;
            summary.edges += counts.edges();
            let share = counts.fraction(counts.faults());
            if share > summary.worst_false {
                summary.worst_false = share;
                summary.worst = Some(sweep_run.to_string());
            }
        }
        summary
    }
}

impl fmt::Display for SweepRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RunReport { light, class, technique, map_size, cascading, filter, .. } = &self.run;
        write!(f, "{} ({light}, {class}), {technique} {map_size}, {filter}", self.case)?;
        cascading.map_or(Ok(()), |cascading| write!(f, ", {} cascades, {}", cascading.count, cascading.split))
    }
}

fn overview(summaries: &[Summary]) -> Table {
    let header =
        ["group", "maps", "no map", "pixels compared", "missing", "beyond bias", "false", "edge", "false at worst"];
    let mut table = table::new(header, 1..header.len());
    for summary in summaries {
        table.add_row([
            summary.group.to_owned(),
            summary.maps.to_string(),
            summary.none.to_string(),
            summary.compared.to_string(),
            summary.missing.to_string(),
            summary.beyond_bias.to_string(),
            percent(share(summary.faults, summary.compared)),
            percent(share(summary.edges, summary.compared)),
            percent(summary.worst_false),
        ]);
    }
    table
}
