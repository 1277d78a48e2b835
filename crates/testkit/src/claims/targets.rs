//! What each fuzz target asserts, from its bytes.

use proptest::prelude::*;

use super::{paraboloid, rays, results, scaling, shared, single_precision, virtual_samples};
use crate::arbitrary::{ShownOnPanic, Together, case_with, settings};

/// Raw bits through every constructor.
pub fn constructors(bytes: &[u8]) {
    super::constructors::take_any_bits(bytes);
}

/// All that is claimed of a fit.
pub fn fit(bytes: &[u8]) {
    let Some((case, (settings, seed))) = case_with((settings(), any::<u64>()), bytes) else { return };
    let _shown = ShownOnPanic(&(&case, &settings, seed));
    let together = Together::of(&case);
    let scene = together.store.scene().expect("the scene is accepted");
    results::exercise(&together.view, &together.light, &scene, &settings);
    rays::keep_their_place(&case, &settings, seed);
    rays::end_in_the_map(&case, &settings, seed);
    single_precision::holds_what_it_must(&case, &settings, seed);
    single_precision::is_as_quiet_as_it_says(&case, &settings, seed);
    scaling::changes_no_bit(&case, &settings, (seed % 41) as i32 - 20);
    shared::lose_nothing(&case, &settings, seed);
}

/// All that is claimed of paraboloid maps.
pub fn paraboloid(bytes: &[u8]) {
    let others = (settings(), any::<u64>(), any::<bool>());
    let Some((case, (settings, seed, among))) = case_with(others, bytes) else { return };
    let _shown = ShownOnPanic(&(&case, &settings, seed, among));
    paraboloid::holds_what_it_must(&case, &settings, seed, among);
    paraboloid::carries_no_farther_than_it_says(&case, &settings, seed);
    paraboloid::noise_is_at_least_that_of_points(&case, &settings, seed);
}

/// All that is claimed of virtual samples.
pub fn virtual_samples(bytes: &[u8]) {
    let Some((case, (settings, seed))) = case_with((settings(), any::<u64>()), bytes) else { return };
    let _shown = ShownOnPanic(&(&case, &settings, seed));
    virtual_samples::depths_are_exact(&case, &settings, seed);
    virtual_samples::shaders_find_them(&case, &settings, seed);
    virtual_samples::rules_hold_where_planes_are_seen(&case, &settings, seed);
    virtual_samples::allows_for_rounding(&case, &settings, seed);
}

/// All that is claimed of plans.
#[cfg(feature = "alloc")]
pub fn planner(bytes: &[u8]) {
    use super::planner;
    use super::town::{Bytes, LitTown};

    let mut bytes = Bytes::new(bytes);
    let town = LitTown::from_bytes(&mut bytes);
    let _shown = ShownOnPanic(&town);
    planner::loses_no_caster(&mut bytes, &town);
    planner::keeps_every_receiver_in_view(&mut bytes, &town);
    planner::warps_to_gain(&town);
    planner::keeps_to_its_texels(&town);
    planner::sees_no_more_in_less(&mut bytes, &town);
}
