//! Cascades, as asked for on the command line.

use std::fmt;
use std::str::FromStr;

use anyhow::{Context, Result};
use shadowfit::{
    Light, Scene, View,
    cascades::{CascadeSplits, Cascades},
};

/// How a view is split into cascades, one map each.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Cascading {
    /// The number of cascades, 1 to [`Cascades::MAX`].
    pub count: usize,
    /// The split scheme.
    pub split: SplitArg,
}

/// A split scheme with the command line's spelling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplitArg(pub shadowfit::cascades::SplitScheme);

impl Default for SplitArg {
    /// Logarithmic splits are the best for the depth range of the receivers, as it begins at a visible surface.
    fn default() -> Self {
        Self(shadowfit::cascades::SplitScheme::Logarithmic)
    }
}

/// The command line's spelling.
impl fmt::Display for SplitArg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            shadowfit::cascades::SplitScheme::Uniform => f.write_str("uniform"),
            shadowfit::cascades::SplitScheme::Logarithmic => f.write_str("log"),
            shadowfit::cascades::SplitScheme::Practical(part) => write!(f, "practical:{part}"),
            other => unreachable!("the command line has no word for {other:?}"),
        }
    }
}

impl FromStr for SplitArg {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let part = |text: &str| text.parse().ok().filter(|part| (0.0..=1.0).contains(part));
        let split = match (text, text.strip_prefix("practical:").and_then(part)) {
            ("uniform", _) => shadowfit::cascades::SplitScheme::Uniform,
            ("log", _) => shadowfit::cascades::SplitScheme::Logarithmic,
            (_, Some(part)) => shadowfit::cascades::SplitScheme::Practical(part),
            _ => return Err("write uniform, log, or practical:PART with the logarithmic part, from 0 to 1".into()),
        };
        Ok(Self(split))
    }
}

impl serde::Serialize for SplitArg {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl Cascading {
    /// The splits of the receivers' depth range; for stabilised maps, which must not depend on visible surfaces, of
    /// the range between the near and far planes.
    #[must_use]
    pub fn cuts(&self, stay_put: bool) -> CascadeSplits<'static> {
        let Self { count, split: SplitArg(split) } = *self;
        if stay_put { CascadeSplits::View { count, split } } else { CascadeSplits::Visible { count, split } }
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
    cuts: CascadeSplits<'static>,
) -> Result<Cascades<'static>> {
    Cascades::new(view, light, scene, cuts, 0.0)
        .context("the view cannot be cut into cascades; stable cascades need a --far that is not inf")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_are_spelled_as_they_are_read() {
        for text in ["uniform", "log", "practical:0.5", "practical:1"] {
            let split: SplitArg = text.parse().expect(text);
            assert_eq!(split.to_string(), text);
        }
        for wrong in ["", "practical", "practical:", "practical:1.5", "practical:NaN", "logarithmic"] {
            assert!(wrong.parse::<SplitArg>().is_err(), "{wrong}");
        }
    }
}
