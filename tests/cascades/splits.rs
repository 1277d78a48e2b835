//! Cascades of a view: where they are cut, what they are worth, which of them are dropped, and what holds for all.

use glam::{DVec2, DVec3, Vec3, Vec4};
use proptest::prelude::*;
use shadowfit::{
    Aabb, Empty, InputError, Light, Outcome, Scene, Settings, View, Warp,
    cascades::{CascadeLayout, CascadeSplits, CascadeUniform, Cascades, SplitScheme, TextureExtent},
    depth::ReceiverOffset,
    fit,
    input::{InputErrorKind, MAX_COORDINATE, MIN_DISTANCE},
    warp::Shift,
};
use testkit::arbitrary::{Together, case, run, settings, sides};
use testkit::claims::cascades::{self, cutting};
use testkit::claims::constructors::cut_at_any_bits;

/// The field of view with 2T = 1, twice the angle whose tangent is a half.
const FOV: f64 = 0.927_295_218_001_612_2;
/// As many texels a side as the image has pixels, so that a ratio of sizes is a ratio of counts.
const PIXELS: u32 = 1024;
/// What f32 can be wrong about by a rounding.
const UNIT: f64 = 1.0 / 16_777_216.0;

fn view(near: f64, far: f64) -> View {
    View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, FOV, 1.0, near, far).unwrap()
}

fn overhead() -> Light {
    Light::directional(DVec3::Y).unwrap()
}

fn around(far: f64) -> Scene<'static> {
    Scene::from_box(DVec3::splat(-2.0 * far), DVec3::splat(2.0 * far)).unwrap()
}

fn fars(cascades: &Cascades<'_>) -> Vec<f64> {
    cascades.iter().map(|cascade| cascade.far).collect()
}

/// Cuts that can be worked out by hand, and those of Zhang et al.'s formula for a view from 1 to 1000.
#[test]
fn cuts_are_where_the_formulas_say() {
    let at = |near: f64, far: f64, count: usize, split: SplitScheme| {
        let cuts = CascadeSplits::View { count, split };
        fars(&Cascades::new(&view(near, far), &overhead(), &around(far), cuts, 0.0).unwrap())
    };
    assert_eq!(at(1.0, 16.0, 4, SplitScheme::Logarithmic), [2.0, 4.0, 8.0, 16.0]);
    assert_eq!(at(1.0, 256.0, 8, SplitScheme::Logarithmic), [2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0]);
    assert_eq!(at(1.0, 1000.0, 3, SplitScheme::Logarithmic), [10.0, 100.0, 1000.0]);
    assert_eq!(at(0.5, 40.5, 2, SplitScheme::Logarithmic), [4.5, 40.5]);
    assert_eq!(at(1.0, 16.0, 4, SplitScheme::Uniform), [4.75, 8.5, 12.25, 16.0]);
    assert_eq!(at(1.0, 16.0, 4, SplitScheme::Practical(0.5)), [3.375, 6.25, 10.125, 16.0]);
    assert_eq!(at(1.0, 16.0, 4, SplitScheme::Practical(0.0)), [4.75, 8.5, 12.25, 16.0]);
    assert_eq!(at(1.0, 16.0, 4, SplitScheme::Practical(1.0)), [2.0, 4.0, 8.0, 16.0]);
    // (5.6234 + 250.75)/2, (31.6228 + 500.5)/2, (177.8279 + 750.25)/2, to f32.
    let single = [128.186_7_f32, 266.061_4, 464.038_97].map(f64::from);
    let ours = at(1.0, 1000.0, 4, SplitScheme::Practical(0.5));
    for (ours, right) in ours.iter().zip(single) {
        assert!((ours - right).abs() < 1e-4, "{ours} {right}");
    }
}

/// What is visible is split, not what the planes are: with the far plane at infinity and the near one in the air.
#[test]
fn cuts_follow_what_is_visible() {
    let scene = Scene::from_box((-1.0, -1.0, -81.0), (1.0, 1.0, -5.0)).unwrap();
    let far = view(0.01, f64::INFINITY);
    let cuts = CascadeSplits::Visible { count: 4, split: SplitScheme::Logarithmic };
    let cascades = Cascades::new(&far, &overhead(), &scene, cuts, 0.0).unwrap();
    // Corners are off by the slack of planes, which f32 does not see.
    let ratio: f64 = 81.0 / 5.0;
    let roots = [ratio.sqrt().sqrt(), ratio.sqrt(), ratio.sqrt() * ratio.sqrt().sqrt()];
    for (cascade, root) in cascades.iter().zip(roots) {
        assert!((cascade.far / (5.0 * root) - 1.0).abs() <= 2.0 * UNIT, "{} {root}", cascade.far);
    }
    assert_eq!((cascades[0].near, cascades[3].far), (0.01, f64::INFINITY));
    // Of the view's own planes, infinity cannot be split.
    let planes = CascadeSplits::View { count: 2, split: SplitScheme::Uniform };
    refused(Cascades::new(&far, &overhead(), &scene, planes, 0.0), "view", InputErrorKind::NotFinite);
    assert_eq!(Cascades::new(&far, &overhead(), &scene, CascadeSplits::At(&[7.0, 20.0]), 0.0).unwrap().len(), 3);
}

/// A wall across the view has one depth, which is in one cascade.
#[test]
fn what_has_one_depth_is_not_cut() {
    let wall = Scene::from_box((-9.0, -9.0, -10.0), (9.0, 9.0, -10.0)).unwrap();
    let sun = Light::directional((0.3, 1.0, 1.0)).unwrap();
    for split in [SplitScheme::Uniform, SplitScheme::Logarithmic, SplitScheme::Practical(0.5)] {
        let cascades =
            Cascades::new(&view(1.0, 90.0), &sun, &wall, CascadeSplits::Visible { count: 8, split }, 0.5).unwrap();
        assert_eq!(cascades.len(), 1);
        assert!(cascades.fit(&Settings::default()).outcomes()[0].map().is_some());
    }
}

/// Cascades of the view's planes stay where they are while the camera moves; those of what is visible do not.
#[test]
fn cuts_of_the_planes_stay() {
    let scene = Scene::from_box((-50.0, -3.0, -50.0), (50.0, 5.0, 50.0)).unwrap();
    let at = |x: f64, cuts: CascadeSplits<'_>| {
        let view = View::perspective((x, 0.0, 0.0), (0.3 * x, -0.1, -1.0), DVec3::Y, 1.0, 1.5, 0.5, 200.0).unwrap();
        fars(&Cascades::new(&view, &overhead(), &scene, cuts, 0.1).unwrap())
    };
    let split = SplitScheme::Practical(0.7);
    let steady = CascadeSplits::View { count: 4, split };
    assert_eq!(at(0.0, steady), at(1.0, steady));
    let moving = CascadeSplits::Visible { count: 4, split };
    assert_ne!(at(0.0, moving), at(1.0, moving));
    // Kept, they stay too.
    let kept = at(0.0, moving);
    assert_eq!(at(1.0, CascadeSplits::At(&kept[..3])), kept);
}

/// `docs/design.md`, section 8, with its light overhead and all of V receiving: a uniform map of a view from n to f needs f/n texels
/// across and (f − n)/(2T n) along the view for each pixel. Cut logarithmically, each of k cascades is a view whose ends have
/// the ratio ρ = (f/n)^(1/k), so that all need ρ and (ρ − 1)/(2T), and together k ρ(ρ − 1)/(2T), which tends to
/// ln(f/n)/(2T) from above.
///
/// A cascade is wider than its cuts by the rounding of depths, eight units of the distance to the frame's corners, here
/// √(1 + 2T²) = √1.5 of the depth, and cuts are rounded by a unit each: ρ is larger by
/// (2 · 8 · √1.5 + 2) units at most, and ρ − 1 by ρ/(ρ − 1) times as much of itself. The padding of windows is divided out.
#[test]
fn logarithmic_slices_need_as_little_as_derived() {
    let settings = Settings::new(PIXELS, PIXELS).unwrap().with_border(0).unwrap().with_warp(Warp::Uniform);
    for far in [10.0, 100.0, 1000.0, 1e4_f64] {
        let mut before = f64::INFINITY;
        for (count, ratio) in [(1, far), (2, far.sqrt()), (4, far.sqrt().sqrt()), (8, far.sqrt().sqrt().sqrt())] {
            let cuts = CascadeSplits::View { count, split: SplitScheme::Logarithmic };
            let cascades = Cascades::new(&view(1.0, far), &overhead(), &around(far), cuts, 0.0).unwrap();
            assert_eq!(cascades.len(), count);
            let maps = cascades.fit(&settings);
            let wider = (16.0 * 1.5_f64.sqrt() + 2.0) * UNIT;
            let mut texels = 0.0;
            for (index, map) in maps.maps() {
                let (across, along) = map.window().padding;
                let visible = cascades[index].focus.receiver_volume();
                let needed = visible.vertices().iter().fold((0.0, 0.0), |(rs, rt): (f64, f64), &point| {
                    let (texel, pixel) = (map.footprint(point).unwrap(), map.pixel_size(point));
                    let (x, y) = (texel.along_x.length() / pixel, texel.along_y.length() / pixel);
                    (rs.max(x * (1.0 - across)), rt.max(y * (1.0 - along)))
                });
                for (ours, right, wider) in
                    [(needed.0, ratio, wider), (needed.1, ratio - 1.0, wider * ratio / (ratio - 1.0))]
                {
                    let off = ours / right - 1.0;
                    // Smaller by the roundings of the corners alone, far below a unit.
                    assert!(off >= -2.0 * wider && off <= wider, "{far} {count}: {ours} not {right}, off {off:e}");
                }
                texels += needed.0 * needed.1;
            }
            // With 2T = 1.
            let least = far.ln();
            assert!(texels > least && texels < before, "{far} {count}: {texels}, at least {least}");
            before = texels;
        }
    }
}

/// Towards the eye there is a field, far away a hill, and between them nothing that receives; on the field stands
/// nothing.
#[test]
fn what_nobody_sees_is_dropped() {
    let boxed = |min: [f32; 3], max: [f32; 3]| Aabb::new(Vec3::from(min), Vec3::from(max));
    let field = boxed([-5.0, -1.5, -10.0], [5.0, -1.0, -2.0]);
    let hill = boxed([-50.0, -1.0, -400.0], [50.0, 20.0, -300.0]);
    let tree = boxed([3.0, -1.0, -350.0], [5.0, 30.0, -348.0]);
    let view = view(1.0, 500.0);
    let cuts = CascadeSplits::At(&[20.0, 100.0, 250.0]);
    let (casters, receivers) = ([tree], [field, hill]);
    let scene = Scene::new(&casters, &receivers).unwrap();
    let cascades = Cascades::new(&view, &overhead(), &scene, cuts, 0.1).unwrap();
    let maps = cascades.fit(&Settings::default());
    assert_eq!(maps.outcomes()[0], Outcome::Empty(Empty::NoCasters));
    assert_eq!(maps.outcomes()[1], Outcome::Empty(Empty::NoReceivers));
    assert_eq!(maps.outcomes()[2], Outcome::Empty(Empty::NoReceivers));
    assert!(maps.outcomes()[3].map().is_some());
    assert!(cascades[1].focus.receiver_volume().is_empty() && cascades[2].focus.receiver_volume().is_empty());
    let report = maps.report();
    assert_eq!((report.cascades, report.maps, report.worst), (4, 1, Some(3)));
    assert_eq!((report.nothing_visible, report.nothing_casts, report.surrounded), (2, 1, 0));
    assert_eq!(report.texels, 2048 * 2048);
    let whole = maps.report_of(3).unwrap();
    assert_eq!((report.aliasing, report.texel), (whole.aliasing, whole.texel));
    assert!(maps.report_of(0).is_none() && maps.report_of(4).is_none());
    // One map takes no room of the others, whatever their number was.
    for layout in [CascadeLayout::Array, CascadeLayout::Atlas] {
        assert_eq!(maps.extent(layout), TextureExtent { width: 2048, height: 2048, layers: 1 });
        assert!(maps.tile(0, layout).is_none() && maps.tile(3, layout).is_some_and(|tile| tile.layer == 0));
        assert_eq!(maps.uniform(layout, |_| None).layer, [-1, -1, -1, 0, -1, -1, -1, -1]);
    }
}

/// A lamp among what is visible is beside of it in the cascades before and behind it.
#[test]
fn a_lamp_surrounds_itself_with_one_slice() {
    let scene = Scene::from_box((-20.0, -3.0, -60.0), (20.0, 5.0, 0.0)).unwrap();
    let lamp = Light::point((0.0, 0.0, -30.0), 0.1, 100.0).unwrap();
    let view = view(1.0, 100.0);
    assert!(matches!(fit(&view, &lamp, &scene, &Settings::default()), Outcome::Surrounded(_)));
    let cascades = Cascades::new(&view, &lamp, &scene, CascadeSplits::At(&[20.0, 40.0]), 0.0).unwrap();
    let maps = cascades.fit(&Settings::default());
    let report = maps.report();
    assert_eq!((report.maps, report.surrounded), (2, 1));
    assert!(matches!(maps.outcomes(), [Outcome::Map(_), Outcome::Surrounded(_), Outcome::Map(_)]));
}

/// What the report has of each cascade, and the worst of all: less with each cascade.
#[test]
fn reports_are_of_the_worst_slice() {
    let scene = Scene::from_box((-50.0, -3.0, -90.0), (50.0, 5.0, 0.0)).unwrap();
    let sun = Light::directional((0.3, 1.0, 0.2)).unwrap();
    let settings = Settings::default().with_warp(Warp::Uniform);
    let mut before = f64::INFINITY;
    for count in 1..=Cascades::MAX {
        let cuts = CascadeSplits::Visible { count, split: SplitScheme::Logarithmic };
        let cascades = Cascades::new(&view(1.0, 80.0), &sun, &scene, cuts, 0.1).unwrap();
        let maps = cascades.fit(&settings);
        let report = maps.report();
        let each: Vec<f64> = (0..count).map(|index| maps.report_of(index).unwrap().aliasing).collect();
        let worst = report.worst.unwrap();
        assert!(each.iter().all(|one| *one <= report.aliasing) && each[worst] == report.aliasing);
        assert_eq!(report.texels, count as u64 * 2048 * 2048);
        assert!(report.aliasing < before, "{count}: {}", report.aliasing);
        before = report.aliasing;
    }
}

/// Grids, and tiles that lie side by side in them.
#[test]
fn tiles_fill_an_atlas() {
    let square = [(1, 1), (2, 1), (2, 2), (2, 2), (3, 2), (3, 2), (3, 3), (3, 3)];
    let wide = [(1, 1), (1, 2), (1, 3), (1, 4), (2, 3), (2, 3), (2, 4), (2, 4)];
    let tall = [(1, 1), (2, 1), (3, 1), (4, 1), (4, 2), (4, 2), (4, 2), (4, 2)];
    tiles_fill_atlases((512, 512), square);
    tiles_fill_atlases((512, 128), wide);
    tiles_fill_atlases((256, 512), tall);
}

/// For one map and more, in grids of so many tiles across and down.
fn tiles_fill_atlases((width, height): (u32, u32), grids: [(u32, u32); 8]) {
    let texels = |(across, down): (u32, u32)| DVec2::new(across.into(), down.into());
    let scene = Scene::from_box((-50.0, -3.0, -90.0), (50.0, 5.0, 0.0)).unwrap();
    let sun = Light::directional((0.3, 1.0, 0.2)).unwrap();
    for (count, (across, down)) in (1..).zip(grids) {
        let cuts = CascadeSplits::Visible { count, split: SplitScheme::Logarithmic };
        let cascades = Cascades::new(&view(1.0, 80.0), &sun, &scene, cuts, 0.1).unwrap();
        let settings = Settings::new(512, 1080).unwrap().with_map_sides(width, height).unwrap();
        let maps = cascades.fit(&settings.with_border(2).unwrap());
        let atlas = TextureExtent { width: across * width, height: down * height, layers: 1 };
        assert_eq!(maps.extent(CascadeLayout::Atlas), atlas);
        assert_eq!(maps.extent(CascadeLayout::Array), TextureExtent { width, height, layers: count as u32 });
        assert_eq!(maps.report().texels, count as u64 * u64::from(width * height));
        let tiles: Vec<_> = (0..count).map(|index| maps.tile(index, CascadeLayout::Atlas).unwrap()).collect();
        for (index, tile) in tiles.iter().enumerate() {
            assert_eq!((tile.layer, tile.size, tile.extent), (0, (width, height), atlas));
            let (x, y) = tile.corner;
            assert!(x % width == 0 && y % height == 0 && x < atlas.width && y < atlas.height);
            assert!(tiles[..index].iter().all(|other| other.corner != tile.corner));
            let (scale, offset) = tile.texture_from_map();
            let size = texels((atlas.width, atlas.height));
            assert!((offset * size - texels((x, y))).length() < 1e-9);
            assert!((scale * size - texels(tile.size)).length() < 1e-9);
            let (least, most) = tile.inner(2);
            assert!(((least - offset) * size - 2.0).length() < 1e-9);
            assert!(((most - least) * size - (texels(tile.size) - 4.0)).length() < 1e-9);
            let layer = maps.tile(index, CascadeLayout::Array).unwrap();
            assert_eq!((layer.layer, layer.corner), (index as u32, (0, 0)));
            let map = maps.outcomes()[index].map().unwrap();
            assert_eq!(layer.receiver_matrix(map, None), map.receiver_matrix());
        }
    }
}

/// A block's bytes are its words in order.
#[test]
fn a_block_is_its_words() {
    let scene = Scene::from_box((-50.0, -3.0, -90.0), (50.0, 5.0, 0.0)).unwrap();
    let cuts = CascadeSplits::At(&[5.0, 20.0]);
    let cascades = Cascades::new(&view(1.0, 80.0), &overhead(), &scene, cuts, 0.25).unwrap();
    let maps = cascades.fit(&Settings::default());
    let offset = ReceiverOffset::depth(0.01).unwrap();
    let uniform = maps.uniform(CascadeLayout::Atlas, |_| Some(offset));
    let bytes = uniform.to_bytes();
    let word = |index: usize| [0, 1, 2, 3].map(|byte| bytes[4 * index + byte]);
    let float = |index: usize| f32::from_le_bytes(word(index));
    assert_eq!(bytes.len(), CascadeUniform::SIZE);
    assert_eq!(float(16 + 5), uniform.texture_from_origin[1][5]);
    assert_eq!(float(128 + 6), uniform.inner[1][2]);
    assert_eq!([160, 161, 162, 167].map(float), [5.0, 20.0, f32::MAX, f32::MAX]);
    assert_eq!([168, 169, 170].map(float), [4.0, 16.25, f32::MAX]);
    assert_eq!([176, 177, 178, 179].map(|index| i32::from_le_bytes(word(index))), [0, 0, 0, -1]);
    // The offset is in the matrices.
    let map = maps.outcomes()[1].map().unwrap();
    let tile = maps.tile(1, CascadeLayout::Atlas).unwrap();
    assert_eq!(tile.receiver_matrix(map, Some(&offset)).to_cols_array(), uniform.texture_from_origin[1]);
    assert_ne!(tile.receiver_matrix(map, None).to_cols_array(), uniform.texture_from_origin[1]);
}

/// In an atlas the matrix takes what is visible to where it is in the map's own texture, in its tile: off by the rounding
/// of the last row, 2c + 1 times that of the map's in column or row c.
#[test]
fn an_atlas_is_its_maps_side_by_side() {
    let scene = Scene::from_box((-50.0, -3.0, -90.0), (50.0, 5.0, 0.0)).unwrap();
    let sun = Light::directional((0.3, 1.0, 0.2)).unwrap();
    let cuts = CascadeSplits::Visible { count: 8, split: SplitScheme::Practical(0.8) };
    let cascades = Cascades::new(&view(1.0, 80.0), &sun, &scene, cuts, 0.1).unwrap();
    let square = Settings::default().with_warp(Warp::Uniform).with_shift(Shift::None);
    let wide = square.with_map_sides(4096, 1024).unwrap();
    for settings in [square, square.with_warp(Warp::Perspective), wide] {
        let maps = cascades.fit(&settings);
        for (index, map) in maps.maps() {
            let tile = maps.tile(index, CascadeLayout::Atlas).unwrap();
            let matrix = tile.receiver_matrix(map, None);
            let (scale, offset) = tile.texture_from_map();
            let last = (tile.corner.0 / tile.size.0).max(tile.corner.1 / tile.size.1);
            for &point in cascades[index].focus.receiver_volume().vertices() {
                let place = matrix * Vec4::from((point.as_vec3(), 1.0));
                let place = place.truncate().as_dvec3() / f64::from(place.w);
                let exact = map.texture_from_world() * point.extend(1.0);
                let exact = exact.truncate() / exact.w;
                let exact = (exact.truncate() * scale + offset).extend(exact.z);
                let texels = (place - exact).truncate() / scale * sides(&settings);
                let most = f64::from(2 * last + 1) * map.window().rounding;
                assert!(texels.abs().max_element() <= most, "{index}: {texels} of {most}");
                assert!((place.z - exact.z).abs() <= map.depth().rounding);
            }
        }
    }
}

#[track_caller]
fn refused<T: core::fmt::Debug>(result: Result<T, InputError>, field: &str, problem: InputErrorKind) {
    let error = result.expect_err("accepted");
    assert_eq!((error.field, error.problem), (field, problem));
}

#[test]
fn what_makes_no_slices_is_refused() {
    let (view, scene) = (view(1.0, 100.0), around(100.0));
    let new = |cuts: CascadeSplits<'_>, overlap: f64| Cascades::new(&view, &overhead(), &scene, cuts, overlap);
    for make in [
        |count, split| CascadeSplits::Visible { count, split },
        |count, split| CascadeSplits::View { count, split },
    ] {
        let make: fn(usize, SplitScheme) -> CascadeSplits<'static> = make;
        refused(new(make(0, SplitScheme::Uniform), 0.0), "count", InputErrorKind::TooSmall);
        refused(new(make(9, SplitScheme::Uniform), 0.0), "count", InputErrorKind::TooLarge);
        refused(new(make(2, SplitScheme::Practical(-0.1)), 0.0), "split", InputErrorKind::TooSmall);
        refused(new(make(2, SplitScheme::Practical(1.1)), 0.0), "split", InputErrorKind::TooLarge);
        refused(new(make(2, SplitScheme::Practical(f64::NAN)), 0.0), "split", InputErrorKind::NotFinite);
        refused(new(make(2, SplitScheme::Uniform), -0.1), "overlap", InputErrorKind::TooSmall);
        refused(new(make(2, SplitScheme::Uniform), 1.1), "overlap", InputErrorKind::TooLarge);
        refused(new(make(2, SplitScheme::Uniform), f64::NAN), "overlap", InputErrorKind::NotFinite);
    }
    refused(new(CascadeSplits::At(&[2.0; 8]), 0.0), "cuts", InputErrorKind::TooMany);
    refused(new(CascadeSplits::At(&[f64::NAN]), 0.0), "cuts", InputErrorKind::NotFinite);
    refused(new(CascadeSplits::At(&[f64::INFINITY]), 0.0), "cuts", InputErrorKind::NotFinite);
    refused(new(CascadeSplits::At(&[1.0]), 0.0), "cuts", InputErrorKind::TooSmall);
    refused(new(CascadeSplits::At(&[100.0]), 0.0), "cuts", InputErrorKind::TooLarge);
    refused(new(CascadeSplits::At(&[3.0, 2.0]), 0.0), "cuts", InputErrorKind::OutOfOrder);
    // One number for f32.
    refused(new(CascadeSplits::At(&[3.0, 3.000_000_01]), 0.0), "cuts", InputErrorKind::OutOfOrder);
}

/// The nearest near plane, the farthest far ones, and a scene as large as can be, seen from its corner along its
/// diagonal: depths there are larger than a plane's may be.
#[test]
fn views_at_the_ends_of_what_is_accepted() {
    let corner = DVec3::splat(-MAX_COORDINATE);
    let scene = Scene::from_box(corner, -corner).unwrap();
    let (forward, up) = (DVec3::ONE, DVec3::new(-1.0, 2.0, -1.0));
    let look = |near: f64, far: f64| View::perspective(corner, forward, up, 1.0, 1.0, near, far).unwrap();
    let parallel = View::orthographic(corner, forward, up, 1.0, 1.0, 0.0, MAX_COORDINATE).unwrap();
    let views = [
        look(MIN_DISTANCE, f64::INFINITY),
        look(MIN_DISTANCE, MAX_COORDINATE),
        look(0.5 * MAX_COORDINATE, f64::INFINITY),
        parallel,
    ];
    for view in views {
        for split in [SplitScheme::Uniform, SplitScheme::Logarithmic, SplitScheme::Practical(0.5)] {
            for cuts in [CascadeSplits::Visible { count: 8, split }, CascadeSplits::View { count: 8, split }] {
                if view.far().is_infinite() && matches!(cuts, CascadeSplits::View { .. }) {
                    continue;
                }
                let cascades = Cascades::new(&view, &overhead(), &scene, cuts, 0.5).unwrap();
                assert_eq!(cascades.len(), 8, "{view:?} {cuts:?}");
                let maps = cascades.fit(&Settings::default());
                assert_eq!(maps.report().maps + maps.report().nothing_casts, 8, "{view:?} {cuts:?}");
            }
        }
    }
}

#[test]
fn any_bits_cut_or_are_refused() {
    let bytes = prop::collection::vec(any::<u8>(), 0..100);
    run(5000, &(case(), settings(), bytes), |(case, settings, bytes)| {
        let together = Together::of(&case);
        let scene = together.store.scene().expect("the scene is accepted");
        cut_at_any_bits(&bytes, &together.view, &together.light, &scene, &settings);
    });
}

#[test]
fn one_slice_is_a_plain_fit() {
    run(2000, &(case(), cutting(), settings()), |(case, cutting, settings)| {
        cascades::one_is_a_plain_fit(&case, &cutting, &settings);
    });
}

#[test]
fn every_depth_is_in_one_slice() {
    run(1000, &(case(), cutting(), settings(), any::<u64>()), |(case, cutting, settings, seed)| {
        cascades::every_depth_is_in_one(&case, &cutting, &settings, seed);
    });
}

#[test]
fn maps_hold_what_is_visible_in_their_cascades() {
    run(2000, &(case(), cutting(), settings(), any::<u64>()), |(case, cutting, settings, seed)| {
        cascades::maps_hold_what_is_visible(&case, &cutting, &settings, seed);
    });
}

#[test]
fn bodies_of_slices_hold_what_casts() {
    run(2000, &(case(), cutting(), any::<u64>()), |(case, cutting, seed)| {
        cascades::bodies_hold_what_casts(&case, &cutting, seed);
    });
}

#[test]
fn orthographic_views_are_cut_uniformly() {
    run(2000, &(case(), cutting()), |(case, cutting)| cascades::orthographic_cuts_are_uniform(&case, &cutting));
}
