//! Where precision is short, near planes are tiny and worlds large: what maps make of the surfaces that are seen.
//!
//! - `table`: one view by hand, near planes and places far from the origin.
//! - `walks`: random views of random towns, all lights, near planes and places.
//! - `lamps`: faces of cubes far from the origin, and a plan of a thousand lamps.
//! - `place`: the towns, and what is seen in them by rays.

mod lamps;
mod place;
mod table;
mod walks;
