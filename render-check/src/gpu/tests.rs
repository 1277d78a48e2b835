//! What the GPU draws, compared with rays.

use shadowfit::glam::{DVec2, DVec3};
use shadowfit::{
    ClipSpace, DepthFormat, Focus, Light, Origin, Scene, Settings, ShadowMap, View,
    depth::{Decision, TangentPlane},
    fit,
    input::DepthRange,
    omni::{Paraboloid, Paraboloids},
    seen::{DepthTile, Seen},
};

use super::*;
use crate::maps::{Layout, Split};
use crate::picture::DepthMap;
use crate::run::{Cut, Cutting};
use crate::scene::{self, Mesh};
use crate::trace::{Faces, Hit, Lens, Ray, Tracer};

const IMAGE: [u32; 2] = [160, 100];
const MAP: u32 = 128;

struct Stage {
    gpu: Gpu,
    mesh: Mesh,
    view: View,
    map: ShadowMap,
}

/// The chess board under its sun.
fn stage(clip: ClipSpace) -> Stage {
    let mesh = scene::load("chess-board".as_ref()).expect("built in").mesh;
    let (eye, forward) = (DVec3::new(0.9, 2.1, 2.6), DVec3::new(-1.0, -2.0, -7.0));
    let view = View::perspective(eye, forward, DVec3::Y, 0.73, 1.6, 1.0, 28.0).expect("sound");
    let light = Light::directional(DVec3::new(-0.8, 0.6, 0.2)).expect("sound");
    let (min, max) = mesh.bounds();
    let scene = Scene::from_box(min, max).expect("sound");
    let settings = Settings::new(MAP, IMAGE[1]).expect("sound").with_origin(Origin::Eye).with_clip(clip);
    let map = fit(&view, &light, &scene, &settings).into_map().expect("one map does");
    Stage { gpu: Gpu::new().expect("an adapter"), mesh, view, map }
}

fn draw_all(stage: &Stage, format: DepthFormat, bias: Bias) -> (Geometry, ShadowMaps) {
    let geometry = Geometry::upload(&stage.gpu, &stage.mesh, stage.view.eye()).expect("it fits");
    let pass = MapPass { format, faces: Faces::All, bias, receiver: 0.0, relative: 0.0, points: Points::Discs };
    let all = 0..stage.mesh.triangles.len() as u32;
    let draw = MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: &[all], pass };
    let shadow_maps = ShadowMaps::draw(&stage.gpu, &geometry, &Split::whole(), &[Some(draw)]).expect("drawn");
    (geometry, shadow_maps)
}

#[test]
fn the_camera_sees_the_triangles_that_rays_meet() {
    let Stage { gpu, mesh, view, .. } = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&gpu, &mesh, view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&gpu, &geometry, &view, IMAGE).expect("drawn");
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let lens = Lens::of_view(&view).expect("invertible");
    let [width, height] = IMAGE;
    let same = (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .zip(&surfaces.triangles)
        .filter(|((x, y), drawn)| {
            let ray = lens.ray_through_pixel(*x, *y, width, height).expect("in front");
            tracer.first_hit(&ray).map_or(Surfaces::SKY, |hit| hit.triangle as u32) == **drawn
        })
        .count();
    // Pixels whose centre lies on an edge may differ.
    let all = (width * height) as usize;
    assert!(same * 200 >= all * 199, "{same} of {all} pixels");
}

#[test]
fn tiles_of_the_card_are_those_of_the_crate() {
    let Stage { gpu, mesh, view, .. } = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&gpu, &mesh, view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&gpu, &geometry, &view, IMAGE).expect("drawn");
    // Tiles of a pixel are the depth buffer itself.
    let pixels = surfaces.depth_tiles(&gpu, 1).expect("reduced");
    let depths: Vec<f32> = pixels.iter().map(|tile| tile.depth).collect();
    for (tile, triangle) in pixels.iter().zip(&surfaces.triangles) {
        assert_eq!(tile.is_empty(), *triangle == Surfaces::SKY);
    }
    let sky = pixels.iter().filter(|tile| tile.is_empty()).count();
    assert!(sky > 0 && sky < pixels.len() / 2, "{sky} pixels of sky");
    for tile in [1, 7, 16, 64, 200] {
        let card = surfaces.depth_tiles(&gpu, tile).expect("reduced");
        let own = DepthTile::reduce(&depths, IMAGE, tile, DepthRange::ZeroToOneReversed).expect("sound");
        for (index, (card, own)) in card.iter().zip(own).enumerate() {
            assert_eq!(*card, own, "tile {index} of {tile} pixels");
        }
    }
}

/// A tile's sample and slope give back the surface that the pixel shows.
#[test]
fn tiles_tell_the_surface_of_their_sample() {
    let Stage { gpu, mesh, view, .. } = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&gpu, &mesh, view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&gpu, &geometry, &view, IMAGE).expect("drawn");
    let tracer = Tracer::new(&mesh).expect("it has triangles");
    let (sun, scene) = (Light::directional(DVec3::Y).expect("sound"), mesh.bounds());
    let scene = Scene::from_box(scene.0, scene.1).expect("sound");
    let tiles = surfaces.depth_tiles(&gpu, 8).expect("reduced");
    let seen = Seen::from_tiles(&view, DepthRange::ZeroToOneReversed, IMAGE, 8, &tiles).expect("sound");
    // What a fit makes of flat ground under a sun from above: no bias, as it is told the ground's normal.
    let focus = Focus::new(&view, &sun, &scene).with_seen(&seen);
    let map = focus.fit(&Settings::new(MAP, IMAGE[1]).expect("sound")).into_map().expect("one map does");
    assert!(map.surface_error(&focus).is_some_and(|error| error.bias < error.texel));
    let lens = Lens::of_view(&view).expect("invertible");
    let (mut near, shown) = (0, tiles.iter().filter(|tile| !tile.is_empty()).count());
    for tile in tiles.iter().filter(|tile| !tile.is_empty()) {
        let [x, y] = tile.pixel.map(u32::from);
        let ray = lens.ray_through_pixel(x, y, IMAGE[0], IMAGE[1]).expect("in front");
        let hit = tracer.first_hit(&ray).expect("a surface");
        let depth = view.depth_of(tile.depth.into(), DepthRange::ZeroToOneReversed);
        near += usize::from((view.depth(hit.point) / depth - 1.0).abs() < 1e-3);
    }
    // Pixels whose centre lies on an edge may differ.
    assert!(near * 50 >= shown * 49, "{near} of {shown}");
}

/// Stored depth and its slope give back the plane of the triangle that the pixel shows.
#[test]
fn the_slopes_of_tiles_are_those_of_the_triangles() {
    let Stage { gpu, mesh, view, .. } = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&gpu, &mesh, view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&gpu, &geometry, &view, IMAGE).expect("drawn");
    let world_from_clip = view.clip_from_world().inverse();
    let [width, height] = IMAGE;
    // A pixel's centre at a stored depth. The camera's depth buffer is reversed; the view's own depth runs from −1 to 1.
    let point = |x: f64, y: f64, stored: f32| {
        let place = (DVec2::new(x, y) + 0.5) / DVec2::new(width.into(), height.into());
        let clip = DVec3::new(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 1.0 - 2.0 * f64::from(stored));
        world_from_clip.project_point3(clip)
    };
    let shown = |x: u32, y: u32| surfaces.triangles[(y * width + x) as usize];
    let mut angles = Vec::new();
    for tile in surfaces.depth_tiles(&gpu, 4).expect("reduced").iter().filter(|tile| !tile.is_empty()) {
        let [x, y] = tile.pixel.map(u32::from);
        let is_inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
        // Elsewhere the nearest of the neighbours may be of another face.
        let neighbours = || [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
        if !is_inside
            || neighbours().iter().any(|&(x, y)| shown(x, y) != shown(tile.pixel[0].into(), tile.pixel[1].into()))
        {
            continue;
        }
        let [a, b, c] = mesh.triangles[shown(x, y) as usize].map(|vertex| mesh.vertices[vertex as usize]);
        let (x, y) = (f64::from(x), f64::from(y));
        let sample = point(x, y, tile.depth);
        let right = point(x + 1.0, y, tile.depth + tile.slope[0]) - sample;
        let down = point(x, y + 1.0, tile.depth + tile.slope[1]) - sample;
        let (found, normal) = (right.cross(down).normalize(), (b - a).cross(c - a).normalize());
        angles.push(found.cross(normal).length().min(1.0).asin().to_degrees());
    }
    angles.sort_by(f64::total_cmp);
    assert!(angles.len() > 200, "{} tiles", angles.len());
    assert!(angles[angles.len() - 1] < 0.01, "{}°", angles[angles.len() - 1]);
}

#[test]
fn every_format_holds_the_depths_that_rays_find_in_every_convention() {
    for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::VULKAN, ClipSpace::OPENGL.reversed()] {
        let stage = stage(clip);
        let tracer = Tracer::new(&stage.mesh).expect("it has triangles");
        let lens = Lens::new(stage.map.clip_from_world_in(ClipSpace::WGPU)).expect("invertible");
        let cast = DepthMap::cast(&lens, MAP, &tracer).depths;
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            let (_, shadow_maps) = draw_all(&stage, format, Bias::NONE);
            let drawn = shadow_maps.depths(&stage.gpu).expect("readable").remove(0);
            let unreversed = drawn.iter().map(|&d| if clip.depth.is_reversed() { 1.0 - d } else { d });
            let close = unreversed.zip(&cast).filter(|(a, b)| (a - *b).abs() < 1e-3).count();
            assert!(close * 200 >= cast.len() * 199, "{close} of {} in {format:?}, {clip:?}", cast.len());
        }
    }
}

#[test]
fn conventions_and_formats_make_no_difference_to_shadows() {
    let bias = Bias { constant: 4, slope: 2.0 };
    let reference = {
        let stage = stage(ClipSpace::WGPU);
        let (geometry, shadow_maps) = draw_all(&stage, DepthFormat::Float32, bias);
        let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
        shadow_test(&stage.gpu, &surfaces, &shadow_maps, Filter::Nearest).expect("tested").lit
    };
    let shadowed = reference.iter().filter(|&&lit| lit < 0.5).count();
    assert!(shadowed * 20 > reference.len(), "{shadowed} of {} pixels in shadow", reference.len());
    let opengl_y_down = ClipSpace { y: shadowfit::input::YAxis::Down, ..ClipSpace::OPENGL };
    for clip in [ClipSpace::WGPU, ClipSpace::VULKAN, ClipSpace::OPENGL, opengl_y_down] {
        for clip in [clip, clip.reversed()] {
            let stage = stage(clip);
            for format in [DepthFormat::Unorm16, DepthFormat::Float32] {
                let (geometry, shadow_maps) = draw_all(&stage, format, bias);
                let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
                let lit = shadow_test(&stage.gpu, &surfaces, &shadow_maps, Filter::Nearest).expect("tested").lit;
                let different = lit.iter().zip(&reference).filter(|(a, b)| a != b).count();
                assert!(different * 300 < lit.len(), "{different} pixels differ with {clip:?}, {format:?}");
            }
        }
    }
}

#[test]
fn a_wider_filter_blends_more() {
    let stage = stage(ClipSpace::WGPU);
    let (geometry, shadow_maps) = draw_all(&stage, DepthFormat::Float32, Bias { constant: 4, slope: 8.0 });
    let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
    let blended = |filter| {
        let lit = shadow_test(&stage.gpu, &surfaces, &shadow_maps, filter).expect("tested").lit;
        lit.iter().filter(|&&lit| lit > 0.0 && lit < 1.0).count()
    };
    let [nearest, hardware, three, five] =
        [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(3), Filter::Pcf(5)].map(blended);
    assert!(
        nearest == 0 && 0 < hardware && hardware < three && three < five,
        "{nearest} {hardware} {three} {five}"
    );
}

#[test]
fn each_part_of_a_light_has_its_layer() {
    let stage = stage(ClipSpace::WGPU);
    let (geometry, one) = draw_all(&stage, DepthFormat::Float32, Bias { constant: 4, slope: 2.0 });
    let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
    let lit = |maps: &ShadowMaps| shadow_test(&stage.gpu, &surfaces, maps, Filter::Nearest).expect("tested").lit;
    let one = lit(&one);

    // Parts around a point in the middle of the board, with the sun's map in each.
    let split = Split::cube(DVec3::new(0.0, 0.5, -4.0));
    let (all, bias) = (0..stage.mesh.triangles.len() as u32, Bias { constant: 4, slope: 2.0 });
    let all = [all];
    let pass = MapPass {
        format: DepthFormat::Float32,
        faces: Faces::All,
        bias,
        receiver: 0.0,
        relative: 0.0,
        points: Points::Discs,
    };
    let (full, empty) = (
        MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: &all, pass },
        MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: &[], pass },
    );
    let draw = |maps: &[Option<MapDraw>]| ShadowMaps::draw(&stage.gpu, &geometry, &split, maps);
    assert_eq!(lit(&draw(&[Some(full); 6]).expect("drawn")), one);
    // A part without a map is lit, as is one with an empty map; no layer is allocated for it.
    let some = lit(&draw(&[None, Some(full), None, Some(full), None, None]).expect("drawn"));
    let others_empty = [empty, full, empty, full, empty, empty].map(Some);
    assert_eq!(some, lit(&draw(&others_empty).expect("drawn")));
    let changed = some.iter().zip(&one).filter(|(a, b)| a != b).count();
    let dark = some.iter().filter(|&&lit| lit == 0.0).count();
    assert!(changed > 100 && dark > 100, "{changed} changed, {dark} dark");

    let refusal = |maps: &[Option<MapDraw>]| draw(maps).err().expect("refused").to_string();
    assert!(refusal(&[Some(full)]).contains("6 parts"));
    assert!(refusal(&[None; 6]).contains("none of the parts"));
    let coarse = MapPass { format: DepthFormat::Unorm16, ..pass };
    let mixed = [Some(full), Some(MapDraw { pass: coarse, ..full }), None, None, None, None];
    assert!(refusal(&mixed).contains("differ"));
}

#[test]
fn virtual_samples_on_the_card_are_those_of_the_crate() {
    for clip in [ClipSpace::WGPU, ClipSpace::VULKAN.reversed()] {
        let stage = stage(clip);
        let (geometry, shadow_maps) = draw_all(&stage, DepthFormat::Float32, Bias::NONE);
        let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
        let depths = shadow_maps.depths(&stage.gpu).expect("readable").remove(0);
        let lens = Lens::of_view(&stage.view).expect("invertible");
        let tracer = Tracer::new(&stage.mesh).expect("it has triangles");
        let stored = |x: u32, y: u32| f64::from(depths[(y * MAP + x) as usize]);
        for taps in [2, 3] {
            let reach = Filter::Virtual(taps).reach();
            let tolerance = stage.map.comparison_tolerance(DepthFormat::Float32, reach).expect("a reach");
            let Shadows { lit, used_plane, .. } =
                shadow_test(&stage.gpu, &surfaces, &shadow_maps, Filter::Virtual(taps)).expect("tested");
            let (mut compared, mut same, mut of_plane) = (0, 0, 0);
            for (i, &triangle) in surfaces.triangles.iter().enumerate() {
                let ray = lens.ray_through_pixel(i as u32 % IMAGE[0], i as u32 / IMAGE[0], IMAGE[0], IMAGE[1]);
                let hit = ray.and_then(|ray| tracer.first_hit(&ray)).filter(|hit| hit.triangle as u32 == triangle);
                let Some(plane) = hit.and_then(|hit| TangentPlane::new(&stage.map, hit.point, hit.face_normal))
                else {
                    continue;
                };
                let expected = match taps {
                    2 => plane.blended(&tolerance, stored),
                    _ => plane.mean(taps, &tolerance, stored),
                };
                let is_alike = (expected.share - f64::from(lit[i])).abs() < 0.01;
                compared += 1;
                same += usize::from(is_alike && used_plane[i] == (expected.rule == Decision::VirtualSamples));
                of_plane += usize::from(used_plane[i]);
            }
            // Faces at grazing incidence may differ.
            assert!(same * 50 >= compared * 49, "{same} of {compared} pixels, {taps} taps, {clip:?}");
            assert!(of_plane * 2 > compared, "{of_plane} of {compared}");
        }
    }
}

#[test]
fn the_second_layer_is_the_next_surface_that_rays_meet() {
    for clip in [ClipSpace::WGPU, ClipSpace::VULKAN.reversed()] {
        let stage = stage(clip);
        let tracer = Tracer::new(&stage.mesh).expect("it has triangles");
        let lens = Lens::new(stage.map.clip_from_world_in(ClipSpace::WGPU)).expect("invertible");
        let geometry = Geometry::upload(&stage.gpu, &stage.mesh, stage.view.eye()).expect("it fits");
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            let (bias, points) = (Bias::NONE, Points::Discs);
            let pass = MapPass { format, faces: Faces::Layers, bias, receiver: 0.0, relative: 0.0, points };
            let all = 0..stage.mesh.triangles.len() as u32;
            let draw =
                MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: std::slice::from_ref(&all), pass };
            let maps = ShadowMaps::draw(&stage.gpu, &geometry, &Split::whole(), &[Some(draw)]).expect("drawn");
            let behind = &maps.behind.as_ref().expect("asked for").one_by_one[0];
            let behind = depth_copy::depths(&stage.gpu, behind, MAP).expect("readable");
            let first = maps.depths(&stage.gpu).expect("readable").remove(0);
            let away = |depth: f32| f64::from(if clip.depth.is_reversed() { 1.0 - depth } else { depth });
            let tolerance = stage.map.comparison_tolerance(format, 0.5).expect("a reach");
            // Its minimum.
            let gap = 2.0 * tolerance.at(1.0);
            let (mut same, mut beyond) = (0, 0);
            for (i, (first, behind)) in first.into_iter().zip(behind).enumerate() {
                let (first, behind) = (away(first), away(behind));
                assert!(first == 1.0 || behind - first > 0.5 * gap, "{first} and {behind}");
                let ray = lens.ray_through_pixel(i as u32 % MAP, i as u32 / MAP, MAP, MAP).expect("in front");
                let met = |hit: &Hit| lens.project(hit.point).z;
                let mut next = tracer.first_hit(&ray);
                while let Some(hit) = next.filter(|hit| met(hit) <= first + gap) {
                    let origin = hit.point + 1e-6 * ray.direction;
                    next = tracer.first_hit(&Ray { origin, ..ray });
                }
                let exact = next.map_or(1.0, |hit| met(&hit).min(1.0));
                same += usize::from((behind - exact).abs() < 1e-3);
                beyond += usize::from(behind < 1.0);
            }
            let all = (MAP * MAP) as usize;
            assert!(same * 200 >= all * 199, "{same} of {all} texels in {format:?}, {clip:?}");
            assert!(beyond * 4 > all, "{beyond} of {all} texels have a second layer");
        }
    }
}

#[test]
fn what_cannot_be_tested_between_layers_is_refused() {
    let stage = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&stage.gpu, &stage.mesh, stage.view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
    let all = 0..stage.mesh.triangles.len() as u32;
    let maps = |points| {
        let format = DepthFormat::Float32;
        let pass = MapPass { format, faces: Faces::Layers, bias: Bias::NONE, receiver: 0.0, relative: 0.0, points };
        let draw = MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: std::slice::from_ref(&all), pass };
        ShadowMaps::draw(&stage.gpu, &geometry, &Split::whole(), &[Some(draw)])
    };
    let splats = maps(Points::Splats).err().expect("refused");
    assert!(format!("{splats:#}").contains("as discs"), "{splats:#}");
    let maps = maps(Points::Discs).expect("drawn");
    for filter in [Filter::Hardware2x2, Filter::Virtual(2)] {
        let error = shadow_test(&stage.gpu, &surfaces, &maps, filter).err().expect("refused");
        assert!(format!("{error:#}").contains("nearest or pcfN"), "{error:#}");
    }
    for filter in [Filter::Nearest, Filter::Pcf(3)] {
        assert!(shadow_test(&stage.gpu, &surfaces, &maps, filter).is_ok());
    }
}

#[test]
fn what_the_card_cannot_hold_is_an_error() {
    let Stage { gpu, mesh, view, .. } = stage(ClipSpace::WGPU);
    let geometry = Geometry::upload(&gpu, &mesh, view.eye()).expect("it fits");
    let too_wide = gpu.largest_texture() + 1;
    let error = Surfaces::draw(&gpu, &geometry, &view, [too_wide, 1]).err().expect("too wide");
    assert!(format!("{error:#}").contains("the camera's view"), "{error:#}");
}

#[test]
fn a_step_of_bias_is_what_it_is_said_to_be() {
    let stage = stage(ClipSpace::WGPU);
    for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
        let depths = |constant| {
            let (_, shadow_maps) = draw_all(&stage, format, Bias { constant, slope: 0.0 });
            shadow_maps.depths(&stage.gpu).expect("readable").remove(0)
        };
        let steps = 500;
        // Only depths from 1/4 on are compared; triangles that reach out of the map may exceed 1.
        let (least, most) = (*format.bias_unit(0.25).start(), *format.bias_unit(1.0).end());
        for (after, before) in depths(steps).iter().zip(&depths(0)) {
            // Floating point is finer near zero; the depth buffer clamps at the far end.
            if (0.25..0.98).contains(before) {
                let step = f64::from(after - before) / f64::from(steps);
                assert!((0.99 * least..=1.01 * most).contains(&step), "{format:?}: {step} at {before}");
            }
        }
    }
}

/// Both hemispheres of a point light in the middle of the chess board.
fn hemispheres(stage: &Stage, clip: ClipSpace) -> [Paraboloid; 2] {
    let light = Light::point(LAMP, 0.02, f64::INFINITY).expect("sound");
    let (min, max) = stage.mesh.bounds();
    let scene = Scene::from_box(min, max).expect("sound");
    let settings = Settings::new(MAP, IMAGE[1]).and_then(|settings| settings.with_border(2)).expect("sound");
    let settings = settings.with_origin(Origin::Eye).with_clip(clip);
    match Focus::new(&stage.view, &light, &scene).paraboloids(&settings) {
        Paraboloids::Two(maps) => maps,
        other => panic!("{other:?}"),
    }
}

const LAMP: DVec3 = DVec3::new(0.0, 1.3, -4.0);

/// Both maps of the light, casters tessellated, without a bias; and the mesh.
fn draw_hemispheres(stage: &Stage, maps: &[Paraboloid; 2], format: DepthFormat) -> ShadowMaps {
    let drawn = vec![true; stage.mesh.objects.len()];
    let cut = Cut::new(&stage.gpu, stage.view.eye(), &stage.mesh, &drawn, &maps[0], Cutting::Bound);
    let cut = cut.expect("not too many").expect("cut");
    let all = 0..cut.mesh.triangles.len() as u32;
    let all = [all];
    let pass = MapPass {
        format,
        faces: Faces::All,
        bias: Bias::NONE,
        receiver: 0.0,
        relative: 0.0,
        points: Points::Discs,
    };
    let layouts = maps.each_ref().map(|map| Layout::Paraboloid(map.clone()));
    let draws = layouts.each_ref().map(|map| Some(MapDraw { map, casters: &all, pass }));
    let split = Split::halves(LAMP, maps[0].axis());
    ShadowMaps::draw(&stage.gpu, &cut.geometry, &split, &draws).expect("drawn")
}

#[test]
fn paraboloids_hold_the_distances_that_rays_find_in_every_convention() {
    for clip in [ClipSpace::WGPU, ClipSpace::WGPU.reversed(), ClipSpace::VULKAN, ClipSpace::OPENGL.reversed()] {
        let stage = stage(ClipSpace::WGPU);
        let tracer = Tracer::new(&stage.mesh).expect("it has triangles");
        let maps = hemispheres(&stage, clip);
        for format in [DepthFormat::Unorm24, DepthFormat::Float32] {
            let shadow_maps = draw_hemispheres(&stage, &maps, format);
            for (map, stored) in maps.iter().zip(shadow_maps.depths(&stage.gpu).expect("readable")) {
                let (mut inside, mut close, mut met) = (0, 0, 0);
                for (texel, &stored) in stored.iter().enumerate() {
                    let at = |i: usize| (i as f64 + 0.5 - 64.0) / 62.0;
                    let place = DVec2::new(at(texel % MAP as usize), -at(texel / MAP as usize));
                    if place.length() > 1.0 {
                        continue;
                    }
                    let direction = (map.unproject(place.extend(1.0)) - LAMP).normalize();
                    let ray = Ray { origin: LAMP + 0.02 * direction, direction, length: f64::INFINITY };
                    let hit = tracer.first_hit(&ray);
                    let depth = hit.and_then(|hit| map.project(hit.point)).map_or(1.0, |place| place.z.min(1.0));
                    let stored = if clip.depth.is_reversed() { 1.0 - stored } else { stored };
                    inside += 1;
                    met += usize::from(depth < 1.0);
                    close += usize::from((f64::from(stored) - depth).abs() < 1e-5);
                }
                // Texels at edges, which are drawn at most half a texel off, may differ.
                assert!(close * 100 >= inside * 97, "{close} of {inside}, {clip:?}, {format:?}");
                // The board is below the light, and a few pieces reach above it.
                assert_eq!(met * 2 > inside, map.axis().y < 0.0, "{met} of {inside}");
            }
        }
    }
}

#[test]
fn what_paraboloids_cannot_do_is_an_error() {
    let stage = stage(ClipSpace::WGPU);
    let maps = hemispheres(&stage, ClipSpace::WGPU);
    let shadow_maps = draw_hemispheres(&stage, &maps, DepthFormat::Float32);
    let geometry = Geometry::upload(&stage.gpu, &stage.mesh, stage.view.eye()).expect("it fits");
    let surfaces = Surfaces::draw(&stage.gpu, &geometry, &stage.view, IMAGE).expect("drawn");
    let refused = shadow_test(&stage.gpu, &surfaces, &shadow_maps, Filter::Virtual(2)).err().expect("refused");
    assert!(format!("{refused:#}").contains("virtual samples"), "{refused:#}");

    let cloud = scene::load("cloud".as_ref()).expect("built in").mesh;
    let geometry = Geometry::upload(&stage.gpu, &cloud, stage.view.eye()).expect("it fits");
    let pass = MapPass {
        format: DepthFormat::Float32,
        faces: Faces::All,
        bias: Bias::NONE,
        receiver: 0.0,
        relative: 0.0,
        points: Points::Splats,
    };
    let all = 0..cloud.triangles.len() as u32;
    let all = [all];
    let layouts = maps.each_ref().map(|map| Layout::Paraboloid(map.clone()));
    let draws = layouts.each_ref().map(|map| Some(MapDraw { map, casters: &all, pass }));
    let split = Split::halves(LAMP, maps[0].axis());
    let refused = ShadowMaps::draw(&stage.gpu, &geometry, &split, &draws).err().expect("refused");
    assert!(format!("{refused:#}").contains("as discs"), "{refused:#}");
    let frustum = MapDraw { map: &Layout::Frustum(stage.map.clone()), casters: &all, pass };
    let mixed = [draws[0], Some(frustum)];
    let refused = ShadowMaps::draw(&stage.gpu, &geometry, &split, &mixed).err().expect("refused");
    assert!(format!("{refused:#}").contains("differ in kind"), "{refused:#}");
}
