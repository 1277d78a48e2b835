//! Virtual samples are the depths of planes, in f64 and in a shader.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testkit::claims::targets::virtual_samples(bytes));
