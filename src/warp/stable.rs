//! Stabilised maps: uniform maps with texels snapped to the world, while the camera moves and turns.
//!
//! Three causes of shimmering are removed from a map fitted to R:
//!
//! - axes that turn with the view: here they are the light's own;
//! - a window that grows and shrinks with R: here it has room for the view in every position, for all of S, or for all of L;
//! - a middle that moves by fractions of a texel: here it moves by whole texels, on a grid through the world's origin. The texel has
//!   so few bits that its product with a whole number is exact in f64.
//!
//! (Valient, *Stable Rendering of Cascaded Shadow Maps*, ShaderX6, 2008.)

use crate::convex::Polyhedron;
use crate::error::MIN_DISTANCE;
use crate::focus::Focus;
use crate::focus::cone::{MIN_MARGIN, direction_between};
use crate::input::light::Light;
use crate::math::bounds::{Interval, Rectangle, most};
use crate::math::frame;
use crate::settings::Settings;
use crate::settings::fallback::WarpFallback;
use crate::warp::rays::Rays;
use glam::{DVec2, DVec3};

/// The window of a stabilised map: as the camera moves and turns, it changes by whole texels only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stable {
    /// The axes u and v across the light, and the axis away from it.
    axes: [DVec3; 3],
    /// The least cosine between the axis and a ray to R.
    margin: f64,
    /// The middle of the region that the window has room for, on the chart.
    centre: DVec2,
    /// The sides of a texel on the chart.
    texel: DVec2,
    /// Half of the map's texels, across and down.
    half_sides: DVec2,
    /// The step of the ends of the depth range under a directional light; `None` for a local light.
    step: Option<f64>,
}

/// The relative room of a window for f32 rounding at its sides, which takes a thousandth in most maps, and a few next to a local
/// light.
const ROOM: f64 = 1.0 / 128.0;

/// The least side of a texel, for regions without extent; it grows to the f32 resolution.
const LEAST_TEXEL: f64 = MIN_DISTANCE * MIN_DISTANCE * (MIN_DISTANCE * MIN_DISTANCE);

/// Bits of a texel's sides after the leading one: few, so that matrices decoded with other roundings in every frame give the same
/// texel, and the grid is exact out to [`FARTHEST`].
const TEXEL_BITS: u32 = 12;

/// The largest number of steps whose product with a step of 13 bits is exact.
const FARTHEST: f64 = (1_u64 << 40) as f64;

/// Bits after the leading one of the distances from a local light at which depth ranges end: eight steps per power of two.
const DISTANCE_BITS: u32 = 3;

impl Stable {
    /// The window for a focus; `visible` are the vertices of R.
    pub(crate) fn new(
        focus: &Focus<'_>,
        visible: impl Iterator<Item = DVec3>,
        settings: &Settings,
    ) -> Result<Self, WarpFallback> {
        match focus.light().position() {
            None => Self::of_direction(focus, settings),
            Some(position) => Self::of_region(focus.light(), position, visible, settings),
        }
    }

    fn of_direction(focus: &Focus<'_>, settings: &Settings) -> Result<Self, WarpFallback> {
        let axis = -focus.light().homogeneous().truncate();
        let (u_axis, v_axis) = frame::of_light(axis);
        let across = |point: DVec3| DVec2::new(u_axis.dot(point), v_axis.dot(point));
        let of_view = focus
            .ball(settings.image_height())
            .map(|(centre, radius)| Rectangle { centre: across(centre), half: DVec2::splat(radius) });
        let of_scene = focus.scene().map(|scene| {
            let (mut body, mut u, mut v) = (Polyhedron::EMPTY, Interval::EMPTY, Interval::EMPTY);
            scene.fill(&mut body);
            for point in body.positions().map(across) {
                u.include(point.x);
                v.include(point.y);
            }
            Rectangle::over(&u, &v)
        });
        let Rectangle { centre, half } = match (of_view, of_scene) {
            (None, None) => return Err(WarpFallback::Endless),
            (Some(one), None) | (None, Some(one)) => one,
            // R lies in both: take the narrower on each axis.
            (Some(view), Some(scene)) => {
                let is_narrower = scene.half.cmplt(view.half);
                Rectangle {
                    centre: DVec2::select(is_narrower, scene.centre, view.centre),
                    half: DVec2::select(is_narrower, scene.half, view.half),
                }
            }
        };
        // Snapping moves the middle by up to half a texel to either side.
        let stable = Self::with_room([u_axis, v_axis, axis], half, 1.0, settings);
        let step = rounded_up((stable.texel * stable.half_sides).max_element() / 8.0, TEXEL_BITS);
        Ok(Self { centre, step: Some(step), ..stable })
    }

    fn of_region(
        light: &Light,
        position: DVec3,
        mut visible: impl Iterator<Item = DVec3>,
        settings: &Settings,
    ) -> Result<Self, WarpFallback> {
        let (axes, tangents) = light.frustum().ok_or(WarpFallback::NoRegion)?;
        // The cosine is least at the edges of the pyramid.
        let margin = tangents.extend(1.0).length().recip();
        let [.., axis] = axes;
        let is_in_front = |point: DVec3| {
            direction_between(position, point).is_some_and(|direction| axis.dot(direction) >= MIN_MARGIN)
        };
        if margin < MIN_MARGIN || !visible.all(is_in_front) {
            return Err(WarpFallback::NoRegion);
        }
        Ok(Self { margin, ..Self::with_room(axes, tangents, 0.0, settings) })
    }

    /// A window around zero with room for `half` to each side, for the border, and for `moves` texels.
    fn with_room(axes: [DVec3; 3], half: DVec2, moves: f64, settings: &Settings) -> Self {
        let sides = settings.sides();
        // At least one: a map has 4 texels or more, at most half of them border.
        let inner = sides - 2.0 * f64::from(settings.border()) - moves;
        let texel = (half * (2.0 * (1.0 + ROOM) / inner)).max(DVec2::splat(LEAST_TEXEL));
        let texel = texel.map(|side| rounded_up(side, TEXEL_BITS));
        Self { axes, margin: 1.0, centre: DVec2::ZERO, texel, half_sides: 0.5 * sides, step: None }
    }

    /// The chart of the light's rays, with its origin at the world's under a directional light.
    pub(crate) fn rays(&self, light: &Light) -> Rays {
        Rays::about(self.axes, DVec3::ZERO, light, self.margin)
    }

    /// The middle of the window on the chart.
    pub(crate) fn middle(&self) -> DVec2 {
        self.middle_of(self.texel)
    }

    fn middle_of(&self, texel: DVec2) -> DVec2 {
        whole_steps(self.centre, texel, DVec2::round)
    }

    /// The window relative to its middle, unless rounding needs a larger one.
    pub(crate) fn least_window(&self) -> Rectangle {
        Rectangle { centre: DVec2::ZERO, half: self.texel * self.half_sides }
    }

    /// The window, relative to the middle of the least one, for R in the rectangle `visible`; a window around a rectangle needs the half
    /// extents `needed`.
    ///
    /// Where there is too little room, texels double until it suffices, which keeps every other grid line. In each round the need
    /// grows by at most half a texel, and the window by half of the map's texels.
    pub(crate) fn window(&self, visible: &Rectangle, needed: impl Fn(&Rectangle) -> DVec2) -> Rectangle {
        let (mut texel, least) = (self.texel, self.middle());
        loop {
            let centre = self.middle_of(texel) - least;
            let around = Rectangle { centre, half: (visible.centre - centre).abs() + visible.half };
            let half = texel * self.half_sides;
            let short = needed(&around) / half;
            if short.max_element() <= 1.0 {
                return Rectangle { centre, half };
            }
            texel *= short.map(|times| rounded_up(most(times, 1.0), 0));
        }
    }

    /// The distance of zero depth: the step nearest to `along`.
    pub(crate) fn zero(&self, along: f64) -> f64 {
        match self.step {
            Some(step) => whole_steps(DVec2::splat(along), DVec2::splat(step), DVec2::round).x,
            None => rounded_down(along, DISTANCE_BITS),
        }
    }

    /// A range of distances along the axis with both ends moved outwards to the next step, so that they change rarely: multiples of a
    /// sixteenth of the window under a directional light, eighths of a power of two for a local one.
    ///
    /// Depth moves no texel, but equal depths have equal values only while the range is the same.
    pub(crate) fn in_steps(&self, range: &Interval) -> Interval {
        match self.step {
            Some(step) => {
                let ends = whole_steps(DVec2::new(range.min, -range.max), DVec2::splat(step), DVec2::floor);
                Interval { min: ends.x, max: -ends.y }
            }
            // Linear depth may begin behind a local light next to its receivers.
            None if range.min <= 0.0 => *range,
            None => {
                Interval { min: rounded_down(range.min, DISTANCE_BITS), max: rounded_up(range.max, DISTANCE_BITS) }
            }
        }
    }

    /// As [`Self::in_steps`], for depths of the homography, zero at the distance `zero`.
    pub(crate) fn in_depth_steps(&self, zero: f64, depth: &Interval) -> Interval {
        if self.step.is_some() {
            let Interval { min, max } = self.in_steps(&Interval { min: zero + depth.min, max: zero + depth.max });
            return Interval { min: min - zero, max: max - zero };
        }
        // The depth 1 − zero/distance is 1 at infinity; padding may have moved the far end beyond.
        let far = if depth.max < 1.0 { zero / (1.0 - depth.max) } else { f64::INFINITY };
        let Interval { min, max } = self.in_steps(&Interval { min: zero / (1.0 - depth.min), max: far });
        Interval { min: 1.0 - zero / min, max: if far.is_finite() { 1.0 - zero / max } else { depth.max } }
    }

    /// The w that the map scales to 1, with at most `visible` on R: that at the light's range, or a power of two.
    pub(crate) fn largest_w(&self, light: &Light, visible: f64) -> f64 {
        let range = light.range();
        if self.step.is_some() {
            1.0
        } else if range.is_finite() {
            // Rounding may put receivers beyond the range.
            most(range * (1.0 + ROOM), visible)
        } else {
            rounded_up(visible, 0)
        }
    }
}

/// Numbers rounded to whole multiples of steps, unless the steps are too small for exact multiples.
fn whole_steps(numbers: DVec2, steps: DVec2, rounded: fn(DVec2) -> DVec2) -> DVec2 {
    let counts = numbers / steps;
    DVec2::select(counts.abs().cmplt(DVec2::splat(FARTHEST)), rounded(counts) * steps, numbers)
}

/// A positive number rounded up to `bits` bits after the leading one.
fn rounded_up(number: f64, bits: u32) -> f64 {
    let rest = rest_below(bits);
    f64::from_bits((number.to_bits() + rest) & !rest)
}

/// A positive number rounded down to `bits` bits after the leading one.
fn rounded_down(number: f64, bits: u32) -> f64 {
    f64::from_bits(number.to_bits() & !rest_below(bits))
}

const fn rest_below(bits: u32) -> u64 {
    (1 << (f64::MANTISSA_DIGITS - 1 - bits)) - 1
}
