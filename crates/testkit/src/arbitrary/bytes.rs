//! From the bytes of a fuzzer to the values of the same strategies that the property tests draw from.
//!
//! proptest can take a fuzzer's bytes for its random numbers, but halves what is left of them for each option of a
//! `prop_oneof!` that it passes over, and two dozen unions deep there is nothing left. So the first eight bytes are a
//! seed, and what follows changes the value drawn, a little at a time: a mutation of those bytes is a neighbour of
//! the case, which is what coverage can climb on.

use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::edits::edited;
use super::{Case, case};

/// Bytes of the seed.
const SEED: usize = 8;

/// What a strategy draws for the first bytes, and the bytes after them; `None` where it refuses what it drew.
pub fn drawn<'a, S: Strategy>(strategy: &S, bytes: &'a [u8]) -> Option<(S::Value, &'a [u8])> {
    let (first, rest) = bytes.split_at_checked(SEED)?;
    let mut seed = [0; 32];
    seed[..SEED].copy_from_slice(first);
    // A strategy that refuses this often has nothing for this seed.
    let config = Config { max_local_rejects: 16, failure_persistence: None, ..Config::default() };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    let tree = strategy.new_tree(&mut TestRunner::new_with_rng(config, rng)).ok()?;
    Some((tree.current(), rest))
}

/// A case that all constructors take, and what is drawn with it.
pub fn case_with<S: Strategy>(others: S, bytes: &[u8]) -> Option<(Case, S::Value)> {
    let ((case, others), edits) = drawn(&(case(), others), bytes)?;
    let case = edited(&case, edits);
    case.is_accepted().then_some((case, others))
}

/// Prints what a claim was made of when it does not hold: the expression that makes the case again.
pub struct ShownOnPanic<'a, T: std::fmt::Debug>(pub &'a T);

impl<T: std::fmt::Debug> Drop for ShownOnPanic<'_, T> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("{:?}", self.0);
        }
    }
}
