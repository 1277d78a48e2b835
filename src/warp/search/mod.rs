//! The best single matrix: a search over all warps and windows of a light.
//!
//! Every single-pass map of a light is a homography of the chart of its rays (`docs/design.md`, sections 2 and 6): two numbers choose
//! c, two turn and shear the window, and the rest is its fit to R. The search minimises the error of the map at points of the
//! surfaces in view ([`Objective`]).
//!
//! There are many local minima, one for each pair of edges of R along sides of the window, but few while the sides are soft. So the
//! search starts softly from the best closed form, as it is and turned by 45°, and sharpens the better result. In a map that is not
//! square a quarter turn makes another map: there are twice as many closed forms and starts, and the better half is sharpened.

mod chart;
mod lanes;
mod moments;
mod projection;
pub(crate) mod ranges;
mod refine;
mod step;
mod surfaces;

use crate::convex::Plane;
use crate::focus::Focus;
use crate::math::bounds::{least, most};
use crate::settings::{Effort, Objective, Settings};
use crate::warp::homography::Frame;
use crate::warp::rays::{Functional, Rays};
use crate::warp::{MAX_RATIO, Proposed, Visible, light_space, trapezoidal};
use chart::{Change, Chart, Drawn, Rows};
use core::f32::consts::FRAC_1_SQRT_2;
use glam::{DVec2, DVec3, Mat2, Vec2};
use refine::Refinement;
use surfaces::Surfaces;

/// The chosen map.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Chosen {
    pub(crate) proposed: Proposed,
    /// Whether points of R jump from the previous map, if any, to this one.
    pub(crate) jumped: bool,
}

/// The previous frame's map, as far as the search needs it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Previous {
    /// World to clip, depth 0 to 1, y up.
    pub(crate) rows: [Plane; 4],
    pub(crate) weakening: f64,
}

/// Chooses the best map for R, starting from the closed forms; `perspective` may be that of a camera moved back. `before` is the
/// previous frame's map, if any.
pub(crate) fn choose<P: Iterator<Item = DVec3> + Clone>(
    focus: &Focus<'_>,
    visible: &Visible<'_, P>,
    perspective: Proposed,
    effort: Effort,
    settings: &Settings,
    before: Option<&Previous>,
) -> Chosen {
    let Visible { rays, middle, .. } = *visible;
    let (width, height) = settings.map_sides();
    let search = Search::new(focus, visible, settings);
    let mut closed = None::<(Candidate, Proposed)>;
    let fallible = [light_space::propose(visible), trapezoidal::propose(visible)].into_iter().flatten();
    let forms = [Proposed::UNIFORM, perspective, perspective.through_eye(visible)].into_iter().chain(fallible);
    // In a square map a quarter turn makes no difference.
    let ways = if width == height { 1 } else { 2 };
    for proposed in forms.flat_map(|form| [form, form.quarter_turned()].into_iter().take(ways)) {
        let measured = search.measured(&proposed.frame.rows(middle, &proposed.warp));
        closed = match (closed, measured) {
            (Some(best), Some(measured)) if measured.error >= best.0.error => Some(best),
            (best, None) => best,
            (_, Some(measured)) => Some((measured, proposed)),
        };
    }
    let Some((closed, form)) = closed else {
        // All of R lies on one ray.
        return Chosen { proposed: Proposed::UNIFORM, jumped: false };
    };
    let drawn = before.map(|map| rows_of(map, rays, middle));
    let kept = drawn.and_then(|rows| search.measured(&rows));
    let kept = kept.map(|kept| search.refined(&kept, &Refinement::NEXT_FRAME));
    let chosen = kept.filter(|kept| kept.error * WORTH_JUMPING <= closed.error).unwrap_or_else(|| {
        let best = search.best(closed, effort);
        if width == height { best } else { search.upright(best, middle) }
    });

    // Weakened for f32, a map may be worse than a closed form.
    let worth = if kept.is_some() { WORTH_JUMPING } else { 1.0 };
    let held = |[x, y, w]: Rows, already: f64| {
        let mut proposed = visible.weakened(&rays.covector(&w), MAX_RATIO);
        // Next to a local light even the uniform map is short of f32 digits, and a map would be weakened again in every frame.
        if proposed.weakening <= already {
            proposed = Proposed { warp: w.scaled(w.at(middle).recip()), weakening: already, ..proposed };
        }
        let held = search.measured(&[x, y, proposed.warp]).filter(|held| held.error * worth < closed.error)?;
        Some((held, Proposed { frame: frame(&search.chart.rows(&held.map), middle)?, ..proposed }))
    };
    let moves = held(search.chart.rows(&chosen.map), 0.0);
    let stays = before.zip(drawn).and_then(|(map, rows)| held(rows, map.weakening));
    let (_, proposed) = match (stays, moves) {
        (Some(stays), None) => stays,
        // Where the error hardly depends on the map, the search would go on for next to nothing, and texels would crawl.
        (Some(stays), Some(moves)) if moves.0.error > stays.0.error * WORTH_MOVING => stays,
        (_, moves) => moves.unwrap_or((closed, form)),
    };
    let rows = proposed.frame.rows(middle, &proposed.warp);
    Chosen { proposed, jumped: drawn.is_some_and(|before| search.jumps(&before, &rows)) }
}

/// The rows x, y and w of a map on the chart, w 1 in the middle.
fn rows_of(map: &Previous, rays: &Rays, middle: DVec2) -> Rows {
    let [x, y, _, w] = map.rows.map(|row| rays.functional(&row));
    let scale = w.at(middle).recip();
    [x, y, w].map(|row| row.scaled(scale))
}

/// The normals of the window's sides at a place on the chart; `None` where they are almost parallel or the window is almost a line. R
/// is then hardly wider than a line and any window is as good, while rounding would cut casters off in a thin one.
fn frame([x, y, w]: &Rows, place: DVec2) -> Option<Frame> {
    let across = |row: &Functional| row.slope - w.slope * (row.at(place) / w.at(place));
    let (x, y) = (across(x), across(y));
    let (u, v) = (x.try_normalize()?, y.try_normalize()?);
    // The window extends from −1 to 1.
    let thin = least(x.length(), y.length()) < LEAST_WIDTH * most(x.length(), y.length());
    (u.perp_dot(v).abs() >= LEAST_ANGLE && !thin).then_some(Frame { u, v })
}

/// A map and its error.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    map: Drawn,
    error: f64,
}

impl Candidate {
    /// The better one.
    fn or(self, other: Option<Self>) -> Self {
        other.filter(|other| other.error < self.error).unwrap_or(self)
    }
}

/// What a search knows.
struct Search {
    chart: Chart,
    surfaces: Surfaces,
    objective: Objective,
    is_square: bool,
}

/// Turns of the window for further starts: by 45° and, in maps that are not square, by 90° and 135°.
const TURNS: [Mat2; 3] = [
    Mat2::from_cols_array(&[FRAC_1_SQRT_2, FRAC_1_SQRT_2, -FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    Mat2::from_cols_array(&[0.0, 1.0, -1.0, 0.0]),
    Mat2::from_cols_array(&[-FRAC_1_SQRT_2, FRAC_1_SQRT_2, -FRAC_1_SQRT_2, -FRAC_1_SQRT_2]),
];

/// The least sine of the angle between sides of the window.
const LEAST_ANGLE: f64 = 1.0 / 64.0;

/// The least ratio of width and height of a window.
const LEAST_WIDTH: f64 = 1.0 / 1_048_576.0;

/// The largest move of a point from one map to the next that is no jump: a 32nd of the map.
const JUMP: f32 = 2.0 / 32.0;

/// The error, relative to the previous map's, that justifies a move.
const WORTH_MOVING: f64 = 1.0 - 1.0 / 1024.0;

/// The error of a closed form, relative to that of the previous map's successor, that justifies a jump.
const WORTH_JUMPING: f64 = 1.0 - 1.0 / 32.0;

impl Search {
    fn new<P: Iterator<Item = DVec3> + Clone>(
        focus: &Focus<'_>,
        visible: &Visible<'_, P>,
        settings: &Settings,
    ) -> Self {
        let Visible { rays, middle, along, .. } = *visible;
        let chart = Chart::new(visible.points.clone().map(|point| rays.through(point).0), middle);
        let (width, height) = settings.map_sides();
        Self {
            surfaces: Surfaces::new(focus, rays, &chart, along, settings),
            chart,
            objective: settings.objective(),
            is_square: width == height,
        }
    }

    /// A map with its error; `None` where that is not finite.
    fn candidate(&self, map: Drawn) -> Option<Candidate> {
        let error = self.surfaces.error(&map);
        (error > 0.0 && error.is_finite()).then_some(Candidate { map, error })
    }

    /// A homography with its error; `None` unless w > 0 on R.
    fn measured(&self, rows: &Rows) -> Option<Candidate> {
        self.chart.fitted(rows).and_then(|map| self.candidate(map))
    }

    /// The best map found from the best closed form.
    fn best(&self, closed: Candidate, effort: Effort) -> Candidate {
        let turns = if self.is_square { &TURNS[..1] } else { &TURNS };
        let count = match effort {
            Effort::ClosedForms => return closed,
            Effort::Rough => return self.refined(&closed, &Refinement::ROUGH),
            Effort::Good => turns.len().div_ceil(2),
            Effort::Thorough => 1 + turns.len(),
        };
        let mut starts = [closed; 1 + TURNS.len()];
        let starts = &mut starts[..=turns.len()];
        starts[0] = self.refined(&closed, &Refinement::SOFT);
        for (start, turn) in starts[1..].iter_mut().zip(turns) {
            let turned = self.chart.changed(&closed.map, &Change { axes: *turn, tilt: Vec2::ZERO });
            let turned = turned.and_then(|map| self.candidate(map));
            *start = turned.map_or(closed, |turned| self.refined(&turned, &Refinement::SOFT));
        }
        starts.sort_unstable_by(|a, b| a.error.total_cmp(&b.error));
        starts[..count].iter().fold(closed, |best, start| best.or(Some(self.refined(start, &Refinement::SHARP))))
    }

    /// The map itself or turned by 180°, whichever turns the chart by −22.5° to 157.5° at a place on it. Starts a quarter turn or more
    /// apart may end at the same map either way up, which rounding would decide; the bounds are as far from all starts as possible.
    fn upright(&self, best: Candidate, place: DVec2) -> Candidate {
        // Of 67.5°.
        const MIDDLE: DVec2 = DVec2::new(0.382_683_432_365_089_8, 0.923_879_532_511_286_7);
        let turned =
            frame(&self.chart.rows(&best.map), place).map(|Frame { u, v }| DVec2::new(u.x + v.y, u.y - v.x));
        if turned.is_none_or(|turned| turned.dot(MIDDLE) >= 0.0) {
            return best;
        }
        let [x, y, w] = best.map.rows;
        Candidate { map: Drawn { rows: [-x, -y, w], ..best.map }, ..best }
    }

    /// Whether any point of R jumps from one map to another.
    fn jumps(&self, before: &Rows, after: &Rows) -> bool {
        match (self.chart.fitted(before), self.chart.fitted(after)) {
            (Some(before), Some(after)) => self.chart.largest_move(&before, &after) > JUMP,
            _ => true,
        }
    }
}
