//! The costs of one work as a curve over the number of things, and its exponents.

use super::cost::{Cost, Counted, Work};
use crate::statistics::exponent;

/// Over a range at least so wide, what a work costs with no things at all hides how it grows at first, and the upper half tells.
const WIDE: f64 = 100.0;

/// The costs of one work, from the fewest things to the most.
#[derive(Clone, Debug)]
pub struct Curve<'a> {
    /// The costs; two at least.
    costs: Vec<&'a Cost>,
}

impl<'a> Curve<'a> {
    /// Every curve that some costs make, in the order in which they were measured.
    #[must_use]
    pub fn all(costs: &'a [Cost]) -> Vec<Self> {
        let mut kinds: Vec<(Counted, Work)> = Vec::new();
        for cost in costs {
            if !kinds.contains(&(cost.counted, cost.work)) {
                kinds.push((cost.counted, cost.work));
            }
        }
        kinds.into_iter().filter_map(|(counted, work)| Self::new(costs, counted, work)).collect()
    }

    /// That of some work; nothing where there is none.
    #[must_use]
    pub fn new(costs: &'a [Cost], counted: Counted, work: Work) -> Option<Self> {
        let mut costs: Vec<_> = costs.iter().filter(|cost| cost.counted == counted && cost.work == work).collect();
        costs.sort_by_key(|cost| cost.count);
        (costs.len() > 1).then_some(Self { costs })
    }

    /// The costs.
    #[must_use]
    pub fn costs(&self) -> &[&'a Cost] {
        &self.costs
    }

    /// With the fewest things.
    #[must_use]
    pub fn first(&self) -> &'a Cost {
        self.costs[0]
    }

    /// With the most.
    #[must_use]
    pub fn last(&self) -> &'a Cost {
        self.costs[self.costs.len() - 1]
    }

    /// How many times as many things it ends with as it begins with.
    #[must_use]
    pub fn range(&self) -> f64 {
        self.last().count as f64 / self.first().count as f64
    }

    /// The exponent over all of it.
    #[must_use]
    pub fn whole(&self) -> f64 {
        Self::exponent(&self.costs)
    }

    /// The exponent over the upper half of it, by points; the one in the middle counts.
    #[must_use]
    pub fn upper(&self) -> f64 {
        Self::exponent(&self.costs[(self.costs.len() - 1) / 2..])
    }

    fn exponent(costs: &[&Cost]) -> f64 {
        exponent(&costs.iter().map(|cost| (cost.count as f64, cost.times)).collect::<Vec<_>>())
    }

    /// Whether its upper half tells how it grows with many things, and not all of it.
    #[must_use]
    pub fn is_wide(&self) -> bool {
        self.range() >= WIDE
    }

    /// The exponent that tells how it grows with many things.
    #[must_use]
    pub fn telling(&self) -> f64 {
        if self.is_wide() { self.upper() } else { self.whole() }
    }

    /// What one more thing costs among the most, in seconds: the slope between the last two points.
    #[must_use]
    pub fn each(&self) -> f64 {
        let [.., before, last] = &self.costs[..] else { return f64::NAN };
        (last.seconds - before.seconds) / (last.count - before.count) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fixed cost of a thousand seconds and one for each thing.
    fn costs(counts: &[u64]) -> Vec<Cost> {
        let seconds = |count: u64| 1000.0 + count as f64;
        let cost = |&count: &u64| {
            let times = seconds(count) / seconds(counts[0]);
            let (work, counted, seconds) = (Work::Plan, Counted::Lights, seconds(count));
            Cost { work, counted, count, seconds, times, times_low: times, times_high: times }
        };
        counts.iter().map(cost).collect()
    }

    #[test]
    fn the_upper_half_tells_where_a_fixed_cost_hides_the_lower_one() {
        let costs = costs(&[1, 10, 100, 1_000_000, 10_000_000]);
        let curve = &Curve::all(&costs)[0];
        assert_eq!(curve.costs().len(), 5);
        assert!(curve.whole() < 0.7 && (curve.upper() - 0.8).abs() < 0.05, "{} {}", curve.whole(), curve.upper());
        assert_eq!((curve.telling(), curve.range()), (curve.upper(), 1e7));
        assert!((curve.each() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn over_a_narrow_range_all_of_it_tells() {
        let costs = costs(&[1, 2, 4, 8]);
        let curve = &Curve::all(&costs)[0];
        assert_eq!(curve.telling(), curve.whole());
        assert!(Curve::new(&costs, Counted::Casters, Work::Plan).is_none());
    }
}
