//! The best single matrix: a search over all warps and windows of a light.
//!
//! Every single-pass map of a light is a homography of the chart of its rays (`docs/design.md`, sections 2 and 6): two numbers choose
//! c, two turn and shear the window, and the rest is its fit to R. The search minimises the worst aliasing over the vertices of R,
//! with those in the air next to the eye counted as if they stood farther away. The result is mixed with the uniform map as far as
//! that scores better at sampled receivers ([`mixed`]).
//!
//! There are many local minima, one for each pair of edges of R along sides of the window, but few of a soft maximum over the points.
//! So the search starts softly from the best closed form, as it is and turned by 45°, and sharpens the better result. In a map that
//! is not square a quarter turn makes another map: there are twice as many closed forms and starts, and the better half is sharpened.

mod draft;
mod refine;
mod step;

use crate::convex::Plane;
use crate::math::bounds::{least, most};
use crate::settings::{Effort, Settings};
use crate::warp::homography::Frame;
use crate::warp::rays::{Functional, Rays};
use crate::warp::{MAX_RATIO, NEAREST, Proposed, Samples, Visible, light_space, trapezoidal};
use core::f64::consts::FRAC_1_SQRT_2;
use draft::{Change, Draft, Rows};
use glam::{DMat2, DVec2, DVec3};
use refine::Refinement;

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
    /// See [`Proposed::mixed`].
    pub(crate) mixed: f64,
}

/// Chooses the best map for R, given by its vertices and edges, starting from the closed forms; `perspective` may be that of a camera
/// moved back. `before` is the previous frame's map, if any; `samples` stand for the receivers.
pub(crate) fn choose<P: Iterator<Item = DVec3> + Clone>(
    visible: &Visible<'_, P>,
    edges: impl Iterator<Item = (DVec3, DVec3)>,
    perspective: Proposed,
    effort: Effort,
    settings: &Settings,
    before: Option<&Previous>,
    samples: &Samples,
) -> Chosen {
    let Visible { rays, middle, .. } = *visible;
    let (width, height) = settings.map_sides();
    let mut search = Search::new(visible, edges, f64::from(width) / f64::from(height));
    let mut closed = None::<(Candidate, Proposed)>;
    let fallible = [light_space::propose(visible), trapezoidal::propose(visible)].into_iter().flatten();
    let forms = [Proposed::UNIFORM, perspective, perspective.through_eye(visible)].into_iter().chain(fallible);
    // In a square map a quarter turn makes no difference.
    let ways = if width == height { 1 } else { 2 };
    for proposed in forms.flat_map(|form| [form, form.quarter_turned()].into_iter().take(ways)) {
        let measured = search.measured(&proposed.frame.rows(middle, &proposed.warp));
        closed = match (closed, measured) {
            (Some(best), Some(measured)) if measured.worst >= best.0.worst => Some(best),
            (best, None) => best,
            (_, Some(measured)) => Some((measured, proposed)),
        };
    }
    let Some((closed, form)) = closed else {
        // All of R lies on one ray.
        return Chosen { proposed: Proposed::UNIFORM, jumped: false };
    };
    let already = before.map(|map| map.mixed);
    let drawn = before.map(|map| rows_of(map, rays, middle));
    let before = before.and_then(|map| unmixed(map, rays, middle));
    let kept = before.and_then(|(rows, _)| search.next_frame(&rows)).filter(|kept| kept.worst <= closed.worst);
    let chosen = kept.unwrap_or_else(|| {
        let best = search.best(closed, effort);
        if width == height { best } else { best.upright(middle) }
    });

    // Weakened for f32, a map may be worse than a closed form.
    let mut held = |[x, y, w]: Rows, already: f64| {
        let mut proposed = visible.weakened(&rays.covector(&w), MAX_RATIO);
        // Next to a local light even the uniform map is short of f32 digits, and a map would be weakened again in every frame.
        if proposed.weakening <= already {
            proposed = Proposed { warp: w.scaled(w.at(middle).recip()), weakening: already, ..proposed };
        }
        let held = search.measured(&[x, y, proposed.warp]).filter(|held| held.worst < closed.worst)?;
        Some((held, Proposed { frame: held.frame(middle)?, ..proposed }))
    };
    let moves = held(chosen.rows, 0.0);
    let stays = before.and_then(|(rows, weakening)| held(rows, weakening));
    let (_, proposed) = match (stays, moves) {
        (Some(stays), None) => stays,
        // Where the worst hardly depends on the map, the search would go on for next to nothing, and texels would crawl.
        (Some(stays), Some(moves)) if moves.0.worst > stays.0.worst * WORTH_MOVING => stays,
        (_, moves) => moves.unwrap_or((closed, form)),
    };
    let proposed = mixed(visible, proposed, already, samples);
    let rows = proposed.frame.rows(middle, &proposed.warp);
    Chosen { proposed, jumped: drawn.is_some_and(|before| search.jumps(&before, &rows)) }
}

/// The weights of the uniform map's w that are tried in a mix: from no mixing to no warp.
const MIXED: [f64; 6] = [0.0, 0.125, 0.25, 0.5, 1.0, f64::INFINITY];

/// The advantage in score that a mixed map needs over the map found, and the uniform map likewise. On scenes that were drawn and
/// compared with ground truth (`docs/warps.md`) smaller differences did not predict pixel error. Where f32 is short, none is needed.
const WORTH_MIXING: f64 = 1.0 / 32.0;
const WORTH_NO_WARP: f64 = 1.0 / 12.0;

/// The advantage in score that justifies another mix than the previous frame's.
const SAME_SCORE: f64 = 1.0 / 64.0;

/// The map found, mixed with the uniform map to the best score; `before` is the mix of the previous frame.
///
/// The search minimises the worst texel over R, which is mostly air; the score at sampled receivers ([`Visible::score`]) decides how
/// much of that warp is kept.
fn mixed<P: Iterator<Item = DVec3> + Clone>(
    visible: &Visible<'_, P>,
    proposed: Proposed,
    before: Option<f64>,
    samples: &Samples,
) -> Proposed {
    let of = |kappa: f64| {
        if kappa.is_finite() {
            Proposed { mixed: kappa, ..proposed.mixed_by(kappa) }
        } else {
            Proposed { mixed: kappa, ..Proposed::UNIFORM }
        }
    };
    let mut best = (f64::INFINITY, proposed);
    for kappa in MIXED {
        let candidate = of(kappa);
        let stays = if before == Some(kappa) { SAME_SCORE } else { 0.0 };
        let handicap = match kappa {
            _ if visible.precision.is_short() => 0.0,
            0.0 => 0.0,
            f64::INFINITY => WORTH_NO_WARP,
            _ => WORTH_MIXING,
        };
        let score = visible.score(&candidate, samples) - stays + handicap;
        if score < best.0 {
            best = (score, candidate);
        }
    }
    best.1
}

/// The rows x, y and w of a map on the chart, w 1 in the middle.
fn rows_of(map: &Previous, rays: &Rays, middle: DVec2) -> Rows {
    let [x, y, _, w] = map.rows.map(|row| rays.functional(&row));
    let scale = w.at(middle).recip();
    [x, y, w].map(|row| row.scaled(scale))
}

/// The rows of a map before it was mixed, and its weakening then; `None` where the mix left no warp.
fn unmixed(map: &Previous, rays: &Rays, middle: DVec2) -> Option<(Rows, f64)> {
    if !map.mixed.is_finite() {
        return None;
    }
    let [x, y, w] = rows_of(map, rays, middle);
    // x and y contain a multiple of the mixed w, the window's middle.
    let [x, y] = [x, y].map(|row| row.plus(&w.scaled(-row.at(middle))));
    let times = 1.0 + map.mixed;
    let w = Functional { slope: w.slope * times, constant: w.constant * times - map.mixed };
    Some(([x, y, w], (map.weakening * times - map.mixed).max(0.0)))
}

/// A homography and its worst texel over R.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    rows: Rows,
    worst: f64,
}

impl Candidate {
    /// The better one.
    fn or(self, other: Option<Self>) -> Self {
        other.filter(|other| other.worst < self.worst).unwrap_or(self)
    }

    /// The map itself or turned by 180°, whichever turns the chart by −22.5° to 157.5° at a place on it. Starts a quarter turn or more
    /// apart may end at the same map either way up, which rounding would decide; the bounds are as far from all starts as possible.
    fn upright(self, place: DVec2) -> Self {
        // Of 67.5°.
        const MIDDLE: DVec2 = DVec2::new(0.382_683_432_365_089_8, 0.923_879_532_511_286_7);
        let turned = self.frame(place).map(|Frame { u, v }| DVec2::new(u.x + v.y, u.y - v.x));
        if turned.is_none_or(|turned| turned.dot(MIDDLE) >= 0.0) {
            return self;
        }
        let [x, y, w] = self.rows;
        Self { rows: [x.scaled(-1.0), y.scaled(-1.0), w], ..self }
    }

    /// The normals of the window's sides at a place on the chart; `None` where they are almost parallel or the window is almost a
    /// line. R is then hardly wider than a line and any window is as good, while rounding would cut casters off in a thin one.
    fn frame(&self, place: DVec2) -> Option<Frame> {
        let [x, y, w] = &self.rows;
        let across = |row: &Functional| row.slope - w.slope * (row.at(place) / w.at(place));
        let (x, y) = (across(x), across(y));
        let (u, v) = (x.try_normalize()?, y.try_normalize()?);
        // The window extends from −1 to 1.
        let thin = least(x.length(), y.length()) < LEAST_WIDTH * most(x.length(), y.length());
        (u.perp_dot(v).abs() >= LEAST_ANGLE && !thin).then_some(Frame { u, v })
    }
}

/// The memory of a search.
struct Search {
    /// Points of R on the chart: the vertices and, for a local light, the middles of edges.
    chart: Draft,
    vertices: usize,
    /// The vertices, and the middles of edges that steps take into account.
    watched: Draft,
    /// A map, and the next one.
    draft: Draft,
    next: Draft,
}

/// Turns of the window for further starts: by 45° and, in maps that are not square, by 90° and 135°.
const TURNS: [DMat2; 3] = [
    DMat2::from_cols_array(&[FRAC_1_SQRT_2, FRAC_1_SQRT_2, -FRAC_1_SQRT_2, FRAC_1_SQRT_2]),
    DMat2::from_cols_array(&[0.0, 1.0, -1.0, 0.0]),
    DMat2::from_cols_array(&[-FRAC_1_SQRT_2, FRAC_1_SQRT_2, -FRAC_1_SQRT_2, -FRAC_1_SQRT_2]),
];

/// The least sine of the angle between sides of the window.
const LEAST_ANGLE: f64 = 1.0 / 64.0;

/// The least ratio of width and height of a window.
const LEAST_WIDTH: f64 = 1.0 / 1_048_576.0;

/// The largest move of a point from one map to the next that is no jump: a 32nd of the map.
const JUMP: f64 = 2.0 / 32.0;

/// The squared worst, relative to the previous map's, that justifies a move.
const WORTH_MOVING: f64 = 1.0 - 1.0 / 512.0;

/// The squared texel, relative to the worst, from which on a point is watched.
const CLOSE: f64 = 0.5;

impl Search {
    fn new<P: Iterator<Item = DVec3> + Clone>(
        visible: &Visible<'_, P>,
        edges: impl Iterator<Item = (DVec3, DVec3)>,
        shape: f64,
    ) -> Self {
        let Visible { view, rays, middle, eye_depth, .. } = *visible;
        let nearest = NEAREST * eye_depth.max;
        let mut chart = Draft::chart(middle, shape);
        visible.points.clone().for_each(|vertex| chart.include(rays, view, nearest, vertex));
        let (vertices, watched) = (chart.points().len(), chart.clone());
        // Footprints are measured across the ray. Rays of a local light slant towards both ends of an edge, where the long side of a
        // texel may look shorter than between them.
        if rays.local {
            edges.for_each(|(a, b)| chart.include(rays, view, nearest, (a + b) * 0.5));
        }
        Self { chart, vertices, watched, draft: Draft::EMPTY, next: Draft::EMPTY }
    }

    /// A homography with its worst; `None` unless w > 0 on R.
    fn measured(&mut self, rows: &Rows) -> Option<Candidate> {
        let Self { chart, draft, .. } = self;
        draft.set_rows(chart, rows).then_some(Candidate { rows: draft.rows, worst: draft.worst })
    }

    /// The best map found from the best closed form.
    fn best(&mut self, closed: Candidate, effort: Effort) -> Candidate {
        let turns = if self.chart.shape == 1.0 { &TURNS[..1] } else { &TURNS };
        let count = match effort {
            Effort::ClosedForms => return closed,
            Effort::Rough => {
                let rough = self.refined(&closed.rows, &Refinement::ROUGH);
                return closed.or(rough.and_then(|rough| self.measured(&rough.rows)));
            }
            Effort::Good => turns.len().div_ceil(2),
            Effort::Thorough => 1 + turns.len(),
        };
        let mut starts = [closed; 1 + TURNS.len()];
        let starts = &mut starts[..=turns.len()];
        starts[0] = self.refined(&closed.rows, &Refinement::SOFT).unwrap_or(closed);
        for (start, turn) in starts[1..].iter_mut().zip(turns) {
            let turned = self.turned(&closed.rows, turn);
            *start = turned.and_then(|rows| self.refined(&rows, &Refinement::SOFT)).unwrap_or(closed);
        }
        starts.sort_unstable_by(|a, b| a.worst.total_cmp(&b.worst));
        starts[..count].iter().fold(closed, |best, start| {
            self.watch(&start.rows);
            let sharp = self.refined(&start.rows, &Refinement::SHARP);
            best.or(sharp.and_then(|sharp| self.measured(&sharp.rows)))
        })
    }

    /// The previous frame's map, refined for this frame.
    fn next_frame(&mut self, before: &Rows) -> Option<Candidate> {
        self.watch(before);
        let kept = self.refined(before, &Refinement::NEXT_FRAME)?;
        self.measured(&kept.rows)
    }

    /// Whether any point of R jumps from one map to another.
    fn jumps(&mut self, before: &Rows, after: &Rows) -> bool {
        let Self { chart, draft, next, .. } = self;
        if !(draft.set_rows(chart, before) && next.set_rows(chart, after)) {
            return true;
        }
        let mut moved = draft.points().iter().zip(next.points()).map(|(from, to)| (to.place - from.place).abs());
        moved.any(|moved| moved.max_element() > JUMP)
    }

    /// A homography turned in its window.
    fn turned(&mut self, rows: &Rows, turn: &DMat2) -> Option<Rows> {
        let Self { chart, draft, next, .. } = self;
        let turn = Change { axes: *turn, tilt: DVec2::ZERO };
        (draft.set_rows(chart, rows) && next.set_changed(draft, &turn)).then_some(next.rows)
    }

    /// Watches the middles of edges where a homography comes close to its worst.
    fn watch(&mut self, rows: &Rows) {
        let Self { chart, vertices, watched, draft, .. } = self;
        if chart.points().len() > *vertices && draft.set_rows(chart, rows) {
            watched.truncate(*vertices);
            for (on_chart, in_map) in chart.points().iter().zip(draft.points()).skip(*vertices) {
                if in_map.longest > CLOSE * draft.worst {
                    watched.push(*on_chart);
                }
            }
        }
    }
}
