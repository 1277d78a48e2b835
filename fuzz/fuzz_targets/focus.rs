//! R and both forms of H against the exact oracle: nothing lost, little gained.

#![no_main]

use proptest::strategy::Just;
use testkit::arbitrary::case_with;
use testkit::oracle::focus::check_case;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Some((case, ())) = case_with(Just(()), bytes) {
        check_case(&case);
    }
});
