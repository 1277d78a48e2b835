//! The bias that a fitted map needs against shadow acne: enough for every plane, and no more than that takes.

use crate::error::{Expected, InputError, check};
use crate::map::quality::DepthFormat;
use crate::map::receiver_offset::ReceiverOffset;
use crate::map::shadow_map::ShadowMap;
use crate::settings::Settings;
use crate::warp::rounding::MapNoise;
use glam::DVec3;

/// The depth bias of a map, with which no plane has shadow acne ([`ShadowMap::bias`]): a part for the rasteriser that draws
/// casters and a part for the matrix that receivers are tested with.
///
/// `constant` and `slope_scale` go to the rasteriser as they are: they have the sign of the map's clip space, which is away
/// from the light, and negative where depth is reversed. [`Self::offset`] goes to the shadow test, through
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
/// `constant` and, in most maps, `slope_scale` depend on the format and the filter alone, so that they can be compiled
/// into a pipeline; where f32 moves places by more than a 64th of a texel, the slope is one of the few that are 1.25,
/// 1.5625, … times that. The receiver's part changes from fit to fit and is in a matrix that is uploaded anyway. To test
/// with [`ShadowMap::receiver_matrix`] as it is, take [`Self::constant_alone`].
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// let bias = map.bias(DepthFormat::Float32, Filter::Hardware2x2.reach())?;
/// assert!(bias.constant == 1 && bias.slope_scale > 2.0); // for the pipeline that draws casters
/// let receivers = map.receiver_matrix_with(&bias.offset()); // for the shader that lights receivers
/// assert_ne!(receivers, map.receiver_matrix());
/// # Ok::<(), shadowfit::InputError>(())
/// ```
///
/// The bias is derived for planes, whatever the warp: see `docs/depth.md` for the derivation and its assumptions. At
/// creases and on curved surfaces made of facets some acne may remain.
#[doc(alias = "acne")]
#[doc(alias = "shadow acne")]
#[doc(alias = "peter-panning")]
#[doc(alias = "slope-scaled bias")]
#[doc(alias = "polygon offset")]
#[doc(alias = "DepthBiasState")]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DepthBias {
    /// The format that it is for.
    pub format: DepthFormat,
    /// Units of constant bias for the rasteriser, see [`DepthFormat::bias_unit`]: negative where depth is reversed.
    pub constant: i32,
    /// The factor of the slope, the larger of depth's changes to the next texel across and down: negative where depth is
    /// reversed.
    pub slope_scale: f32,
    /// How much nearer to the light receivers are tested all over the map, where the depth range is 1.
    pub receiver: f64,
    /// How much nearer they are tested besides, as a part for [`ReceiverOffset::relative`]: in depth it goes with 1/w.
    pub relative: f64,
    /// The most that both take off the depth of any receiver no nearer to the light than its near distance.
    pub most: f64,
    /// How far f32 may move a place for `slope_scale` to suffice, in texels:
    /// [`Window::rounding`](crate::map::Window::rounding), or under a local light [`ShadowMap::place_rounding`] beyond
    /// 1/16 of the farthest receiver's axial distance.
    pub places: f64,
}

/// The grid that corners of triangles are moved to, in texels.
pub(crate) const GRID: f64 = 1.0 / 256.0;

/// The least height of a triangle that the bias answers for, in texels.
pub(crate) const LEAST_HEIGHT: f64 = 1.0;

/// The largest part of their distance to a local light that receivers may be off by.
const MOST_OF_DISTANCE: f64 = 1.0 / 8.0;

/// The largest part of the depth range that a receiver is moved by, of either kind: beyond the whole range everything is lit
/// already, and unbounded numbers would leave f32.
const MOST_OF_RANGE: f64 = 2.0;

/// Slopes are the next multiple of this, so that they stay the same while the rounding of f32 changes.
const SLOPE_STEP: f64 = 1.0 / 16.0;

/// A filter's reach, in texels, checked at the door.
pub(crate) fn checked_reach(reach: f64) -> Result<f64, InputError> {
    check::within("reach", reach, Expected::Within { least: 0.5, most: Settings::MAX_SIZE.into() })
}

/// The depth that a rasteriser adds away from the light, for a unit and a slope (the change of depth to the next texel),
/// where the depth range is 1.
pub(crate) fn away(bias: &DepthBias, unit: f64, slope: f64) -> f64 {
    f64::from(bias.constant.saturating_abs()) * unit + f64::from(bias.slope_scale.abs()) * slope
}

/// How far f32 moves places in most maps, in texels: those maps share one slope for a format and a filter.
const USUAL_PLACES: f64 = 1.0 / 64.0;

/// The ratio of neighbouring slopes, for maps in which f32 moves places farther.
const NEXT_SLOPE: f32 = 1.25;

/// The first of `usual` and the slopes above it, each [`NEXT_SLOPE`] times the one before, that is no less than needed: each
/// is a pipeline in wgpu.
fn one_of_few(usual: f32, needed: f64) -> f32 {
    let mut slope = usual;
    while f64::from(slope) < needed {
        slope *= NEXT_SLOPE;
    }
    slope
}

/// The terms of a slope, as `docs/depth.md` derives them.
struct Slope {
    slope: f64,
    /// f.
    of_slope: f64,
    /// j: how far an error of a corner's slope can grow on the way to the receiver.
    on_the_way: f64,
    /// 1 + k + 4 f/h₀: what multiplies ε in the receiver's part.
    times: f64,
}

impl Slope {
    /// For a filter's reach, places that f32 moves by so many texels, and points by such a part of their distance to the
    /// light.
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
    /// The receiver's part of the bias, for [`ShadowMap::receiver_matrix_with`].
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// let bias = map.bias(DepthFormat::Float32, 1.0)?;
    /// let biased = map.texture_from_world_with(&bias.offset()).project_point3(floor).z;
    /// let off = map.texture_from_world().project_point3(floor).z - biased;
    /// assert!(off > 0.0 && off <= bias.most);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn offset(&self) -> ReceiverOffset {
        ReceiverOffset::of(self.relative, self.receiver)
    }

    /// The constant that does without the receiver's part, with the sign of the map's clip space; `None` in floating
    /// point, whose units vanish towards depth 0, so that none does.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let fixed = map.bias(DepthFormat::Unorm24, 1.0)?;
    /// assert!(fixed.constant_alone().is_some_and(|units| units > fixed.constant));
    /// assert_eq!(map.bias(DepthFormat::Float32, 1.0)?.constant_alone(), None);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
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
    /// The depth bias with which no plane has shadow acne in this map: the least that suffices for planes.
    ///
    /// `reach` is how far from a point the middles of the texels lie that are compared for it, at most, across and down,
    /// in texels: 0.5 for the nearest texel, 1 for a comparison sampler's 2 × 2, n/2 for n × n
    /// ([`Filter::reach`](crate::Filter::reach)). A filter of several samplers' reads reaches as far as its farthest read
    /// does and one texel more. `docs/depth.md` has the derivation.
    ///
    /// # Errors
    ///
    /// Names `"reach"` when it is not finite, below 0.5 or above [`Settings::MAX_SIZE`].
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let two = map.bias(DepthFormat::Unorm24, Filter::Hardware2x2.reach())?;
    /// let five = map.bias(DepthFormat::Unorm24, Filter::Pcf(5).reach())?;
    /// assert!(two.slope_scale < five.slope_scale); // a wider filter needs more
    /// assert!(map.bias(DepthFormat::Unorm24, 0.0).is_err());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "shadow acne")]
    #[doc(alias = "acne")]
    pub fn bias(&self, format: DepthFormat, reach: f64) -> Result<DepthBias, InputError> {
        let reach = checked_reach(reach)?;
        let MapNoise { depth, place, least_w, away_w, to_light, change } = self.noise;
        let (over_w, constant) = depth.parts(least_w);
        // No more than the whole map.
        let places = place.at(away_w).min(Settings::MAX_SIZE.into());
        let part = if self.light.position().is_some() { (over_w / to_light).min(MOST_OF_DISTANCE) } else { 0.0 };
        let Slope { slope, of_slope, on_the_way, times } = Slope::new(reach, places, part);
        let usual = Slope::new(reach, USUAL_PLACES, 0.0);
        // A unit may be less than a step by a little. A half is in the range of depths with the largest steps below 1.
        let short = (format.step(0.5) - format.bias_unit(0.5).start()).max(0.0);
        let receiver = times * constant + (on_the_way + 2.0 * of_slope) * over_w * change + short;
        let (receiver, over_w) = (receiver.min(MOST_OF_RANGE), (times * over_w).min(MOST_OF_RANGE));
        // Where rounding has lost e·l, on which an offset towards the light works, its remainders in the rows of depth and
        // of w must not grow instead.
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

    /// Peter-panning: how far behind a caster a receiver may be and still be lit, in world units along the light's ray
    /// through a point on the caster.
    ///
    /// It is the most that a driver may make of the bias, on a plane across `normal` (of any length), where the ray goes
    /// through the middle of a texel; elsewhere in the texel it is more or less by the plane's own slope. Infinite
    /// outside of the map, where the light sees the plane from its edge, and where no depth is so much larger.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let bias = map.bias(DepthFormat::Unorm24, 1.0)?;
    /// let gap = map.bias_distance(ground, up, &bias);
    /// assert!(0.0 < gap && gap < 0.5); // shadows begin within half a metre of the feet of things
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "peter-panning")]
    #[doc(alias = "detached shadow")]
    #[must_use]
    pub fn bias_distance(&self, point: DVec3, normal: DVec3, bias: &DepthBias) -> f64 {
        let Some(slopes) = self.depth_slopes(point, normal) else {
            return f64::INFINITY;
        };
        let unit = bias.format.bias_unit(1.0);
        // The constant, the slope as the length of the gradient, and the rounding of the stored depth.
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
