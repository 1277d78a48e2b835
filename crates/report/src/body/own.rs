//! The crate: R's uniform map, and casters culled by H in its forms.

use shadowfit::{Focus, FocusForm, Outcome, Scene, Settings, Warp, focus::ConvexBody};

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
        Contender::new(PAPER, |case| Some(fit(case, &case.scene, FocusForm::ViewHull)), finish),
        Contender::new(TIGHT, |case| Some(fit(case, &case.scene, FocusForm::ReceiverHull)), finish),
    ]
}

/// S as lists of casters and receivers.
pub(crate) fn of_lists<'a>() -> Vec<Contender<'a>> {
    vec![
        Contender::new(PAPER_LISTS, |case| Some(fit(case, case.lists.as_ref()?, FocusForm::ViewHull)), finish),
        Contender::new(TIGHT_LISTS, |case| Some(fit(case, case.lists.as_ref()?, FocusForm::ReceiverHull)), finish),
    ]
}

fn fit(case: &Case<'_>, scene: &Scene<'_>, form: FocusForm) -> (Outcome, ConvexBody) {
    let focus = Focus::new(&case.view, &case.light, scene);
    (focus.fit(&Settings::default().with_warp(Warp::Uniform)), focus.caster_volume(form))
}

fn finish(_: &Case<'_>, (outcome, body): (Outcome, ConvexBody)) -> Fitted {
    let culling = Culling::Body(Box::new(body));
    match outcome {
        Outcome::Map(map) => {
            let matrix = map.caster_matrix().as_dmat4();
            let clip = clip_planes(&matrix, false, NearSide::Closed);
            Fitted { shadow_from_world: Some(matrix), clip, culling }
        }
        Outcome::Empty(_) => Fitted { shadow_from_world: None, clip: Vec::new(), culling: Culling::Nobody },
        // Faces of a cube hold it, and are culled by the same body.
        Outcome::Surrounded(_) => Fitted { shadow_from_world: None, clip: Vec::new(), culling },
    }
}
