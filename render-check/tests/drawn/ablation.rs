//! What a plan leaves out costs no pixels beyond a bound, and what it asks for pays.

use render_check::cmd::ablation::{Ablation, CASES, Effect};
use render_check::gpu::Gpu;

/// Width of the pictures, in pixels.
const WIDTH: u32 = 240;

fn all() -> Vec<(bool, Ablation)> {
    let gpu = Gpu::new().unwrap_or_else(|error| panic!("{error:#}"));
    let of = |case| Ablation::of(&gpu, case, WIDTH, 1).unwrap_or_else(|error| panic!("{case:?}: {error:#}"));
    CASES.iter().map(|case| (case.is_asked_for, of(case))).collect()
}

/// By [`render_check::cmd::ablation::MOST_COST`] and [`render_check::cmd::ablation::LEAST_GAIN`].
#[test]
fn leaving_out_costs_no_pixels_and_putting_in_pays() {
    for (is_asked_for, ablation) in all() {
        assert_eq!(ablation.is_asked_for, is_asked_for, "{ablation:?}");
        assert_eq!(ablation.complaint(), None, "{ablation:?}");
    }
}

#[test]
fn every_effect_is_left_out_once_and_asked_for_once() {
    let effects = [
        Effect::Map,
        Effect::Warp,
        Effect::BackShift,
        Effect::SeveralMaps,
        Effect::FaceDropping,
        Effect::SecondDepth,
        Effect::VirtualSamples,
        Effect::Filter,
        Effect::FullSize,
        Effect::Culling,
        Effect::Narrowing,
    ];
    for effect in effects {
        for is_asked_for in [false, true] {
            assert!(
                CASES.iter().any(|case| (case.effect, case.is_asked_for) == (effect, is_asked_for)),
                "{effect}"
            );
        }
    }
}
