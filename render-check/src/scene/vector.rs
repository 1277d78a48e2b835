//! Vectors on the command line.

use shadowfit::glam::DVec3;

/// Reads `X,Y,Z`: three finite numbers.
///
/// # Errors
///
/// A message that names the mistake.
pub fn parse_vector(text: &str) -> Result<DVec3, String> {
    let numbers = text
        .split(',')
        .map(|part| match part.trim().parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => Err(format!("'{part}' in '{text}' is not a number")),
        })
        .collect::<Result<Vec<f64>, String>>()?;
    match numbers[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("'{text}' should be three numbers with commas between: X,Y,Z")),
    }
}
