//! Virtual samples are the depths of planes, in f64 and in a shader.

#![no_main]

#[path = "../../tests/arbitrary/mod.rs"]
mod arbitrary;
#[path = "../../tests/claims/mod.rs"]
mod claims;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| claims::targets::virtual_samples(bytes));
