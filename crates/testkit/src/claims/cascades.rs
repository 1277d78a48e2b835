//! What cascades of a view promise: one cascade is a plain fit, no depth is lost, and each cascade's map holds what is visible
//! in it and what casts on that.

use proptest::prelude::*;
use shadowfit::glam::DVec3;
use shadowfit::{
    Aabb, Empty, Focus, FocusForm, InputError, Outcome, Settings,
    cascades::{CascadeLayout, CascadeSplits, Cascades, SplitScheme},
    fit,
    focus::ConvexBody,
    input::Lens,
};

use super::single_precision::{in_f32, is_in_window, rounding};
use crate::arbitrary::{Case, Numbers, SceneStore, Together, points_of, sides};

/// How a view is cut, as numbers.
#[derive(Clone, Copy, Debug)]
pub struct Cutting {
    count: usize,
    split: SplitScheme,
    /// Between the view's planes, not what is visible.
    planes: bool,
    overlap: f64,
}

pub fn cutting() -> impl Strategy<Value = Cutting> {
    let split = prop_oneof![
        Just(SplitScheme::Uniform),
        Just(SplitScheme::Logarithmic),
        (0.0..=1.0).prop_map(SplitScheme::Practical)
    ];
    let overlap = prop_oneof![Just(0.0), 0.0..=1.0, Just(1.0)];
    (1..=Cascades::MAX, split, any::<bool>(), overlap).prop_map(|(count, split, planes, overlap)| Cutting {
        count,
        split,
        planes,
        overlap,
    })
}

impl Cutting {
    fn cut<'a>(&self, together: &'a Together) -> Result<Cascades<'a>, InputError> {
        let Self { count, split, overlap, .. } = *self;
        let cuts = if self.planes && together.view.far().is_finite() {
            CascadeSplits::View { count, split }
        } else {
            CascadeSplits::Visible { count, split }
        };
        let scene = together.store.scene().expect("the scene is accepted");
        Cascades::new(&together.view, &together.light, &scene, cuts, overlap)
    }

    fn cascades<'a>(&self, together: &'a Together) -> Cascades<'a> {
        self.cut(together).expect("legal cuts")
    }
}

/// Points that are visible: of R, or, among lists, of the receivers themselves, which R is only a bound of.
fn visible_points(together: &Together, focus: &Focus<'_>, seed: u64) -> Vec<DVec3> {
    let SceneStore::Lists(_, receivers) = &together.store else { return points_of(&focus.receiver_volume(), seed) };
    let mut numbers = Numbers(seed);
    let mut points = Vec::new();
    for one in receivers {
        let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
        points.extend([(); 4].map(|()| {
            let part = DVec3::new(numbers.part(), numbers.part(), numbers.part());
            min + (max - min) * part
        }));
    }
    let (view, light) = (together.view.planes(), together.light.planes());
    points.retain(|point| view.iter().chain(light.iter()).all(|plane| plane.at(*point) >= 0.0));
    points
}

/// Asserts that one cascade is the view itself, to the last bit.
pub fn one_is_a_plain_fit(case: &Case, cutting: &Cutting, settings: &Settings) {
    let together = Together::of(case);
    let scene = together.store.scene().expect("the scene is accepted");
    let plain = fit(&together.view, &together.light, &scene, settings);
    let one = Cutting { count: 1, ..*cutting };
    let at_none = Cascades::new(&together.view, &together.light, &scene, CascadeSplits::At(&[]), one.overlap);
    for cascades in [one.cascades(&together), at_none.expect("no cuts")] {
        assert_eq!(cascades.len(), 1);
        assert_eq!(cascades[0].focus.view(), &together.view);
        assert_eq!(cascades.fit(settings).outcomes(), std::slice::from_ref(&plain));
    }
}

/// Asserts that the cascades follow on one another, cut at numbers of f32, and that every depth is in the one around it, for a
/// shader as well.
pub fn every_depth_is_in_one(case: &Case, cutting: &Cutting, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let cascades = cutting.cascades(&together);
    let view = &together.view;
    assert!((1..=cutting.count).contains(&cascades.len()));
    assert_eq!((cascades[0].near, cascades[cascades.len() - 1].far), (view.near(), view.far()));
    for pair in cascades.as_slice().windows(2) {
        assert_eq!(pair[0].far, pair[1].near);
        assert_eq!(pair[0].far, f64::from(pair[0].far as f32));
        assert!(pair[0].near <= pair[0].blend && pair[0].blend <= pair[0].far);
    }
    let uniform = cascades.fit(settings).uniform(CascadeLayout::Array, |_| None);
    let mut numbers = Numbers(seed);
    let last = view.far().min(2.0 * view.near().abs() + 1e4);
    let mut depths: Vec<f64> = (0..32).map(|_| view.near() + (last - view.near()) * numbers.part()).collect();
    depths.extend(
        cascades.iter().flat_map(|cascade| [cascade.near, cascade.far.next_down(), cascade.far, cascade.blend]),
    );
    for depth in depths {
        let index = cascades.index_at(depth);
        let cascade = &cascades[index];
        assert!(
            cascade.near <= depth && (depth < cascade.far || index == cascades.len() - 1),
            "{depth} is in {index}"
        );
        let blend = cascades.blend_at(depth);
        assert!((0.0..=1.0).contains(&blend) && (blend == 0.0 || depth > cascade.blend), "{blend} at {depth}");
        assert!(blend == 0.0 || index + 1 < cascades.len());
        // As `shadowfit_cascade_at` counts.
        let single = depth as f32;
        let of_shader = uniform.far.iter().filter(|far| single >= **far).count().min(Cascades::MAX - 1);
        // Which is for depths that are finite.
        assert!(single >= f32::MAX || of_shader == cascades.index_at(f64::from(single)), "{depth}: {of_shader}");
    }
}

/// Asserts that a visible point is in the map of its cascade, also where f32 takes it for one of the next cascade, and in the
/// next cascade's map where that is blended in.
pub fn maps_hold_what_is_visible(case: &Case, cutting: &Cutting, settings: &Settings, seed: u64) {
    let together = Together::of(case);
    let cascades = cutting.cascades(&together);
    let maps = cascades.fit(settings);
    let view = &together.view;
    let border = f64::from(settings.border()) / sides(settings);
    let inner = (1.0 - 2.0 * border) * (1.0 + f64::EPSILON);
    for point in visible_points(&together, &together.focus(), seed) {
        if !together.is_served(point) {
            continue;
        }
        let depth = view.depth(point);
        // Six roundings of a sum of three products of coordinates relative to the eye.
        let off = 6.0 / 16_777_216.0 * (point - view.eye()).length();
        for depth in [depth, depth - off, depth + off] {
            let index = cascades.index_at(depth);
            let next = (cascades.blend_at(depth) > 0.0).then_some(index + 1);
            for index in [Some(index), next].into_iter().flatten() {
                let outcome = &maps.outcomes()[index];
                assert_ne!(*outcome, Outcome::Empty(Empty::NoReceivers), "{point} is in cascade {index}");
                let Some(map) = outcome.map() else { continue };
                let (across, of_w) = rounding(map, point);
                // Beside a lamp f32 may not tell a place to a 64th of the window.
                if of_w > 0.5 || together.light.position().is_some() && across > 1.0 / 64.0 {
                    continue;
                }
                let position = in_f32(map, point);
                let shown = position.truncate() / position.w;
                assert!(
                    is_in_window(position, inner),
                    "{point} of cascade {index} is at {shown}, w {}",
                    position.w
                );
            }
        }
    }
}

/// Asserts that what can cast on a visible point is in the body of its cascade: the tight body of the whole view is covered by
/// those of the cascades.
pub fn bodies_hold_what_casts(case: &Case, cutting: &Cutting, seed: u64) {
    let together = Together::of(case);
    let cascades = cutting.cascades(&together);
    let bodies: Vec<_> =
        cascades.iter().map(|cascade| cascade.focus.caster_volume(FocusForm::ReceiverHull)).collect();
    let cullers: Vec<_> = bodies.iter().map(|body| body.culler()).collect();
    let whole = together.focus().caster_volume(FocusForm::ReceiverHull);
    for point in visible_points(&together, &together.focus(), seed) {
        let index = cascades.index_at(together.view.depth(point));
        for caster in together.casters(&whole, &[point], seed) {
            // Among lists, what casts is in one of the casters.
            if let SceneStore::Lists(casters, _) = &together.store {
                let holds =
                    |one: &&Aabb| one.min.as_dvec3().cmple(caster).all() && caster.cmple(one.max.as_dvec3()).all();
                let Some(one) = casters.iter().find(holds) else { continue };
                assert!(
                    bodies[index].intersects_aabb(one.min, one.max),
                    "{one:?} casts on {point} in cascade {index}"
                );
                let mut meets = [false];
                cullers[index].boxes(&[*one], &mut meets);
                assert_eq!(meets, [true], "{one:?} casts on {point} in cascade {index}");
            } else {
                let (body, visible) = (&bodies[index], cascades[index].focus.receiver_volume());
                let slack = slack(&visible, caster.abs().max(point.abs()));
                let least = body.planes().map(|plane| plane.at(caster)).fold(f64::INFINITY, f64::min);
                assert!(
                    !body.is_empty() && least >= -slack,
                    "{caster} casts on {point} in cascade {index}: {least:e}"
                );
            }
        }
    }
}

/// How far outside of a plane of H a caster may be that was found from a point of the whole R.
///
/// The planes of H are those of R, and weighted means of two of them that are zero at the light, so that no such mean is less
/// at the caster than at the point. The point is outside of each plane of R by no more than what planes of it are
/// loosened by, which is what corners are rounded by: 96 ε of the terms. Again as much for the caster's own rounding.
fn slack(visible: &ConvexBody, largest: DVec3) -> f64 {
    let terms = visible.planes().map(|plane| plane.normal.abs().dot(largest) + plane.offset.abs());
    2.0 * 96.0 * f64::EPSILON * terms.fold(0.0, f64::max)
}

/// Asserts that cuts of an orthographic view are uniform, whatever was asked for.
pub fn orthographic_cuts_are_uniform(case: &Case, cutting: &Cutting) {
    let together = Together::of(case);
    if together.view.lens() != Lens::Orthographic {
        return;
    }
    let uniform = Cutting { split: SplitScheme::Uniform, ..*cutting }.cascades(&together);
    let ours = cutting.cascades(&together);
    assert!(ours.iter().map(|cascade| cascade.far).eq(uniform.iter().map(|cascade| cascade.far)));
}
