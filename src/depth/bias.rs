//! The bias that a fitted map needs: with it no plane shadows itself, and no more is added than that takes.

use crate::error::{Expected, InputError, check};
use crate::map::quality::DepthFormat;
use crate::map::receiver_offset::ReceiverOffset;
use crate::map::shadow_map::ShadowMap;
use crate::settings::Settings;
use crate::warp::rounding::MapNoise;
use glam::DVec3;

/// What is added to depth so that no plane shadows itself ([`ShadowMap::bias`]).
///
/// # Use
///
/// `constant` and `slope_scale` go to the rasteriser that draws casters, as they are: they have the sign of the map's clip space, which is
/// away from the light, and negative where depth is reversed. `receiver` goes to the shadow test, through
/// [`ShadowMap::receiver_matrix_with`] or, in clip space, [`ShadowMap::receiver_clip_matrix_with`].
///
/// | | constant | slope_scale | clamp |
/// |---|---|---|---|
/// | wgpu, `DepthBiasState` | `constant` | `slope_scale` | 0 |
/// | Vulkan, `vkCmdSetDepthBias` | `depthBiasConstantFactor` | `depthBiasSlopeFactor` | 0 |
/// | OpenGL, `glPolygonOffset` | `units` | `factor` | |
/// | Direct3D | `DepthBias` | `SlopeScaledDepthBias` | 0 |
/// | a shader that writes depth, with m = max(\|dz/dx\|, \|dz/dy\|) | steps of the format | times m | |
///
/// `constant` and, in most maps, `slope_scale` depend on the format and the filter alone, which suits pipelines that they are
/// compiled into: `slope_scale` is the one for places that f32 carries by a 64th of a texel, or, where it carries them farther, one of the
/// few that are 1.25, 1.5625, … times that. What changes from fit to fit is in the receiver's matrix, which is uploaded with every fit anyway. One
/// who tests with [`ShadowMap::receiver_matrix`] as it is takes [`Self::constant_alone`].
///
/// ```
/// use shadowfit::{DepthFormat, Light, Scene, Settings, View, fit};
///
/// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
/// let sun = Light::directional((0.4, 1.0, 0.2))?;
/// let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
/// if let Some(map) = fit(&view, &sun, &scene, &Settings::default()).map() {
///     let bias = map.bias(DepthFormat::Float32, 1.0)?; // a comparison sampler's 2 × 2 texels
///     println!("constant {}, slope_scale {}", bias.constant, bias.slope_scale);
///     println!("upload {} for casters and {} for receivers", map.caster_matrix(), map.receiver_matrix_with(&bias.offset()));
/// }
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// # Derivation
///
/// On a plane depth is an affine function D of the place in the map, in texels (a projective map takes planes to planes),
/// with gradient (p, q). A filter compares the depth of a receiver at R with what is stored for the middle T of each texel
/// that it reads, which lies at most `reach` away, across and down.
///
/// *What f32 does.* A row is off by a sum of magnitudes that hardly changes over the scene, and depth by that over w:
///
/// ```text
///     ε(X) = α/w(X) + β
/// ```
///
/// ([`ShadowMap::depth_rounding`]; α and β come from the fit). On a plane 1/w is an affine function of the place, as depth is,
/// and so is ε: where the corners of a triangle are off by ε each, points in it are off by no more than ε there, if a
/// corner next to a lamp is off by a hundred times as much. Per texel 1/w changes by at most γ + (\|p\| + \|q\|)/−z·l, z
/// the row of depth and l a light at a position, and by at most γ under a directional light (γ comes from the warp, 0 without
/// one, see `rounding.rs`). So for ε that is α γ + π (\|p\| + \|q\|), where π = α/−z·l, the part of its distance to the
/// lamp by which f32 moves a point.
///
/// *What is stored.* The corners of a triangle of that plane are off, each by itself: across by at most s = t + 1/256
/// texels, t what f32 makes of a place ([`Self::places`]) and 1/256 a step of the grid that rasterisers move corners to,
/// half of it for the grid and half for the interpolation of depth; in depth by at most ε. The triangle's own depth D' is
/// affine too. E = D' − D is at the corners, and so in the triangle, within the affine function e = s(\|p\| + \|q\|) + ε, and
/// its gradient within that of e and twice the largest e/h at a corner, h the corner's height over the side across. Where no
/// h is less than what ε there is to ε at R times some h₀, nor than h₀, e/h is at most e(R)/h₀.
///
/// *What the receiver may exceed it by.* R is read off by t more, so that T − R is at most r = reach + t on each axis, and
/// with e and ε at R and m = max(\|p'\|, \|q'\|)
///
/// ```text
///     D(R) − D'(T) = (D'(R) − D'(T)) − E(R) ≤ r (|p'| + |q'|) + k e + j g
///     k = 1 + 2√2 r/h₀       j = 2√2 r       g = α γ + π (|p| + |q|)
///     |p| + |q| ≤ 2 (m + g + 2 e/h₀)         |p'| + |q'| ≤ 2 m
///     |p| + |q| ≤ 2 (m + α γ + 2 ε/h₀)/n     n = 1 − 2 π − 4 s/h₀
/// ```
///
/// *What the rasteriser adds.* Slope times the larger of \|p'\| and \|q'\|, or any value from there to the length of the
/// gradient, as the API's documents allow: at least slope · m. So
///
/// ```text
///     slope    = 2 r + 2 f                    f = (k s + j π)/n
///     receiver = ε + (k + 4 f/h₀) ε + (j + 2 f) α γ
///     constant = 1                            ε of the receiver's own depth, and of the corners'
/// ```
///
/// covers all but the rounding of what is stored, half a step, and of what it is compared with where a card brings that
/// into the map's format, the other half: one unit. In fixed point a unit is a step of the format, or in Direct3D less by
/// so little that `receiver` takes it. In floating point it is a step at the triangle's largest depth, so that it covers
/// the rounding of a stored value, which is relative too. It vanishes towards depth 0, where ε does not, so that **no
/// number of units can cover ε**: at the near end of a map, or at the far end of a reversed one. That is why ε is the
/// receiver's. Of it, what goes with 1/w is [`Self::relative`], as [`ReceiverOffset::relative`] does, and the rest [`Self::receiver`].
///
/// # What it takes for granted
///
/// - h₀ is a texel, or eight times s where that is more: of thinner triangles the slope itself is noise, and they may be
///   biased too little. A corner that is x times as noisy as the receiver, x times nearer to a lamp, is x h₀ high.
/// - Corners of triangles are no farther from the origin of the settings than what is visible, or their positions round
///   more coarsely than ε says. A rasteriser's grid has 8 bits, as Direct3D asks and all cards today have.
/// - Receivers and corners are not beside a lamp: closer to it, along the axis of the map, than a 16th of the way to the farthest of
///   what is visible. A lamp in view has the air around it in view, down to its near distance, where t is hundreds of times
///   what it is elsewhere, and a slope for that would let light through everywhere. What is beside it and steep may
///   shadow itself, if f32 carries it by more than `places`; noise of depth is covered there too. Where more is needed,
///   the light's near distance is the place to say so.
/// - f32 moves no receiver by more than an eighth of its distance to the lamp.
/// - It is about planes. At a convex edge, or on a curved surface made of facets, a texel's middle may lie on a facet with
///   less slope than the receiver's; a card knows only the caster's.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthBias {
    /// The format that it is for.
    pub format: DepthFormat,
    /// Units of constant bias, see [`DepthFormat::bias_unit`]: negative where depth is reversed.
    pub constant: i32,
    /// What multiplies the slope, the larger of depth's changes to the next texel, across and down: negative where depth is
    /// reversed.
    pub slope_scale: f32,
    /// What receivers are tested nearer to the light by all over the map, where the depth range is 1.
    pub receiver: f64,
    /// What they are tested nearer by besides, as a part for [`ReceiverOffset::relative`]: in depth it goes with 1/w.
    pub relative: f64,
    /// The most that both take off the depth of anything visible and no nearer to the light than its near distance.
    pub most: f64,
    /// How far f32 may carry a place that `slope_scale` is enough for, in texels: [`Window::rounding`](crate::map::Window::rounding),
    /// or what [`ShadowMap::place_rounding`] is away from a lamp.
    pub places: f64,
}

/// The grid that corners of triangles are moved to, in texels.
pub(crate) const GRID: f64 = 1.0 / 256.0;

/// The least height of a triangle that the bias answers for, in texels.
pub(crate) const LEAST_HEIGHT: f64 = 1.0;

/// The largest part of their distance to the lamp that receivers may be off by.
const MOST_OF_DISTANCE: f64 = 1.0 / 8.0;

/// The largest part of the depth range that a receiver is moved by, of either kind: with more than all of it, everything is
/// lit already, and numbers beyond all measure would leave f32.
const MOST_OF_RANGE: f64 = 2.0;

/// Slopes are the next multiple of this, so that they stay the same while the rounding of f32 changes.
const SLOPE_STEP: f64 = 1.0 / 16.0;

/// A filter's reach, in texels, checked at the door.
pub(crate) fn checked_reach(reach: f64) -> Result<f64, InputError> {
    check::within("reach", reach, Expected::Within { least: 0.5, most: Settings::MAX_SIZE.into() })
}

/// What a rasteriser adds to depth away from the light, where the depth range is 1, a unit is so much, and depth changes so much
/// to the next texel.
pub(crate) fn away(bias: &DepthBias, unit: f64, slope: f64) -> f64 {
    f64::from(bias.constant.saturating_abs()) * unit + f64::from(bias.slope_scale.abs()) * slope
}

/// How far f32 carries places, in texels, in most maps: they have one slope for a format and a filter.
const USUAL_PLACES: f64 = 1.0 / 64.0;

/// How many times one slope is the next smaller one, where f32 carries places farther.
const NEXT_SLOPE: f32 = 1.25;

/// The first of `usual` and the slopes above it, each [`NEXT_SLOPE`] times the one before, that is no less than what is needed: each
/// is a pipeline in wgpu.
fn one_of_few(usual: f32, needed: f64) -> f32 {
    let mut slope = usual;
    while f64::from(slope) < needed {
        slope *= NEXT_SLOPE;
    }
    slope
}

/// What a slope is made of, see [`DepthBias`].
struct Slope {
    slope: f64,
    /// f.
    of_slope: f64,
    /// j: what an error of a corner's change can grow to on the way to the receiver.
    on_the_way: f64,
    /// 1 + k + 4 f/h₀.
    times: f64,
}

impl Slope {
    /// For a filter's reach, places that f32 carries by so many texels, and points by such a part of their distance to the light.
    fn new(reach: f64, places: f64, part: f64) -> Self {
        let reach = reach + places;
        let corner = GRID + places;
        let height = LEAST_HEIGHT.max(8.0 * corner);
        let on_the_way = 2.0 * core::f64::consts::SQRT_2 * reach;
        let spread = 1.0 + on_the_way / height;
        let of_slope = (spread * corner + on_the_way * part) / (1.0 - 2.0 * part - 4.0 * corner / height);
        Self {
            slope: 2.0 * (reach + of_slope),
            of_slope,
            on_the_way,
            times: 1.0 + spread + 4.0 * of_slope / height,
        }
    }
}

/// The next multiple of [`SLOPE_STEP`] above a slope.
pub(crate) fn stepped(slope: f64) -> f32 {
    (f64::from((slope / SLOPE_STEP) as u32 + 1) * SLOPE_STEP) as f32
}

impl DepthBias {
    /// The receiver's part, for [`ShadowMap::receiver_matrix_with`].
    #[must_use]
    pub fn offset(&self) -> ReceiverOffset {
        ReceiverOffset::of(self.relative, self.receiver)
    }

    /// The constant that does without the receiver's part, with the sign of the map's clip space; `None` in floating point, where
    /// none does.
    #[must_use]
    pub fn constant_alone(&self) -> Option<i32> {
        match self.format {
            DepthFormat::Unorm8 | DepthFormat::Unorm16 | DepthFormat::Unorm24 => {
                let units = self.most / self.format.bias_unit(1.0).start();
                let away = self.constant.saturating_abs().saturating_add(units as i32).saturating_add(1);
                Some(away.saturating_mul(self.constant.signum()))
            }
            DepthFormat::Float32 => None,
        }
    }
}

impl ShadowMap {
    /// The bias with which no plane shadows itself in this map.
    ///
    /// `reach` is how far from a point the middles of the texels lie that are compared for it, at most, across and down, in
    /// texels: 0.5 for the nearest texel, 1 for a comparison sampler's 2 × 2, n/2 for n × n. A filter of several samplers'
    /// reads reaches as far as its farthest read does and one texel more.
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`].
    pub fn bias(&self, format: DepthFormat, reach: f64) -> Result<DepthBias, InputError> {
        let reach = checked_reach(reach)?;
        let MapNoise { depth, place, least_w, away_w, to_light, change } = self.noise;
        let (over_w, constant) = depth.parts(least_w);
        // What is off by more than the map is anywhere.
        let places = place.at(away_w).min(Settings::MAX_SIZE.into());
        let part = if self.light.position().is_some() { (over_w / to_light).min(MOST_OF_DISTANCE) } else { 0.0 };
        let Slope { slope, of_slope, on_the_way, times } = Slope::new(reach, places, part);
        let usual = Slope::new(reach, USUAL_PLACES, 0.0);
        // A unit may be less than a step by a little. A half is in the range of depths with the largest steps below 1.
        let short = (format.step(0.5) - format.bias_unit(0.5).start()).max(0.0);
        let receiver = times * constant + (on_the_way + 2.0 * of_slope) * over_w * change + short;
        let (receiver, over_w) = (receiver.min(MOST_OF_RANGE), (times * over_w).min(MOST_OF_RANGE));
        // Where the matrix has lost what an offset towards the light takes off depth, what rounding has left of it and of w
        // must not grow instead.
        let left = |row: usize| self.rows[row].on(self.light.homogeneous()).abs();
        let to_light = to_light.max(left(2)).max(left(3));
        let away = if self.settings.clip().depth.is_reversed() { -1 } else { 1 };
        Ok(DepthBias {
            format,
            constant: away,
            slope_scale: one_of_few(stepped(usual.slope), slope) * away as f32,
            receiver,
            relative: over_w / to_light,
            most: receiver + over_w / least_w,
            places,
        })
    }

    /// How far behind a caster a receiver may be and still be lit, in world units along the ray through a point on the
    /// caster: what the bias costs, and what lifts shadows off the feet of things ("peter-panning").
    ///
    /// It is the most that a driver may make of the bias, on a plane across `normal` (of any length), where the ray goes
    /// through the middle of a texel; elsewhere in the texel it is more or less by the plane's own slope. Infinite outside
    /// of the map, where the light sees the plane from its edge, and where no depth is so much larger.
    #[must_use]
    pub fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64 {
        let Some(slopes) = self.depth_slopes(point, normal) else {
            return f64::INFINITY;
        };
        let unit = bias.format.bias_unit(1.0);
        // The constant, the slope as the length of the gradient, and the rounding of what is stored.
        let added = away(bias, *unit.end(), slopes.length()) + bias.format.step(0.5);
        let [_, _, depth, w] = &self.rows;
        let tested = bias.offset().depth_row(*depth, *w, self.light.homogeneous(), &self.along);
        let ray = -self.light.direction_from(point);
        let at = w.at(point);
        // The δ with tested(X + δ ray) = depth(X) + added: all rows are linear in it.
        let stored = depth.at(point) / at + added;
        let change = (tested.normal - w.normal * stored).dot(ray);
        if change > 0.0 { (stored * at - tested.at(point)) / change } else { f64::INFINITY }
    }
}
