//! What is compared: in each comparison one thing varies, and all else stays.

use render_check::gpu::{Bias, Filter};
use render_check::maps::{Cascading, ClipConvention, SplitArg, Technique};
use render_check::run::Options;
use render_check::trace::Faces;
use shadowfit::DepthFormat;

use crate::size::Size;

/// A scene made by code, and a light in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shot {
    /// The scene.
    pub scene: &'static str,
    /// The light, as `render-check` spells it. The direction of a sun points towards it.
    pub light: &'static str,
}

const STREET_SUN: Shot = Shot { scene: "street", light: "sun:0.62,0.72,-0.42" };
const BOARD_SUN: Shot = Shot { scene: "chess-board", light: "sun:-0.8,0.6,0.2" };
const BOARD_LAMP: Shot = Shot { scene: "chess-board", light: "point:-1.6,7,-8" };
const LEAVES_SUN: Shot = Shot { scene: "leaves", light: "sun:-0.55,1,-0.25" };
const TABLE_LAMP: Shot = Shot { scene: "table", light: "point:-1.1,1.9,0.9" };
const BEHIND_SUN: Shot = Shot { scene: "behind", light: "sun:0.22,0.22,1" };
/// In its shade, out of the picture.
const ROOM_LAMP: Shot = Shot { scene: "room", light: "point:0.9,2.3,-1.9" };
/// In the middle of the picture.
const ROOM_LAMP_IN_VIEW: Shot = Shot { scene: "room", light: "point:0,1.5,-2.5" };

/// A comparison.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// A name without spaces.
    pub name: &'static str,
    /// The scenes and lights.
    pub shots: Vec<Shot>,
    /// Whether maps are fitted to the depths that something is seen in, to all between the camera's planes, or once each.
    pub narrowed: &'static [bool],
    /// The contenders. All are held against the first.
    pub contenders: Vec<Options>,
}

/// Warps, sizes, and cascades as engines have them.
pub const WARPS: &str = "warps";
/// One cascade to eight, with as many texels in all.
pub const CASCADES_OF_SAME_SUM: &str = "cascades-same-sum";
/// One cascade to eight, with as many texels each.
pub const CASCADES_OF_SAME_SIZE: &str = "cascades-same-size";
/// Maps for lamps among what they light.
pub const KINDS: &str = "kinds";
/// Depth formats.
pub const FORMATS: &str = "formats";
/// Depth tests.
pub const TESTS: &str = "tests";
/// Filters.
pub const FILTERS: &str = "filters";

/// Every warp that a single map can have.
pub const ALL_WARPS: [Technique; 9] = [
    Technique::Uniform,
    Technique::Psm,
    Technique::PsmUnshifted,
    Technique::LightSpace,
    Technique::Trapezoidal,
    Technique::BestClosed,
    Technique::BestRough,
    Technique::Best,
    Technique::BestThorough,
];

/// Those that are plotted, and measured in all sizes.
pub const PLOTTED: [Technique; 4] = [Technique::Uniform, Technique::Psm, Technique::LightSpace, Technique::Best];

/// Those that cascades are cut with, and how many: as engines have cascades, and as the crate would.
pub const SLICED: [(Technique, usize); 4] =
    [(Technique::Uniform, 4), (Technique::Stable, 4), (Technique::Best, 2), (Technique::Best, 4)];

/// The size that all others are held against, in texels a side.
#[must_use]
pub const fn middle_size(size: Size) -> u32 {
    size.of(128, 1024)
}

/// All comparisons.
#[must_use]
pub fn comparisons(size: Size) -> Vec<Comparison> {
    let middle = middle_size(size);
    let first_of = |shots: &[Shot], smoke: usize| shots[..size.of(smoke, shots.len())].to_vec();
    let suns_and_lamps = [STREET_SUN, TABLE_LAMP, BOARD_SUN, BOARD_LAMP, LEAVES_SUN, BEHIND_SUN];
    let deep = first_of(&[STREET_SUN, BOARD_SUN, BEHIND_SUN], 1);
    let solid_and_not = first_of(&[TABLE_LAMP, LEAVES_SUN, BOARD_SUN], 1);
    let best = Options::new(Technique::Best, middle);
    let both = &[true, false];
    vec![
        Comparison {
            name: WARPS,
            shots: first_of(&suns_and_lamps, 2),
            narrowed: both,
            contenders: warps(size, middle),
        },
        Comparison {
            name: CASCADES_OF_SAME_SUM,
            shots: deep.clone(),
            narrowed: both,
            contenders: cascades(|count| (f64::from(2 * middle) / (count as f64).sqrt()).round() as u32),
        },
        Comparison { name: CASCADES_OF_SAME_SIZE, shots: deep, narrowed: both, contenders: cascades(|_| middle) },
        Comparison {
            name: KINDS,
            shots: vec![ROOM_LAMP, ROOM_LAMP_IN_VIEW],
            narrowed: &[true],
            contenders: kinds(size, middle),
        },
        Comparison {
            name: FORMATS,
            shots: first_of(&[STREET_SUN, BOARD_SUN, ROOM_LAMP], 1),
            narrowed: &[true],
            contenders: vec![
                best,
                Options { format: DepthFormat::Unorm16, ..best },
                Options { format: DepthFormat::Float32, ..best },
                Options { format: DepthFormat::Float32, clip: ClipConvention::WgpuReversed, ..best },
            ],
        },
        Comparison {
            name: TESTS,
            shots: solid_and_not.clone(),
            narrowed: &[true],
            contenders: vec![
                best,
                Options { bias: Some(Bias::NONE), ..best },
                Options { faces: Faces::Second, ..best },
                Options { faces: Faces::Layers, ..best },
                Options { filter: Filter::Virtual(1), ..best },
                Options { faces: Faces::Second, filter: Filter::Virtual(1), ..best },
            ],
        },
        Comparison {
            name: FILTERS,
            shots: solid_and_not,
            narrowed: &[true],
            contenders: [
                Filter::Nearest,
                Filter::Hardware2x2,
                Filter::Pcf(3),
                Filter::Pcf(5),
                Filter::Virtual(2),
                Filter::Virtual(3),
            ]
            .map(|filter| Options { filter, ..best })
            .to_vec(),
        },
    ]
}

/// So many cascades, each where pixels grow by one factor.
fn cascaded(technique: Technique, count: usize, map_size: u32) -> Options {
    let cascading = (count > 1).then(|| Cascading { count, split: SplitArg::default() });
    Options { cascading, ..Options::new(technique, map_size) }
}

/// The uniform map of the middle size first. What is plotted is drawn in all sizes, the other warps in those around the
/// middle, and cascades in those whose texels are no more than the largest map's.
fn warps(size: Size, middle: u32) -> Vec<Options> {
    let sizes: &[u32] = if size == Size::Smoke { &[64, 128] } else { &[256, 512, 1024, 2048, 4096] };
    let mut all = vec![Options::new(Technique::Uniform, middle)];
    for technique in ALL_WARPS {
        let is_wanted = |of: &u32| PLOTTED.contains(&technique) || (middle / 2..=2 * middle).contains(of);
        all.extend(sizes.iter().filter(|of| is_wanted(of)).map(|&of| Options::new(technique, of)));
    }
    for (technique, count) in SLICED {
        let is_wanted = |of: &u32| *of <= middle;
        all.extend(sizes.iter().filter(|of| is_wanted(of)).map(|&of| cascaded(technique, count, of)));
    }
    // The first is there twice by now.
    let again = (1..all.len()).find(|&index| all[index] == all[0]);
    again.map(|index| all.remove(index));
    all
}

/// One cascade to eight, uniform ones first, in maps whose size depends on their number.
fn cascades(map_size: impl Fn(usize) -> u32) -> Vec<Options> {
    let of = |technique| [1, 2, 4, 8].map(|count| cascaded(technique, count, map_size(count)));
    [Technique::Uniform, Technique::LightSpace, Technique::Best].into_iter().flat_map(of).collect()
}

/// Faces of a cube of the middle size first, as these always do.
fn kinds(size: Size, middle: u32) -> Vec<Options> {
    let sizes = size.of([middle / 2, middle, middle], [middle / 4, middle / 2, middle]);
    let mut all = vec![Options::new(Technique::Cube, middle)];
    for technique in
        [Technique::Cube, Technique::CubePsm, Technique::Paraboloid, Technique::Uniform, Technique::Best]
    {
        for map_size in sizes {
            let options = Options::new(technique, map_size);
            if !all.contains(&options) {
                all.push(options);
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_is_there_twice_and_the_first_is_the_middle() {
        for size in [Size::Smoke, Size::Full] {
            for comparison in comparisons(size) {
                let contenders = &comparison.contenders;
                for (index, one) in contenders.iter().enumerate() {
                    assert!(!contenders[..index].contains(one), "{}: {}", comparison.name, one.name());
                }
                let is_middle = |options: &Options| options.map_size == middle_size(size);
                assert!(
                    comparison.name == CASCADES_OF_SAME_SUM || is_middle(&contenders[0]),
                    "{}",
                    comparison.name
                );
                assert!(!comparison.shots.is_empty() && !comparison.narrowed.is_empty(), "{}", comparison.name);
            }
        }
    }

    #[test]
    fn cascades_of_one_sum_have_as_many_texels() {
        let all = comparisons(Size::Full);
        let same = all.iter().find(|comparison| comparison.name == CASCADES_OF_SAME_SUM).expect("it is there");
        for options in &same.contenders {
            let count = options.cascading.map_or(1, |cascading| cascading.count);
            let texels = count as f64 * f64::from(options.map_size).powi(2);
            assert!((texels / 2048_f64.powi(2) - 1.0).abs() < 1e-3, "{}", options.name());
        }
    }
}
