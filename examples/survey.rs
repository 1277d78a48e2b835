//! How much the warp gains: worst aliasing over what is visible, warped over uniform, on random outdoor views.
//!
//! `cargo run --release --example survey`

// Views may be drawn with whatever sines the platform has.
#![allow(clippy::disallowed_methods)]

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::glam::DVec3;
use shadowfit::{Focus, Form, InputError, Light, Scene, Settings, Shift, View, Warp};
use std::f64::consts::TAU;

/// Views that are drawn.
const VIEWS: usize = 3_000;

fn main() -> Result<(), InputError> {
    let settings = Settings::default();
    let maps = [
        ("unshifted", settings.with_shift(Shift::None)),
        ("shifted by the paper's H", settings.with_shift(Shift::Back(Form::Paper))),
        ("shifted by the tight H", settings.with_shift(Shift::Back(Form::Tight))),
    ];
    let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 15.0, 200.0))?;
    let mut random = StdRng::seed_from_u64(1);
    let mut ratios = [const { Vec::new() }; 3];
    for _ in 0..VIEWS {
        let (view, sun) = (view(&mut random)?, sun(&mut random)?);
        let focus = Focus::new(&view, &sun, &scene);
        let aliasing = |settings: &Settings| Some(focus.fit(settings).map()?.report(&focus).aliasing);
        let Some(uniform) = aliasing(&settings.with_warp(Warp::Uniform)) else { continue };
        for (ratios, (_, settings)) in ratios.iter_mut().zip(&maps) {
            ratios.extend(aliasing(settings).map(|warped| warped / uniform));
        }
    }

    println!("worst aliasing of the perspective warp over that of the uniform map, {VIEWS} random outdoor views\n");
    println!("{:26}   10 %   25 %   50 %   75 %   90 %    worst   worse than uniform", "");
    for (ratios, (name, _)) in ratios.iter_mut().zip(&maps) {
        ratios.sort_by(f64::total_cmp);
        let at = |part: f64| ratios[((ratios.len() - 1) as f64 * part) as usize];
        // Both maps have rounding of their own in their windows.
        let worse = ratios.iter().filter(|&&ratio| ratio > 1.0001).count() as f64 / ratios.len() as f64;
        let [p10, p25, p50, p75, p90, most] = [0.1, 0.25, 0.5, 0.75, 0.9, 1.0].map(at);
        print!("{name:26} {p10:6.3} {p25:6.3} {p50:6.3} {p75:6.3} {p90:6.3} {most:8.3}");
        println!("   {:6.1} % of {}", 100.0 * worse, ratios.len());
    }
    Ok(())
}

/// Somebody standing in a town and looking around.
fn view(random: &mut StdRng) -> Result<View, InputError> {
    let (yaw, pitch) = (random.random_range(0.0..TAU), random.random_range(-0.6..0.1_f64));
    let forward = DVec3::new(yaw.cos() * pitch.cos(), pitch.sin(), yaw.sin() * pitch.cos());
    let mut coordinate = |low: f64, high: f64| random.random_range(low..high);
    let eye = DVec3::new(coordinate(-50.0, 50.0), coordinate(1.0, 10.0), coordinate(-50.0, 50.0));
    let (near, far) = (10.0_f64.powf(coordinate(-1.0, 0.3)), 10.0_f64.powf(coordinate(2.0, 3.0)));
    View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, near, far)
}

/// A sun between 6° and 86° above the horizon.
fn sun(random: &mut StdRng) -> Result<Light, InputError> {
    let (azimuth, height) = (random.random_range(0.0..TAU), random.random_range(0.1..1.5_f64));
    Light::directional((azimuth.cos() * height.cos(), height.sin(), azimuth.sin() * height.cos()))
}
