//! A whole case, and the similarity that moves it.

use glam::DVec3;
use shadowfit::{InputError, Light, View, focus::Plane};

use super::{LightParams, SceneParams, ViewParams};

/// A view, a light and a scene as plain numbers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Case {
    pub(crate) view: ViewParams,
    pub(crate) light: LightParams,
    pub(crate) scene: SceneParams,
}

impl Case {
    /// The crate's view and light of an accepted case.
    pub(crate) fn build(&self) -> (View, Light) {
        let view = self.view.build().expect("the view is accepted");
        let light = self.light.build().expect("the light is accepted");
        (view, light)
    }

    /// Whether every constructor takes its part: far out and at large scales some number may be
    /// beyond what they take.
    pub(crate) fn is_accepted(&self) -> bool {
        let scene: Result<(), InputError> = self.scene.store().scene().map(|_| ());
        self.view.build().is_ok() && self.light.build().is_ok() && scene.is_ok()
    }
}

/// A scaling about the origin followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Similarity {
    pub(crate) scale: f64,
    pub(crate) offset: [f64; 3],
}

impl Similarity {
    pub(crate) fn apply(&self, case: &Case) -> Case {
        Case { view: case.view.moved(self), light: case.light.moved(self), scene: case.scene.moved(self) }
    }

    pub(crate) fn point(&self, point: [f64; 3]) -> [f64; 3] {
        (DVec3::from(point) * self.scale + DVec3::from(self.offset)).to_array()
    }

    pub(crate) fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// A plane given by its normal and its offset, inside ≥ 0.
    pub(crate) fn plane(&self, [x, y, z, offset]: [f64; 4]) -> [f64; 4] {
        let along = DVec3::new(x, y, z).dot(DVec3::from(self.offset));
        [x, y, z, offset * self.scale - along]
    }
}

/// The crate's plane with these numbers: its normal and its offset.
pub(crate) fn plane([x, y, z, offset]: [f64; 4]) -> Plane {
    Plane::new(DVec3::new(x, y, z), offset)
}
