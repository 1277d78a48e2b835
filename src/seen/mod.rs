//! What the camera sees: [`Seen`], for fits that spend their texels on surfaces and not on the air before them.
//!
//! | what is known | how it is told |
//! |---|---|
//! | one box, a convex scene | [`Scene`](crate::Scene) alone: surfaces may be anywhere in it |
//! | boxes of receivers | [`Scene::new`](crate::Scene::new): R ends at them, and lines of sight meet them |
//! | points on surfaces | [`Seen::from_points`] |
//! | the camera's depth buffer, of this frame or the one before | [`Seen::from_tiles`] |

mod known;
mod point;
mod tile;

pub use known::Seen;
pub use point::SeenPoint;
pub use tile::DepthTile;
