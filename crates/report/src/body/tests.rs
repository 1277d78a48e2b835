//! A small run of it all.

use super::*;
use crate::chapter::Part;
use contender::{Culling, Fitted};
use shadowfit::focus::Plane;
use shadowfit::glam::DVec3;

#[test]
fn a_small_run_makes_a_chapter_of_every_contender() {
    let measured = measure(Size::Smoke).expect("it runs");
    let contenders = |light: &str| {
        let of_light = measured.summaries.iter().filter(|summary| summary.light == light);
        of_light.map(|summary| summary.contender).collect::<Vec<_>>()
    };
    let bevy = if cfg!(feature = "bevy") { 2 } else { 0 };
    assert_eq!([SUN, LAMP, SPOT].map(|light| contenders(light).len()), [10 + bevy, 6, 7]);

    for summary in &measured.summaries {
        let fits = measured.fits.iter().filter(|fit| {
            fit.light == summary.light
                && fit.contender == summary.contender
                && fit.needed == fit.needed.min(fit.casters)
        });
        assert_eq!(fits.count(), summary.cases, "{summary:?}");
        assert!(summary.nanoseconds > 0.0 && summary.needed <= summary.casters as f64, "{summary:?}");
        assert!(
            summary.over_least.is_none_or(|over| over > 0.999),
            "no window is less than the least: {summary:?}"
        );
        if own::NAMES.contains(&summary.contender) {
            assert_eq!((summary.failed, summary.missing), (0, 0.0), "the crate loses nothing: {summary:?}");
            assert_eq!(summary.hard_lost.unwrap_or(0.0), 0.0, "the crate loses nothing: {summary:?}");
            assert_eq!(summary.receivers_cut, 0.0, "{summary:?}");
        }
    }

    let chapter = chapter(&measured).expect("it was measured");
    assert_eq!(chapter.opening.contains("without the feature"), bevy == 0);
    assert!(chapter.findings.len() >= 9, "{:?}", chapter.findings);
    for part in &chapter.parts {
        match part {
            Part::Table(table) => {
                assert!(table.lines.iter().all(|line| line.len() == table.columns.len()), "{}", table.caption);
            }
            Part::Plot(plot) => {
                let points: usize = plot.series.iter().map(|series| series.points.len()).sum();
                assert_eq!(points, 10 + bevy, "{}", plot.name);
            }
        }
    }
}

#[test]
fn all_contenders_have_the_same_cases() {
    let town = Town::new(1);
    let lists = Scene::new(&town.casters, &town.receivers).expect("a sound town");
    let (first, truths) = cases(Kind::Sun, Size::Smoke, &town, &lists).expect("they can be made");
    let (second, _) = cases(Kind::Sun, Size::Smoke, &town, &lists).expect("they can be made");
    assert_eq!(first.len(), truths.len());
    assert!(first.iter().zip(&second).all(|(a, b)| a.view == b.view && a.light == b.light));
    assert!(truths.iter().all(|truth| !truth.seen.is_empty()));
}

#[test]
fn casters_are_missing_where_they_are_not_drawn_or_cut() {
    let town = Town::new(1);
    let lists = Scene::new(&town.casters, &town.receivers).expect("a sound town");
    let (cases, truths) = cases(Kind::Sun, Size::Smoke, &town, &lists).expect("they can be made");
    let mut bench = Bench::new(SUN, 0, &cases[0], &town, &truths[0]);
    let mut judge = |clip: Vec<Plane>, culling: Culling| {
        bench.judge("anyone", Some(&Fitted { shadow_from_world: None, clip, culling }))
    };
    // One plane that holds all of the town, and one that holds none of it.
    let [held, lost] = [1.0, -1.0].map(|offset| Plane::new(DVec3::Y * 1e-3, offset));
    let everyone = || Culling::Planes(Vec::new());

    let sound = judge(vec![held], everyone());
    assert_eq!((sound.drawn, sound.missing()), (town.casters.len(), 0));
    assert!(sound.needed > 0);
    assert_eq!(judge(vec![held, lost], everyone()).cut, sound.needed);
    assert_eq!(judge(vec![held], Culling::Nobody).undrawn, sound.needed);
    assert_eq!(judge(vec![held], Culling::Planes(vec![lost])).undrawn, sound.needed);

    let failed = bench.judge("nobody", None);
    assert!(failed.failed && failed.receivers_cut && failed.missing() == sound.needed);
}
