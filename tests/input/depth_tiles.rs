//! Depth buffers reduced to tiles.

use proptest::prelude::*;
use shadowfit::input::DepthRange;
use shadowfit::seen::{DepthTile, Seen};
use shadowfit::{Focus, Light, Scene, Settings, View};
use testkit::arbitrary::run;

const RANGES: [DepthRange; 4] = [
    DepthRange::ZeroToOne,
    DepthRange::ZeroToOneReversed,
    DepthRange::NegativeOneToOne,
    DepthRange::NegativeOneToOneReversed,
];

/// Stored depths: surfaces, some of them equal, cleared pixels of either direction, and what no depth buffer should hold.
fn stored() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => 0.0_f32..1.0,
        2 => (0_u8..4).prop_map(|step| f32::from(step) / 4.0),
        2 => Just(1.0),
        1 => Just(-0.0),
        1 => prop_oneof![Just(f32::NAN), Just(f32::INFINITY), Just(-0.25), Just(1.25), Just(f32::from_bits(1))],
    ]
}

fn buffer() -> impl Strategy<Value = ([u32; 2], Vec<f32>)> {
    (1_u32..24, 1_u32..24).prop_flat_map(|(width, height)| {
        proptest::collection::vec(stored(), (width * height) as usize)
            .prop_map(move |depths| ([width, height], depths))
    })
}

/// A tile by its definition, from all pixels of the image.
fn by_definition(
    [width, height]: [u32; 2],
    depths: &[f32],
    tile: u32,
    column: u32,
    row: u32,
    clear: f32,
) -> DepthTile {
    let surface = |x: i64, y: i64| -> Option<f32> {
        let is_in_image = (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y);
        let depth = is_in_image.then(|| depths[(y * i64::from(width) + x) as usize])?;
        (depth != clear && (0.0..=1.0).contains(&depth)).then_some(depth)
    };
    let [left, top] = [column * tile, row * tile];
    let [right, bottom] = [(left + tile).min(width), (top + tile).min(height)];
    let mut pixels: Vec<(i64, i64, f32)> = (0..i64::from(width * height))
        .map(|index| (index % i64::from(width), index / i64::from(width)))
        .filter(|(x, y)| (left.into()..right.into()).contains(x) && (top.into()..bottom.into()).contains(y))
        .filter_map(|(x, y)| Some((x, y, surface(x, y)?)))
        .collect();
    // Nearest to the middle first; a sort that keeps the order of rows among equals.
    let apart = |at: i64, first: u32, end: u32| (2 * at + 1 - i64::from(first + end)).pow(2);
    pixels.sort_by_key(|&(x, y, _)| apart(x, left, right) + apart(y, top, bottom));
    let Some(&(x, y, depth)) = pixels.first() else { return DepthTile::EMPTY };
    let slope = [(1, 0), (0, 1)].map(|(dx, dy)| {
        let after = surface(x + dx, y + dy).map(|next| next - depth);
        let before = surface(x - dx, y - dy).map(|previous| depth - previous);
        let changes = [after, before].into_iter().flatten();
        changes.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(0.0)
    });
    DepthTile {
        least: pixels.iter().map(|pixel| pixel.2).fold(1.0, f32::min),
        greatest: pixels.iter().map(|pixel| pixel.2).fold(0.0, f32::max),
        depth,
        slope,
        pixel: [x as u16, y as u16],
        pixels: pixels.len() as u32,
    }
}

#[test]
fn tiles_are_what_their_definition_says() {
    run(3000, &(buffer(), 1_u32..30), |((image, depths), tile)| {
        for range in RANGES {
            let clear = if range.is_reversed() { 0.0 } else { 1.0 };
            let tiles: Vec<_> =
                DepthTile::reduce(&depths, image, tile, range).expect("as many as pixels").collect();
            let [across, down] = image.map(|side| side.div_ceil(tile));
            assert_eq!(tiles.len(), (across * down) as usize);
            for (index, found) in tiles.iter().enumerate() {
                let (column, row) = (index as u32 % across, index as u32 / across);
                let expected = by_definition(image, &depths, tile, column, row, clear);
                assert_eq!(*found, expected, "{range:?}: tile {column}, {row} of {tile} pixels");
            }
        }
    });
}

/// On a plane stored depth is affine in the image, also where only one neighbour shows the plane.
#[test]
fn the_slope_is_that_of_the_surface_at_the_sample() {
    let at = |x: usize, y: usize| 0.25 + x as f32 / 64.0 + y as f32 / 256.0;
    let mut depths: Vec<f32> = (0..36).map(|index| at(index % 6, index / 6)).collect();
    let slope = |depths: &[f32]| -> [f32; 2] {
        let mut tiles = DepthTile::reduce(depths, [6, 6], 6, DepthRange::ZeroToOne).expect("36 pixels");
        tiles.next().expect("one tile").slope
    };
    assert_eq!(slope(&depths), [1.0 / 64.0, 1.0 / 256.0]);
    // The sample is the pixel at 2, 2. An edge to its right, sky below it.
    depths[2 * 6 + 3] = 0.9;
    depths[3 * 6 + 2] = 1.0;
    assert_eq!(slope(&depths), [1.0 / 64.0, 1.0 / 256.0]);
    // Alone in its column.
    depths[6 + 2] = 1.0;
    assert_eq!(slope(&depths), [1.0 / 64.0, 0.0]);
}

/// The bytes that a card writes are the fields in order, four bytes each, the pixel with x in its lower half.
#[test]
fn bytes_are_laid_out_as_the_card_writes_them() {
    let tile = DepthTile {
        least: 0.25,
        greatest: 0.5,
        depth: 0.375,
        slope: [-1.0, 2.0],
        pixel: [1919, 1079],
        pixels: 4096,
    };
    let words = [
        0.25_f32.to_bits(),
        0.5_f32.to_bits(),
        0.375_f32.to_bits(),
        (-1.0_f32).to_bits(),
        2.0_f32.to_bits(),
        1919 | 1079 << 16,
        4096,
    ];
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    assert_eq!(bytes, tile.to_bytes());
    assert_eq!(DepthTile::from_bytes(&tile.to_bytes()), tile);
    assert_eq!((bytes.len(), size_of::<DepthTile>()), (DepthTile::SIZE, DepthTile::SIZE));
}

#[test]
fn images_and_tiles_out_of_range_are_refused() {
    let refused = |image, tile, count: usize| {
        let depths = vec![0.5; count];
        DepthTile::reduce(&depths, image, tile, DepthRange::ZeroToOne).err().map(|error| error.field)
    };
    assert_eq!(refused([0, 4], 4, 0), Some("image"));
    assert_eq!(refused([4, 65_536], 4, 0), Some("image"));
    assert_eq!(refused([4, 4], 0, 16), Some("tile"));
    assert_eq!(refused([4, 4], 32_769, 16), Some("tile"));
    assert_eq!(refused([4, 4], 4, 15), Some("depths"));
    assert_eq!(refused([4, 4], 4, 17), Some("depths"));
    assert_eq!(refused([4, 4], 4, 16), None);
}

/// The largest tile there is: distances to its middle fit into the 32 bits that the card has for them.
#[test]
fn the_largest_tiles_are_reduced() {
    let mut depths = vec![1.0; 65_535 * 2];
    depths[65_535 + 7] = 0.5;
    let tiles: Vec<_> =
        DepthTile::reduce(&depths, [65_535, 2], 32_768, DepthRange::ZeroToOne).expect("legal").collect();
    assert_eq!((tiles.len(), tiles[0].pixel, tiles[1].is_empty()), (2, [7, 1], true));
    assert!(2 * 32_767_u64.pow(2) < 1 << 31);
}
/// What a card hands over before anything is drawn, or after an error, is fitted to as far as it can be.
#[test]
fn no_tile_breaks_a_fit() {
    let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, f64::INFINITY)
        .expect("sound");
    let sun = Light::directional((0.4, 1.0, 0.2)).expect("sound");
    let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0)).expect("sound");
    let sound =
        DepthTile { least: 0.01, greatest: 0.02, depth: 0.015, slope: [0.0, -1e-4], pixel: [5, 5], pixels: 100 };
    for broken in [
        DepthTile { least: f32::NAN, ..sound },
        DepthTile { greatest: f32::INFINITY, ..sound },
        DepthTile { least: 0.9, greatest: 0.1, ..sound },
        DepthTile { least: 0.0, depth: 0.0, ..sound },
        DepthTile { depth: f32::NAN, ..sound },
        DepthTile { slope: [f32::NAN, 0.0], ..sound },
        DepthTile { slope: [f32::MAX; 2], ..sound },
        DepthTile { slope: [f32::INFINITY, 0.0], ..sound },
        DepthTile { pixel: [u16::MAX; 2], ..sound },
        DepthTile { pixels: u32::MAX, ..sound },
        DepthTile::from_bytes(&[0xff; DepthTile::SIZE]),
    ] {
        for tiles in [[broken, sound, sound, sound], [broken; 4]] {
            let seen =
                Seen::from_tiles(&view, DepthRange::ZeroToOneReversed, [20, 20], 10, &tiles).expect("four tiles");
            let focus = Focus::new(&view, &sun, &scene).with_seen(&seen);
            let outcome = focus.fit(&Settings::default());
            assert!(outcome.map().is_none_or(|map| map.caster_matrix().is_finite()), "{broken:?}");
            let error = outcome.map().and_then(|map| map.surface_error(&focus));
            assert!(error.is_none_or(|error| error.mean.is_finite() && error.worst.is_finite()), "{broken:?}");
        }
    }
}
