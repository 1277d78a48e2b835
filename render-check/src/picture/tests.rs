//! Pictures of a square that floats over a floor, small enough to know each pixel.

use image::RgbImage;
use shadowfit::glam::{DMat4, DVec2, DVec3};
use shadowfit::{Focus, FocusForm, Light, Scene, View};

use super::*;
use crate::scene::{LightSpec, Mesh, MeshBuilder, Part};
use crate::trace::{Lens, Tracer};

/// A white floor from −4 to 4 at height 0 and a white square from −1 to 1 at height 2.
fn floating_square() -> Mesh {
    let square = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| DVec3::new(x, 0.0, z));
    let part = Part { positions: &square, normals: &[], triangles: &[[0, 1, 2], [0, 2, 3]], colour: [1.0; 3] };
    let mut builder = MeshBuilder::default();
    builder.add(&part, DMat4::from_scale(DVec3::new(4.0, 1.0, 4.0)));
    builder.add(&part, DMat4::from_translation(2.0 * DVec3::Y));
    builder.finish().0
}

const NOON: LightSpec = LightSpec::Sun { direction_to_light: DVec3::Y };

/// Looks at the floor from the side, from a height between floor and square.
fn view() -> View {
    View::perspective(DVec3::new(0.0, 1.0, 9.0), DVec3::new(0.0, -0.1, -1.0), DVec3::Y, 0.6, 1.0, 1.0, 20.0)
        .expect("a sound view")
}

fn body() -> shadowfit::focus::ConvexBody {
    let scene = Scene::from_box(DVec3::new(-4.0, 0.0, -4.0), DVec3::new(4.0, 2.0, 4.0)).expect("a sound box");
    let light = Light::directional(DVec3::Y).expect("a sound light");
    Focus::new(&view(), &light, &scene).caster_volume(FocusForm::ViewHull)
}

/// The brightness of the pixel that shows a point, 0 to 255.
fn brightness(image: &RgbImage, lens: &Lens, point: DVec3) -> u8 {
    let place = lens.project(point);
    let x = (place.x * 0.5 + 0.5) * f64::from(image.width());
    let y = (0.5 - place.y * 0.5) * f64::from(image.height());
    image.get_pixel(x as u32, y as u32).0[1]
}

#[test]
fn the_floor_is_dark_below_the_square_and_bright_beside_it() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let image = camera_view(&view(), &Lighting::new(NOON, DVec3::ZERO), &tracer, &[], [128, 128]).expect("sound");
    let lens = Lens::of_view(&view()).expect("invertible");
    let at = |x: f64, z: f64| brightness(&image, &lens, DVec3::new(x, 0.0, z));
    for below in [at(0.0, 0.0), at(0.6, 0.5), at(-0.6, -0.5)] {
        assert!(below < 130, "{below} in the shadow");
    }
    for beside in [at(1.8, 0.0), at(-1.8, 0.0), at(0.0, 3.0)] {
        assert!(beside > 220, "{beside} in the light");
    }
}

#[test]
fn a_lamp_between_floor_and_square_casts_no_shadow_on_the_floor() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let lamp = LightSpec::Point { position: DVec3::Y, range: f64::INFINITY };
    let image = camera_view(&view(), &Lighting::new(lamp, DVec3::ZERO), &tracer, &[], [128, 128]).expect("sound");
    let lens = Lens::of_view(&view()).expect("invertible");
    assert!(brightness(&image, &lens, DVec3::ZERO) > 220);
}

#[test]
fn the_focus_body_is_drawn_in_its_colour() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let edges: Vec<Line> = body().edges().collect();
    let lighting = Lighting::new(NOON, DVec3::ZERO);
    let orange = |lines: &[Line]| {
        let image = camera_view(&view(), &lighting, &tracer, lines, [128, 128]).expect("sound");
        // The caption at the bottom is in the same colour.
        let is_orange = |pixel: &image::Rgb<u8>| pixel.0[0] > 200 && pixel.0[2] < 120;
        image.rows().take(90).flatten().filter(|pixel| is_orange(pixel)).count()
    };
    assert_eq!(orange(&[]), 0);
    assert!(orange(&edges) > 50, "{}", orange(&edges));
}

#[test]
fn the_light_sees_the_whole_body_and_darkens_what_lies_outside() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let body = body();
    for light in [NOON, LightSpec::Point { position: 9.0 * DVec3::Y, range: f64::INFINITY }] {
        let lens = light_lens(&light, &view(), &body, &mesh, 1.0).expect("something to see");
        for &vertex in body.vertices() {
            let [x, y, z] = lens.project(vertex).to_array();
            assert!(x.abs() < 1.0 && y.abs() < 1.0 && z > 0.0 && z < 1.0, "{light}: {vertex} at {x}, {y}, {z}");
        }
        let image = light_view(&lens, &view(), &tracer, &body, [96, 96]);
        // The left and right ends of the floor near the camera are out of view.
        let outside = DVec3::new(-3.7, 0.0, 3.7);
        assert!(!body.contains(outside) && body.contains(DVec3::new(1.5, 0.0, -0.4)));
        let inside = brightness(&image, &lens, DVec3::new(1.5, 0.0, -0.4));
        let outside = brightness(&image, &lens, outside);
        assert!(outside < inside / 2 + 30, "{light}: {outside} outside, {inside} inside");
    }
}

#[test]
fn a_depth_map_holds_the_square_in_the_texels_below_it() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    // From height 4 down to −1, over the whole floor and as much again: a texel is one unit wide.
    let axes = [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y];
    let lens = Lens::parallel(4.0 * DVec3::Y, axes, DVec2::splat(8.0), 5.0).expect("sound");
    let map = DepthMap::cast(&lens, 16, &tracer);
    for y in 0..16 {
        for x in 0..16 {
            let is_between = |low: u32, high: u32| (low..high).contains(&x) && (low..high).contains(&y);
            let expected = if is_between(7, 9) {
                0.4
            } else if is_between(4, 12) {
                0.8
            } else {
                1.0
            };
            let depth = map.depths[(y * 16 + x) as usize];
            assert!((depth - expected).abs() < 1e-6, "texel {x}, {y}: {depth}, not {expected}");
        }
    }
    let image = map.to_image();
    let [square, floor] = [image.get_pixel(8, 8).0[0], image.get_pixel(5, 5).0[0]];
    assert!(square > floor, "near is light: {square} over {floor}");
}

#[test]
fn maps_stand_side_by_side() {
    let mesh = floating_square();
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let lens = |size: f64| {
        let axes = [DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y];
        Lens::parallel(4.0 * DVec3::Y, axes, DVec2::splat(size), 5.0).expect("sound")
    };
    // The second shows the middle of the square, and nothing else.
    let maps = [("wide".to_owned(), lens(8.0)), ("near".to_owned(), lens(0.1))];
    let image = maps_view(&maps, 32, &tracer, &[]);
    assert_eq!(image.dimensions(), (12 + 2 * (32 + 12), 40 + 32 + 12));
    let colours = |columns: std::ops::Range<u32>| {
        let mut all: Vec<_> = columns.map(|x| image.get_pixel(x, image.height() - 28).0).collect();
        all.dedup();
        all.len()
    };
    assert!(colours(12..44) >= 4, "floor, square, floor and what is beside");
    assert_eq!(colours(56..88), 1);
}
