//! An axis: where a value lies along it, and its ticks.

/// What is greater counts as infinite, and what is less than its inverse as nothing.
const HUGE: f64 = 1e300;
/// What is left free at both ends, for markers and words, as a part of what is between them.
const MARGIN: f64 = 0.05;
/// At most how many steps there are from tick to tick, without those for values that have no place.
const STEPS: f64 = 10.0;

/// An axis with a coordinate for every value: logarithms on a logarithmic axis, multiples of a power of ten on a linear
/// one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    logarithmic: bool,
    /// The base of the logarithms, or what values are multiples of.
    unit: f64,
    /// The coordinates of its ends.
    pub(super) ends: [f64; 2],
    /// From tick to tick.
    pub(super) step: f64,
    /// The coordinates for values that have no place, less than all others and greater, where there are such.
    edges: [Option<f64>; 2],
    /// Whether some of the lesser are negative.
    has_negative: bool,
}

/// The least and the greatest value that have a place on an axis.
fn limits(logarithmic: bool) -> [f64; 2] {
    [if logarithmic { 1.0 / HUGE } else { -HUGE }, HUGE]
}

impl Scale {
    /// The axis on which these values are shown. A linear one shows zero.
    pub(super) fn new(logarithmic: bool, values: &[f64]) -> Self {
        let [least, most] = limits(logarithmic);
        let inside = values.iter().copied().filter(|value| (least..=most).contains(value));
        let inside = inside.chain((!logarithmic).then_some(0.0));
        // Of no values the least is greater than the greatest.
        let [low, high] = inside.fold([most, least], |[low, high], value| [low.min(value), high.max(value)]);
        let [low, high] = if low <= high { [low, high] } else { [1.0, 1.0] };
        let unit = match f64::max(-low, high) {
            // Few octaves have ticks at powers of two, more of them at powers of ten.
            _ if logarithmic && high / low <= STEPS.exp2() => 2.0,
            _ if logarithmic => 10.0,
            0.0 => 1.0,
            largest => 10_f64.powf(largest.max(1.0 / HUGE).log10().floor()),
        };
        let has_negative = values.iter().any(|&value| value < 0.0);
        let mut scale = Self { logarithmic, unit, ends: [0.0; 2], step: 1.0, edges: [None; 2], has_negative };

        let [low, high] = [low, high].map(|value| scale.coordinate(value));
        let step = round_step((high - low) / STEPS);
        scale.step = if logarithmic { step.max(1.0) } else { step };
        let [low, high] = [(low / scale.step).floor(), (high / scale.step).ceil()];
        let high = high.max(low + 1.0);
        let edge = |is_needed: bool, steps: f64| is_needed.then_some(steps * scale.step);
        scale.edges = [
            edge(values.iter().any(|&value| value < least), low - 1.0),
            edge(values.iter().any(|&value| value > most), high + 1.0),
        ];
        let [low, high] = [scale.edges[0].unwrap_or(low * scale.step), scale.edges[1].unwrap_or(high * scale.step)];
        let margin = MARGIN * (high - low);
        scale.ends = [low - margin, high + margin];
        scale
    }

    /// The coordinate of a value, and whether it is an edge because the value has no place; nothing where it is no number.
    pub(super) fn at(&self, value: f64) -> Option<(f64, bool)> {
        let [least, most] = limits(self.logarithmic);
        match value {
            _ if value.is_nan() => None,
            _ if value < least => self.edges[0].map(|edge| (edge, true)),
            _ if value > most => self.edges[1].map(|edge| (edge, true)),
            _ => Some((self.coordinate(value), false)),
        }
    }

    /// What is written at a tick.
    pub(super) fn text(&self, coordinate: f64) -> String {
        let is_at = |side: usize| self.edges[side].is_some_and(|edge| (coordinate - edge).abs() < 0.5 * self.step);
        if is_at(1) {
            return "∞".to_owned();
        }
        if is_at(0) {
            let below = match (self.logarithmic, self.has_negative) {
                (false, _) => "−∞",
                (true, true) => "≤ 0",
                (true, false) => "0",
            };
            return below.to_owned();
        }
        let value = if self.logarithmic { self.unit.powf(coordinate) } else { self.unit * coordinate };
        // So few digits that what was rounded in the arithmetic is not seen.
        let digits = if value.abs() < 1.0 { 2 } else { 5 };
        let value = format!("{value:.digits$e}").parse().unwrap_or(value);
        if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
            value.to_string()
        } else {
            format!("{value:.1e}").replace(".0e", "e")
        }
    }

    fn coordinate(&self, value: f64) -> f64 {
        if self.logarithmic { value.log10() / self.unit.log10() } else { value / self.unit }
    }
}

/// The least of 1, 2 and 5 times a power of ten that is not less; 1 for nothing.
fn round_step(least: f64) -> f64 {
    if least <= 0.0 {
        return 1.0;
    }
    let power = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].map(|part| part * power).into_iter().find(|&step| step >= least).unwrap_or(10.0 * power)
}
