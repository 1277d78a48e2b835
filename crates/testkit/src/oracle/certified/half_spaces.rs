//! Half-spaces that certainly hold an exact body, and what follows from them.

use std::cmp::Ordering;

use shadowfit::glam::DVec3;

use super::precise::{Precise, admits};
use super::program::{Guess, Program};
use crate::oracle::homogeneous::Homogeneous;
use crate::oracle::scalar::{Scalar, dot};

/// The intersection of a box with half-spaces.
///
/// What lies in hull(C, l) is v + β l for a v in the cone of C and a β ≥ 0. Where the planes aᵢ hold C, a sum Σ λᵢ aᵢ with
/// λᵢ ≥ 0 is at least β Σ λᵢ aᵢ·l there, and so holds the hull if that is not negative: each aᵢ with aᵢ·l ≥ 0, and
///
/// ```text
///     (aᵢ·l) aⱼ − (aⱼ·l) aᵢ        for each two with aᵢ·l > 0 > aⱼ·l.
/// ```
///
/// Whether these are all that bound the hull does not matter here. A plane that such sums show to hold the hull holds
/// it, and one that they do not is left to the exact oracle.
pub struct HalfSpaces {
    min: DVec3,
    max: DVec3,
    sums: Vec<[Precise; 4]>,
    /// The same, rounded.
    rounded: Vec<[f64; 4]>,
}

/// How many of the half-spaces that are most like a plane are tried as its bound.
const TRIED: usize = 2;

impl HalfSpaces {
    /// Of these half-spaces in a box.
    pub fn new(min: DVec3, max: DVec3, planes: &[[f64; 4]]) -> Self {
        let mut body = Self { min, max, sums: Vec::new(), rounded: Vec::new() };
        for plane in planes {
            body.push(plane.map(Precise::new));
        }
        body
    }

    /// Keeps what is in the hull of what `planes` hold and a light. `planes` hold something, and the light's weight is
    /// not negative.
    pub fn meet_hull(&mut self, planes: &[[f64; 4]], light: [f64; 4]) {
        // The plane at infinity holds everything.
        let planes = || planes.iter().copied().chain([[0.0, 0.0, 0.0, 1.0]]);
        let l = light.map(Precise::new);
        let values: Vec<(Precise, Ordering)> = planes().map(|plane| value(plane, &l, light)).collect();
        for (a, (at_a, sign)) in planes().zip(&values) {
            if *sign != Ordering::Less {
                self.push(a.map(Precise::new));
            }
            for (b, (at_b, _)) in planes().zip(&values).filter(|(_, (_, other))| *other == Ordering::Less) {
                if *sign == Ordering::Greater {
                    let (a, b) = (a.map(Precise::new), b.map(Precise::new));
                    self.push(std::array::from_fn(|i| at_a.times(&b[i]).minus(at_b.times(&a[i]))));
                }
            }
        }
    }

    fn push(&mut self, components: [Precise; 4]) {
        let rounded = components.each_ref().map(Precise::value);
        if rounded[..3].iter().any(|component| *component != 0.0) {
            self.rounded.push(rounded);
            self.sums.push(components);
        }
    }

    /// The least and largest coordinates of the box.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        (self.min, self.max)
    }

    /// A number that n·x + offset is certainly not below in the body. One that is `enough` is not improved on.
    pub fn least(&self, plane: [f64; 4], enough: f64) -> f64 {
        let mut best = [(f64::NEG_INFINITY, 0, 0.0); TRIED];
        for (index, &row) in self.rounded.iter().enumerate() {
            let Some(factor) = alike(plane, row) else { continue };
            let rest = std::array::from_fn(|i| plane[i] - factor * row[i]);
            let found = (self.least_in_box(rest), index, factor);
            if let Some(place) = best.iter().position(|known| found.0 > known.0) {
                best[place..].rotate_right(1);
                best[place] = found;
            }
        }
        let certain = |multipliers: &[(usize, f64)]| self.certain(plane, multipliers);
        let direct = best.iter().filter(|found| found.0 > f64::NEG_INFINITY);
        let direct =
            direct.map(|&(_, index, factor)| certain(&[(index, factor)])).fold(f64::NEG_INFINITY, f64::max);
        if direct >= enough {
            return direct;
        }
        match self.program().least(plane) {
            Some(Guess::Least(multipliers)) => direct.max(certain(&multipliers)),
            // No point at all: anything holds.
            Some(Guess::Empty(multipliers)) if self.is_empty_by(&multipliers) => f64::INFINITY,
            _ => direct,
        }
    }

    /// Whether there is certainly no point in the body.
    pub fn is_certainly_empty(&self) -> bool {
        self.program().empty().is_some_and(|multipliers| self.is_empty_by(&multipliers))
    }

    fn program(&self) -> Program {
        Program::new(self.rounded.iter().copied(), self.min, self.max)
    }

    /// Whether a sum of half-spaces is certainly negative all over the box: zero minus it is positive.
    fn is_empty_by(&self, multipliers: &[(usize, f64)]) -> bool {
        !multipliers.is_empty() && self.certain([0.0; 4], multipliers) > 0.0
    }

    /// A number that a plane less a sum of half-spaces is certainly not below in the box.
    fn certain(&self, plane: [f64; 4], multipliers: &[(usize, f64)]) -> f64 {
        let mut rest = plane.map(Precise::new);
        for &(index, factor) in multipliers {
            if !admits(&[factor]) {
                return f64::NEG_INFINITY;
            }
            let factor = Precise::new(factor);
            let components = &self.sums[index];
            rest = std::array::from_fn(|i| rest[i].minus(factor.times(&components[i])));
        }
        let corner: [f64; 3] =
            std::array::from_fn(|i| if rest[i].value() >= 0.0 { self.min[i] } else { self.max[i] });
        let [x, y, z] = corner.map(Precise::new);
        // Where the sign of a component is not certain, the other end of the box may be lower by this.
        let width = (self.max - self.min) * (1.0 + f64::EPSILON);
        let doubt: f64 = (0..3).map(|i| 2.0 * rest[i].error() * width[i]).sum();
        (dot(&rest, &[x, y, z, Precise::new(1.0)]).lower() - doubt * 2.0).next_down()
    }

    /// About the least value in the box.
    fn least_in_box(&self, [x, y, z, offset]: [f64; 4]) -> f64 {
        let least = |component: f64, axis: usize| (component * self.min[axis]).min(component * self.max[axis]);
        least(x, 0) + least(y, 1) + least(z, 2) + offset
    }
}

/// The factor that brings a half-space closest to a plane that it is similar to.
fn alike(plane: [f64; 4], row: [f64; 4]) -> Option<f64> {
    let product = |a: [f64; 4], b: [f64; 4]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (along, plane2, row2) = (product(plane, row), product(plane, plane), product(row, row));
    (along > 0.0 && along * along > 0.99 * plane2 * row2).then(|| along / row2)
}

/// The value of a plane at the light, and its exact sign.
fn value(plane: [f64; 4], l: &[Precise; 4], light: [f64; 4]) -> (Precise, Ordering) {
    let value = dot(&plane.map(Precise::new), l);
    let sign = if value.lower() > 0.0 {
        Ordering::Greater
    } else if value.upper() < 0.0 {
        Ordering::Less
    } else {
        Homogeneous::from_f64(plane).side(&Homogeneous::from_f64(light))
    };
    (value, sign)
}
