//! The focus body of the crate against the exact one, on cases at random.
//!
//! `cargo test --test focus oracle::bodies -- --nocapture` prints the worst figures. An ordinary run takes
//! 2,500 cases; `SHADOWFIT_CASES=120000` in the environment takes that many. One in six is a scene of
//! lists, whose bounds are the crate's own choice, and is passed over.

use std::cell::RefCell;

use testkit::arbitrary::{case, run, wide_door};
use testkit::oracle::focus::{Figures, check};

#[test]
fn bodies_hold_the_exact_ones_and_little_more() {
    let figures = RefCell::<[Figures; 3]>::default();
    run(2500, &case(), |case| check(&case, &mut figures.borrow_mut()));
    for (figures, name) in figures.borrow_mut().iter_mut().zip(["R", "paper", "tight"]) {
        figures.print(name);
    }
}

/// The same of pyramids, lights within planes, and scenes of up to twelve cuts.
#[test]
fn bodies_through_wide_doors_hold_the_exact_ones_and_little_more() {
    let figures = RefCell::<[Figures; 3]>::default();
    run(300, &wide_door(12), |case| check(&case, &mut figures.borrow_mut()));
}
