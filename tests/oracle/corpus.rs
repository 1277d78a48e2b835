//! The cases that fuzzing has kept, against the exact oracle.

use proptest::prelude::*;

use testkit::arbitrary::{ShownOnPanic, case_with, replay};
use testkit::oracle::focus::check_case;

#[test]
fn focus() {
    replay("focus", |bytes| {
        if let Some((case, ())) = case_with(Just(()), bytes) {
            let _shown = ShownOnPanic(&case);
            check_case(&case);
        }
    });
}
