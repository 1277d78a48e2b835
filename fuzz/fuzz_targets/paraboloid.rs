//! Paraboloid maps hold what they must, and what else is claimed of them.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testkit::claims::targets::paraboloid(bytes));
