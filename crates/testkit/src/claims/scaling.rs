//! Numbers of another size, the same bits.

use shadowfit::glam::DVec3;
use shadowfit::{Focus, FocusForm, Outcome, Settings, ShadowMap};

use crate::arbitrary::{Case, Similarity, Together, numbers};

/// Asserts that scaling a case by two to some power scales its bodies by just that, and its map not at all.
pub fn changes_no_bit(case: &Case, settings: &Settings, exponent: i32) {
    let scale = 2_f64.powi(exponent);
    let [larger, back] = [scale, scale.recip()].map(|scale| Similarity { scale, offset: [0.0; 3] });
    let scaled = case.moved(&larger);
    // Numbers that leave the range of f32 or the normal range of f64 on the way do not scale.
    let l = case.build().1.homogeneous().to_array();
    let is_tiny = |x: f64| x != 0.0 && x.abs() < 1e-200;
    if !scaled.is_accepted() || scaled.moved(&back) != *case || numbers(case).into_iter().chain(l).any(is_tiny) {
        return;
    }
    let (here, there) = (Together::of(case), Together::of(&scaled));
    let (here, there) = (here.focus(), there.focus());
    let bodies = |focus: &Focus<'_>| {
        [
            focus.receiver_volume(),
            focus.caster_volume(FocusForm::ViewHull),
            focus.caster_volume(FocusForm::ReceiverHull),
        ]
    };
    for (body, scaled) in bodies(&here).iter().zip(&bodies(&there)) {
        let expected: Vec<_> = body.vertices().iter().map(|vertex| vertex * scale).collect();
        assert_eq!(scaled.vertices(), expected);
    }
    let (Outcome::Map(map), Outcome::Map(scaled)) = (here.fit(settings), there.fit(settings)) else {
        assert_eq!(here.fit(settings).map(), None);
        assert_eq!(there.fit(settings).map(), None);
        return;
    };
    let clip = |map: &ShadowMap, point: DVec3| map.clip_from_world().project_point3(point);
    // A corner of R where the light is has no place.
    for &point in here.receiver_volume().vertices().iter().filter(|point| map.w_at(**point) > 0.0) {
        assert_eq!(clip(&scaled, point * scale), clip(&map, point));
    }
}
