//! Parsers for numbers on the command line.

use crate::gpu::Bias;

/// Reads `STEPS,SLOPE`.
pub(crate) fn parse_bias(text: &str) -> Result<Bias, String> {
    let wrong = || format!("'{text}' should be a whole number of steps, a comma and a slope: 9,1.5");
    let (constant, slope) = text.split_once(',').ok_or_else(wrong)?;
    let slope = slope.trim().parse().ok().filter(|slope: &f32| slope.is_finite());
    let constant = constant.trim().parse().map_err(|_| wrong())?;
    Ok(Bias { constant, slope: slope.ok_or_else(wrong)? })
}

pub(crate) fn parse_field_of_view(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(degrees) if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err("a field of view is an angle between 0 and 180 degrees".into()),
    }
}

pub(crate) fn parse_angle(text: &str) -> Result<f64, String> {
    let degrees = text.trim().parse().ok().filter(|degrees: &f64| degrees.is_finite());
    degrees.ok_or_else(|| "an angle is a number of degrees".into())
}

pub(crate) fn parse_finite_distance(text: &str) -> Result<f64, String> {
    let distance = parse_distance(text)?;
    if distance.is_finite() { Ok(distance) } else { Err("this distance must have an end".into()) }
}

pub(crate) fn parse_distance(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(distance) if distance > 0.0 => Ok(distance),
        _ => Err("a distance is a number greater than zero".into()),
    }
}
