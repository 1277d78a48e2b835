//! Raw bits in every public constructor: a typed error, or a value that gives results.

#![no_main]

#[path = "../../tests/arbitrary/mod.rs"]
mod arbitrary;
#[path = "../../tests/claims/mod.rs"]
mod claims;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| claims::targets::constructors(bytes));
