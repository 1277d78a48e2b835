//! The exact focus body, by the oracle of the tests: brute force in integers, over the very planes that the crate is given.

#![allow(dead_code, reason = "the oracle's own tests use the rest")]

#[path = "../../../tests/oracle/body.rs"]
pub(crate) mod body;
#[path = "../../../tests/oracle/cone.rs"]
pub(crate) mod cone;
#[path = "../../../tests/oracle/distance.rs"]
pub(crate) mod distance;
#[path = "../../../tests/oracle/exact.rs"]
pub(crate) mod exact;
#[path = "../../../tests/oracle/homogeneous.rs"]
pub(crate) mod homogeneous;
#[path = "../../../tests/oracle/hull.rs"]
pub(crate) mod hull;
#[path = "../../../tests/oracle/scalar.rs"]
pub(crate) mod scalar;
