//! Mathematics that does not depend on shadows.

pub(crate) mod angle;
pub(crate) mod axis;
pub(crate) mod bounds;
pub(crate) mod frame;
#[cfg(feature = "serde")]
pub(crate) mod infinity;
pub(crate) mod list;
