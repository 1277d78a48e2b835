//! What the tests that draw have in common.

use render_check::cmd::sweep::{GROUPS, Summary, SweepRun, run_shots};
use render_check::gpu::{Gpu, MapPass};
use render_check::run::RunResult;
use render_check::verdict::Verdict;

pub(super) fn gpu() -> Gpu {
    Gpu::new().unwrap_or_else(|error| panic!("{error:#}"))
}

/// Sweeps a group; checks that no caster is missing anywhere, that no false light reaches farther behind its caster than the
/// bias of its map, and that no run has more false pixels than `most`, as a part of what is compared.
pub(super) fn sweep(name: &str, most: f64) -> Vec<SweepRun> {
    let group = GROUPS.iter().find(|group| group.name == name).expect(name);
    let shots = (group.shots)().expect("built in");
    let runs = run_shots(&gpu(), group.name, &shots, || ()).expect("drawn");
    let summary = Summary::of(group.name, &runs);
    assert_eq!(runs.len(), summary.maps + summary.none);
    for run in &runs {
        assert_eq!(run.run.missing(), 0, "{run}");
        assert_eq!(verdict(run).map_or(0, |verdict| verdict.beyond_bias), 0, "{run}");
    }
    assert!(
        summary.worst_false <= most,
        "{name}: {} of the pixels are false in {}",
        summary.worst_false,
        summary.worst.unwrap_or_default()
    );
    runs
}

pub(super) fn passes(run: &SweepRun) -> usize {
    match &run.run.result {
        RunResult::Maps(maps) => maps.passes,
        RunResult::NoMap { .. } => 0,
    }
}

pub(super) fn verdict(run: &SweepRun) -> Option<&Verdict> {
    match &run.run.result {
        RunResult::Maps(maps) => Some(&maps.verdict),
        RunResult::NoMap { .. } => None,
    }
}

pub(super) fn pass(run: &SweepRun) -> MapPass {
    match &run.run.result {
        RunResult::Maps(maps) => maps.maps[0].pass,
        RunResult::NoMap { .. } => panic!("{run}: no map"),
    }
}
