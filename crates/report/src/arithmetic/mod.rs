//! What accuracy costs: the same focus body and the same matrix in f32, in f64, in f64 with certified bounds, and exactly.

pub mod bodies;
mod body_page;
mod cases;
pub mod matrices;
mod matrix_page;
mod number;
mod plain;
mod polyhedron;
mod setups;
mod truth;
mod turns;
mod uniform;
mod words;

use anyhow::Result;
use serde::Serialize;

use crate::chapter::{Chapter, Raw};
use crate::size::Size;
use bodies::BodyRecord;
use matrices::{Kind, MatrixRecord};

/// A set of cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Set {
    /// Outdoor views and lights at random.
    Random,
    /// Cases that are made to be hard.
    Hard,
}

impl Set {
    pub(crate) const ALL: [Self; 2] = [Self::Random, Self::Hard];

    /// What tables call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Hard => "hard",
        }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Of bodies.
    pub bodies: Vec<BodyRecord>,
    /// Of matrices.
    pub matrices: Vec<MatrixRecord>,
}

/// Measures it.
///
/// # Errors
///
/// Where two exact results are not the same, which nothing can be compared with then.
pub fn measure(size: Size) -> Result<Measured> {
    let (mut bodies, mut matrices) = (Vec::new(), Vec::new());
    for set in Set::ALL {
        bodies.extend(bodies::measure(size, set)?);
        for kind in Kind::ALL {
            matrices.extend(matrices::measure(size, set, kind)?);
        }
    }
    Ok(Measured { bodies, matrices })
}

/// What is asked, what was compared and how.
const OPENING: &str = "\
What does it cost to compute the same focus body and the same matrix in f32, in f64, in f64 with certified \
bounds, which is the crate, and exactly?

Every arithmetic makes the same body, H = hull(V, l) ∩ S ∩ L, of the same planes: the crate's, in f64, which f32 \
rounds before it begins. *Plain* is one construction written once over all kinds of numbers: the half-spaces of \
the hull by sums of two planes each, without a division, and the scene's box cut by one half-space after \
another, signs as they come. *Grown* is the same with every plane moved outwards by 96 of its own ε of the \
magnitudes of the plane's terms, which is the crate's slack. The crate has a polyhedron of its own, in fixed \
arrays instead of lists, so that its time differs from plain f64's by more than what its bounds cost: what \
growth costs by itself is the difference between plain and grown. All begin with the scene's own body, made \
once. Exact bodies are those of rationals, checked in every case against an oracle that tries all triples of \
planes in integers.

Matrices have square roots, so that rationals cannot hold them: 512 bits stand for exact numbers there. *Random* \
cases are people in a town, under suns, lamps and spots. *Hard* cases are those of the property tests (bodies: \
lights in planes of the view, flat and pointlike scenes, needles of views, everything far out or at other \
scales; no lists, whose bounds are the crate's own choice) and of the table of hard cases (matrices: lights \
through the camera's plane, along the view, far away).";

/// The chapter.
///
/// # Errors
///
/// None are expected: where the figures cannot be written as records.
pub fn chapter(measured: &Measured) -> Result<Chapter> {
    let Measured { bodies, matrices } = measured;
    let bodies_say = Set::ALL.into_iter().flat_map(|set| body_page::findings(bodies, set));
    let matrices_say = Set::ALL.into_iter().flat_map(|set| matrix_page::findings(matrices, set));
    let bodies_show = Set::ALL.into_iter().flat_map(|set| body_page::parts(bodies, set));
    let matrices_show = Set::ALL.into_iter().flat_map(|set| matrix_page::parts(matrices, set));
    Ok(Chapter {
        title: "Arithmetic".to_owned(),
        opening: OPENING.to_owned(),
        findings: bodies_say.chain(matrices_say).collect(),
        parts: bodies_show.chain(matrices_show).collect(),
        raw: vec![Raw::new("arithmetic-bodies", bodies)?, Raw::new("arithmetic-matrices", matrices)?],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chapter::Part;
    use bodies::Arithmetic;
    use matrices::Precision;

    #[test]
    fn everything_is_measured_and_told() {
        let measured = measure(Size::Smoke).expect("exact results agree");
        for record in &measured.bodies {
            assert!(record.cases == 20 && record.time.seconds > 0.0, "{record:?}");
            if matches!(record.arithmetic, Arithmetic::Certified | Arithmetic::Exact) {
                assert!(record.lost_share == 0.0 && record.failures == 0, "{record:?}");
            }
        }
        for record in &measured.matrices {
            assert!(record.cases > 0 && record.time.seconds > 0.0, "{record:?}");
            if matches!(record.precision, Precision::Ours | Precision::Uploaded) {
                assert!(record.unusable_share == 0.0 && record.error_worst < 1e-3, "{record:?}");
            }
        }
        // More digits, smaller errors.
        let body = |arithmetic| {
            let is = |record: &&BodyRecord| record.set == Set::Random && record.arithmetic == arithmetic;
            measured.bodies.iter().find(is).expect("it is measured").lost_worst
        };
        assert!(body(Arithmetic::F32) > body(Arithmetic::F64) && body(Arithmetic::F64) > 0.0);

        let chapter = chapter(&measured).expect("it can be written");
        let tables = chapter.parts.iter().filter_map(|part| match part {
            Part::Table(table) => Some(table),
            Part::Plot(_) => None,
        });
        let mut lines = 0;
        for table in tables {
            assert!(table.lines.iter().all(|line| line.len() == table.columns.len()), "{}", table.caption);
            lines += table.lines.len();
        }
        assert_eq!(lines, measured.bodies.len() + measured.matrices.len());
        assert_eq!(chapter.raw.iter().map(|raw| raw.records.len()).sum::<usize>(), lines);
        assert_eq!(chapter.findings.len(), 12);
    }

    #[test]
    fn sentences_follow_the_figures() {
        let mut measured = measure(Size::Smoke).expect("exact results agree");
        let says = |measured: &Measured, what: &str| {
            let chapter = chapter(measured).expect("it can be written");
            chapter.findings.iter().any(|finding| finding.contains(what))
        };
        let nearly = "On the random cases plain f64 is nearly as good";
        let needed = "On none of the random cases are the crate's exact signs needed";
        assert!(says(&measured, nearly) && says(&measured, needed));
        for record in &mut measured.bodies {
            record.lost_worst = 0.5;
            record.lost_share = 0.25;
        }
        assert!(!says(&measured, nearly) && !says(&measured, needed));
        assert!(says(&measured, "On the random cases plain f64 is not enough"));
        assert!(says(&measured, "25.0 % of the random cases lose something, 0.500 at worst"));
    }
}
