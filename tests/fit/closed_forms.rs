//! Figures that have closed forms, and configurations that must give the same answer.
//!
//! The table of `docs/design.md`, section 8: light at right angles to the view, all of V receives, T the tangent of half the field
//! of view. Rs and Rt are the texels needed across and along the warp for each pixel of the image's height, so that no
//! texel is larger than a pixel:
//!
//! ```text
//!     uniform    Rs = f/n      Rt = (f − n)/(2T n)
//!     PSM        Rs = 1        Rt = (f − n)/(2T n)
//!     LiSPSM     Rs = √(f/n)   Rt = (f − n)/(2T √(nf))
//! ```
//!
//! These are cases of one formula: for the plane c = 0 at n' before the near plane, f' = n' + f − n,
//!
//! ```text
//!     Rs = max(n/n', f/f') max(n'/n, f'/f)      Rt = (f − n)/(2T n' f') max(n'²/n, f'²/f)
//! ```
//!
//! of which that page has the Rs of n' ≥ n, where the wider parts are the first of one and the second of the other: the window
//! is as wide as the widest of R over c, and a texel as wide as that times c.

use approx::assert_relative_eq;
use shadowfit::glam::DVec3;
use shadowfit::{
    Focus, Light, Origin, Outcome, Scene, Settings, ShadowMap, View, Warp, WarpFallback, fit,
    warp::{ClassKind, Shift, classify},
};

const WARPS: [Warp; 4] = [Warp::Uniform, Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal];

/// The field of view with 2T = 1, twice the angle whose tangent is a half.
const FOV: f64 = 0.927_295_218_001_612_2;
/// As many texels a side as the image has pixels, so that a ratio of sizes is a ratio of counts.
const PIXELS: u32 = 1024;

fn settings(warp: Warp) -> Settings {
    let settings = Settings::new(PIXELS, PIXELS).unwrap().with_border(0).unwrap();
    settings.with_warp(warp).with_shift(Shift::None)
}

fn map(outcome: Outcome) -> ShadowMap {
    outcome.into_map().expect("a map")
}

/// Texels needed across and along the warp for each pixel, the worst over V.
fn needed(far: f64, warp: Warp) -> (f64, f64) {
    sizes(far, &settings(warp))
}

/// The largest size of a texel in pixels, over V, across and along the warp.
fn sizes(far: f64, settings: &Settings) -> (f64, f64) {
    let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, FOV, 1.0, 1.0, far).unwrap();
    let light = Light::directional(DVec3::Y).unwrap();
    let side = DVec3::splat(2.0 * far);
    let scene = Scene::from_box(-side, side).unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let map = map(focus.fit(settings));

    // A ten-thousandth for rounding is all that it may be.
    let padding = map.window().padding;
    assert!(padding.0 > 0.0 && padding.0 < 1e-4 && padding.1 > 0.0 && padding.1 < 1e-4, "{padding:?}");
    // The warp runs along y. What the window is larger than R by, it says, and footprints are larger by as much.
    let (across, along) = padding;
    let body = focus.receiver_volume();
    body.vertices().iter().fold((0.0, 0.0), |(rs, rt): (f64, f64), &point| {
        let (texel, pixel) = (map.footprint(point).unwrap(), map.pixel_size(point));
        let step = texel.along_x.length();
        (rs.max(step / pixel * (1.0 - across)), rt.max(texel.area() / step / pixel * (1.0 - along)))
    })
}

/// What is left when the window's padding, 1e-6 and more of it, is divided out: planes stand 96 ε of the sum of their
/// terms' magnitudes outside, here of two coordinates of 2f, and a corner is where three of them meet, the nearest at n,
/// f/n = 10⁴ at most.
const CLOSE: f64 = 3.0 * 96.0 * f64::EPSILON * 2.0 * 2e4;

#[test]
fn texels_needed_by_the_uniform_map() {
    for far in [10.0, 100.0, 1000.0, 1e4] {
        let (rs, rt) = needed(far, Warp::Uniform);
        assert_relative_eq!(rs, far, max_relative = CLOSE);
        assert_relative_eq!(rt, far - 1.0, max_relative = CLOSE);
    }
}

#[test]
fn texels_needed_by_the_perspective_map() {
    for far in [10.0, 100.0, 1000.0, 1e4] {
        let (rs, rt) = needed(far, Warp::Perspective);
        // Where f/n is more than 256, c varies by that much, and is zero so far before the near plane.
        let (of_plane_rs, of_plane_rt) = of_plane(((far - 1.0) / 255.0).max(1.0), far);
        assert_relative_eq!(rs, of_plane_rs, max_relative = CLOSE);
        assert_relative_eq!(rt, of_plane_rt, max_relative = CLOSE);
        if far <= 100.0 {
            assert_relative_eq!(rs, 1.0, max_relative = CLOSE);
            assert_relative_eq!(rt, far - 1.0, max_relative = CLOSE);
        }
    }
}

/// Rs and Rt for n = 1, 2T = 1 and the plane c = 0 at `before` before the near plane.
fn of_plane(before: f64, far: f64) -> (f64, f64) {
    let (near, last) = (before, before + far - 1.0);
    let rs = (1.0 / near).max(far / last) * near.max(last / far);
    (rs, (far - 1.0) / (last * near) * (near * near).max(last * last / far))
}

/// z_n, where the near plane is at 1: 1, and no less than a 256th of the largest depth.
fn z_n(far: f64) -> f64 {
    (far / 256.0).max(1.0)
}

/// The plane c = 0 lies n_opt = z_n + √(z_n (z_n + f − n)) before the near plane, n + √(nf) where f/n is no more than 256; the
/// figures of the table to its six digits.
#[test]
fn texels_needed_by_the_light_space_map() {
    let table = [(10.0, 3.162_28, 2.846_05), (100.0, 10.0, 9.9), (1000.0, 31.622_8, 31.591_2), (1e4, 100.0, 99.99)];
    for (far, table_rs, table_rt) in table {
        let (rs, rt) = needed(far, Warp::LightSpace);
        let z_n = z_n(far);
        let (of_plane_rs, of_plane_rt) = of_plane(z_n + f64::sqrt(z_n * (z_n + far - 1.0)), far);
        assert_relative_eq!(rs, of_plane_rs, max_relative = CLOSE);
        assert_relative_eq!(rt, of_plane_rt, max_relative = CLOSE);
        if z_n == 1.0 {
            for (found, table) in [(rs, table_rs), (rt, table_rt)] {
                assert_relative_eq!(found, table, max_relative = 5e-6);
            }
            assert_relative_eq!(rs, far.sqrt(), max_relative = CLOSE);
            assert_relative_eq!(rt, (far - 1.0) / far.sqrt(), max_relative = CLOSE);
        }
    }
}

/// A map of just so many texels across and along has no texel larger than a pixel either way, and with fewer it would. Whole
/// numbers of texels may be a little more.
#[test]
fn a_map_of_the_texels_needed_has_none_larger_than_a_pixel() {
    for far in [10.0, 50.0, 100.0, 250.0_f64] {
        let root = far.sqrt();
        let forms = [
            (Warp::Uniform, far, far - 1.0),
            (Warp::Perspective, 1.0, far - 1.0),
            (Warp::LightSpace, root, (far - 1.0) / root),
        ];
        // The uniform map needs the most.
        let pixels = (f64::from(Settings::MAX_SIZE) / far).floor().min(f64::from(PIXELS));
        for (warp, rs, rt) in forms {
            let (width, height) = ((rs * pixels).ceil(), (rt * pixels).ceil());
            let settings = Settings::new(PIXELS, pixels as u32).unwrap().with_border(0).unwrap();
            let settings = settings.with_map_sides(width as u32, height as u32).unwrap();
            let (across, along) = sizes(far, &settings.with_warp(warp).with_shift(Shift::None));
            assert!(across <= 1.0 + CLOSE && along <= 1.0 + CLOSE, "{warp:?}, {far}: {across} and {along} pixels");
            assert_relative_eq!(across, rs * pixels / width, max_relative = CLOSE);
            assert_relative_eq!(along, rt * pixels / height, max_relative = CLOSE);
        }
    }
}

/// Light from right above sees all depths alike: λ = f − n, and the focus, at the part p of the depths, is δ' = pλ from the
/// top: n' = η = 0.4 p λ/(1.6 − 2 p).
#[test]
fn texels_needed_by_the_trapezoidal_map() {
    for far in [10.0, 100.0, 1000.0, 1e4] {
        let (rs, rt) = needed(far, Warp::Trapezoidal);
        let eta = 0.4 * FOCUS * (far - 1.0) / (1.6 - 2.0 * FOCUS);
        let (of_plane_rs, of_plane_rt) = of_plane(eta, far);
        assert_relative_eq!(rs, of_plane_rs, max_relative = CLOSE);
        assert_relative_eq!(rt, of_plane_rt, max_relative = CLOSE);
    }
}

/// Where the trapezoid is focused, as a part of the depths of what is visible: the crate's choice.
const FOCUS: f64 = 1.0 / 5.0;

/// A view with a square image down to 2T = 0.8, and a scene that holds all of it.
fn frustum(far: f64) -> (View, Scene<'static>) {
    let (eye, forward) = (DVec3::new(3.0, -2.0, 7.0), DVec3::new(0.48, -0.6, 0.64));
    let view = View::perspective(eye, forward, DVec3::Y, 2.0 * 0.4_f64.atan(), 1.0, 1.0, far).unwrap();
    (view, Scene::from_box(DVec3::splat(-2.0 * far), DVec3::splat(2.0 * far)).unwrap())
}

/// The view's direction as a light sees it, and the sine of the angle between them.
fn view_across(view: &View, sun: &Light) -> (DVec3, f64) {
    let to_light = sun.homogeneous().truncate();
    let across = view.forward() - to_light * to_light.dot(view.forward());
    (across.normalize(), across.length())
}

fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| (min.min(value), max.max(value)))
}

/// Suns over all the sky, in steps of the golden angle, of which those that are nearer than 3° to the view or what it looks
/// away from are left out: there the sine that the formulas divide by is small, and roundings are not.
fn suns(view: &View) -> impl Iterator<Item = Light> {
    let view = *view;
    let direction = |step: i32| {
        let (up, turn) = ((f64::from(step) + 0.5) / 200.0 - 1.0, 2.399_963_229_728_653 * f64::from(step));
        let across = (1.0 - up * up).sqrt();
        Light::directional((turn.cos() * across, up, turn.sin() * across)).unwrap()
    };
    (0..400).map(direction).filter(move |sun| view_across(&view, sun).1 > 0.05)
}

/// w of a directional light's map grows along the view as the light sees it, from zero at n before what is visible:
/// n = (z_n + √(z_n z_f))/sin γ, with z_f = z_n + d sin γ (Wimmer, Scherzer & Purgathofer 2004).
#[test]
fn the_light_space_map_has_the_published_distance() {
    for far in [10.0, 100.0, 1000.0] {
        let (view, scene) = frustum(far);
        for sun in suns(&view) {
            let focus = Focus::new(&view, &sun, &scene);
            let settings = settings(Warp::LightSpace).with_origin(Origin::Eye);
            let map = map(focus.fit(&settings));
            assert_eq!((map.fallback(), map.weakening()), (None, 0.0));
            let visible = focus.receiver_volume();
            let (along, sine) = view_across(&view, &sun);
            let w = map.clip_from_world().row(3);
            assert!(w.truncate().normalize().distance(along) < CLOSE, "{w} is not along {along}");

            let (top, base) = range(visible.vertices().iter().map(|&point| along.dot(point)));
            let (least, _) = range(visible.vertices().iter().map(|&point| w.dot(point.extend(1.0))));
            let z_n = z_n(far);
            let z_f = z_n + (base - top) * sine;
            let published = (z_n + (z_n * z_f).sqrt()) / sine;
            assert_relative_eq!(least / w.truncate().length(), published, max_relative = CLOSE);
        }
    }
}

/// As the light turns into the view, the light-space warp fades by itself: with D = d sin γ the eye depth that c runs over, it
/// varies by 1 + D/(z_n + √(z_n (z_n + D))), and D goes with the sine.
#[test]
fn the_light_space_map_fades_to_the_uniform_one() {
    let (view, scene) = frustum(100.0);
    for sign in [1.0, -1.0] {
        for k in 0..=16 {
            let sun = Light::directional(view.forward() * sign + view.right() * 10_f64.powi(-k)).unwrap();
            let focus = Focus::new(&view, &sun, &scene);
            let map = map(focus.fit(&settings(Warp::LightSpace).with_origin(Origin::Eye)));
            assert_eq!((map.fallback(), map.weakening()), (None, 0.0));
            let (along, sine) = view_across(&view, &sun);
            let (top, base) =
                range(focus.receiver_volume().vertices().iter().map(|&point| along.dot(point) * sine));
            let depth = base - top;
            assert_relative_eq!(map.warp_ratio(), 1.0 + depth / (1.0 + (1.0 + depth).sqrt()), max_relative = CLOSE);
        }
    }
}

/// Lamps around the middle of a view, beyond all that it shows, in the directions of [`suns`].
fn lamps(view: &View) -> impl Iterator<Item = Light> {
    let middle = view.eye() + view.forward() * (0.5 * view.far());
    let distance = 3.0 * view.far();
    suns(view).map(move |sun| {
        let position = middle + sun.homogeneous().truncate() * distance;
        Light::point(position, 1.0, f64::INFINITY).unwrap()
    })
}

/// Where rays meet the plane across the axis of a light's maps, through the middle of what is visible.
fn onto_plane(focus: &Focus<'_>, light: &Light) -> impl Fn(DVec3) -> DVec3 {
    let l = light.homogeneous();
    let axis = match light.position() {
        Some(_) => map(focus.fit(&settings(Warp::Uniform))).clip_from_world().row(3).truncate().normalize(),
        None => -l.truncate(),
    };
    let origin = light.position().unwrap_or(focus.view().eye());
    let along = move |point: DVec3| axis.dot(point - origin);
    let (near, far) = range(focus.receiver_volume().vertices().iter().map(|&point| along(point)));
    let middle = 0.5 * (near + far);
    move |point| match l.w > 0.0 {
        true => origin + (point - origin) * (middle / along(point)),
        false => point + axis * (middle - along(point)),
    }
}

/// After its own perspective a lamp is a sun: on the plane across its axis w grows with eye depth h from h₀, and is zero at
/// z_n + √(z_n (z_n + h₁ − h₀)) less than that.
#[test]
fn the_light_space_map_of_a_lamp_is_that_of_a_sun_on_the_plane_across() {
    for far in [10.0, 100.0, 1000.0] {
        let (view, scene) = frustum(far);
        for lamp in lamps(&view) {
            let focus = Focus::new(&view, &lamp, &scene);
            let map = map(focus.fit(&settings(Warp::LightSpace).with_origin(Origin::Eye)));
            assert_eq!((map.fallback(), map.weakening()), (None, 0.0));
            let (visible, onto_plane) = (focus.receiver_volume(), onto_plane(&focus, &lamp));
            let w = map.clip_from_world().row(3);
            let on_plane: Vec<DVec3> = visible.vertices().iter().map(|&point| onto_plane(point)).collect();
            let (first, last) = range(on_plane.iter().map(|&point| view.depth(point)));
            let (least, _) = range(on_plane.iter().map(|&point| w.dot(point.extend(1.0))));
            let z_n = z_n(far);
            let before = z_n + (z_n * (z_n + last - first)).sqrt();
            for point in on_plane {
                let expected = (view.depth(point) - first + before) / before;
                assert_relative_eq!(w.dot(point.extend(1.0)) / least, expected, max_relative = CLOSE);
            }
        }
    }
}

/// The 80 % rule: the focus, on the central ray, is four fifths of the way through the map from its top to its base, along the
/// centre line. On a line on which w is c, that way is `t/λ · c(λ)/c(t)`.
#[test]
fn the_trapezoidal_map_keeps_four_fifths_for_its_focus() {
    for far in [10.0, 100.0, 1000.0] {
        let (view, scene) = frustum(far);
        for light in suns(&view).chain(lamps(&view)) {
            let focus = Focus::new(&view, &light, &scene);
            let map = map(focus.fit(&settings(Warp::Trapezoidal).with_origin(Origin::Eye)));
            let (visible, onto_plane) = (focus.receiver_volume(), onto_plane(&focus, &light));
            let on_plane = || visible.vertices().iter().map(|&point| onto_plane(point));
            let focused = onto_plane(view.eye() + view.forward() * (1.0 + FOCUS * (far - 1.0)));
            let line = (focused - onto_plane(view.eye())).normalize();
            let (top, base) = range(on_plane().map(|point| line.dot(point)));
            let part = (line.dot(focused) - top) / (base - top);
            assert_eq!((map.fallback(), map.weakening()), (None, 0.0), "{part}");
            let w = map.clip_from_world().row(3);
            let c = |point: DVec3| w.dot(point.extend(1.0));
            let (_, at_base) = range(on_plane().map(c));
            assert_relative_eq!(part * at_base / c(focused), 0.8, max_relative = CLOSE);
        }
    }
}

/// As the focus comes to take four fifths of the map by itself, the trapezoid's warp fades: with x = δ'/λ, c varies by
/// 1 + (1.6 − 2x)/(0.4 x). Then it is refused.
#[test]
fn the_trapezoidal_map_fades_to_the_uniform_one() {
    // All that is visible is the ground, from depth 4 to 36. A sun from behind throws the focus, 2 above it, forward.
    let view = View::perspective((0.0, 2.0, 0.0), DVec3::NEG_Z, DVec3::Y, 2.0 * 0.5_f64.atan(), 1.0, 1.0, 36.0);
    let view = view.unwrap();
    let scene = Scene::from_box((-50.0, 0.0, -50.0), (50.0, 0.0, 50.0)).unwrap();
    let (mut warped, mut before, mut refused) = (0, 0, 0);
    for step in -200..400 {
        let part = FOCUS + (f64::from(step) + 0.5) * 2e-3;
        let cotangent = (part - FOCUS) * 32.0 / 2.0;
        let sun = Light::directional((0.0, 1.0, cotangent)).unwrap();
        let focus = Focus::new(&view, &sun, &scene);
        let map = map(focus.fit(&settings(Warp::Trapezoidal)));
        if part < 0.8 {
            assert_eq!((map.fallback(), map.weakening()), (None, 0.0));
            // A sun from ahead throws it before all that is visible, and no nearer to the top is it taken to be than this.
            let least = FOCUS / 4.0;
            (warped, before) = if part > least { (warped + 1, before) } else { (warped, before + 1) };
            let part = part.max(least);
            assert_relative_eq!(map.warp_ratio(), 1.0 + (1.6 - 2.0 * part) / (0.4 * part), max_relative = CLOSE);
        } else {
            assert_eq!((map.fallback(), map.warp_ratio()), (Some(WarpFallback::FocusLarge), 1.0));
            refused += 1;
        }
    }
    assert!(warped > 100 && before > 50 && refused > 50, "{warped} {before} {refused}");
}

/// What cannot be warped is the uniform map to the last bit, and says why.
#[test]
fn a_refused_warp_is_the_uniform_map() {
    let scene = Scene::from_box((-50.0, -5.0, -50.0), (50.0, 5.0, 50.0)).unwrap();
    let ahead = View::perspective((0.0, 1.0, 20.0), DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.5, 90.0).unwrap();
    let parallel = View::orthographic((0.0, 1.0, 20.0), DVec3::NEG_Z, DVec3::Y, 9.0, 1.5, 0.5, 90.0).unwrap();
    let sun = |x, y, z| Light::directional((x, y, z)).unwrap();
    // What lies to the right of the view and before the lamp, while the view's central ray is behind it.
    let beside = Light::spot((3.0, 1.0, 0.0), DVec3::X, 0.5, 0.1, 40.0).unwrap();
    let miner = Light::spot((0.0, 1.0, 20.0), DVec3::NEG_Z, 0.7, 0.1, 90.0).unwrap();
    let cases = [
        (parallel, sun(0.3, 1.0, 0.2), Warp::LightSpace, WarpFallback::NoPerspective),
        (parallel, sun(0.3, 1.0, 0.2), Warp::Trapezoidal, WarpFallback::NoPerspective),
        (ahead, sun(0.0, 0.0, 1.0), Warp::Trapezoidal, WarpFallback::AlongView),
        (ahead, sun(0.0, 0.0, -1.0), Warp::Trapezoidal, WarpFallback::AlongView),
        (ahead, miner, Warp::Trapezoidal, WarpFallback::AlongView),
        (ahead, beside, Warp::Trapezoidal, WarpFallback::FocusBehindLight),
    ];
    for (view, light, warp, reason) in cases {
        let focus = Focus::new(&view, &light, &scene);
        let refused = map(focus.fit(&settings(warp)));
        let uniform = map(focus.fit(&settings(Warp::Uniform)));
        assert_eq!(refused.fallback(), Some(reason), "{light:?}, {warp:?}");
        assert_eq!(refused.report(&focus).fallback, Some(reason));
        assert!(!reason.to_string().is_empty());
        assert_eq!(refused.clip_from_world(), uniform.clip_from_world());
        assert_eq!((refused.warp_ratio(), refused.weakening()), (1.0, 1.0));
        assert_eq!(uniform.fallback(), None);
    }
}

/// Light along the view or against it: there is no perspective to undo, the warp is the uniform map, also where what is
/// visible is off the axis.
#[test]
fn along_the_view_the_warp_is_the_uniform_map() {
    let eye = DVec3::new(3.0, -2.0, 7.0);
    let forward = DVec3::new(0.48, -0.6, 0.64);
    let view = View::perspective(eye, forward, DVec3::Y, 1.1, 1.6, 0.3, 400.0).unwrap();
    for (min, max) in [
        (DVec3::splat(-600.0), DVec3::splat(600.0)),
        (eye + DVec3::new(4.0, -40.0, 10.0), eye + DVec3::new(60.0, -3.0, 31.0)),
        (eye + DVec3::new(-1.0, -9.0, 1.0), eye + DVec3::new(2.0, -2.0, 80.0)),
    ] {
        let scene = Scene::from_box(min, max).unwrap();
        for direction in [forward, -forward] {
            let light = Light::directional(direction).unwrap();
            let focus = Focus::new(&view, &light, &scene);
            let uniform = map(focus.fit(&settings(Warp::Uniform)));
            for warp in [Warp::Perspective, Warp::LightSpace, Warp::Trapezoidal] {
                let warped = map(focus.fit(&settings(warp)));
                assert_relative_eq!(warped.warp_ratio(), 1.0, epsilon = CLOSE);
                for &point in focus.receiver_volume().vertices() {
                    let (ours, theirs) = (warped.aliasing(point), uniform.aliasing(point));
                    assert_relative_eq!(ours.unwrap(), theirs.unwrap(), max_relative = CLOSE);
                }
            }
        }
    }
}

/// Hard case 15. From a light at a distance D a scene of size S is seen under an angle S/D: rays differ by that
/// from those of a light at infinity, and each coordinate in the map by a few times that.
#[test]
fn a_light_far_away_is_a_directional_light() {
    const DISTANCE: f64 = 1e9;
    const SIZE: f64 = 200.0;
    let eye = DVec3::new(10.0, 2.0, -30.0);
    let view = View::perspective(eye, DVec3::new(0.3, -0.1, 1.0), DVec3::Y, 1.0, 1.5, 0.5, 150.0).unwrap();
    let low = DVec3::new(-80.0, 0.0, -80.0);
    let high = DVec3::new(80.0, 20.0, 80.0);
    let scene = Scene::from_box(low, high).unwrap();
    for direction in [
        DVec3::new(0.0, 1.0, 0.0),
        DVec3::new(0.5, 0.7, 0.2),
        DVec3::new(-0.3, 0.4, 0.9),
        DVec3::new(0.1, 0.2, -0.9),
    ] {
        let sun = Light::directional(direction).unwrap();
        let position = sun.homogeneous().truncate() * DISTANCE;
        let lamp = Light::point(position, 1.0, f64::INFINITY).unwrap();
        for warp in WARPS {
            for shift in [Shift::None, Shift::Back(shadowfit::FocusForm::ReceiverHull)] {
                let settings = settings(warp).with_shift(shift);
                let near = map(fit(&view, &lamp, &scene, &settings));
                let infinite = map(fit(&view, &sun, &scene, &settings));
                let focus = Focus::new(&view, &sun, &scene);
                for &point in focus.receiver_volume().vertices() {
                    let [a, b] = [&near, &infinite].map(|map| {
                        let clip = map.clip_from_world() * point.extend(1.0);
                        clip.truncate() / clip.w
                    });
                    let off = (a - b).abs().max_element();
                    assert!(off < 8.0 * SIZE / DISTANCE, "{direction}, {warp:?}: {a} {b}");
                    let [a, b] = [&near, &infinite].map(|map| map.aliasing(point).unwrap());
                    assert_relative_eq!(a, b, max_relative = 8.0 * SIZE / DISTANCE);
                }
            }
        }
    }
}

/// Hard case 1: λw = 0 with either sign is one light, and one map to the last bit.
#[test]
fn negative_zero_is_zero() {
    let scene = Scene::from_box(DVec3::new(-50.0, -2.0, -50.0), DVec3::new(50.0, 8.0, 50.0)).unwrap();
    for forward in [DVec3::Z, DVec3::NEG_Z] {
        let view = View::perspective(DVec3::ZERO, forward, DVec3::Y, 1.0, 1.3, 0.2, 90.0).unwrap();
        let across = |z: f64| DVec3::new(0.6, 0.8, z);
        let lamp = |z: f64| Light::point(across(z) * 20.0, 0.1, f64::INFINITY).unwrap();
        let sun = |z: f64| Light::directional(across(z)).unwrap();
        for [plus, minus] in [[lamp(0.0), lamp(-0.0)], [sun(0.0), sun(-0.0)]] {
            for light in [&plus, &minus] {
                assert_eq!(classify(&view, light).kind, ClassKind::Directional);
            }
            for warp in WARPS {
                let [a, b] = [plus, minus].map(|light| map(fit(&view, &light, &scene, &settings(warp))));
                assert_eq!(a.clip_from_world(), b.clip_from_world());
                assert_eq!(a.warp_ratio(), b.warp_ratio());
            }
        }
    }
}
