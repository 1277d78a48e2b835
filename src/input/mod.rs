//! What goes in, checked once: views, lights, scenes, and the conventions they come in.
//!
//! [`View`](crate::View), [`Light`](crate::Light) and [`Scene`](crate::Scene) are at the root of the crate; here is what
//! they are made from and answer with, and what an [`InputError`](crate::InputError) says.

pub(crate) mod clip_space;
pub(crate) mod light;
pub(crate) mod numbers;
pub(crate) mod scene;
pub(crate) mod view;

pub use crate::error::{Expected, Hint, InputErrorKind, MAX_COORDINATE, MIN_DISTANCE};
pub use clip_space::{DepthRange, TextureOrigin, YAxis};
pub use light::LightPlanes;
pub use numbers::IntoMatrix;
pub use scene::{Bounding, ConvexScene, DAabb};
pub use view::{FrustumPlanes, Lens, Tangents};
