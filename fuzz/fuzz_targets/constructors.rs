//! Raw bits in every public constructor: a typed error, or a value that gives results.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testkit::claims::targets::constructors(bytes));
