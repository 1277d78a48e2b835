//! Scenes of lists: what is not in view, not lit, or in nobody's way counts for nothing.

use shadowfit::glam::{DVec3, Vec3};
use shadowfit::{Aabb, Focus, FocusForm, Light, Outcome, Scene, Settings, View};

fn around(middle: [f32; 3], half: f32) -> Aabb {
    Aabb::new(Vec3::from(middle) - half, Vec3::from(middle) + half)
}

fn view() -> View {
    View::perspective((0.0, 2.0, 10.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.5, 60.0).expect("sound")
}

/// In view, and one that casts on it under either light.
const SEEN: [f32; 3] = [0.0, 0.0, -5.0];
const CASTS: [f32; 3] = [0.0, 6.0, -5.0];

fn lights() -> [Light; 3] {
    [
        Light::directional(DVec3::Y),
        Light::point((0.0, 12.0, -5.0), 0.1, 30.0),
        Light::spot((0.0, 12.0, -5.0), DVec3::NEG_Y, 0.4, 0.1, 30.0),
    ]
    .map(|light| light.expect("sound"))
}

#[test]
fn what_counts_for_nothing_changes_nothing() {
    let (casters, receivers) = ([around(CASTS, 1.0)], [around(SEEN, 2.0)]);
    // Beside the view, behind the viewer, beyond the far plane.
    let unseen = [[40.0, 0.0, -5.0], [0.0, 0.0, 30.0], [0.0, 0.0, -90.0]].map(|middle| around(middle, 2.0));
    // In view and in nobody's way, below what is seen, and beside the light.
    let aside = [[5.0, 5.0, -5.0], [0.0, -9.0, -5.0], [-20.0, 6.0, -5.0]].map(|middle| around(middle, 1.0));
    let view = view();
    for light in lights() {
        let scene = Scene::new(&casters, &receivers).expect("sound");
        let focus = Focus::new(&view, &light, &scene);
        let more_receivers: Vec<Aabb> = unseen.iter().chain(&receivers).copied().collect();
        let more_casters: Vec<Aabb> = aside.iter().chain(&casters).copied().collect();
        let more = Scene::new(&more_casters, &more_receivers).expect("sound");
        let with_more = Focus::new(&view, &light, &more);
        assert_eq!(focus.receiver_volume().vertices(), with_more.receiver_volume().vertices(), "{light:?}");
        // Their hull is moved outwards by a little more, as casters are farther out.
        let bounds =
            |focus: &Focus<'_>| focus.caster_volume(FocusForm::ReceiverHull).bounds().expect("something casts");
        let ((min, max), (more_min, more_max)) = (bounds(&focus), bounds(&with_more));
        assert!((min - more_min).abs().max_element() <= 1e-12 && (max - more_max).abs().max_element() <= 1e-12);
        assert!(min.y >= 5.0 - 1e-12 && max.y <= 7.0 + 1e-12, "{min} {max}");
    }
}

#[test]
fn nothing_that_counts_is_no_map() {
    let (seen, casts) = ([around(SEEN, 2.0)], [around(CASTS, 1.0)]);
    let (unseen, aside) = ([around([40.0, 0.0, -5.0], 2.0)], [around([-20.0, 6.0, -5.0], 1.0)]);
    let settings = Settings::default();
    for light in lights() {
        let fit = |casters, receivers| {
            let scene = Scene::new(casters, receivers).expect("sound");
            Focus::new(&view(), &light, &scene).fit(&settings)
        };
        assert!(matches!(fit(&casts, &seen), Outcome::Map(_)), "{light:?}");
        assert_eq!(fit(&casts, &unseen), Outcome::Empty(shadowfit::Empty::NoReceivers));
        assert_eq!(fit(&aside, &seen), Outcome::Empty(shadowfit::Empty::NoCasters));
    }
}
