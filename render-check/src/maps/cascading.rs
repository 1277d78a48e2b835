//! Cascades, as asked for on the command line.

use std::fmt;
use std::str::FromStr;

use anyhow::{Context, Result};
use shadowfit::{
    Light, Scene, Settings, View,
    cascades::{CascadeChoice, CascadeSplits, Cascades, SplitScheme},
    seen::Seen,
};

/// How a view is split into cascades, one map each.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Cascading {
    /// The number of cascades, 1 to [`Cascades::MAX`].
    pub count: usize,
    /// The split scheme.
    pub split: SplitArg,
}

/// A split with the command line's spelling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplitArg {
    /// By a scheme.
    Scheme(SplitScheme),
    /// Where the errors at the visible surfaces are least.
    Seen,
}

impl Default for SplitArg {
    /// Logarithmic splits are the best for the depth range of the receivers, as it begins at a visible surface.
    fn default() -> Self {
        Self::Scheme(SplitScheme::Logarithmic)
    }
}

/// The command line's spelling.
impl fmt::Display for SplitArg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scheme(SplitScheme::Uniform) => f.write_str("uniform"),
            Self::Scheme(SplitScheme::Logarithmic) => f.write_str("log"),
            Self::Scheme(SplitScheme::Practical(part)) => write!(f, "practical:{part}"),
            Self::Scheme(other) => unreachable!("the command line has no word for {other:?}"),
            Self::Seen => f.write_str("seen"),
        }
    }
}

impl FromStr for SplitArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let part = |text: &str| text.parse().ok().filter(|part| (0.0..=1.0).contains(part));
        let scheme = match (text, text.strip_prefix("practical:").and_then(part)) {
            ("seen", _) => return Ok(Self::Seen),
            ("uniform", _) => SplitScheme::Uniform,
            ("log", _) => SplitScheme::Logarithmic,
            (_, Some(part)) => SplitScheme::Practical(part),
            _ => return Err("write seen, uniform, log, or practical:PART with the logarithmic part, 0 to 1".into()),
        };
        Ok(Self::Scheme(scheme))
    }
}

impl serde::Serialize for SplitArg {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Where a view is cut.
#[derive(Clone, Copy, Debug)]
pub enum Cuts {
    /// By a scheme, or at given depths.
    Splits(CascadeSplits<'static>),
    /// So many times at most, where the errors at the visible surfaces are least.
    Seen(usize),
}

impl Cascading {
    /// The splits of the receivers' depth range; for stabilised maps, which must not depend on visible surfaces, of
    /// the range between the near and far planes.
    #[must_use]
    pub fn cuts(&self, stay_put: bool) -> Cuts {
        let count = self.count;
        match self.split {
            SplitArg::Seen => Cuts::Seen(count),
            SplitArg::Scheme(split) if stay_put => Cuts::Splits(CascadeSplits::View { count, split }),
            SplitArg::Scheme(split) => Cuts::Splits(CascadeSplits::Visible { count, split }),
        }
    }
}

/// Splits a view into cascades, without blending between them.
///
/// # Errors
///
/// For stabilised cascades of a view with an infinite far plane.
pub fn cascades(
    view: &View,
    light: &Light,
    scene: &Scene<'static>,
    cuts: Cuts,
    seen: &Seen<'static>,
    settings: &Settings,
) -> Result<Cascades<'static>> {
    match cuts {
        Cuts::Splits(cuts) => Cascades::new(view, light, scene, cuts, 0.0)
            .context("the view cannot be cut into cascades; stable cascades need a --far that is not inf"),
        Cuts::Seen(most) => {
            let choice = CascadeChoice { most, enough: ALWAYS_MORE, overlap: 0.0 };
            Ok(Cascades::chosen(view, light, scene, seen, &choice, settings)?)
        }
    }
}

/// An error that no map reaches: as many cascades as are asked for.
const ALWAYS_MORE: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_are_spelled_as_they_are_read() {
        for text in ["seen", "uniform", "log", "practical:0.5", "practical:1"] {
            let split: SplitArg = text.parse().expect(text);
            assert_eq!(split.to_string(), text);
        }
        for wrong in ["", "practical", "practical:", "practical:1.5", "practical:NaN", "logarithmic"] {
            assert!(wrong.parse::<SplitArg>().is_err(), "{wrong}");
        }
    }
}
