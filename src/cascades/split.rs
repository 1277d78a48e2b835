//! Split schemes: the depths at which a view is cut into cascades.

use super::Cascades;
use crate::error::{Expected, InputError, InputErrorKind, MAX_COORDINATE, check};
use crate::input::view::{Lens, View};
use crate::math::bounds::Interval;

/// How a range of depths is split: Zhang, Sun, Xu & Lun, *Parallel-Split Shadow Maps for Large-scale Virtual Environments*,
/// VRCIA 2006, §4.
///
/// With n and f the ends of the range and k cascades, split i is at
///
/// ```text
///     Uniform          n + (f − n) i/k
///     Logarithmic      n (f/n)^(i/k)
///     Practical(λ)     λ · logarithmic + (1 − λ) · uniform
/// ```
///
/// The worst aliasing is least with the logarithmic split; `docs/cascades.md` says why. For an orthographic view pixels have
/// one size at all depths, and all schemes are the uniform one.
///
/// ```
#[doc = include_str!("../examples/cascades.txt")]
/// let at = |split| Cascades::new(&view.narrowed(1.0, 100.0)?, &sun, &scene, CascadeSplits::View { count: 2, split }, 0.0);
/// assert!((at(SplitScheme::Uniform)?[0].far - 50.5).abs() < 1e-5);
/// assert!((at(SplitScheme::Logarithmic)?[0].far - 10.0).abs() < 1e-5);
/// assert!((at(SplitScheme::Practical(0.5))?[0].far - 30.25).abs() < 1e-5);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "split lambda")]
#[doc(alias = "lambda")]
#[doc(alias = "practical split scheme")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum SplitScheme {
    /// Cascades of one length.
    Uniform,
    /// Cascades whose ends have one ratio.
    Logarithmic,
    /// Between the two, with λ from 0 (uniform) to 1 (logarithmic). The logarithmic scheme gives much to the range next
    /// to the eye, which is mostly air.
    Practical(f64),
}

/// The depths at which a view is cut into cascades.
///
/// ```
#[doc = include_str!("../examples/cascades.txt")]
/// let visible = CascadeSplits::Visible { count: 3, split: SplitScheme::Logarithmic }; // moves with the view
/// assert_eq!(Cascades::new(&view, &sun, &scene, visible, 0.1)?.len(), 3);
/// let planes = CascadeSplits::View { count: 3, split: SplitScheme::Logarithmic }; // stays, for stable maps
/// assert!(Cascades::new(&view, &sun, &scene, planes, 0.1).is_err()); // the far plane is at infinity
/// assert_eq!(Cascades::new(&view.narrowed(0.1, 80.0)?, &sun, &scene, planes, 0.1)?.len(), 3);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CascadeSplits<'a> {
    /// Between the nearest and the farthest receiver, so that neither a far plane at infinity nor a near plane in the air
    /// matters. The splits move with the view.
    ///
    /// Where the ends are so close to each other that f32 cannot tell the splits apart, there are fewer cascades.
    #[doc(alias = "SDSM")]
    Visible {
        /// How many cascades, 1 to [`Cascades::MAX`].
        count: usize,
        /// How they are split.
        split: SplitScheme,
    },
    /// Between the view's own planes: the splits stay while the camera moves, as maps that must not shimmer need it. For
    /// shadows that end before the far plane, [narrow](View::narrowed) the view to that depth.
    View {
        /// How many cascades, 1 to [`Cascades::MAX`].
        count: usize,
        /// How they are split.
        split: SplitScheme,
    },
    /// At these depths, ascending, rounded to f32: one less than there are cascades.
    At(&'a [f64]),
}

/// The depths of cuts, ascending, each an f32.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depths {
    depths: [f64; Cascades::MAX - 1],
    len: usize,
    /// Where the first cascade with receivers begins.
    pub(super) near: f64,
}

impl core::ops::Deref for Depths {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.depths[..self.len]
    }
}

impl CascadeSplits<'_> {
    /// The split depths of a view; `visible` finds the view depths of the receivers, upside down without any.
    pub(super) fn depths(&self, view: &View, visible: impl FnOnce() -> Interval) -> Result<Depths, InputError> {
        let (near, far) = (view.near(), view.far());
        match *self {
            CascadeSplits::Visible { count, split } => {
                split.check(count)?;
                let range = visible();
                // Corners of R are off by a few roundings, and farther than any plane can be where both eye
                // and scene are as far out as can be.
                let (near, far) = (range.min.max(near), range.max.min(far).min(MAX_COORDINATE));
                Ok(split.depths(view.lens(), near, far, count))
            }
            CascadeSplits::View { count, split } => {
                split.check(count)?;
                if count > 1 && far.is_infinite() {
                    return check::fail("view", InputErrorKind::NotFinite);
                }
                Ok(split.depths(view.lens(), near, far, count))
            }
            CascadeSplits::At(depths) => {
                let mut cuts = Depths::none(near);
                if depths.len() >= Cascades::MAX {
                    return check::fail("cuts", InputErrorKind::TooMany);
                }
                for (index, &depth) in depths.iter().enumerate() {
                    let at = |error: InputError| error.of_list("cuts", index);
                    let refuse = |problem| at(InputError::new("cuts", problem).got(depth));
                    let between = Expected::Between { above: near, below: far };
                    let depth = rounded(check::coordinate("cuts", depth).map_err(at)?);
                    if depth <= near {
                        return Err(refuse(InputErrorKind::TooSmall).expected(between));
                    }
                    if depth >= far {
                        return Err(refuse(InputErrorKind::TooLarge).expected(between));
                    }
                    if !cuts.push(depth) {
                        return Err(refuse(InputErrorKind::OutOfOrder));
                    }
                }
                Ok(cuts)
            }
        }
    }
}

impl Depths {
    pub(super) const fn none(near: f64) -> Self {
        Self { depths: [0.0; Cascades::MAX - 1], len: 0, near }
    }

    /// Adds a cut, if it lies beyond those before.
    pub(super) fn push(&mut self, depth: f64) -> bool {
        let before = self.last().copied().unwrap_or(self.near);
        match self.depths.get_mut(self.len) {
            Some(slot) if depth > before => {
                *slot = depth;
                self.len += 1;
                true
            }
            _ => false,
        }
    }
}

impl SplitScheme {
    fn check(self, count: usize) -> Result<(), InputError> {
        check::within("count", count as f64, Expected::Within { least: 1.0, most: Cascades::MAX as f64 })?;
        match self {
            Self::Uniform | Self::Logarithmic => Ok(()),
            Self::Practical(part) => check::part("split", part, 1.0).map(|_| ()),
        }
    }

    /// The cuts between two depths, less those that f32 cannot tell from the ends or from another.
    fn depths(self, lens: Lens, near: f64, far: f64, count: usize) -> Depths {
        let mut cuts = Depths::none(near);
        for index in 1..count {
            let depth = rounded(self.depth(lens, near, far, index as u32, count as u32));
            if depth < far {
                cuts.push(depth);
            }
        }
        cuts
    }

    fn depth(self, lens: Lens, near: f64, far: f64, index: u32, count: u32) -> f64 {
        let uniform = || near + (far - near) * (f64::from(index) / f64::from(count));
        let logarithmic = || near * rational_power(far / near, index, count);
        match (lens, self) {
            (Lens::Orthographic, _) | (_, Self::Uniform) => uniform(),
            (Lens::Perspective, Self::Logarithmic) => logarithmic(),
            (Lens::Perspective, Self::Practical(part)) => part * logarithmic() + (1.0 - part) * uniform(),
        }
    }
}

/// The parts of a range of depths between which cuts are chosen.
pub(super) const PARTS: usize = 20;

/// The ends of the parts, with one ratio in a perspective view.
pub(super) fn parts(lens: Lens, near: f64, far: f64) -> [f64; PARTS + 1] {
    let ratio = if far > near { root(root(far / near, 4), 5) } else { 1.0 };
    core::array::from_fn(|index| match lens {
        Lens::Perspective => near * power(ratio, index as u32),
        Lens::Orthographic => near + (far - near) * (index as f64 / PARTS as f64),
    })
}

/// As a shader compares it.
pub(super) fn rounded(depth: f64) -> f64 {
    f64::from(depth as f32)
}

/// `base` to the power of `index`/`count`, for a base from 1 to 2¹⁰⁰ and 0 < `index` < `count` ≤ 8.
///
/// By IEEE 754's own operations alone, so that it has the same bits everywhere, and right to five roundings: those of the
/// power count for less than one after the root, and the root is right to four.
fn rational_power(base: f64, index: u32, count: u32) -> f64 {
    // The seventh power, at most, of 2¹⁰⁰ is far from overflow.
    root(power(base, index), count)
}

fn power(base: f64, exponent: u32) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}

/// The root of a number of at least 1, of a degree from 2 to 8.
///
/// Newton's method. The bits of a float, read as an integer, are its logarithm to 0.087 of a power of two, which gives a
/// start within an eighth of the root. A step squares that error and multiplies it by (degree − 1)/2: 0.05, 10⁻², 3·10⁻⁴,
/// 3·10⁻⁷, 3·10⁻¹³, and the sixth is exact but for its own roundings.
fn root(value: f64, degree: u32) -> f64 {
    const STEPS: usize = 7;
    const ONE: u64 = 1.0_f64.to_bits();
    let start = f64::from_bits(ONE + value.to_bits().saturating_sub(ONE) / u64::from(degree));
    let others = f64::from(degree - 1);
    (0..STEPS).fold(start, |x, _| (others * x + value / power(x, degree - 1)) / f64::from(degree))
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use dashu_int::IBig;
    use proptest::prelude::*;

    #[test]
    fn roots_of_one_and_of_powers_of_two_are_exact() {
        for degree in 2..=8 {
            assert_eq!(root(1.0, degree), 1.0);
            for exponent in 1..12 {
                let two = power(2.0, exponent);
                assert_eq!(root(power(two, degree), degree), two, "{degree} {exponent}");
            }
        }
    }

    /// A number from 1 up, raised and then multiplied by 2^(52 · `factors`), which makes it an integer.
    fn raised(value: f64, exponent: u32, factors: u32) -> IBig {
        let bits = value.to_bits();
        let (mantissa, power_of_two) = (bits & 0xf_ffff_ffff_ffff | 1 << 52, (bits >> 52) - 1023);
        let shift = power_of_two as usize * exponent as usize + 52 * (factors - exponent) as usize;
        IBig::from(mantissa).pow(exponent as usize) << shift
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

        /// The power of the result against the power that it should have, in integers: a root that is off by a part has a
        /// power off by its degree times that.
        #[test]
        fn powers_are_right_to_five_roundings(
            mantissa in 1.0..2.0,
            exponent in 0..100_u32,
            (count, index) in (2..=8_u32).prop_flat_map(|count| (Just(count), 1..count)),
        ) {
            let base = mantissa * power(2.0, exponent);
            let found = rational_power(base, index, count);
            let (ours, right) = (raised(found, count, count), raised(base, index, count));
            let off = if ours > right { &ours - &right } else { &right - &ours };
            // A rounding is 2⁻⁵³ of the result at most.
            prop_assert!(off << 53 <= right * 5 * count, "{} to {}/{} is not {}", base, index, count, found);
        }
    }
}
