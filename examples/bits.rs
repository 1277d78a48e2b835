//! Prints the table of bits that `tests/bits` holds results to, for comparison with other targets.
//!
//! `cargo run --example bits`, or `cargo run --example bits -- full` for every number; for another target see
//! `tests/bits/target.sh`.

#[path = "../tests/bits/setups.rs"]
mod setups;
#[path = "../tests/bits/table.rs"]
mod table;

fn main() {
    print!("{}", table::table(std::env::args().any(|argument| argument == "full")));
}
