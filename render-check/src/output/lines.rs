//! Lines on the terminal.

use std::io::{Write as _, stderr, stdout};

/// Prints a line. Nobody listening (`render-check | head`) is no reason to leave the work undone.
pub fn say(line: &str) {
    drop(writeln!(stdout(), "{line}"));
}

/// Prints a line aside from the results.
pub fn complain(line: &str) {
    drop(writeln!(stderr(), "{line}"));
}
