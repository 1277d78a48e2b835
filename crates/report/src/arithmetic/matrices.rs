//! The same matrix in every arithmetic: how long it takes, and how far it is from that of 512 bits.

use std::hint::black_box;

use anyhow::{Context, Result};
use serde::Serialize;
use shadowfit::glam::DVec3;
use shadowfit::{ClipSpace, Focus, Settings, ShadowMap, Warp};

use super::Set;
use super::setups;
use super::turns::{CaseTime, Turn, times};
use super::uniform::{Extent, uniform};
use crate::size::Size;
use crate::statistics::median;
use crate::timing;
use testkit::stability::arithmetic::{Big, Real};
use testkit::stability::linear::{M4, V3, dot, exactly, point, rows_of, vector};
use testkit::stability::ours::ours;
use testkit::stability::setup::{Lamp, Setup};
use testkit::stability::textbook::textbook;

/// The kind of map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Texels spread evenly, of a sun.
    Uniform,
    /// The perspective map of Stamminger & Drettakis, of suns and lamps.
    Perspective,
}

impl Kind {
    pub(crate) const ALL: [Self; 2] = [Self::Uniform, Self::Perspective];

    /// What tables call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Perspective => "perspective",
        }
    }

    fn warp(self) -> Warp {
        match self {
            Self::Uniform => Warp::Uniform,
            Self::Perspective => Warp::Perspective,
        }
    }
}

/// What a matrix is computed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Precision {
    /// f32 from the first number to the last.
    #[serde(rename = "f32")]
    F32,
    /// f64 likewise.
    #[serde(rename = "f64")]
    F64,
    /// The crate, before it rounds to f32.
    #[serde(rename = "crate, f64")]
    Ours,
    /// The crate's, as it is uploaded: rounded once.
    #[serde(rename = "crate, uploaded as f32")]
    Uploaded,
    /// 512 bits.
    #[serde(rename = "512 bits")]
    Big,
}

impl Precision {
    /// All, the crate's first, which times are compared with.
    pub(crate) const ALL: [Self; 5] = [Self::Uploaded, Self::Ours, Self::F32, Self::F64, Self::Big];

    /// What tables call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::Ours => "crate, f64",
            Self::Uploaded => "crate, uploaded as f32",
            Self::Big => "512 bits",
        }
    }
}

/// What was found of the matrices of one kind, in one precision, in one set. Errors are in parts of the clip volume.
#[derive(Clone, Debug, Serialize)]
pub struct MatrixRecord {
    /// The set of cases.
    pub set: Set,
    /// The kind of map.
    pub kind: Kind,
    /// What it is computed in.
    pub precision: Precision,
    /// Cases, each of which is counted.
    pub cases: usize,
    /// Cases of the set, of whatever light, of which there is no one map, or one whose depth range has no end.
    pub passed_over: usize,
    /// How long it takes.
    #[serde(flatten)]
    pub time: CaseTime,
    /// Median, over the usable matrices, of the worst error at any test point.
    pub error_median: f64,
    /// The worst error of a usable matrix.
    pub error_worst: f64,
    /// Part of the matrices that are not usable: an entry that is not finite, or a visible point with w ≤ 0.
    pub unusable_share: f64,
}

/// A setup with all that is found beforehand.
struct Prepared {
    setup: Setup,
    view: shadowfit::View,
    light: shadowfit::Light,
    settings: Settings,
    map: ShadowMap,
    /// The vertices of what is visible, as f32 has them: what a uniform map is made around.
    visible: Vec<DVec3>,
}

impl Prepared {
    fn new(setup: Setup, kind: Kind) -> Result<Self> {
        let (view, light) = (setup.camera.view(), setup.lamp.light());
        let settings = setup.settings().with_warp(kind.warp());
        let outcome = Focus::new(&view, &light, &setup.scene()).fit(&settings);
        let map = outcome.into_map().context("whether there is a map does not depend on the warp")?;
        let visible = setup.visible().into_iter().map(|p| p.as_vec3().as_dvec3()).collect();
        Ok(Self { setup, view, light, settings, map, visible })
    }

    /// The construction by hand: of a uniform map the crate's formulas, of a perspective one the textbook's.
    fn by_hand<T: Real>(&self) -> M4<T> {
        match self.to_sun() {
            Some(to_sun) => {
                let visible: Vec<V3<T>> = self.visible.iter().map(|p| vector(*p)).collect();
                uniform(&self.setup, to_sun, &visible, None)
            }
            None => textbook(&self.setup),
        }
    }

    /// What the crate's matrix would be in exact numbers.
    fn ours_exactly(&self) -> M4<Big> {
        match self.to_sun() {
            Some(to_sun) => {
                let visible: Vec<V3<Big>> = self.setup.visible().into_iter().map(vector).collect();
                uniform(&self.setup, to_sun, &visible, Some(Extent::of(&self.map)))
            }
            None => ours(&self.setup, &self.map),
        }
    }

    /// Towards the sun, if the map is its uniform one.
    fn to_sun(&self) -> Option<DVec3> {
        match self.setup.lamp {
            Lamp::Sun(to_sun) if self.settings.warp() == Warp::Uniform => Some(to_sun),
            _ => None,
        }
    }
}

/// Measures the matrices of one kind in one set of cases.
pub(crate) fn measure(size: Size, set: Set, kind: Kind) -> Result<Vec<MatrixRecord>> {
    let count = size.of(8, 300);
    let setups = match set {
        Set::Random => setups::random(count),
        Set::Hard => setups::hard(count),
    };
    let passed_over = setups.passed_over;
    let is_of_kind = |setup: &Setup| kind == Kind::Perspective || matches!(setup.lamp, Lamp::Sun(_));
    let cases: Vec<Prepared> = setups
        .taken
        .into_iter()
        .filter(is_of_kind)
        .map(|setup| Prepared::new(setup, kind))
        .collect::<Result<_>>()?;

    let what = format!("{} matrices, {} cases", kind.name(), set.name());
    let progress = render_check::output::progress::bar(&what, cases.len());
    let mut errors = Precision::ALL.map(|_| Vec::with_capacity(cases.len()));
    for case in &cases {
        for (errors, error) in errors.iter_mut().zip(errors_of(case)) {
            errors.push(error);
        }
        progress.inc(1);
    }

    let all = Timed { cases: &cases, rounds: size.of(3, 31) };
    let few = Timed { cases: &cases[..size.of(2, 20).min(cases.len())], rounds: size.of(1, 5) };
    let machine = all.times(&Precision::ALL[..4])?;
    let big = few.times(&[Precision::Uploaded, Precision::Big])?;
    let found = Precision::ALL.into_iter().zip(&errors).zip(machine.into_iter().chain([big[1]]));
    Ok(found
        .map(|((precision, errors), time)| {
            let usable: Vec<f64> = errors.iter().flatten().copied().collect();
            MatrixRecord {
                set,
                kind,
                precision,
                cases: errors.len(),
                passed_over,
                time,
                error_median: median(&usable),
                error_worst: usable.iter().copied().fold(0.0, f64::max),
                unusable_share: 1.0 - usable.len() as f64 / errors.len() as f64,
            }
        })
        .collect())
}

/// The errors of each precision; none of a matrix that is not usable.
fn errors_of(case: &Prepared) -> [Option<f64>; 5] {
    let points = case.setup.receivers();
    let by_hand = case.by_hand::<Big>();
    let exact = case.ours_exactly();
    let of = |matrix: Option<M4<Big>>, exact: &M4<Big>| error(&matrix?, exact, &points);
    [
        of(exactly(&rows_of(&case.map.caster_matrix().as_dmat4())), &exact),
        of(exactly(&rows_of(&case.map.clip_from_world_in(ClipSpace::WGPU))), &exact),
        of(exactly(&case.by_hand::<f32>()), &by_hand),
        of(exactly(&case.by_hand::<f64>()), &by_hand),
        of(Some(by_hand.clone()), &by_hand),
    ]
}

/// The largest difference of x, y or z after the division, over visible points, in parts of the clip volume; none where a point
/// has w ≤ 0 and wraps around. Where the exact matrix wraps a point too, there is nothing to compare it with.
fn error(matrix: &M4<Big>, exact: &M4<Big>, points: &[DVec3]) -> Option<f64> {
    const SIDES: [f64; 3] = [2.0, 2.0, 1.0];
    let zero = Big::of(0.0);
    let project = |matrix: &M4<Big>, p: DVec3| {
        let [x, y, z, w] = matrix.each_ref().map(|row| dot(row, &point(&vector(p))));
        (w > zero).then(|| [x, y, z].map(|x| x / w.clone()))
    };
    let mut most: f64 = 0.0;
    for &p in points {
        let place = project(matrix, p)?;
        let Some(expected) = project(exact, p) else { continue };
        for ((place, expected), side) in place.into_iter().zip(expected).zip(SIDES) {
            most = most.max((place - expected).abs().to_f64() / side);
        }
    }
    Some(most)
}

/// What is timed: a turn is all of the cases.
struct Timed<'a> {
    cases: &'a [Prepared],
    rounds: usize,
}

impl Timed<'_> {
    /// Times of one matrix each, of contenders of which the first is compared with.
    fn times(&self, contenders: &[Precision]) -> Result<Vec<CaseTime>> {
        let turn = |precision: Precision| -> Turn<'_> {
            Box::new(move || Ok(timing::taken(|| self.cases.iter().for_each(|case| work(case, precision)))))
        };
        times(self.rounds, self.cases.len(), contenders.iter().map(|precision| turn(*precision)).collect())
    }
}

fn work(case: &Prepared, precision: Precision) {
    let map = || Focus::new(&case.view, &case.light, &case.setup.scene()).fit(&case.settings).into_map();
    match precision {
        Precision::F32 => drop(black_box(case.by_hand::<f32>())),
        Precision::F64 => drop(black_box(case.by_hand::<f64>())),
        Precision::Big => drop(black_box(case.by_hand::<Big>())),
        Precision::Ours => drop(black_box(map().map(|map| map.clip_from_world_in(ClipSpace::WGPU)))),
        Precision::Uploaded => drop(black_box(map().map(|map| map.caster_matrix()))),
    }
}
