//! The results of a comparison: counts of marks, the worst cluster, and the aliasing.

use serde::Serialize;

use super::cluster::{Cluster, worst_cluster};
use super::mark::Mark;
use super::share::share;
use super::truth::{Truth, TruthImage};

/// Numbers of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// All of the picture.
    pub pixels: usize,
    /// Those without a surface.
    pub sky: usize,
    /// Those that are unlit whatever casts shadows, and those shadowed only by something closer to a local light
    /// than its near plane.
    pub unlit: usize,
    /// The rest, which are compared.
    pub compared: usize,
    /// Compared pixels that are truly in shadow.
    pub shadowed: usize,
    /// In shadow, but should be lit.
    pub false_shadow: usize,
    /// Lit, but should be in shadow, although no caster is missing.
    pub false_light: usize,
    /// Wrong, within the filter's reach of a true shadow's edge.
    pub edge_texel: usize,
    /// Wrong, next to a pixel across a true shadow's edge, and not counted in `edge_texel`.
    pub edge_pixel: usize,
    /// Lit, but should be in shadow, because a caster is missing from the map.
    pub missing: usize,
}

impl Counts {
    /// Counts marks. `shadowed` is the number of compared pixels that are truly in shadow.
    pub(super) fn of(marks: &[Mark], shadowed: usize) -> Self {
        let mut counts = Self { pixels: marks.len(), shadowed, ..Self::default() };
        for mark in marks {
            match mark {
                Mark::Sky => counts.sky += 1,
                Mark::Unlit => counts.unlit += 1,
                Mark::Right => {}
                Mark::EdgeTexel => counts.edge_texel += 1,
                Mark::EdgePixel => counts.edge_pixel += 1,
                Mark::FalseShadow => counts.false_shadow += 1,
                Mark::FalseLight => counts.false_light += 1,
                Mark::Missing => counts.missing += 1,
            }
        }
        counts.compared = counts.pixels - counts.sky - counts.unlit;
        counts
    }

    /// Wrong pixels away from edges.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.false_shadow + self.false_light + self.missing
    }

    /// Wrong pixels at edges of true shadows.
    #[must_use]
    pub fn edges(&self) -> usize {
        self.edge_texel + self.edge_pixel
    }

    /// All wrong pixels. A coarse map shows at the edges of its shadows.
    #[must_use]
    pub fn wrong(&self) -> usize {
        self.faults() + self.edges()
    }

    /// A count as a fraction of the compared pixels, 0 to 1; 0 where none were compared.
    #[must_use]
    pub fn fraction(&self, count: usize) -> f64 {
        share(count, self.compared)
    }
}

/// The aliasing over the compared pixels, texel size over pixel size: see [`shadowfit::ShadowMap::aliasing`].
/// Infinite outside the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Aliasing {
    /// The largest.
    pub worst: f64,
    /// The median.
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

impl Aliasing {
    /// Of the values at all pixels; `None` where there are none.
    pub(super) fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_unstable_by(f64::total_cmp);
        let rank = |percent: usize| values.get((values.len() * percent).div_ceil(100).saturating_sub(1)).copied();
        Some(Self { worst: rank(100)?, median: rank(50)?, p95: rank(95)? })
    }
}

/// The result of comparing a rendered image with the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Numbers of pixels.
    pub counts: Counts,
    /// The number of pixels with false light that lie farther behind their casters than the bias derived from the map
    /// reaches, see [`shadowfit::ShadowMap::bias_distance`]; 0 with any other bias.
    pub beyond_bias: usize,
    /// The largest cluster of faults; `None` without faults.
    pub worst_cluster: Option<Cluster>,
    /// The aliasing; `None` where nothing was compared.
    pub aliasing: Option<Aliasing>,
    /// The mark of each pixel, row by row from the top. Not serialised.
    #[serde(skip)]
    pub marks: Vec<Mark>,
}

impl Verdict {
    /// The verdict without a map: everything counts as lit, and every true shadow as missing.
    #[must_use]
    pub fn without_map(truth: &TruthImage) -> Self {
        let mark = |pixel: &Truth| match (pixel.surface(), pixel.compared()) {
            (None, _) => Mark::Sky,
            (_, None) => Mark::Unlit,
            (_, Some((_, true))) => Mark::Right,
            (_, Some((_, false))) => Mark::Missing,
        };
        let marks: Vec<Mark> = truth.pixels().iter().map(mark).collect();
        Self {
            counts: Counts::of(&marks, truth.shadowed()),
            beyond_bias: 0,
            worst_cluster: worst_cluster(truth, &marks),
            aliasing: None,
            marks,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mark_is_counted_once() {
        let marks = [
            Mark::Sky,
            Mark::Unlit,
            Mark::Unlit,
            Mark::Right,
            Mark::Right,
            Mark::Right,
            Mark::EdgeTexel,
            Mark::EdgePixel,
            Mark::FalseShadow,
            Mark::FalseLight,
            Mark::Missing,
        ];
        let counts = Counts::of(&marks, 4);
        let expected = Counts {
            pixels: 11,
            sky: 1,
            unlit: 2,
            compared: 8,
            shadowed: 4,
            false_shadow: 1,
            false_light: 1,
            edge_texel: 1,
            edge_pixel: 1,
            missing: 1,
        };
        assert_eq!(counts, expected);
        assert_eq!((counts.faults(), counts.edges(), counts.fraction(counts.faults())), (3, 2, 0.375));
        assert_eq!(Counts::default().fraction(0), 0.0);
    }

    #[test]
    fn aliasing_is_ranked() {
        let values: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!(Aliasing::of(values), Some(Aliasing { worst: 200.0, median: 100.0, p95: 190.0 }));
        assert_eq!(Aliasing::of(vec![3.0]), Some(Aliasing { worst: 3.0, median: 3.0, p95: 3.0 }));
        assert_eq!(Aliasing::of(Vec::new()), None);
    }
}
