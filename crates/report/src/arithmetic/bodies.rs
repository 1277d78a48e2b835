//! The same focus body in every arithmetic: how long it takes, and how far it is from the exact one.

use anyhow::{Context, Result, ensure};
use dashu_ratio::RBig;
use serde::Serialize;
use shadowfit::{Focus, FocusForm};

use super::Set;
use super::cases::{self, Case};
use super::number::Number;
use super::plain::{Plain, PlainScene};
use super::truth::{Errors, Truth};
use super::turns::{CaseTime, Turn, times};
use crate::size::Size;
use crate::statistics::{median, quantile};
use crate::timing;

/// What a body is computed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Arithmetic {
    /// The plain construction in f32.
    #[serde(rename = "f32")]
    F32,
    /// The same with planes moved outwards by 96 ε, its own, of the magnitudes of their terms.
    #[serde(rename = "f32, grown")]
    F32Grown,
    /// The plain construction in f64.
    #[serde(rename = "f64")]
    F64,
    /// The same with planes moved outwards, by as many of its ε.
    #[serde(rename = "f64, grown")]
    F64Grown,
    /// The crate: f64, planes moved outwards by a bound on its roundings, signs at the light by exact expansions.
    #[serde(rename = "crate: f64 with certified bounds")]
    Certified,
    /// The plain construction in exact rationals.
    #[serde(rename = "exact rationals")]
    Exact,
}

impl Arithmetic {
    /// All of them, the crate first, which times are compared with.
    pub(crate) const ALL: [Self; 6] =
        [Self::Certified, Self::F32, Self::F32Grown, Self::F64, Self::F64Grown, Self::Exact];

    /// What tables and legends call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F32Grown => "f32, grown",
            Self::F64 => "f64",
            Self::F64Grown => "f64, grown",
            Self::Certified => "crate: f64 with certified bounds",
            Self::Exact => "exact rationals",
        }
    }
}

/// What was found of one arithmetic in one set of cases. Distances are parts of the scene's size.
#[derive(Clone, Debug, Serialize)]
pub struct BodyRecord {
    /// The set of cases.
    pub set: Set,
    /// What the body is computed in.
    pub arithmetic: Arithmetic,
    /// Cases, each of which is counted.
    pub cases: usize,
    /// How long it takes.
    #[serde(flatten)]
    pub time: CaseTime,
    /// Part of the cases in which anything is lost, by any amount.
    pub lost_share: f64,
    /// … more than a millionth of the scene's size.
    pub lost_much_share: f64,
    /// Part of the cases in which it is computed as empty, and is not.
    pub emptied_share: f64,
    /// Median of what is lost, over the cases in which anything is; 0 where none is.
    pub lost_median: f64,
    /// The most that is lost.
    pub lost_worst: f64,
    /// Median of what is gained, over all cases.
    pub gained_median: f64,
    /// What 99 % of the cases gain no more than.
    pub gained_99: f64,
    /// The most that is gained.
    pub gained_worst: f64,
    /// Cases in which no body comes out: not finite, or not closed.
    pub failures: usize,
}

/// What is lost or gained and no more than this part of the scene's size, nobody sees.
pub(crate) const MUCH: f64 = 1e-6;

/// Measures one set of cases.
pub(crate) fn measure(size: Size, set: Set) -> Result<Vec<BodyRecord>> {
    let count = size.of(20, 5_000);
    let cases = match set {
        Set::Random => cases::random(count),
        Set::Hard => cases::hard(count),
    };
    let errors = errors(&cases, set)?;
    let all = Timed { cases: &cases, rounds: size.of(3, 31) };
    let exact = Timed { cases: &cases[..size.of(2, 100).min(cases.len())], rounds: size.of(1, 3) };
    let floats = all.times(&Arithmetic::ALL[..5])?;
    // A turn of rationals takes as long as all others together, so they have few, and the crate beside them.
    let rationals = exact.times(&[Arithmetic::Certified, Arithmetic::Exact])?;
    let found = Arithmetic::ALL.into_iter().zip(&errors).zip(floats.into_iter().chain([rationals[1]]));
    Ok(found.map(|((arithmetic, errors), time)| record(set, arithmetic, errors, time)).collect())
}

/// For each arithmetic, the errors of all cases.
fn errors(cases: &[Case], set: Set) -> Result<[Vec<Errors>; 6]> {
    let progress = render_check::output::progress::bar(&format!("bodies, {} cases", set.name()), cases.len());
    let mut errors = Arithmetic::ALL.map(|_| Vec::with_capacity(cases.len()));
    for (index, case) in cases.iter().enumerate() {
        let truth = Truth::new(case);
        let scene = case.scene().context("the scene was taken before")?;
        let certified = Focus::new(&case.view, &case.light, &scene).caster_volume(FocusForm::ViewHull);
        let certified: Vec<[f64; 3]> = certified.vertices().iter().map(|vertex| vertex.to_array()).collect();
        let exact = vertices::<RBig>(case, false).context("an exact body is closed")?;
        ensure!(
            truth.has_vertices(&exact),
            "the rationals' body of {} case {index} is not the oracle's",
            set.name()
        );
        let of =
            |vertices: Option<Vec<[f64; 3]>>| vertices.map_or(Errors::FAILED, |vertices| truth.errors(&vertices));
        let found = [
            of(Some(certified)),
            of(rounded(vertices::<f32>(case, false))),
            of(rounded(vertices::<f32>(case, true))),
            of(rounded(vertices::<f64>(case, false))),
            of(rounded(vertices::<f64>(case, true))),
            // The very body.
            Errors::default(),
        ];
        for (errors, found) in errors.iter_mut().zip(found) {
            errors.push(found);
        }
        progress.inc(1);
    }
    Ok(errors)
}

/// The vertices of a case's body, unless its surface is not closed.
pub(crate) fn vertices<T: Number>(case: &Case, grown: bool) -> Option<Vec<[T; 3]>> {
    let scene = PlainScene::new(case.min, case.max, &case.cuts, grown);
    let mut plain = Plain::new(grown);
    let body = plain.focus_body(&case.view, &case.light, &scene);
    body.is_closed().then(|| body.vertices().to_vec())
}

/// In f64, which holds them all.
fn rounded<T: Number>(vertices: Option<Vec<[T; 3]>>) -> Option<Vec<[f64; 3]>> {
    Some(vertices?.iter().map(|vertex| vertex.each_ref().map(Number::to_f64)).collect())
}

/// What is timed: a turn is all of the cases.
struct Timed<'a> {
    cases: &'a [Case],
    rounds: usize,
}

impl Timed<'_> {
    /// Times of one body each, of contenders of which the first is compared with.
    fn times(&self, contenders: &[Arithmetic]) -> Result<Vec<CaseTime>> {
        let turns = contenders.iter().map(|arithmetic| self.turn(*arithmetic)).collect::<Result<_>>()?;
        times(self.rounds, self.cases.len(), turns)
    }

    fn turn(&self, arithmetic: Arithmetic) -> Result<Turn<'_>> {
        Ok(match arithmetic {
            Arithmetic::F32 => self.plain::<f32>(false),
            Arithmetic::F32Grown => self.plain::<f32>(true),
            Arithmetic::F64 => self.plain::<f64>(false),
            Arithmetic::F64Grown => self.plain::<f64>(true),
            Arithmetic::Exact => self.plain::<RBig>(false),
            Arithmetic::Certified => {
                let scene = |case| Case::scene(case).context("the scene was taken before");
                let scenes = self.cases.iter().map(scene).collect::<Result<Vec<_>>>()?;
                Box::new(move || {
                    Ok(timing::taken(|| {
                        for (case, scene) in self.cases.iter().zip(&scenes) {
                            std::hint::black_box(
                                Focus::new(&case.view, &case.light, scene).caster_volume(FocusForm::ViewHull),
                            );
                        }
                    }))
                })
            }
        })
    }

    fn plain<T: Number + 'static>(&self, grown: bool) -> Turn<'_> {
        let scene = |case: &Case| PlainScene::<T>::new(case.min, case.max, &case.cuts, grown);
        let scenes: Vec<_> = self.cases.iter().map(scene).collect();
        let mut plain = Plain::<T>::new(grown);
        Box::new(move || {
            Ok(timing::taken(|| {
                for (case, scene) in self.cases.iter().zip(&scenes) {
                    std::hint::black_box(plain.focus_body(&case.view, &case.light, scene));
                }
            }))
        })
    }
}

fn record(set: Set, arithmetic: Arithmetic, errors: &[Errors], time: CaseTime) -> BodyRecord {
    let share = |is: &dyn Fn(&Errors) -> bool| {
        errors.iter().filter(|errors| is(errors)).count() as f64 / errors.len() as f64
    };
    let lost: Vec<f64> = errors.iter().map(|errors| errors.lost).filter(|lost| *lost > 0.0).collect();
    let gained: Vec<f64> = errors.iter().map(|errors| errors.gained).collect();
    BodyRecord {
        set,
        arithmetic,
        cases: errors.len(),
        time,
        lost_share: share(&|errors| errors.lost > 0.0),
        lost_much_share: share(&|errors| errors.lost > MUCH),
        emptied_share: share(&|errors| errors.emptied),
        lost_median: if lost.is_empty() { 0.0 } else { median(&lost) },
        lost_worst: lost.iter().copied().fold(0.0, f64::max),
        gained_median: median(&gained),
        gained_99: quantile(&gained, 0.99),
        gained_worst: gained.iter().copied().fold(0.0, f64::max),
        failures: errors.iter().filter(|errors| errors.failed).count(),
    }
}
