//! The hard cases of the property tests: flat, tiny, huge, far out, lit along the view's own planes.

use anyhow::{Context as _, Result};
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadowfit::glam::DVec3;

use super::case::Case;
use super::contender::Contender;
use super::judge::loses;
use super::truth::Truth;
use super::{library, naive, own};
use crate::size::Size;
use render_check::output::progress::bar;
use testkit::arbitrary::{LightParams, SceneParams, ViewParams, case, plane};

/// What became of one hard case.
#[derive(Clone, Debug)]
pub(crate) struct HardFit {
    /// Who fitted.
    pub(crate) contender: &'static str,
    /// Whether nothing came of it, or nothing finite.
    pub(crate) failed: bool,
    /// Whether some of R or of the exact H is left out.
    pub(crate) lost: bool,
}

/// Perspective views and lights infinitely far away, which is what every contender takes, where something can cast on
/// something visible.
///
/// # Errors
///
/// Where a case cannot be made or a contender cannot be set up.
pub(crate) fn measure(size: Size) -> Result<Vec<HardFit>> {
    let wanted = size.of(60, 4000);
    let progress = bar("hard cases", wanted);
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[11; 32]);
    let mut runner = TestRunner::new_with_rng(Config { failure_persistence: None, ..Config::default() }, rng);
    let strategy = case().boxed();
    let contenders = contenders()?;
    let mut fits = Vec::new();
    let mut found = 0;
    while found < wanted {
        let drawn = strategy.new_tree(&mut runner).map_err(|reason| anyhow::anyhow!("no hard case: {reason}"))?;
        let params = drawn.current();
        let is_for_all = matches!(params.view, ViewParams::Perspective { .. })
            && matches!(params.light, LightParams::Directional { .. })
            && !matches!(params.scene, SceneParams::Lists { .. });
        if !is_for_all {
            continue;
        }
        let (view, light) = params.build();
        let store = params.scene.store();
        let scene = store.scene().context("a hard case has no scene")?;
        let (min, max) = params.scene.bounds();
        let cuts = match &params.scene {
            SceneParams::Cut { planes, .. } => planes.iter().copied().map(plane).collect(),
            SceneParams::Bounds { .. } | SceneParams::Lists { .. } => Vec::new(),
        };
        let case = Case::new(view, light, scene, (DVec3::from(min), DVec3::from(max)), cuts)?;
        let planes = case.scene_planes();
        let Some(truth) = Truth::new(&view, &light, &planes, &planes) else { continue };
        for contender in &contenders {
            let fitted = contender.fitted(&case);
            let lost = fitted.as_ref().is_none_or(|fitted| loses(&case, &truth, fitted));
            fits.push(HardFit { contender: contender.name, failed: fitted.is_none(), lost });
        }
        found += 1;
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(fits)
}

/// All that take a light infinitely far away and a scene without lists. None is timed.
fn contenders<'a>() -> Result<Vec<Contender<'a>>> {
    let mut contenders = naive::boxes_and_balls();
    contenders.extend(super::cascades(&[])?);
    contenders.extend(library::libraries());
    contenders.extend(own::of_bounds());
    Ok(contenders)
}
