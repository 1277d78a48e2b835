//! The cases of the groups.

use anyhow::Result;
use clap::ValueEnum as _;
use shadowfit::glam::DVec3;
use shadowfit::{DepthFormat, Origin, View};

use super::shot::{EXTREMES, MAP_SIZE, Shot, Stand, chess_board, lit_chess_board};
use crate::gpu::{Filter, Points};
use crate::maps::{Cascading, ClipConvention, SplitArg, Technique};
use crate::run::Options;
use crate::scene::LightSpec;
use crate::trace::Faces;

/// Point lights inside the scene: out of view, in view, and in between; with one map and with cube faces, with
/// nearest texels and with wide filters, which read across the seams.
pub(super) fn lights_inside() -> Result<Vec<Shot>> {
    let room = Stand::built_in("room")?;
    let own = Stand::built_in("room")?.own_lights("room")?;
    let across = room.shot("a lamp that comes into view", |view| {
        let ahead = view.eye() + 1.5 * view.forward();
        (0..=8)
            .map(|i| {
                let above = 0.25 * f64::from(i);
                let position = ahead + above * view.up();
                (format!("lamp {above} above the axis"), LightSpec::Point { position, range: f64::INFINITY })
            })
            .collect()
    })?;
    let mut options = own.options.clone();
    for filter in [Filter::Nearest, Filter::Pcf(5)] {
        options.extend(Technique::CUBES.map(|technique| Options { filter, ..Options::new(technique, MAP_SIZE) }));
    }
    Ok([own, across].map(|shot| shot.with_options(options.clone())).into())
}

/// Lights with one paraboloid and with two, casters tessellated; every filter, which reads across the seam between
/// the two.
pub(super) fn paraboloids() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for filter in [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(5)] {
        let paraboloid = |map_size| Options { filter, ..Options::new(Technique::Paraboloid, map_size) };
        options.extend([paraboloid(MAP_SIZE), paraboloid(2 * MAP_SIZE)]);
    }
    let plain = options[0];
    options.extend([
        Options { clip: ClipConvention::VulkanReversed, format: DepthFormat::Float32, ..plain },
        Options { clip: ClipConvention::OpenglReversed, format: DepthFormat::Unorm16, ..plain },
        Options { faces: Faces::Second, ..plain },
    ]);
    let lamp = |words: &str, position| (words.to_owned(), LightSpec::Point { position, range: f64::INFINITY });
    let room = Stand::built_in("room")?.shot("room", |_| {
        vec![
            lamp("in its shade", DVec3::new(0.9, 2.3, -1.9)),
            lamp("in view", DVec3::new(0.0, 1.5, -2.5)),
            lamp("level with the table", DVec3::new(-1.2, 0.78, -1.3)),
        ]
    })?;
    let board = chess_board()?.shot("chess board", |_| {
        let aimed = LightSpec::Spot {
            position: DVec3::new(0.0, 3.0, -4.0),
            target: DVec3::new(0.0, 0.0, -4.2),
            cone_degrees: 150.0,
            range: f64::INFINITY,
        };
        vec![lamp("lamp in its midst", DVec3::new(0.5, 1.2, -4.0)), ("wide spot".to_owned(), aimed)]
    })?;
    Ok([room, board].map(|shot| shot.with_options(options.clone())).into())
}

/// Stabilised maps: suns, a spot, cube faces; relative to the eye and in world space; near the origin and far from
/// it.
pub(super) fn stable() -> Result<Vec<Shot>> {
    let wide = Filter::Pcf(5);
    let mut options = Vec::new();
    for technique in [Technique::Stable, Technique::CubeStable] {
        let plain = Options::new(technique, MAP_SIZE);
        options.extend([plain, Options { filter: wide, clip: ClipConvention::OpenglReversed, ..plain }]);
    }
    let far = || chess_board().map(|stand| stand.scene.moved(1.0, 1e6 * DVec3::new(1.0, -0.3, 0.7)));
    let shots = [
        lit_chess_board()?,
        Shot { origin: Origin::World, ..chess_board()?.own_lights("chess board in world space")? },
        Stand::before(far()?)?.own_lights("a million away")?,
        Stand::built_in("street")?.own_lights("street")?,
        Stand::built_in("room")?.own_lights("room")?,
    ];
    Ok(shots.map(|shot| shot.with_options(options.clone())).into())
}

/// Two to eight cascades with every split scheme.
pub(super) fn cascades() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for technique in [Technique::Uniform, Technique::Psm, Technique::Best, Technique::Stable] {
        for (count, split) in [
            (2, shadowfit::cascades::SplitScheme::Uniform),
            (3, shadowfit::cascades::SplitScheme::Practical(0.5)),
            (5, shadowfit::cascades::SplitScheme::Logarithmic),
            (8, shadowfit::cascades::SplitScheme::Logarithmic),
        ] {
            let cascading = Some(Cascading { count, split: SplitArg::Scheme(split) });
            options.push(Options { cascading, ..Options::new(technique, MAP_SIZE / 2) });
        }
    }
    let wide = Filter::Pcf(5);
    options.push(Options { filter: wide, clip: ClipConvention::VulkanReversed, ..options[3] });
    let shots = [lit_chess_board()?, Stand::built_in("street")?.own_lights("street")?];
    Ok(shots.map(|shot| shot.with_options(options.clone())).into())
}

/// A street with the near plane a step from the eye, far in front of the nearest surface, and with it close to that
/// surface.
pub(super) fn street() -> Result<Vec<Shot>> {
    let narrowed = || -> Result<Stand> {
        let mut stand = Stand::built_in("street")?;
        stand.camera.near = None;
        Ok(stand)
    };
    Ok(vec![
        Stand::built_in("street")?.own_lights("near plane in the air")?.warped(),
        narrowed()?.own_lights("near plane at what is seen")?.warped(),
    ])
}

/// A plate without casters, under a high sun, a low one, and a point light.
pub(super) fn flat() -> Result<Vec<Shot>> {
    let lights = |_: &View| {
        vec![
            ("high sun".to_owned(), LightSpec::Sun { direction_to_light: DVec3::new(0.2, 1.0, 0.1) }),
            ("low sun".to_owned(), LightSpec::Sun { direction_to_light: DVec3::new(1.0, 0.05, -0.4) }),
            ("sun from straight above".to_owned(), LightSpec::Sun { direction_to_light: DVec3::Y }),
            ("lamp".to_owned(), LightSpec::Point { position: DVec3::new(3.0, 5.0, -2.0), range: f64::INFINITY }),
        ]
    };
    Ok(vec![Stand::built_in("ground")?.shot("plate", lights)?])
}

/// Far planes at infinity and at a million units, near planes at a thousandth.
pub(super) fn far_planes() -> Result<Vec<Shot>> {
    [("endless", 1.0, f64::INFINITY), ("a million", 1.0, 1e6), ("near and endless", 1e-3, f64::INFINITY)]
        .into_iter()
        .map(|(name, near, far)| chess_board()?.with_planes(near, far).own_lights(name))
        .collect()
}

/// The chess board small, large, and far from the origin.
pub(super) fn scales() -> Result<Vec<Shot>> {
    let far_off = 1e6 * DVec3::new(1.0, -0.3, 0.7);
    [
        ("a thousandth", 1e-3, DVec3::ZERO),
        ("a million", 1e6, DVec3::ZERO),
        ("a million away", 1.0, far_off),
        ("a thousandth, a thousand away", 1e-3, 1e-3 * far_off),
    ]
    .into_iter()
    .map(|(name, scale, offset)| {
        let moved = chess_board()?.scene.moved(scale, offset);
        Stand::before(moved)?.own_lights(name)
    })
    .collect()
}

/// Every clip space, fixed and floating point.
pub(super) fn clip_spaces() -> Vec<Options> {
    let mut all = Vec::new();
    for &clip in ClipConvention::value_variants() {
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            all.extend(EXTREMES.map(|technique| Options { clip, format, ..Options::new(technique, MAP_SIZE) }));
        }
    }
    all
}

/// From 256² to 4096² texels.
pub(super) fn sizes() -> Vec<Options> {
    let of = |size| Technique::COMPARED.map(|technique| Options::new(technique, size));
    [256, 512, 1024, 2048, 4096].into_iter().flat_map(of).collect()
}

/// Every filter and every choice of faces.
pub(super) fn filters() -> Vec<Options> {
    let mut all = Vec::new();
    for faces in [Faces::All, Faces::Front, Faces::Back] {
        for filter in [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(3), Filter::Pcf(5)] {
            all.extend(EXTREMES.map(|technique| Options { faces, filter, ..Options::new(technique, MAP_SIZE) }));
        }
    }
    all
}

/// Solids on a floor: first depth with a bias, second depth without, and second depth with virtual samples.
pub(super) fn solids() -> Vec<Options> {
    let ways =
        [(Faces::All, Filter::Nearest), (Faces::Second, Filter::Nearest), (Faces::Second, Filter::Virtual(2))];
    let of = |map_size| {
        ways.map(|(faces, filter)| Options { faces, filter, ..Options::new(Technique::Uniform, map_size) })
    };
    [512, 256, 128].into_iter().flat_map(of).collect()
}

/// Open sheets, which are their own second surface, without a bias: with virtual samples, and with the midpoint of
/// two layers.
pub(super) fn open_sheets() -> Result<Vec<Shot>> {
    let ways = [(Faces::Second, Filter::Virtual(2)), (Faces::Layers, Filter::Nearest)];
    let of = |technique| ways.map(|(faces, filter)| Options { faces, filter, ..Options::new(technique, MAP_SIZE) });
    let options: Vec<_> = EXTREMES.into_iter().flat_map(of).collect();
    ["ground", "leaves"]
        .into_iter()
        .map(|name| Ok(Stand::built_in(name)?.own_lights(name)?.with_options(options.clone())))
        .collect()
}

/// Virtual samples in every format, with reversed and ordinary depth, for first and second depth.
pub(super) fn virtual_samples() -> Result<Vec<Shot>> {
    let mut options = Vec::new();
    for clip in [ClipConvention::Wgpu, ClipConvention::OpenglReversed] {
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32] {
            for (faces, taps) in [(Faces::All, 2), (Faces::All, 3), (Faces::Second, 2), (Faces::Second, 3)] {
                let filter = Filter::Virtual(taps);
                options.push(Options { clip, format, faces, filter, ..Options::new(Technique::Uniform, MAP_SIZE) });
            }
        }
    }
    ["chess-board", "street"]
        .into_iter()
        .map(|name| Ok(Stand::built_in(name)?.own_lights(name)?.with_options(options.clone())))
        .collect()
}

/// A point cloud as hexagons and as splats.
pub(super) fn points() -> Vec<Options> {
    let of = |points| EXTREMES.map(|technique| Options { points, ..Options::new(technique, MAP_SIZE) });
    [Points::Discs, Points::Splats].into_iter().flat_map(of).collect()
}
