//! Lines on the terminal.

use std::io::{Write as _, stderr, stdout};

/// Prints a line. A closed pipe (`render-check | head`) does not end the program.
pub fn say(line: &str) {
    drop(writeln!(stdout(), "{line}"));
}

/// Prints a line on stderr.
pub fn complain(line: &str) {
    drop(writeln!(stderr(), "{line}"));
}
