//! Inputs: views, lights, scenes, and the clip conventions that matrices come in.
//!
//! [`View`](crate::View), [`Light`](crate::Light) and [`Scene`](crate::Scene) are at the root of the crate; this module has the
//! types of their arguments and results, and the parts of an [`InputError`](crate::InputError).

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
pub use view::{FrustumPlanes, Lens, OrthographicCamera, PerspectiveCamera, Tangents};
