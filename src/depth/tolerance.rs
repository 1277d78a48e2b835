//! What a comparison of depths must allow for where no bias does.

use crate::depth::bias::checked_reach;
use crate::error::InputError;
use crate::map::quality::DepthFormat;
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::least;

/// How far rasterisers move a vertex in a map, in texels: to a grid of a 256th, by half of a step, and as much again for
/// the interpolation of depth across a triangle.
pub const RASTER_GRID: f64 = 1.0 / 256.0;

/// The largest part of the depth range that is allowed for: with more than all of it, everything is lit already.
const MOST_OF_RANGE: f64 = 2.0;

/// How much of the depth range a comparison must allow for so that a plane does not shadow itself by rounding
/// ([`ShadowMap::comparison_tolerance`]): what remains of a bias where virtual samples do the rest.
///
/// At a point with the given w, on a plane whose depth changes by (p, q) from one texel to the next, it is
///
/// ```text
///     constant + min(over_w / w, most) + slope · (|p| + |q|)
/// ```
///
/// The four numbers, in this order, are what the shader functions of the `wgsl` feature take ([`Self::to_array`]).
///
/// ```
/// use shadowfit::{DepthFormat, Light, Scene, Settings, View, Warp, fit, depth::TangentPlane};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
/// let lamp = Light::spot((0.0, 4.0, -5.0), (0.0, -1.0, -0.2), 0.7, 0.01, 30.0)?;
/// let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 5.0, 20.0))?;
/// let settings = Settings::default().with_warp(Warp::Uniform);
/// if let Some(map) = fit(&view, &lamp, &scene, &settings).map() {
///     let tolerance = map.comparison_tolerance(DepthFormat::Float32, 1.0)?; // 2 × 2 texels
///     let floor = TangentPlane::new(map, (0.0, 0.0, -5.0).into(), (0.0, 1.0, 0.0).into()).expect("in the map");
///     // Four metres from the lamp it is a sixth of what it is a centimetre from it.
///     assert!(floor.tolerance(&tolerance) < 0.2 * tolerance.most);
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Derivation
///
/// What is compared are the depth stored for a plane at the middle T of a texel, and the plane's depth there as it follows
/// from the depth at a point R. f32 puts a point's depth off by at most ε = min(α/w, β) ([`ShadowMap::depth_rounding`]).
///
/// *What is stored.* On a plane 1/w is an affine function of the place in the map, and ε a concave one of 1/w. The corners
/// of a triangle are off by ε each, and T is a mean of them, so that what is stored is off by no more than ε(T), if a corner
/// next to a lamp is off by a hundred times as much; and by half a step of the format.
///
/// *What it is compared with* is off by ε(R), and T at most r = reach texels away, across and down. Per texel 1/w changes
/// by at most γ + (\|p\| + \|q\|)/−z·l, z the row of depth and l a light at a position, and by at most γ under a directional
/// light (γ comes from the warp, 0 without one). So
///
/// ```text
///     ε(R) + ε(T) ≤ min(2 α/w(R) + r α (γ + (|p| + |q|)/−z·l), 2 β)
///                 ≤ r α γ + min(2 α/w(R), 2 β) + r α/−z·l (|p| + |q|)
/// ```
///
/// Without a warp, under a directional light, that is 2 α/w. α/−z·l is the part of its distance to the lamp by which f32
/// moves a point, some millionths; it is taken to be no more than all of it. The rasteriser's grid adds [`RASTER_GRID`] to what multiplies the slopes.
///
/// The w that a shader reads is itself off, by as small a part as depth is: the room for terms of second order that α has
/// covers it wherever f32 loses less than a quarter of w.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ComparisonTolerance {
    /// Everywhere: half a step of the format, and what a warp changes of the rounding across the texels that are read.
    pub constant: f64,
    /// Over w: twice what f32 can be off by, once for the point and once for what is stored.
    pub over_w: f64,
    /// The most that this comes to, beside a lamp.
    pub most: f64,
    /// Times the plane's changes of depth with each texel, across and down together.
    pub slope: f64,
}

impl ComparisonTolerance {
    /// The same everywhere but for [`RASTER_GRID`] of the slopes: for depths that f32 puts off by nothing more.
    #[must_use]
    pub const fn constant(constant: f64) -> Self {
        Self { constant, over_w: 0.0, most: 0.0, slope: RASTER_GRID }
    }

    /// Where w is that, on a plane across the light; the most there is where w ≤ 0, outside of the map.
    #[must_use]
    pub fn at(&self, w: f64) -> f64 {
        self.constant + if w > 0.0 { least(self.over_w / w, self.most) } else { self.most }
    }

    /// What a shader takes.
    #[must_use]
    pub const fn to_array(&self) -> [f32; 4] {
        [self.constant as f32, self.over_w as f32, self.most as f32, self.slope as f32]
    }
}

impl ShadowMap {
    /// What a comparison must allow for so that no plane shadows itself by rounding where virtual samples
    /// ([`TangentPlane`](crate::depth::TangentPlane)) take the place of a bias, or where layers are told apart.
    ///
    /// `reach` is how far from a point the middles of the texels lie that are compared for it, at most, across and down, in
    /// texels, as for [`Self::bias`]: 0.5 for one texel, 1 for 2 × 2, n/2 for n × n.
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`](crate::Settings::MAX_SIZE).
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
