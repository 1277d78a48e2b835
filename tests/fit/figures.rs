//! Figures of a map that follow from others: where its camera is, and how small its texels may be.

use shadowfit::glam::DVec3;
use shadowfit::{
    Focus, FocusForm, Light, Scene, Settings, View, Warp,
    warp::{Shift, VirtualCamera},
};

/// The camera that warps is the view's own, moved back along the view axis by its shift and by nothing else.
#[test]
fn a_shifted_camera_is_behind_the_eye() {
    let eye = DVec3::new(3.0, 1.75, 8.0);
    let view = View::perspective(eye, (0.25, -0.125, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).unwrap();
    let scene = Scene::from_box((-32.0, 0.0, -48.0), (32.0, 8.0, 32.0)).unwrap();
    // From behind the viewer, so that what casts begins behind the eye.
    let sun = Light::directional((0.1, 0.3, 1.0)).unwrap();
    let focus = Focus::new(&view, &sun, &scene);
    for form in [FocusForm::ViewHull, FocusForm::ReceiverHull] {
        let settings = Settings::default().with_shift(Shift::Back(form));
        let map = focus.fit(&settings).into_map().unwrap();
        let camera = map.camera();
        assert_eq!(Some(*camera), VirtualCamera::new(&focus, Shift::Back(form)));
        // The near plane is where the view's was before, and the least depth of H is at it.
        let depths =
            focus.caster_volume(form).vertices().iter().map(|point| view.depth(*point)).collect::<Vec<_>>();
        let (least, most) = depths.iter().fold((f64::MAX, f64::MIN), |(a, b), &depth| (a.min(depth), b.max(depth)));
        assert!(least < -1.0, "{least}");
        assert_eq!(camera.shift, view.near() - least);
        assert!((camera.near - view.near()).abs() <= 1e-12 && (camera.far - (most + camera.shift)).abs() <= 1e-12);
        let behind = view.eye() - view.forward() * camera.shift;
        assert!((camera.eye - behind).length() <= 1e-12, "{} not {behind}", camera.eye);
    }
}

/// Of a scene that is all but a point, far from the origin, texels could be made smaller than what f32 knows of places. They
/// are not: nothing visible is carried farther than a texel, and by as many thousandths of one as w's own rounding is.
#[test]
fn no_texel_is_smaller_than_the_rounding() {
    let sun = Light::directional((0.4, 1.0, 0.3)).unwrap();
    for far in [1.0, 1e3, 1e6] {
        for extent in [0.0, 1e-9, 1e-6, 1e-3] {
            for size in [512, 2048, 8192] {
                let middle = DVec3::new(far, 0.5 * far, -far);
                let eye = middle + DVec3::new(0.0, 2.0, 6.0);
                let view = View::perspective(eye, (0.0, -0.3, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 100.0).unwrap();
                let scene = Scene::from_box(middle - extent, middle + extent).unwrap();
                let settings = Settings::new(size, 1080).unwrap().with_warp(Warp::Uniform);
                let focus = Focus::new(&view, &sun, &scene);
                let map = focus.fit(&settings).into_map().unwrap();
                let rounding = map.window().rounding;
                // w is 1 but for eight roundings of f32, of which three count across half of the map.
                let of_w = 3.0 * 8.0 / 16_777_216.0 * 0.5 * f64::from(size);
                assert!(rounding <= 1.0 + 2.0 * of_w, "{rounding} texels, {far} away, {extent} large, {size}");
            }
        }
    }
}

/// Casters next to a lamp are seen through few bits. They may ask for a thousandth of the window and of w, and no more: with
/// what the visible asks for, twice what f32 carries that by, that is all the padding there is.
#[test]
fn casters_next_to_a_lamp_pad_the_window_by_no_more_than_a_thousandth() {
    let place = DVec3::new(1000.0, -500.0, 700.0);
    let eye = place + DVec3::new(0.0, 1.75, 0.0);
    let view = View::perspective(eye, (0.0, -0.5, -1.0), DVec3::Y, 0.8, 1.5, 0.5, 40.0).unwrap();
    let (min, max) = (place + DVec3::new(-30.0, 0.0, -30.0), place + DVec3::new(30.0, 9.0, 30.0));
    let scene = Scene::from_box(min, max).unwrap();
    for near in [0.25, 1e-2, 1e-4] {
        let lamp = Light::point(place + DVec3::new(0.5, 8.0, 6.0), near, f64::INFINITY).unwrap();
        let focus = Focus::new(&view, &lamp, &scene);
        for warp in [Warp::Uniform, Warp::Perspective] {
            let settings = Settings::default().with_warp(warp);
            let map = focus.fit(&settings).into_map().unwrap();
            let of_visible = 2.0 * map.window().rounding / f64::from(settings.map_size());
            let (across, down) = map.window().padding;
            let most = 2.0 / 1024.0 + 2.0 * of_visible;
            assert!(across.max(down) <= most, "{across} {down}, at most {most}, near {near}, {warp:?}");
        }
    }
}
