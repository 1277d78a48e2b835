//! The bounds of balls and discs in f64.

use super::rounds::{Round, Rows, direction, landscape, rounds};
use glam::{DVec2, DVec3, DVec4};
use proptest::prelude::*;
use shadowfit::{Outcome, Settings, Warp, depth::Splat};
use testkit::arbitrary::{Numbers, Similarity, Together, case, run, settings};

#[test]
fn bounds_hold_balls_and_discs_and_touch_them() {
    let tried = std::cell::Cell::new(0_usize);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let rows = Rows::new(&map, &together, &case);
        let mut numbers = Numbers(seed);
        for round in rounds(&together, &case, seed) {
            let Some(splat) = round.splat(&map) else { continue };
            let Some(slack) = rows.slack(&round, &splat) else { continue };
            tried.set(tried.get() + 1);
            let off = |point: DVec3| rows.place(point) - splat.centre;
            for _ in 0..8 {
                let aside = direction(&mut numbers);
                let point = round.farthest(aside).lerp(round.centre, (2.0 * numbers.part() - 1.0).max(0.0));
                let outside = off(point).abs() - splat.half - slack;
                assert!(outside.cmple(DVec2::ZERO).all(), "{round:?}, {splat:?}: {point} is {outside} outside");
            }
            // The planes of the four ends touch the ball where their normals lead to.
            for sign in [1.0, -1.0] {
                let end = splat.centre + splat.half * sign;
                let normal = |row: DVec4, end: f64| (row - rows.w * end).truncate() * sign;
                let x = off(round.farthest(normal(rows.x, end.x))).x - splat.half.x * sign;
                let y = off(round.farthest(normal(rows.y, end.y))).y - splat.half.y * sign;
                let apart = DVec2::new(x, y).abs();
                assert!(apart.cmple(slack).all(), "{round:?}, {splat:?}: {apart} before its end, not {slack}");
            }
        }
    });
    assert!(tried.get() > 10_000, "{} were tried", tried.get());
}

#[test]
fn what_reaches_behind_the_light_has_no_bounds() {
    let counts = std::cell::Cell::new([0_usize; 2]);
    run(3000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let Outcome::Map(map) = together.focus().fit(&settings) else { return };
        let rows = Rows::new(&map, &together, &case);
        for round in rounds(&together, &case, seed) {
            let (least, slack) = (rows.least_w(&round), rows.slack_of(rows.w, &round));
            let splat = round.splat(&map);
            let [mut with, mut without] = counts.get();
            match splat {
                Some(_) => with += 1,
                None => without += 1,
            }
            counts.set([with, without]);
            if least.abs() > 4.0 * slack {
                assert_eq!(splat.is_some(), least > 0.0, "{round:?} has w from {least} on");
            }
        }
    });
    let [with, without] = counts.get();
    assert!(with > 10_000 && without > 1000, "{with} with bounds, {without} without");
}

#[test]
fn scaling_by_a_power_of_two_scales_nothing_in_texels() {
    run(1000, &(case(), settings(), -20..=20_i32, any::<u64>()), |(case, settings, exponent, seed)| {
        let scale = 2_f64.powi(exponent);
        let [larger, back] = [scale, scale.recip()].map(|scale| Similarity { scale, offset: [0.0; 3] });
        let scaled = case.moved(&larger);
        let l = case.build().1.homogeneous();
        let is_tiny = |x: f64| x != 0.0 && x.abs() < 1e-200;
        if !scaled.is_accepted() || scaled.moved(&back) != case || l.to_array().into_iter().any(is_tiny) {
            return;
        }
        let (here, there) = (Together::of(&case), Together::of(&scaled));
        let (Some(map), Some(scaled)) =
            (here.focus().fit(&settings).into_map(), there.focus().fit(&settings).into_map())
        else {
            return;
        };
        for round in rounds(&here, &case, seed) {
            let larger = Round { centre: round.centre * scale, radius: round.radius * scale, ..round };
            let (one, other) = (round.splat(&map), larger.splat(&scaled));
            // Squares of what is tiny across may leave the normal range of f64 in one of the two.
            let is_tiny = |splat: &Splat| splat.half.min_element() < 1e-100;
            if !one.iter().chain(&other).any(is_tiny) {
                assert_eq!(one, other, "{round:?}");
            }
        }
    });
}

/// Through parallel light a ball is a ball: in texels, its radius over what a texel covers.
#[test]
fn in_a_uniform_map_of_the_sun_a_ball_is_a_radius_and_a_disc_across_the_light_too() {
    let map = landscape(&Settings::default().with_warp(Warp::Uniform));
    let (centre, radius) = (DVec3::new(1.0, 0.5, -3.0), 0.25);
    let expected = 2048.0 * radius / DVec2::new(map.window().width, map.window().height);
    let place = map.texture_from_world().project_point3(centre).truncate() * 2048.0;
    for splat in [map.splat(centre, radius), map.disc_splat(centre, (0.6, 2.0, 0.4), radius)] {
        let splat = splat.expect("in the map");
        assert!((splat.half / expected - 1.0).abs().max_element() < 1e-12, "{splat:?}, not {expected}");
        assert!((splat.centre - place).length() < 1e-9, "{splat:?}, not {place}");
        assert_eq!(splat.diameter(), 2.0 * splat.half.max_element());
    }
    // From its edge a disc is a line: across the light and across its normal it is as wide as ever.
    let edge = map.disc_splat(centre, DVec3::new(1.0, 0.0, -1.5), radius).expect("in the map");
    let flat = map.splat(centre, radius).expect("in the map");
    assert!(edge.half.cmple(flat.half).all() && edge.half.length() < 1.0001 * flat.half.max_element());
}

#[test]
fn a_covering_rectangle_holds_the_middle_of_a_texel_wherever_it_falls() {
    let map = landscape(&Settings::default());
    let mut numbers = Numbers(7);
    for _ in 0..10_000 {
        let place = DVec3::new(20.0 * numbers.part() - 10.0, numbers.part(), -10.0 * numbers.part());
        let exact = map.disc_splat(place, direction(&mut numbers), 1e-3).expect("in the map");
        let splat = exact.covering();
        assert!(splat.half.cmpge(exact.half).all() && splat.centre == exact.centre);
        // Corners on a grid of 256ths, each moved by half a step at most.
        let [low, high] = [-1.0, 1.0].map(|sign| ((splat.centre + splat.half * sign) * 256.0).round() / 256.0);
        let first_middle = (low - 0.5).ceil() + 0.5;
        assert!(first_middle.cmplt(high).all(), "{splat:?} holds no middle of a texel");
    }
    let large = Splat { centre: DVec2::ONE, half: DVec2::new(3.0, 0.25) };
    assert_eq!(large.covering().half.x, 3.0);
}

#[test]
fn numbers_that_are_none_have_no_bounds() {
    let map = landscape(&Settings::default());
    let (point, up) = (DVec3::new(1.0, 0.5, -3.0), DVec3::Y);
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(map.splat(point, radius), None);
        assert_eq!(map.disc_splat(point, up, radius), None);
    }
    for centre in [DVec3::NAN, DVec3::INFINITY, DVec3::splat(f64::MAX)] {
        assert_eq!(map.splat(centre, 1.0), None);
        assert_eq!(map.disc_splat(centre, up, 1.0), None);
    }
    for normal in [DVec3::ZERO, DVec3::NAN, DVec3::NEG_INFINITY] {
        assert_eq!(map.disc_splat(point, normal, 1.0), None);
    }
    let point = map.splat(point, 0.0).expect("a point has a place");
    assert_eq!(point.half, DVec2::ZERO);
}
