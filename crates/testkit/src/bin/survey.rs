//! How much each warp gains: worst aliasing over what is visible, over the uniform map's and over the least that any spread of the
//! same texels could have, on random outdoor views.
//!
//! `cargo run --release -p testkit --bin survey`

use rand::SeedableRng;
use rand::rngs::StdRng;
use shadowfit::{Effort, Focus, FocusForm, Settings, Warp, warp::Shift};
use testkit::outdoors::{self, Kind};

/// Views that are drawn for each kind of light.
const VIEWS: usize = 3_000;

fn main() {
    let settings = Settings::default();
    let psm = settings.with_warp(Warp::Perspective);
    let maps = [
        ("uniform", settings.with_warp(Warp::Uniform)),
        ("perspective, unshifted", psm.with_shift(Shift::None)),
        ("perspective, by paper's H", psm.with_shift(Shift::Back(FocusForm::ViewHull))),
        ("perspective, by tight H", psm.with_shift(Shift::Back(FocusForm::ReceiverHull))),
        ("light-space", settings.with_warp(Warp::LightSpace)),
        ("trapezoidal", settings.with_warp(Warp::Trapezoidal)),
        ("best of closed forms", settings.with_warp(Warp::Best(Effort::ClosedForms))),
        ("best, rough", settings.with_warp(Warp::Best(Effort::Rough))),
        ("best, good", settings.with_warp(Warp::Best(Effort::Good))),
        ("best, thorough", settings.with_warp(Warp::Best(Effort::Thorough))),
    ];
    let scene = outdoors::town();
    for kind in Kind::ALL {
        let mut random = StdRng::seed_from_u64(1);
        // For each map, over the uniform one and over the limit.
        let mut ratios = maps.map(|_| [const { Vec::new() }; 2]);
        for _ in 0..VIEWS {
            let (view, light) = (outdoors::view(&mut random), kind.light(&mut random));
            let focus = Focus::new(&view, &light, &scene);
            let aliasing = |settings: &Settings| Some(focus.fit(settings).map()?.report(&focus).aliasing);
            let limit = focus.aliasing_lower_bound(&settings);
            let Some(uniform) = aliasing(&maps[0].1) else { continue };
            for (ratios, (_, settings)) in ratios.iter_mut().zip(&maps) {
                if let Some(aliasing) = aliasing(settings) {
                    ratios[0].push(aliasing / uniform);
                    ratios[1].push(aliasing / limit);
                }
            }
        }
        let views = ratios[0][0].len();
        println!(
            "\n{kind:?}: worst aliasing over that of the uniform map, and over the limit, {views} random outdoor views\n"
        );
        println!("| map | 10 % | median | 90 % | worse than uniform | over the limit: 10 % | median | 90 % |");
        println!("|---|---|---|---|---|---|---|---|");
        for (ratios, (name, _)) in ratios.iter_mut().zip(&maps) {
            ratios.iter_mut().for_each(|ratios| ratios.sort_by(f64::total_cmp));
            let at = |of: &[f64], part: f64| of[((of.len() - 1) as f64 * part) as usize];
            let [uniform, limit] = &ratios;
            // Both maps have rounding of their own in their windows.
            let worse = uniform.iter().filter(|&&ratio| ratio > 1.001).count() as f64 / uniform.len() as f64;
            let [p10, p50, p90] = [0.1, 0.5, 0.9].map(|part| at(uniform, part));
            print!("| {name} | {p10:.3} | {p50:.3} | {p90:.3} | {:.1} % ", 100.0 * worse);
            let [p10, p50, p90] = [0.1, 0.5, 0.9].map(|part| at(limit, part));
            println!("| {p10:.1} | {p50:.1} | {p90:.1} |");
        }
    }
}
