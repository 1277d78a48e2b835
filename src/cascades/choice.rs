//! Cuts chosen by what is seen.

use super::Cascades;
use super::split::{self, Depths, PARTS};
use crate::error::{Expected, InputError, check};
use crate::focus::Focus;
use crate::input::light::Light;
use crate::input::scene::Scene;
use crate::input::view::View;
use crate::seen::Seen;
use crate::settings::{Objective, Settings};
use crate::warp::search::ranges::{Cost, Ranges};

/// How cascades are chosen by what is seen ([`Cascades::chosen`]).
///
/// ```
/// use shadowfit::cascades::CascadeChoice;
///
/// let choice = CascadeChoice { most: 3, enough: 1.5, ..CascadeChoice::default() };
/// assert_eq!((choice.most, choice.overlap), (3, 0.1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CascadeChoice {
    /// How many cascades at most, 1 to [`Cascades::MAX`]; 4 by default.
    pub most: usize,
    /// The error that is good enough, in pixels ([`SurfaceError`](crate::map::SurfaceError)): fewer cascades are chosen where
    /// they reach it, or where one more would improve little. 1 by default.
    pub enough: f64,
    /// The part of each cascade but the last in which the next one is blended in, 0 to 1; 0.1 by default.
    pub overlap: f64,
}

impl Default for CascadeChoice {
    fn default() -> Self {
        Self { most: 4, enough: 1.0, overlap: 0.1 }
    }
}

/// One more cascade has to take this part of the error away.
const WORTH_ONE_MORE: f64 = 0.05;

impl<'a> Cascades<'a> {
    /// Cuts a view where the errors of all maps are least together: the number of cascades and the depths between them are chosen by
    /// what is seen, for maps of these settings.
    ///
    /// The cuts minimise the objective of the settings over all seen surfaces, in twentieths of the range of depths (each a factor of
    /// depth): the mean, or the worst. Each cascade is cut down to what is seen in it.
    ///
    /// # Errors
    ///
    /// Names `"most"`, `"enough"` or `"overlap"` when it is out of range.
    pub fn chosen(
        view: &View,
        light: &Light,
        scene: &Scene<'a>,
        seen: &Seen<'a>,
        choice: &CascadeChoice,
        settings: &Settings,
    ) -> Result<Self, InputError> {
        let most = choice.most;
        check::within("most", most as f64, Expected::Within { least: 1.0, most: Self::MAX as f64 })?;
        check::above("enough", choice.enough, "zero", 0.0)?;
        let overlap = check::part("overlap", choice.overlap, 1.0)?;
        let focus = Focus::new(view, light, scene).with_seen(seen);
        let cuts = match Ranges::new(&focus, settings) {
            Some(ranges) => chosen(view, &ranges, most, choice.enough, settings.objective()),
            None => Depths::none(view.near()),
        };
        Ok(Self::cut(view, light, scene, &cuts, overlap)?.with_seen(seen))
    }

    /// The cascades with the surfaces that the camera sees, each cut down to those in it ([`Focus::with_seen`]).
    #[must_use]
    pub fn with_seen(mut self, seen: &Seen<'a>) -> Self {
        let len = self.len;
        for cascade in &mut self.cascades[..len] {
            cascade.focus = cascade.focus.clone().with_seen(seen);
        }
        self
    }
}

/// The cuts with the least error, and as few as are enough.
fn chosen(view: &View, ranges: &Ranges<'_>, most: usize, enough: f64, objective: Objective) -> Depths {
    let ends = ranges.ends();
    let mut depths = split::parts(view.lens(), ends.min.max(view.near()), ends.max);
    // Past all surfaces, whatever the rounding.
    depths[PARTS] = f64::INFINITY;
    // The cost of each range of parts.
    let nothing = Cost { error: 0.0, pixels: 0.0 };
    let mut costs = [[nothing; PARTS + 1]; PARTS];
    for (from, costs) in costs.iter_mut().enumerate() {
        let near = if from == 0 { f64::NEG_INFINITY } else { depths[from] };
        ranges.costs(near, depths[from], &depths[from + 1..], |to, cost| {
            costs[from + 1 + to] = cost.unwrap_or(nothing);
        });
    }
    let sum = |a: f64, b: f64| match objective {
        Objective::Mean => a + b,
        Objective::Worst => a.max(b),
    };
    let pixels = costs[0][PARTS].pixels;
    let error = |cost: f64| match objective {
        Objective::Mean => cost / pixels,
        Objective::Worst => cost,
    };
    // The least cost of the parts up to each with so many cascades, and where the last of them begins.
    let mut best = [[(f64::INFINITY, 0); PARTS + 1]; Cascades::MAX];
    for to in 1..=PARTS {
        best[0][to] = (costs[0][to].error, 0);
    }
    let mut count = 1;
    while count < most && error(best[count - 1][PARTS].0) > enough {
        for to in count + 1..=PARTS {
            for from in count..to {
                let cost = sum(best[count - 1][from].0, costs[from][to].error);
                if cost < best[count][to].0 {
                    best[count][to] = (cost, from);
                }
            }
        }
        if error(best[count][PARTS].0) > error(best[count - 1][PARTS].0) * (1.0 - WORTH_ONE_MORE) {
            break;
        }
        count += 1;
    }
    let (mut cuts, mut to) = ([0; Cascades::MAX], PARTS);
    for cascade in (1..count).rev() {
        to = best[cascade][to].1;
        cuts[cascade] = to;
    }
    let mut chosen = Depths::none(view.near().max(ends.min));
    for &cut in &cuts[1..count] {
        let depth = split::rounded(depths[cut]);
        if depth < view.far() {
            chosen.push(depth);
        }
    }
    chosen
}
