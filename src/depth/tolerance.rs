//! Comparison tolerances: the rounding that a comparison allows for where there is no bias.

use crate::depth::bias::checked_reach;
use crate::error::InputError;
use crate::map::quality::DepthFormat;
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::least;

/// How far rasterisers move a vertex in a map, in texels: half a step of their grid of 256ths, and as much again for the
/// interpolation of depth across a triangle.
pub const RASTER_GRID: f64 = 1.0 / 256.0;

/// The largest part of the depth range that is allowed for: beyond the whole range everything is lit already.
const MOST_OF_RANGE: f64 = 2.0;

/// The rounding that a comparison with a virtual sample allows for, so that no plane has shadow acne
/// ([`ShadowMap::comparison_tolerance`]): the rest of a bias that virtual samples leave.
///
/// At a point with the given w, on a plane whose depth changes by (p, q) from texel to texel, it is, where the depth range is
/// 1,
///
/// ```text
///     constant + min(over_w / w, most) + slope · (|p| + |q|)
/// ```
///
/// The four numbers, in this order, are what the shader functions of the `wgsl` feature take ([`Self::to_array`]).
/// `docs/depth.md` derives them.
///
/// ```
#[doc = include_str!("../examples/spot.txt")]
/// use shadowfit::depth::TangentPlane;
///
/// let tolerance = map.comparison_tolerance(DepthFormat::Float32, Filter::Hardware2x2.reach())?;
/// let plane = TangentPlane::new(&map, floor, up).expect("in the map");
/// // Far less four metres from the light than next to it.
/// assert!(plane.tolerance(&tolerance) < 0.2 * tolerance.most);
/// assert_eq!(tolerance.to_array()[0], tolerance.constant as f32);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ComparisonTolerance {
    /// Everywhere: half a step of the format, and the warp's change of the rounding across the texels that are read.
    pub constant: f64,
    /// Over w: twice the most that f32 changes depth by, once for the point and once for the stored depth.
    pub over_w: f64,
    /// The most that `over_w` comes to, next to a local light.
    pub most: f64,
    /// The factor of the plane's slopes of depth, across and down together, in texels.
    pub slope: f64,
}

impl ComparisonTolerance {
    /// A tolerance of `constant` everywhere, and [`RASTER_GRID`] of the slopes: for depths without any other rounding.
    ///
    /// ```
    /// use shadowfit::depth::{ComparisonTolerance, RASTER_GRID};
    ///
    /// let tolerance = ComparisonTolerance::constant(1e-6);
    /// assert_eq!((tolerance.at(1.0), tolerance.at(0.01), tolerance.slope), (1e-6, 1e-6, RASTER_GRID));
    /// ```
    #[must_use]
    pub const fn constant(constant: f64) -> Self {
        Self { constant, over_w: 0.0, most: 0.0, slope: RASTER_GRID }
    }

    /// The tolerance at a point with the given w, on a plane across the light's ray; the largest where w ≤ 0, outside of
    /// the map.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let tolerance = map.comparison_tolerance(DepthFormat::Float32, 1.0)?;
    /// assert!(tolerance.at(map.w_at(floor)) < tolerance.at(map.w_at(floor + 3.5 * up)));
    /// assert_eq!(tolerance.at(-1.0), tolerance.constant + tolerance.most);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn at(&self, w: f64) -> f64 {
        self.constant + if w > 0.0 { least(self.over_w / w, self.most) } else { self.most }
    }

    /// The four numbers in the order that the shader functions take them: constant, over w, most, slope.
    #[must_use]
    pub const fn to_array(&self) -> [f32; 4] {
        [self.constant as f32, self.over_w as f32, self.most as f32, self.slope as f32]
    }
}

impl ShadowMap {
    /// The tolerance of comparisons in this map with virtual samples ([`TangentPlane`](crate::depth::TangentPlane)), or
    /// between two layers.
    ///
    /// `reach` is how far from a point the middles of the texels lie that are compared for it, at most, across and down, in
    /// texels, as for [`Self::bias`]: 0.5 for one texel, 1 for 2 × 2, n/2 for n × n.
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`](crate::Settings::MAX_SIZE).
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let coarse = map.comparison_tolerance(DepthFormat::Unorm16, 1.0)?;
    /// let fine = map.comparison_tolerance(DepthFormat::Unorm24, 1.0)?;
    /// assert!(fine.constant < coarse.constant);
    /// assert!(map.comparison_tolerance(DepthFormat::Unorm24, f64::INFINITY).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    pub fn comparison_tolerance(&self, format: DepthFormat, reach: f64) -> Result<ComparisonTolerance, InputError> {
        let reach = checked_reach(reach)?;
        let noise = &self.noise;
        let of_warp = reach * noise.depth.over_w * noise.change;
        let part = match self.light.position() {
            Some(_) => reach * noise.depth.over_w / noise.to_light,
            None => 0.0,
        };
        // ε(T) is at most β, whatever the warp, and a point is anywhere where f32 moves it by all of its distance.
        Ok(ComparisonTolerance {
            constant: 0.5 * format.step(1.0) + of_warp.min(noise.depth.most).min(MOST_OF_RANGE),
            over_w: (2.0 * noise.depth.over_w).min(MOST_OF_RANGE),
            most: (2.0 * noise.depth.most).min(MOST_OF_RANGE),
            slope: RASTER_GRID + part.min(reach),
        })
    }
}
