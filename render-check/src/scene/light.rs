//! Lights in the command line's spelling.

use std::fmt;
use std::str::FromStr;

use anyhow::{Context, Result};
use shadowfit::Light;
use shadowfit::glam::DVec3;

use super::vector::parse_vector;

/// A light as given on the command line or in a file, not yet validated.
///
/// The spelling is `KIND:…` with the parts of a light separated by `/`:
/// `sun:X,Y,Z`, `point:X,Y,Z[/RANGE]`, `spot:X,Y,Z/TX,TY,TZ/DEGREES[/RANGE]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSpec {
    /// A directional light.
    Sun {
        /// The direction towards the light; of any length but zero.
        direction_to_light: DVec3,
    },
    /// A point light.
    Point {
        /// Its position, in world space.
        position: DVec3,
        /// Its range, in world units; may be infinite.
        range: f64,
    },
    /// A spot light.
    Spot {
        /// Its position, in world space.
        position: DVec3,
        /// A point on the cone's axis, in world space.
        target: DVec3,
        /// The full cone angle, in degrees, between 0 and 180.
        cone_degrees: f64,
        /// Its range, in world units; may be infinite.
        range: f64,
    },
}

impl LightSpec {
    /// `sun`, `point` or `spot`: the word used in spellings, tables and file names.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sun { .. } => "sun",
            Self::Point { .. } => "point",
            Self::Spot { .. } => "spot",
        }
    }

    /// Its position; `None` for a directional light.
    #[must_use]
    pub fn position(&self) -> Option<DVec3> {
        match *self {
            Self::Sun { .. } => None,
            Self::Point { position, .. } | Self::Spot { position, .. } => Some(position),
        }
    }

    /// Its range, in world units; infinite for a sun.
    #[must_use]
    pub fn range(&self) -> f64 {
        match *self {
            Self::Sun { .. } => f64::INFINITY,
            Self::Point { range, .. } | Self::Spot { range, .. } => range,
        }
    }

    /// The same light with `moved` applied to its position and target.
    #[must_use]
    pub fn with_position(&self, moved: impl Fn(DVec3) -> DVec3) -> Self {
        match *self {
            Self::Sun { .. } => *self,
            Self::Point { position, range } => Self::Point { position: moved(position), range },
            Self::Spot { position, target, cone_degrees, range } => {
                Self::Spot { position: moved(position), target: moved(target), cone_degrees, range }
            }
        }
    }

    /// The light for `shadowfit`. `near` is the near plane of point and spot lights, in world units; a sun has
    /// none.
    ///
    /// # Errors
    ///
    /// When `shadowfit` rejects it: a zero direction, an invalid cone, a range below `near`.
    pub fn to_light(&self, near: f64) -> Result<Light> {
        match *self {
            Self::Sun { direction_to_light } => Light::directional(direction_to_light),
            Self::Point { position, range } => Light::point(position, near, range),
            Self::Spot { position, target, cone_degrees, range } => {
                let half_angle = 0.5 * cone_degrees.to_radians();
                Light::spot(position, target - position, half_angle, near, range)
            }
        }
        .with_context(|| format!("the light {self} cannot be used"))
    }
}

/// The spelling that [`FromStr`] reads, with numbers rounded to four decimals, as those of files are long.
impl fmt::Display for LightSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let round = |v: DVec3| {
            let [x, y, z] = v.to_array().map(|x| (x * 1e4).round() / 1e4 + 0.0);
            format!("{x},{y},{z}")
        };
        let range = match *self {
            Self::Point { range, .. } | Self::Spot { range, .. } if range.is_finite() => {
                format!("/{range}")
            }
            _ => String::new(),
        };
        match *self {
            Self::Sun { direction_to_light } => write!(f, "sun:{}", round(direction_to_light)),
            Self::Point { position, .. } => write!(f, "point:{}{range}", round(position)),
            Self::Spot { position, target, cone_degrees, .. } => {
                let cone_degrees = (cone_degrees * 1e2).round() / 1e2;
                write!(f, "spot:{}/{}/{cone_degrees}{range}", round(position), round(target))
            }
        }
    }
}

impl FromStr for LightSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const SPELLINGS: &str =
            "write sun:X,Y,Z (towards the sun), point:X,Y,Z[/RANGE] or spot:X,Y,Z/TX,TY,TZ/DEGREES[/RANGE]";
        let (kind, rest) =
            text.split_once(':').ok_or_else(|| format!("no ':' after the kind of light; {SPELLINGS}"))?;
        let parts: Vec<&str> = rest.split('/').collect();
        match (kind, parts.as_slice()) {
            ("sun", [direction]) => {
                let direction_to_light = parse_vector(direction)?;
                if direction_to_light == DVec3::ZERO {
                    return Err("a sun needs a direction: 0,0,0 points nowhere".into());
                }
                Ok(Self::Sun { direction_to_light })
            }
            ("point", [position, range @ ..]) if range.len() <= 1 => {
                Ok(Self::Point { position: parse_vector(position)?, range: parse_range(range)? })
            }
            ("spot", [position, target, degrees, range @ ..]) if range.len() <= 1 => {
                let (position, target) = (parse_vector(position)?, parse_vector(target)?);
                if position == target {
                    return Err("a spot's target must be apart from its position".into());
                }
                let cone_degrees: f64 =
                    degrees.trim().parse().map_err(|_| format!("'{degrees}' is not an angle in degrees"))?;
                if !(cone_degrees > 0.0 && cone_degrees < 180.0) {
                    return Err(format!(
                        "a spot's cone is its full angle, between 0 and 180 degrees, not {cone_degrees}"
                    ));
                }
                Ok(Self::Spot { position, target, cone_degrees, range: parse_range(range)? })
            }
            ("sun" | "point" | "spot", _) => Err(format!("a {kind} has other parts; {SPELLINGS}")),
            _ => Err(format!("'{kind}' is no kind of light; {SPELLINGS}")),
        }
    }
}

fn parse_range(parts: &[&str]) -> Result<f64, String> {
    match parts {
        [] => Ok(f64::INFINITY),
        [text, ..] => match text.trim().parse::<f64>() {
            Ok(range) if range > 0.0 => Ok(range),
            _ => Err(format!("'{text}' is not a range: a distance greater than zero, or inf")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        text.parse::<LightSpec>().expect_err(text)
    }

    #[test]
    fn every_spelling_reads_and_prints_back() {
        for text in
            ["sun:0.5,1,-0.35", "point:1,2,3", "point:1,2,3/20", "spot:0,4,0/1,0,-1/40", "spot:0,4,0/1,0,-1/40/9"]
        {
            let light: LightSpec = text.parse().expect(text);
            assert_eq!(light.to_string(), text);
        }
    }

    #[test]
    fn parts_land_where_they_belong() {
        let light: LightSpec = "spot: 0, 4, 0 / 1,0,-1 / 40 / 9".parse().expect("spaces are allowed");
        let expected = LightSpec::Spot {
            position: DVec3::new(0.0, 4.0, 0.0),
            target: DVec3::new(1.0, 0.0, -1.0),
            cone_degrees: 40.0,
            range: 9.0,
        };
        assert_eq!(light, expected);
        assert_eq!(
            "point:1,2,3".parse(),
            Ok(LightSpec::Point { position: DVec3::new(1.0, 2.0, 3.0), range: f64::INFINITY })
        );
    }

    #[test]
    fn a_wrong_spelling_is_told_the_right_one() {
        assert!(refusal("1,2,3").contains("no ':'"));
        assert!(refusal("moon:1,2,3").contains("'moon' is no kind of light"));
        assert!(refusal("sun:1,2,3/4").contains("sun:X,Y,Z"));
        assert!(refusal("spot:1,2,3").contains("spot:X,Y,Z/TX,TY,TZ/DEGREES"));
    }

    #[test]
    fn a_wrong_number_is_named() {
        assert!(refusal("sun:1,2").contains("three numbers"));
        assert!(refusal("sun:1,two,3").contains("'two'"));
        assert!(refusal("sun:0,0,0").contains("points nowhere"));
        assert!(refusal("sun:1,NaN,3").contains("'NaN'"));
        assert!(refusal("point:1,2,3/-4").contains("'-4' is not a range"));
        assert!(refusal("spot:1,2,3/4,5,6/wide").contains("'wide'"));
        assert!(refusal("spot:1,2,3/4,5,6/180").contains("between 0 and 180"));
        assert!(refusal("spot:1,2,3/1,2,3/40").contains("apart"));
    }
}
