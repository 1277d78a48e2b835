//! R and both forms of H against the exact oracle: nothing lost, little gained.

#![no_main]
#![allow(dead_code, unused_imports, reason = "the oracle's own tests use the rest of it")]

#[path = "../../tests/arbitrary/mod.rs"]
mod arbitrary;
#[path = "../../tests/oracle/body.rs"]
mod body;
#[path = "../../tests/oracle/cone.rs"]
mod cone;
#[path = "../../tests/oracle/distance.rs"]
mod distance;
#[path = "../../tests/oracle/exact.rs"]
mod exact;
#[path = "../../tests/oracle/focus.rs"]
mod focus;
#[path = "../../tests/oracle/homogeneous.rs"]
mod homogeneous;
#[path = "../../tests/oracle/hull.rs"]
mod hull;
#[path = "../../tests/oracle/loss.rs"]
mod loss;
#[path = "../../tests/oracle/scalar.rs"]
mod scalar;

use arbitrary::case_with;
use proptest::strategy::Just;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Some((case, ())) = case_with(Just(()), bytes) {
        focus::check_case(&case);
    }
});
