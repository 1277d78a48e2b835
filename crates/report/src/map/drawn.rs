//! Contenders drawn and held against rays once, and then timed in turn.

use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, bail, ensure};
use render_check::gpu::Gpu;
use render_check::maps::NoMap;
use render_check::output::progress::bar;
use render_check::run::{FittedMaps, Frames, MapRun, Options, run};
use render_check::scene;
use render_check::stage::{Stage, StageLight, choose_view};
use render_check::trace::Tracer;
use shadowfit::Settings;

use super::cases::{Comparison, Shot};
use super::record::{Contender, Record, Refused};
use crate::statistics::median;
use crate::timing::{Time, in_turn, taken};

/// So many fits are timed at once: one is too short for the clock.
const FITS: u32 = 10;

/// How contenders are drawn and timed.
#[derive(Clone, Copy, Debug)]
pub struct Manner {
    /// Width and height of the camera's image, in pixels.
    pub image: [u32; 2],
    /// How often each has its turn.
    pub rounds: usize,
}

/// What came of all comparisons.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Of contenders with maps.
    pub records: Vec<Record>,
    /// Of those without.
    pub refused: Vec<Refused>,
}

/// Draws and times all contenders of all comparisons. What is true is traced once for each scene and light.
///
/// # Errors
///
/// When something cannot be drawn or timed, and when a caster is missing from a map: there must be none.
pub fn drawn(gpu: &Gpu, comparisons: &[Comparison], manner: Manner) -> Result<Drawn> {
    let mut shots: Vec<Shot> = Vec::new();
    for shot in comparisons.iter().flat_map(|comparison| &comparison.shots) {
        if !shots.contains(shot) {
            shots.push(*shot);
        }
    }
    let contenders =
        |comparison: &Comparison| comparison.shots.len() * comparison.narrowed.len() * comparison.contenders.len();
    let bar = bar("wrong pixels over time", comparisons.iter().map(contenders).sum());
    let mut all = Drawn::default();
    for shot in shots {
        let at = || format!("{} under {}", shot.scene, shot.light);
        let scene = scene::load(Path::new(shot.scene))?;
        let tracer = Tracer::new(&scene.mesh)?;
        let camera = scene.camera.with_context(|| format!("the scene '{}' has no camera", shot.scene))?;
        let aspect = f64::from(manner.image[0]) / f64::from(manner.image[1]);
        let (view, _) = choose_view(&camera, aspect, &tracer)?;
        let mut stage = Stage::new(gpu, &tracer, &view, manner.image)?.narrowed()?;
        let seen = stage.fitted_view;
        let light = stage.light(shot.light.parse().map_err(anyhow::Error::msg)?)?;
        for comparison in comparisons.iter().filter(|comparison| comparison.shots.contains(&shot)) {
            for &narrowed in comparison.narrowed {
                stage.fitted_view = if narrowed { seen } else { view };
                let case = Case { comparison: comparison.name, shot, narrowed, stage: &stage, light: &light };
                let of_case = case.drawn(&comparison.contenders, manner.rounds, || bar.inc(1)).with_context(at)?;
                all.records.extend(of_case.records);
                all.refused.extend(of_case.refused);
            }
        }
    }
    Ok(all)
}

/// One comparison before one scene under one light.
struct Case<'a> {
    comparison: &'static str,
    shot: Shot,
    narrowed: bool,
    stage: &'a Stage<'a>,
    light: &'a StageLight,
}

/// A contender that has maps.
struct Judged {
    options: Options,
    settings: Settings,
    run: MapRun,
}

impl Case<'_> {
    fn drawn(&self, contenders: &[Options], rounds: usize, done: impl Fn()) -> Result<Drawn> {
        let (mut judged, mut refused) = (Vec::new(), Vec::new());
        for options in contenders {
            let name = || format!("{}: {}", self.comparison, options.name());
            match run(self.stage, self.light, options).with_context(name)? {
                Ok(run) => judged.push(self.judged(options, run).with_context(name)?),
                Err(NoMap::Empty(why)) => bail!("{}: {why}, although there are shadows", name()),
                Err(NoMap::Surrounded(why)) => refused.push(Refused {
                    comparison: self.comparison,
                    scene: self.shot.scene,
                    light: self.shot.light,
                    narrowed: self.narrowed,
                    contender: options.into(),
                    why: why.to_string(),
                }),
            }
            done();
        }
        let first = judged.first().context("nobody has a map")?;
        ensure!(first.options == contenders[0], "the contender that all are held against has no map");
        let mut turns: Vec<_> = judged.iter().map(|judged| Turn::new(self.stage, judged)).collect::<Result<_>>()?;
        let mut in_order: Vec<Box<dyn FnMut() -> Result<Duration>>> = Vec::new();
        for turn in &mut turns {
            in_order.push(Box::new(|| turn.taken()));
        }
        let times = in_turn(rounds, &mut in_order)?;
        drop(in_order);
        let base = first.run.verdict.counts.wrong();
        let records = judged.iter().zip(&turns).zip(&times);
        let records =
            records.map(|((judged, turn), time)| self.record(judged, turn, time, base)).collect::<Result<_>>()?;
        Ok(Drawn { records, refused })
    }

    fn judged(&self, options: &Options, mut run: MapRun) -> Result<Judged> {
        let missing = run.verdict.counts.missing;
        ensure!(missing == 0, "{missing} pixels are lit because a caster is missing from a map");
        // What is drawn again has no use for these, which are the largest part of it.
        run.depths = Vec::new();
        Ok(Judged { options: *options, settings: options.settings(self.stage)?, run })
    }

    fn record(&self, judged: &Judged, turn: &Turn<'_>, time: &Time, base: usize) -> Result<Record> {
        let MapRun { fitted, drawn, verdict, prediction, .. } = &judged.run;
        let (counts, size) = (&verdict.counts, u64::from(judged.options.map_size));
        let aliasing = verdict.aliasing.context("nothing that is seen is lit or in shadow")?;
        let passes = fitted.maps.iter().flatten().count();
        let [fit, map, test] =
            [0, 1, 2].map(|part| median(&turn.parts.iter().map(|it| it[part]).collect::<Vec<_>>()));
        Ok(Record {
            adapter: self.stage.gpu.name().to_owned(),
            comparison: self.comparison,
            scene: self.shot.scene,
            light: self.shot.light,
            narrowed: self.narrowed,
            contender: Contender::from(&judged.options),
            passes,
            texels: passes as u64 * size * size,
            triangles: drawn.triangles,
            compared: counts.compared,
            wrong: counts.wrong(),
            false_shadow: counts.false_shadow,
            false_light: counts.false_light,
            edge: counts.edges(),
            missing: counts.missing,
            wrong_share: counts.fraction(counts.wrong()),
            wrong_ratio: (counts.wrong() + 1) as f64 / (base + 1) as f64,
            aliasing_worst: aliasing.worst,
            aliasing_median: aliasing.median,
            predicted: prediction.predicted,
            limit: prediction.limit,
            fit_us: 1e6 * fit,
            map_ms: 1e3 * map,
            test_ms: 1e3 * test,
            frame_ms: 1e3 * time.seconds,
            time_ratio: time.ratio,
            time_ratio_low: time.spread[0],
            time_ratio_high: time.spread[1],
        })
    }
}

/// A contender's turns.
struct Turn<'a> {
    stage: &'a Stage<'a>,
    fitted: &'a FittedMaps,
    settings: Settings,
    frames: Frames<'a>,
    /// Seconds of fit, maps and test, a turn each.
    parts: Vec<[f64; 3]>,
}

impl<'a> Turn<'a> {
    fn new(stage: &'a Stage<'a>, judged: &'a Judged) -> Result<Self> {
        let fitted = &judged.run.fitted;
        let frames = Frames::new(stage, fitted, judged.options.filter)?;
        Ok(Self { stage, fitted, settings: judged.settings, frames, parts: Vec::new() })
    }

    /// A frame as a renderer has it: fitted, drawn, tested.
    fn taken(&mut self) -> Result<Duration> {
        let fits = || (0..FITS).map(|_| self.fitted.fit_again(None, self.stage, &self.settings)).sum::<usize>();
        let fit = taken(fits) / FITS;
        let frame = self.frames.draw()?;
        let clock =
            || anyhow!("{} has no clock: choose another adapter by WGPU_ADAPTER_NAME", self.stage.gpu.name());
        let (map, test) = frame.shadow_maps.zip(frame.shadows.time).ok_or_else(clock)?;
        self.parts.push([fit, map, test].map(|time| time.as_secs_f64()));
        Ok(fit + map + test)
    }
}
