//! Meshes: whether they are watertight, which decides their depth test, and tessellation for paraboloid maps.

mod solidity;
#[cfg(feature = "spade")]
mod tessellate;

pub use solidity::{OpenShape, Solidity, SolidityReport};
#[cfg(feature = "spade")]
pub use tessellate::{NewVertex, Tessellation, Tessellator};
