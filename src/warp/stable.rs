//! Stable maps: uniform ones whose texels stay where they are in the world while the camera moves and turns.
//!
//! Three things move the texels of a map that is fitted to what is visible, and none of them is left:
//!
//! - its axes turn with the view. Here they are the light's own;
//! - its window grows and shrinks with what is visible. Here it has room for the view in every position, or for all of the
//!   scene, or for all that the light reaches;
//! - its middle moves by parts of texels. Here it moves by whole ones, on a grid through the world's origin: the middle is a
//!   whole number of texels there, and a texel a number of so few bits that the product of the two is exact in f64.
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

/// What a stable map has for its window: nothing here changes as the camera moves and turns, but for whole texels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stable {
    /// Axes across and along the light: u, v, and away from the light.
    axes: [DVec3; 3],
    /// The least cosine between the axis and a ray to anything visible.
    margin: f64,
    /// The middle of what the window has room for, on the chart.
    centre: DVec2,
    /// The sides of a texel there.
    texel: DVec2,
    /// Half of the map's texels, across and down.
    half_sides: DVec2,
    /// What the ends of the depth range of a directional light are whole multiples of; none for any other.
    step: Option<f64>,
}

/// The part of what a window is for that it is wider by, for what f32 loses at its sides: a thousandth in most maps, and a few
/// next to a lamp.
const ROOM: f64 = 1.0 / 128.0;

/// What has no extent of its own has some texels all the same, far smaller than any others; they grow to what f32 can tell
/// apart.
const LEAST_TEXEL: f64 = MIN_DISTANCE * MIN_DISTANCE * (MIN_DISTANCE * MIN_DISTANCE);

/// Bits of a texel's sides after the first one. Projection matrices that are taken apart with other roundings in every frame
/// make the same texel then, and a grid is exact as far out as [`FARTHEST`].
const TEXEL_BITS: u32 = 12;

/// The most steps from the origin at which their number times a step of 13 bits is exact.
const FARTHEST: f64 = (1_u64 << 40) as f64;

/// Bits of a distance that a depth range ends at, from a light at a position, after the first one: eight steps from a power of
/// two to the next.
const DISTANCE_BITS: u32 = 3;

impl Stable {
    /// The window for a view, a light and a scene; `visible` are the vertices of R.
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
            // What is visible is in both.
            (Some(view), Some(scene)) => {
                let is_narrower = scene.half.cmplt(view.half);
                Rectangle {
                    centre: DVec2::select(is_narrower, scene.centre, view.centre),
                    half: DVec2::select(is_narrower, scene.half, view.half),
                }
            }
        };
        // The nearest whole texel is up to half a texel to either side.
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
        // The cosine at the edges of the pyramid, where it is least.
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

    /// A window around zero with room for `half` to each side, for its border, and for `moves` texels altogether.
    fn with_room(axes: [DVec3; 3], half: DVec2, moves: f64, settings: &Settings) -> Self {
        let sides = settings.sides();
        // No less than one: of 4 texels or more, at least half are no border.
        let inner = sides - 2.0 * f64::from(settings.border()) - moves;
        let texel = (half * (2.0 * (1.0 + ROOM) / inner)).max(DVec2::splat(LEAST_TEXEL));
        let texel = texel.map(|side| rounded_up(side, TEXEL_BITS));
        Self { axes, margin: 1.0, centre: DVec2::ZERO, texel, half_sides: 0.5 * sides, step: None }
    }

    /// The chart of the light's rays, zero at the world's origin for a directional light.
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

    /// The window, about its middle, unless rounding needs a larger one.
    pub(crate) fn least_window(&self) -> Rectangle {
        Rectangle { centre: DVec2::ZERO, half: self.texel * self.half_sides }
    }

    /// The window, about the middle of the least one, for what is visible in `visible`, where a window around a
    /// rectangle has to have half extents of `needed`.
    ///
    /// Where that is more than there is room for, texels double until there is: half of the lines between texels stay where
    /// they are. Each time around, what is needed grows by half a texel at most and the window by half of the map's.
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

    /// A distance next to another one, where depth is zero.
    pub(crate) fn zero(&self, along: f64) -> f64 {
        match self.step {
            Some(step) => whole_steps(DVec2::splat(along), DVec2::splat(step), DVec2::round).x,
            None => rounded_down(along, DISTANCE_BITS),
        }
    }

    /// A range of distances along the axis, with both ends moved outwards to the next step, so that they change rarely:
    /// under a directional light to a sixteenth of the window from the world's origin, from any other to an eighth of a power
    /// of two.
    ///
    /// Depth moves no texel, but the same depth is the same number only while its range is.
    pub(crate) fn in_steps(&self, range: &Interval) -> Interval {
        match self.step {
            Some(step) => {
                let ends = whole_steps(DVec2::new(range.min, -range.max), DVec2::splat(step), DVec2::floor);
                Interval { min: ends.x, max: -ends.y }
            }
            // Linear depth may begin behind a lamp that is next to what it lights.
            None if range.min <= 0.0 => *range,
            None => {
                Interval { min: rounded_down(range.min, DISTANCE_BITS), max: rounded_up(range.max, DISTANCE_BITS) }
            }
        }
    }

    /// The same for depths of the homography, which are zero at distance `zero`.
    pub(crate) fn in_depth_steps(&self, zero: f64, depth: &Interval) -> Interval {
        if self.step.is_some() {
            let Interval { min, max } = self.in_steps(&Interval { min: zero + depth.min, max: zero + depth.max });
            return Interval { min: min - zero, max: max - zero };
        }
        // The depth 1 − zero/distance is 1 at infinity, and padding may have moved the far end beyond.
        let far = if depth.max < 1.0 { zero / (1.0 - depth.max) } else { f64::INFINITY };
        let Interval { min, max } = self.in_steps(&Interval { min: zero / (1.0 - depth.min), max: far });
        Interval { min: 1.0 - zero / min, max: if far.is_finite() { 1.0 - zero / max } else { depth.max } }
    }

    /// What w is 1 at in the map, where it is no more than `visible` on what is visible: where the light's range ends, or at a
    /// power of two.
    pub(crate) fn largest_w(&self, light: &Light, visible: f64) -> f64 {
        let range = light.range();
        if self.step.is_some() {
            1.0
        } else if range.is_finite() {
            // Rounding may put what is visible beyond the range.
            most(range * (1.0 + ROOM), visible)
        } else {
            rounded_up(visible, 0)
        }
    }
}

/// Numbers to whole multiples of steps, unless those are so small that there is nothing to be had from them.
fn whole_steps(numbers: DVec2, steps: DVec2, rounded: fn(DVec2) -> DVec2) -> DVec2 {
    let counts = numbers / steps;
    DVec2::select(counts.abs().cmplt(DVec2::splat(FARTHEST)), rounded(counts) * steps, numbers)
}

/// The least number of so few bits after the first that is no less than a positive one.
fn rounded_up(number: f64, bits: u32) -> f64 {
    let rest = rest_below(bits);
    f64::from_bits((number.to_bits() + rest) & !rest)
}

/// The largest number of so few bits after the first that is no more than a positive one.
fn rounded_down(number: f64, bits: u32) -> f64 {
    f64::from_bits(number.to_bits() & !rest_below(bits))
}

const fn rest_below(bits: u32) -> u64 {
    (1 << (f64::MANTISSA_DIGITS - 1 - bits)) - 1
}
