//! The crate's bodies against the exact ones, and the oracle that makes these (`testkit::oracle`) against bodies that are known.
//!
//! - `bodies`: R and both forms of H, on cases at random.
//! - `long_run`: ten million cases, certified or, where that fails, decided exactly.
//! - `found`: cases in which something was wrong once.
//! - `checks`: the oracle itself.

mod bodies;
mod checks;
mod found;
mod long_run;
