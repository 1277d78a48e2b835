//! The inputs that fuzzing has kept, through the same claims on a stable compiler.
//!
//! `fuzz/run.sh SECONDS` finds more of them.

use proptest::prelude::*;
use std::path::Path;
use testkit::arbitrary::{ShownOnPanic, case_with, numbers, replay};
use testkit::claims::targets;
use testkit::oracle::focus::check_case;

#[test]
fn constructors() {
    replay("constructors", targets::constructors);
}

#[test]
fn fit() {
    replay("fit", targets::fit);
}

#[test]
fn focus() {
    replay("focus", |bytes| {
        if let Some((case, ())) = case_with(Just(()), bytes) {
            let _shown = ShownOnPanic(&case);
            check_case(&case);
        }
    });
}

#[test]
fn paraboloid() {
    replay("paraboloid", targets::paraboloid);
}

#[test]
fn virtual_samples() {
    replay("virtual_samples", targets::virtual_samples);
}

#[cfg(feature = "alloc")]
#[test]
fn planner() {
    replay("planner", targets::planner);
}

/// A target that is not replayed would not be missed.
#[test]
fn every_target_is_replayed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/fuzz_targets");
    let targets = std::fs::read_dir(folder).expect("the targets").map(|entry| entry.expect("a readable folder"));
    let mut targets: Vec<String> =
        targets.filter_map(|entry| Some(entry.path().file_stem()?.to_str()?.to_owned())).collect();
    targets.sort();
    assert_eq!(targets, ["constructors", "fit", "focus", "paraboloid", "planner", "virtual_samples"]);
}

/// What makes a mutation of an input worth trying: another seed is another case, and a few bytes after it change a number.
#[test]
fn bytes_make_cases_and_their_neighbours() {
    let case_of = |bytes: &[u8]| case_with(Just(()), bytes).map(|(case, ())| case);
    assert_eq!(case_of(&[1; 7]), None);
    let cases: Vec<_> =
        (0..200).filter_map(|seed: u64| case_of(&seed.to_le_bytes()).map(|case| (seed, case))).collect();
    assert!(cases.len() > 190, "{}", cases.len());
    let mut neighbours = 0;
    for (at, (seed, case)) in cases.iter().enumerate() {
        assert!(cases[..at].iter().all(|(_, other)| other != case), "{seed} is {case:?} again");
        // The fourth number, the first of the forward axis, a step further.
        let Some(changed) = case_of(&[&seed.to_le_bytes()[..], &[3, 1, 1, 0]].concat()) else { continue };
        let differences = numbers(case).iter().zip(numbers(&changed)).filter(|(a, b)| **a != *b).count();
        assert_eq!(differences, 1, "{case:?} and {changed:?}");
        neighbours += 1;
    }
    assert!(neighbours > 190, "{neighbours}");
}
