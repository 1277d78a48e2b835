//! One map for several views: all that any of them sees is in it, and what casts on that.

use shadowfit::glam::{DQuat, DVec3};
use shadowfit::{ClipSpace, Empty, FocusForm, Outcome, Settings, View, focus::ConvexBody, multiview::SharedFocus};

use crate::arbitrary::{Case, SceneParams, points_of};

/// What there was to try.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tried {
    pub maps: usize,
    pub seen: usize,
    pub casting: usize,
}

/// The view of a case and up to three more about it, turned and moved by the bits of `seed`.
fn views(view: View, seed: u64) -> Vec<View> {
    let part = |at: u64| (seed >> (8 * at) & 0xff) as f64 / 255.0 * 2.0 - 1.0;
    let size = view.far().min(100.0 * view.near().abs() + 1.0) - view.near().min(0.0);
    let mut views = vec![view];
    for at in 0..seed % SharedFocus::MAX as u64 {
        let turn = DQuat::from_rotation_y(3.0 * part(at)) * DQuat::from_rotation_x(1.5 * part(at + 1));
        let eye = view.eye() + DVec3::new(part(at + 2), part(at + 3), part(at + 4)) * (0.5 * size);
        let near = view.near().abs().max(1e-6 * size);
        let other = View::perspective(eye, turn * view.forward(), turn * view.up(), 1.0, 1.5, near, near + size);
        views.extend(other.ok());
    }
    views
}

/// Whatever the views are, all that any of them sees, and what casts on it, is in the map.
pub fn lose_nothing(case: &Case, settings: &Settings, seed: u64) -> Tried {
    let (view, light) = case.build();
    let store = case.scene.store();
    let scene = store.scene().expect("the scene is accepted");
    let views = views(view, seed);
    let shared = SharedFocus::new(&views, &light, &scene).expect("no more views than there may be");
    assert_eq!(shared.bodies(FocusForm::ReceiverHull).count(), views.len());
    let sharing = shared.sharing(settings);
    assert!(sharing.shared >= 0.0 && sharing.separate >= 0.0, "{sharing:?}");
    let outcome = shared.fit(settings);
    let Outcome::Map(map) = &outcome else {
        let nothing = outcome == Outcome::Empty(Empty::NoReceivers);
        assert!(!nothing || shared.iter().all(|part| part.receiver_volume().is_empty()));
        return Tried::default();
    };
    assert!(map.caster_matrix().is_finite(), "{}", map.caster_matrix());
    let mut tried = Tried { maps: 1, ..Tried::default() };
    let matrix = map.clip_from_world_in(ClipSpace::WGPU);
    let l = light.homogeneous();
    let (min, max) = case.scene.bounds();
    let is_box = matches!(case.scene, SceneParams::Bounds { .. });
    let reach = DVec3::from(max).distance(min.into());
    // Half of the way to a light at a position, or some way to any other, where that is in a scene that is a box.
    let casting = |point: DVec3, body: &ConvexBody| {
        let caster = if l.w > 0.0 { point.lerp(l.truncate(), 0.5) } else { point + l.truncate() * (0.125 * reach) };
        let is_inside = caster.cmpge(min.into()).all() && caster.cmple(max.into()).all();
        (is_box && is_inside && body.contains(caster)).then_some((caster, true))
    };
    for part in shared.iter() {
        let (points, body) =
            (points_of(&part.receiver_volume(), seed).into_iter(), part.caster_volume(FocusForm::ReceiverHull));
        for (point, casts) in points.flat_map(|point| [Some((point, false)), casting(point, &body)]).flatten() {
            if light.position().is_some_and(|position| position.distance(point) < light.near()) {
                continue;
            }
            *(if casts { &mut tried.casting } else { &mut tried.seen }) += 1;
            let (place, w) = (matrix.project_point3(point), matrix.row(3).dot(point.extend(1.0)));
            // 128 roundings of the terms of a row, and as many of w's.
            let terms = |row: usize| matrix.row(row).abs().dot(point.abs().extend(1.0)) / w;
            let lost = |row: usize| 128.0 * f64::EPSILON * (terms(row) + terms(3));
            let is_inside = place.x.abs() <= 1.0 + lost(0) && place.y.abs() <= 1.0 + lost(1);
            assert!(is_inside, "{point} at {place}, w {w}");
            let is_between = place.z >= -lost(2) && place.z <= 1.0 + lost(2);
            assert!(!casts || is_between, "{point} at {place}, w {w}");
        }
    }
    tried
}
