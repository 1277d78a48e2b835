//! Messages of errors: field, value, range, hint.

use super::{Expected, InputError, InputErrorKind, MAX_COORDINATE, MIN_DISTANCE};
use core::f64::consts::{FRAC_PI_2, PI};
use core::fmt;

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.field)?;
        if let Some(index) = self.index {
            write!(f, "[{index}]")?;
        }
        if let Some(component) = self.component {
            write!(f, ".{component}")?;
        }
        match (self.problem, self.value, self.expected) {
            (InputErrorKind::NotFinite, Some(value), _) if value.is_nan() => f.write_str(" is NaN"),
            (InputErrorKind::NotFinite, Some(value), _) => write!(f, " must be finite; got {}", Number(value)),
            (InputErrorKind::TooMany, Some(count), Some(Expected::Within { most, .. })) => {
                write!(f, " has {count} elements; at most {most} are allowed")
            }
            (_, _, Some(Expected::NotParallel { field })) => write!(f, " must not be parallel to {field}"),
            (problem, Some(value), Some(expected)) => {
                let got = Number(value);
                match expected {
                    Expected::Within { least, most } => {
                        write!(f, " must lie in [{}, {}]; got {got}", Number(least), Number(most))
                    }
                    Expected::Between { above, below } => {
                        let unit = if problem == InputErrorKind::AngleOutOfRange { " radians" } else { "" };
                        write!(f, " must lie in ({}, {}){unit}; got {got}", Number(above), Number(below))
                    }
                    Expected::Above { field, value } => {
                        write!(f, " ({got}) must be greater than {field} ({})", Number(value))
                    }
                    Expected::Below { field, value } => {
                        write!(f, " ({got}) must be less than {field} ({})", Number(value))
                    }
                    Expected::AtLeast { field, value } => {
                        write!(f, " ({got}) must be no less than {field} ({})", Number(value))
                    }
                    Expected::NotParallel { .. } => write!(f, " {problem}"),
                }
            }
            (problem, ..) => write!(f, " {problem}"),
        }?;
        match self.hint {
            Some(hint) => write!(f, ". {hint}"),
            None => Ok(()),
        }
    }
}

/// A number as one would write it: bounds by their names, the rest in the shorter of the two notations.
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        let names = [
            (f64::INFINITY, "∞"),
            (f64::NEG_INFINITY, "−∞"),
            (PI, "π"),
            (PI - 2.0 * MIN_DISTANCE, "π − 2⁻³⁹"),
            (2.0 * MIN_DISTANCE, "2⁻³⁹"),
            (FRAC_PI_2, "π/2"),
            (-FRAC_PI_2, "−π/2"),
            (FRAC_PI_2 - 1e-9, "π/2 − 1e-9"),
            (MAX_COORDINATE, "2⁴⁰"),
            (-MAX_COORDINATE, "−2⁴⁰"),
            (MIN_DISTANCE, "2⁻⁴⁰"),
        ];
        if let Some((_, name)) = names.iter().find(|(known, _)| *known == value) {
            f.write_str(name)
        } else if value == 0.0 || (1e-4..1e7).contains(&value.abs()) {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}
