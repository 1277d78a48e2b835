//! The crate: R's uniform map, and casters culled by H in its forms.

use shadowfit::{Body, Focus, Form, Outcome, Scene, Settings, Warp};

use super::case::Case;
use super::contender::{Contender, Culling, Fitted, NearSide, clip_planes};

/// The names of the contenders here.
pub(crate) const PAPER: &str = "shadowfit, H";
pub(crate) const TIGHT: &str = "shadowfit, tight H";
pub(crate) const PAPER_LISTS: &str = "shadowfit, H of lists";
pub(crate) const TIGHT_LISTS: &str = "shadowfit, tight H of lists";
pub(crate) const NAMES: [&str; 4] = [PAPER, TIGHT, PAPER_LISTS, TIGHT_LISTS];

/// S as one box or body.
pub(crate) fn of_bounds<'a>() -> Vec<Contender<'a>> {
    vec![
        Contender::new(PAPER, |case| Some(fit(case, &case.scene, Form::Paper)), finish),
        Contender::new(TIGHT, |case| Some(fit(case, &case.scene, Form::Tight)), finish),
    ]
}

/// S as lists of casters and receivers.
pub(crate) fn of_lists<'a>() -> Vec<Contender<'a>> {
    vec![
        Contender::new(PAPER_LISTS, |case| Some(fit(case, case.lists.as_ref()?, Form::Paper)), finish),
        Contender::new(TIGHT_LISTS, |case| Some(fit(case, case.lists.as_ref()?, Form::Tight)), finish),
    ]
}

fn fit(case: &Case<'_>, scene: &Scene<'_>, form: Form) -> (Outcome, Body) {
    let focus = Focus::new(&case.view, &case.light, scene);
    (focus.fit(&Settings::default().with_warp(Warp::Uniform)), focus.body(form))
}

fn finish(_: &Case<'_>, (outcome, body): (Outcome, Body)) -> Fitted {
    let culling = Culling::Body(Box::new(body));
    match outcome {
        Outcome::Map(map) => {
            let matrix = map.matrix().as_dmat4();
            let clip = clip_planes(&matrix, false, NearSide::Closed);
            Fitted { shadow_from_world: Some(matrix), clip, culling }
        }
        Outcome::Empty(_) => Fitted { shadow_from_world: None, clip: Vec::new(), culling: Culling::Nobody },
        // Faces of a cube hold it, and are culled by the same body.
        Outcome::Surrounded(_) => Fitted { shadow_from_world: None, clip: Vec::new(), culling },
    }
}
