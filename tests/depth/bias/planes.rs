//! With its bias no plane shadows itself in a map, and with less some do.

use std::cell::Cell;

use glam::Vec4Swizzles;
use proptest::prelude::*;
use shadowfit::{ClipSpace, DepthFormat, Outcome, depth::DepthBias};

use super::simulate::{Card, UNITS, drawing, margin};
use testkit::arbitrary::{Together, case, points_of, run, settings};

#[test]
fn no_plane_shadows_itself() {
    let (tested, grazing) = (Cell::new(0_u32), Cell::new(0_u32));
    run(8000, &(case(), settings(), drawing(), any::<u64>()), |(case, settings, how, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map);
        let bias = map.bias(how.format, how.reach).expect("a legal reach");
        for (i, point) in points_of(&focus.receiver_volume(), seed).into_iter().enumerate() {
            if !together.is_served(point) {
                continue;
            }
            let seed = seed.wrapping_add(i as u64);
            let Some(margin) = margin(&card, &together.light, point, &bias, &how, seed) else { continue };
            assert!(margin >= 0.0, "{point} is in its own shadow by {margin}, {bias:?}");
            tested.set(tested.get() + 1);
            grazing.set(grazing.get() + u32::from(how.lean > 3.0));
        }
    });
    // The premises leave out points at the end of what is visible, whose neighbours round more coarsely.
    assert!(tested.get() > 2 * grazing.get() && grazing.get() > 1000, "{} and {}", tested.get(), grazing.get());
}

/// Half of the slope is too little, and so is a map without the receiver's parts: neither is there for safety alone.
#[test]
fn less_is_not_enough() {
    let [steep, with_half, flat, without_receiver] = [(); 4].map(|()| Cell::new(0_u32));
    run(8000, &(case(), settings(), drawing(), any::<u64>()), |(case, settings, how, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map);
        let bias = map.bias(how.format, how.reach).expect("a legal reach");
        let count = |of: &Cell<u32>, bad: &Cell<u32>, margin: Option<f64>| {
            let Some(margin) = margin else { return };
            of.set(of.get() + 1);
            bad.set(bad.get() + u32::from(margin < 0.0));
        };
        for (i, point) in points_of(&focus.receiver_volume(), seed).into_iter().enumerate() {
            let seed = seed.wrapping_add(i as u64);
            if !together.is_served(point) {
                continue;
            }
            let margin = |bias: &DepthBias| margin(&card, &together.light, point, bias, &how, seed);
            if how.lean > 3.0 && how.format != DepthFormat::Unorm8 {
                count(&steep, &with_half, margin(&DepthBias { slope_scale: 0.5 * bias.slope_scale, ..bias }));
            }
            if how.lean == 0.0 && how.format == DepthFormat::Float32 {
                let without = DepthBias { receiver: 0.0, relative: 0.0, ..bias };
                count(&flat, &without_receiver, margin(&without));
            }
        }
    });
    let [steep, with_half, flat, without_receiver] =
        [steep, with_half, flat, without_receiver].map(Cell::into_inner);
    let counts = format!("{with_half} of {steep}, {without_receiver} of {flat}");
    assert!(steep > 1000 && 10 * with_half > steep, "{counts} shadow themselves");
    // Flat planes need it only where f32 is about as far off as it can be and a unit is next to nothing.
    assert!(flat > 1000 && 100 * without_receiver > flat, "{counts} shadow themselves");
}

#[test]
fn places_are_as_quiet_as_the_window_says() {
    run(5000, &(case(), settings(), any::<u64>()), |(case, settings, seed)| {
        let together = Together::of(&case);
        let focus = together.focus();
        let Outcome::Map(map) = focus.fit(&settings) else { return };
        let card = Card::new(&map);
        for point in points_of(&focus.receiver_volume(), seed) {
            if !together.is_served(point) {
                continue;
            }
            // Where f32 loses half of w there is no bound.
            let rows = map.clip_from_world_in(ClipSpace::WGPU).transpose();
            let (w, origin) = (rows.w_axis, card.origin);
            let terms = w.xyz().abs().dot((point - origin).abs()) + w.dot(origin.extend(1.0)).abs();
            if UNITS * terms > 0.5 * w.dot(point.extend(1.0)) {
                continue;
            }
            let off = card.place_in_f32(&map.receiver_matrix(), point) - card.place(point);
            let (off, noise) = (off.truncate().abs().max_element(), map.place_rounding(point));
            assert!(noise <= map.window().rounding);
            assert!(off <= noise, "{point}: {off} texels, noise {noise}");
        }
    });
}
