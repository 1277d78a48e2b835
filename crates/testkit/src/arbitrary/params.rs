//! A whole case.

use shadowfit::{InputError, Light, View};

use super::{LightParams, SceneParams, Similarity, ViewParams};

/// A view, a light and a scene as plain numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    pub view: ViewParams,
    pub light: LightParams,
    pub scene: SceneParams,
}

impl Case {
    /// The crate's view and light of an accepted case.
    pub fn build(&self) -> (View, Light) {
        let view = self.view.build().expect("the view is accepted");
        let light = self.light.build().expect("the light is accepted");
        (view, light)
    }

    /// The case after a similarity of the world.
    pub fn moved(&self, by: &Similarity) -> Self {
        Self { view: self.view.moved(by), light: self.light.moved(by), scene: self.scene.moved(by) }
    }

    /// Whether every constructor takes its part: far out and at large scales some number may be
    /// beyond what they take.
    pub fn is_accepted(&self) -> bool {
        let scene: Result<(), InputError> = self.scene.store().scene().map(|_| ());
        self.view.build().is_ok() && self.light.build().is_ok() && scene.is_ok()
    }
}
