//! Where a paraboloid map puts things: its closed forms, and what the shader makes of them.

use glam::{DVec2, DVec3, Vec4Swizzles};
use shadowfit::{ClipSpace, DepthFormat, Focus, Light, Settings};

use super::{both, direction_about, from_light, room, view};
use testkit::arbitrary::Numbers;
use testkit::claims::paraboloid::{shader, texels_per_unit};

#[test]
fn places_are_those_of_the_paper() {
    for map in both(&Settings::default()) {
        let at = |u: f64, v: f64| map.unproject(DVec3::new(u, v, 0.5)) - map.position();
        let distance = 0.5 * (map.near() + map.far());
        // The middle is the axis, the rim is across it, and outside of the rim is behind.
        assert!((at(0.0, 0.0) - map.axis() * distance).length() <= 1e-14 * distance);
        for around in [0.0_f64, 1.0, 2.0, 4.0] {
            let (v, u) = around.sin_cos();
            assert!(map.clip_plane().at(map.position() + at(u, v)).abs() <= 1e-14 * distance);
            assert!(map.clip_plane().at(map.position() + at(1.1 * u, 1.1 * v)) < 0.0);
            // tan(θ/2) for a direction θ away from the axis.
            let half = at(0.5 * u, 0.5 * v).angle_between(map.axis()) / 2.0;
            assert!((half.tan() - 0.5).abs() <= 1e-6, "{half}");
        }
    }
}

#[test]
fn project_and_unproject_undo_each_other() {
    let mut numbers = Numbers(1);
    // About the origin, so that the world's coordinates are no coarser than the frame's.
    let light = Light::point(DVec3::ZERO, 0.1, f64::INFINITY).expect("sound");
    let focus = Focus::new(&view(), &light, &room());
    for map in focus.paraboloids(&Settings::default()).maps() {
        for _ in 0..20_000 {
            let distance = 20.0 * numbers.part() + 0.01;
            let local = direction_about(&mut numbers);
            let point = from_light(map, local) * distance;
            let place = map.project(point).expect("nothing is exactly behind");
            let back = map.unproject(place);
            // A dozen roundings of the distance and, in depth, of the range.
            let allowed = 16.0 * f64::EPSILON * (distance + map.far());
            assert!((back - point).length() <= allowed, "{local}: {point} {back}");
            // The world's rounding of a point near the rim may put it on either side.
            if local.z.abs() > 1e-15 {
                assert_eq!(place.truncate().length() < 1.0 + 1e-15, local.z > -1e-15, "{local} {place}");
            }
        }
        let opposite = map.opposite();
        assert_eq!(opposite.opposite(), *map);
        assert_eq!(map.project(map.position()), None);
        assert_eq!(
            opposite.project(opposite.unproject(DVec3::new(0.0, 0.0, 1.0))).map(DVec3::truncate),
            Some(DVec2::ZERO)
        );
        assert_eq!(map.project(map.position() - map.axis() * 3.0), None);
        // As near to straight behind as numbers go.
        let place = DVec3::new(3e200, -1e200, 1.0);
        assert!((map.unproject(place) + map.axis() * map.far()).length() <= 1e-12);
    }
}

#[test]
fn both_hemispheres_mirror_each_other() {
    let [front, back] = both(&Settings::default());
    let mut numbers = Numbers(2);
    for _ in 0..1000 {
        let point = front.position() + from_light(&front, direction_about(&mut numbers)) * 3.0;
        let [Some(a), Some(b)] = [&front, &back].map(|map| map.project(point)) else { continue };
        let (a_place, b_place) = (a.truncate(), b.truncate());
        // Inverse points about the rim, u turned.
        let inverse = a_place * DVec2::new(-1.0, 1.0) / a_place.length_squared();
        assert!((inverse - b_place).length() <= 1e-7 * b_place.length(), "{a} {b}");
        assert_eq!(a.z, b.z);
    }
}

#[test]
fn footprints_are_squares_and_the_numeric_ones() {
    let settings = Settings::new(1024, 1080).and_then(|settings| settings.with_border(5)).expect("sound");
    let mut numbers = Numbers(3);
    for map in both(&settings) {
        for _ in 0..2000 {
            let local = direction_about(&mut numbers);
            let distance = 1.0 + 9.0 * numbers.part();
            // Straight behind, texels are smaller than any step for a difference.
            if local.z < -0.999 {
                continue;
            }
            let point = map.position() + from_light(&map, local) * distance;
            let footprint = map.footprint(point).expect("not behind");
            let angle = (1.0 + local.z) / texels_per_unit(&settings);
            for side in [footprint.along_x, footprint.along_y] {
                assert!((side.length() / (distance * angle) - 1.0).abs() <= 1e-9, "{local}");
                assert!(side.dot(point - map.position()).abs() <= 1e-9 * side.length() * distance);
            }
            assert!(footprint.along_x.dot(footprint.along_y).abs() <= 1e-9 * footprint.area());
            assert!((footprint.longest() / footprint.shortest() - 1.0).abs() <= 1e-6);
            // A thousandth of a texel along either side moves the place by that much, and to that order by no more.
            let place = map.project(point).expect("not behind").truncate();
            for (side, expected) in [(footprint.along_x, DVec2::X), (footprint.along_y, DVec2::Y)] {
                let moved = map.project(point + side * 1e-3).expect("not behind").truncate();
                let texels = (moved - place) * texels_per_unit(&settings) / 1e-3;
                assert!((texels - expected).length() <= 1e-4, "{local}: {texels}");
            }
            let texel = footprint.longest() / map.pixel_size(point);
            assert!((map.aliasing(point).expect("not behind") / texel - 1.0).abs() <= 1e-12);
        }
        let middle = map.position() + map.axis() * 5.0;
        let range = map.far() - map.near();
        assert_eq!(map.depth_resolution(middle, DepthFormat::Unorm16), range / 65_535.0);
    }
}

#[test]
fn the_shader_honours_clip_conventions() {
    let clips = [ClipSpace::WGPU, ClipSpace::VULKAN.reversed(), ClipSpace::OPENGL, ClipSpace::OPENGL.reversed()];
    for clip in clips {
        let settings = Settings::new(512, 1080).and_then(|settings| settings.with_border(8)).expect("sound");
        for map in both(&settings.with_clip(clip)) {
            let mut numbers = Numbers(4);
            for _ in 0..200 {
                let local = direction_about(&mut numbers);
                if local.z < -0.5 {
                    continue;
                }
                let point = map.position() + from_light(&map, local) * (1.0 + 7.0 * numbers.part());
                let place = map.project(point).expect("not behind");
                let shader = shader(&map, point.as_vec3());
                let held = if clip.depth.is_reversed() { 1.0 - place.z } else { place.z };
                let inner = 1.0 - 16.0 / 512.0;
                let up = if clip == ClipSpace::VULKAN.reversed() { -1.0 } else { 1.0 };
                let clip_place = DVec2::new(place.x * inner, place.y * inner * up);
                assert!((shader.clip.as_dvec2() - clip_place).length() < 1e-5, "{clip:?}");
                // Only OpenGL has its first row at the bottom.
                let down = if clip.texture_origin == ClipSpace::OPENGL.texture_origin { 1.0 } else { -1.0 };
                let read = DVec3::new(0.5 + 0.5 * inner * place.x, 0.5 + 0.5 * inner * place.y * down, held);
                assert!((shader.texture.xyz().as_dvec3() - read).length() < 1e-5, "{clip:?}");
                if local.z.abs() > 1e-6 {
                    assert_eq!(shader.texture.w >= 0.0, local.z >= 0.0);
                }
                // What is drawn ends with the map.
                let reach = place.truncate().length() * inner;
                if (reach - 1.0).abs() > 1e-5 {
                    assert_eq!(shader.kept, reach <= 1.0, "{local}");
                }
            }
        }
    }
}

#[test]
fn vertices_behind_the_light_are_somewhere_and_cut_off() {
    for map in both(&Settings::default()) {
        for distance in [1e-3, 1.0, 10.0] {
            for local in [DVec3::NEG_Z, DVec3::new(1e-9, 0.0, -1.0), DVec3::new(1e-4, -1e-4, -1.0)] {
                let point = map.position() + from_light(&map, local.normalize()) * distance;
                let shader = shader(&map, point.as_vec3());
                assert!(shader.clip.is_finite() && !shader.kept, "{local} {}", shader.clip);
            }
        }
        let at_light = shader(&map, map.position().as_vec3());
        assert!(at_light.clip.is_finite());
    }
}

#[cfg(feature = "wgsl")]
#[test]
fn the_shader_text_is_valid() {
    use naga::front::wgsl;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    let caller = "
        @group(0) @binding(0) var<uniform> matrix: mat4x4<f32>;
        @group(0) @binding(1) var<uniform> scale: vec4<f32>;
        @vertex fn vertex(@location(0) position: vec3<f32>) -> ShadowfitParaboloidVertex {
            return shadowfit_paraboloid_clip(matrix, scale.xy, position);
        }
        @fragment fn fragment(vertex: ShadowfitParaboloidVertex) -> @builtin(frag_depth) f32 {
            return shadowfit_paraboloid_depth(matrix, scale.xy, scale, vertex, vec2(1e-6, 1.0));
        }
        @fragment fn read(@location(0) position: vec3<f32>) -> @location(0) vec4<f32> {
            return shadowfit_paraboloid_texture(matrix, scale, position);
        }";
    let module = wgsl::parse_str(&format!("{}{caller}", shadowfit::wgsl::PARABOLOID)).expect("it parses");
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    validator.validate(&module).expect("it is valid");
}
