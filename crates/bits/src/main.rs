//! Prints the table of bits that `tests/bits` holds results to, for comparison with other targets.
//!
//! `cargo run -p bits`, or `cargo run -p bits -- full` for every number; for another target see
//! `tests/bits/target.sh`.

fn main() {
    print!("{}", bits::table::table(std::env::args().any(|argument| argument == "full")));
}
