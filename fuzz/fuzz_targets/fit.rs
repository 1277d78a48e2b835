//! A map holds what it must, in f64 and in f32, and what else is claimed of every fit.

#![no_main]

#[path = "../../tests/arbitrary/mod.rs"]
mod arbitrary;
#[path = "../../tests/claims/mod.rs"]
mod claims;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| claims::targets::fit(bytes));
