//! No plan loses a caster, and what else is claimed of plans.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testkit::claims::targets::planner(bytes));
