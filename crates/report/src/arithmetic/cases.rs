//! What bodies are computed for: random views and lights of a town, and the hard cases of the property tests.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rand::SeedableRng;
use rand::rngs::StdRng;
use shadowfit::glam::DVec3;
use shadowfit::{InputError, Light, Scene, View, focus::Plane};

use testkit::arbitrary::{SceneParams, SceneStore, case, plane};
use testkit::outdoors::{self, Kind, TOWN};

/// A view, a light and a scene.
pub(crate) struct Case {
    pub(crate) view: View,
    pub(crate) light: Light,
    pub(crate) min: [f64; 3],
    pub(crate) max: [f64; 3],
    /// What the scene's box is cut by.
    pub(crate) cuts: Vec<Plane>,
    store: SceneStore,
}

impl Case {
    /// None for scenes of lists, whose bounds are the crate's own choice, and for views that are cut by oblique planes, which the
    /// textbook's clipper knows nothing of.
    fn new(view: View, light: Light, scene: &SceneParams) -> Option<Self> {
        let upright = if view.far().is_finite() { 6 } else { 5 };
        if view.planes().len() != upright {
            return None;
        }
        let cuts = match scene {
            SceneParams::Bounds { .. } => Vec::new(),
            SceneParams::Cut { planes, .. } => planes.iter().copied().map(plane).collect(),
            SceneParams::Lists { .. } => return None,
        };
        let (min, max) = scene.bounds();
        Some(Self { view, light, min, max, cuts, store: scene.store() })
    }

    /// The scene as the crate takes it.
    pub(crate) fn scene(&self) -> Result<Scene<'_>, InputError> {
        self.store.scene()
    }

    /// The diagonal of the scene's box; of a point, how far out it is, for want of a size.
    pub(crate) fn size(&self) -> f64 {
        let (min, max) = (DVec3::from(self.min), DVec3::from(self.max));
        [max.distance(min), max.length()].into_iter().find(|size| *size > 0.0).unwrap_or(1.0)
    }
}

/// Somebody in a town, in turn with a sun, a lamp and a spot.
pub(crate) fn random(count: usize) -> Vec<Case> {
    let mut random = StdRng::seed_from_u64(1);
    let (min, max) = TOWN;
    let kinds = Kind::ALL.into_iter().cycle().take(count);
    kinds
        .filter_map(|kind| {
            let (view, light) = (outdoors::view(&mut random), kind.light(&mut random));
            Case::new(view, light, &SceneParams::Bounds { min, max })
        })
        .collect()
}

/// The cases of the property tests, without scenes of lists and oblique views, the same in every run.
pub(crate) fn hard(count: usize) -> Vec<Case> {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[11; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = case();
    let mut cases = Vec::with_capacity(count);
    while cases.len() < count {
        let case = strategy.new_tree(&mut runner).expect("few cases are refused").current();
        let (view, light) = case.build();
        cases.extend(Case::new(view, light, &case.scene));
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowfit::{Focus, FocusForm};

    #[test]
    fn the_town_is_that_of_the_outdoor_views() {
        let mut solid = 0;
        for case in random(9) {
            let scene = case.scene().expect("a legal scene");
            let bodies = [&scene, &outdoors::town()].map(|scene| {
                Focus::new(&case.view, &case.light, scene).caster_volume(FocusForm::ViewHull).vertices().to_vec()
            });
            assert_eq!(bodies[0], bodies[1]);
            solid += usize::from(bodies[0].len() >= 4);
        }
        assert!(solid > 4, "{solid} solid bodies");
    }
}
