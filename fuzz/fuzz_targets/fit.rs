//! A map holds what it must, in f64 and in f32, and what else is claimed of every fit.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testkit::claims::targets::fit(bytes));
