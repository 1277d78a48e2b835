//! The smoke-sized chapter, made once, and what must hold of it.

use std::sync::LazyLock;

use render_check::maps::Technique;

use super::cases::{ALL_WARPS, KINDS, comparisons};
use super::{Measured, chapter, measure};
use crate::chapter::Part;
use crate::size::Size;

static SMOKE: LazyLock<Measured> =
    LazyLock::new(|| measure(Size::Smoke).expect("there is an adapter with a clock"));

#[test]
fn every_contender_is_counted_in_every_scene() {
    for comparison in comparisons(Size::Smoke) {
        let expected = comparison.shots.len() * comparison.narrowed.len() * comparison.contenders.len();
        let drawn = SMOKE.records.iter().filter(|it| it.comparison == comparison.name).count();
        let refused = SMOKE.refused.iter().filter(|it| it.comparison == comparison.name).count();
        assert_eq!(drawn + refused, expected, "{}", comparison.name);
    }
}

#[test]
fn only_single_frusta_are_refused_and_only_a_lamp_in_view() {
    assert!(!SMOKE.refused.is_empty());
    for refused in &SMOKE.refused {
        let technique = refused.contender.technique;
        assert!(refused.comparison == KINDS && !technique.has_faces() && !technique.is_paraboloid(), "{refused:?}");
    }
}

#[test]
fn figures_are_what_they_are_said_to_be() {
    for record in &SMOKE.records {
        assert_eq!(record.missing, 0);
        assert_eq!(record.wrong, record.false_shadow + record.false_light + record.edge, "{record:?}");
        assert!(record.wrong <= record.compared && record.compared > 0, "{record:?}");
        assert!(record.fit_us > 0.0 && record.map_ms > 0.0 && record.test_ms > 0.0, "{record:?}");
        // No map has finer texels everywhere than any spread of them could have.
        assert!(record.predicted.is_none_or(|predicted| predicted > 0.99 * record.limit), "{record:?}");
    }
    for fits in &SMOKE.survey {
        assert!(fits.over_limit_50 > 0.99 && fits.worst_10 <= fits.worst_50 && fits.worst_50 <= fits.worst_90);
    }
}

#[test]
fn the_first_contender_is_one_on_both_axes() {
    for narrowed in [true, false] {
        let middle = SMOKE.warp(narrowed, Technique::Uniform, 1, SMOKE.middle_size).expect("it was drawn");
        assert_eq!((middle.wrong_ratio, middle.time_ratio, middle.aliasing_ratio), (1.0, 1.0, 1.0));
        for technique in ALL_WARPS {
            for kind in ["sun", "lamp", "spot"] {
                let price = SMOKE.price(technique, kind, narrowed).expect("it was measured");
                assert!(price.wrong_ratio > 0.0 && price.fit_us > 0.0);
                assert!(technique != Technique::Uniform || (price.worst_median, price.coarser_share) == (1.0, 0.0));
            }
        }
    }
}

#[test]
fn the_chapter_is_whole() {
    let chapter = chapter(&SMOKE).expect("figures can be written");
    assert!(chapter.opening.contains(&SMOKE.adapter));
    for part in &chapter.parts {
        match part {
            Part::Table(table) => {
                assert!(!table.lines.is_empty(), "{}", table.caption);
                assert!(table.lines.iter().all(|line| line.len() == table.columns.len()), "{}", table.caption);
            }
            Part::Plot(plot) => {
                assert!(plot.series.iter().all(|series| !series.points.is_empty()), "{}", plot.name);
                let points = || plot.series.iter().flat_map(|series| &series.points);
                assert!(points().all(|point| point.x > 0.0 && point.y >= 0.0), "{}", plot.name);
            }
        }
    }
    for raw in &chapter.raw {
        let fields = |index: usize| raw.records[index].keys().collect::<Vec<_>>();
        assert!((1..raw.records.len()).all(|index| fields(index) == fields(0)), "{}", raw.name);
    }
    assert!(chapter.findings.iter().all(|found| !found.contains("NaN")), "{:#?}", chapter.findings);
}
