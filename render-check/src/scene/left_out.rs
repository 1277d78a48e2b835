//! Counts of what a loader left out.

use std::fmt;

/// What a loader left out of a scene, by count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// Triangles with an index beyond the vertices.
    pub out_of_range: usize,
    /// Duplicate triangles, with the same corners in the same order.
    pub twice: usize,
    /// Triangles with a vertex that is not finite.
    pub not_finite: usize,
    /// Triangles with a coordinate beyond [`shadowfit::input::MAX_COORDINATE`].
    pub too_large: usize,
    /// Triangles without area.
    pub flat: usize,
    /// Points that are not finite, too large, or have too few neighbours.
    pub points: usize,
    /// Primitives made of lines, strips or fans.
    pub other_primitives: usize,
    /// Cameras that are not used: all but the first valid perspective camera.
    pub cameras: usize,
    /// Invalid lights.
    pub lights: usize,
}

impl LeftOut {
    /// Whether nothing was left out.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<String> = [
            (self.flat, "triangle(s) without area"),
            (self.twice, "triangle(s) that are there twice"),
            (self.not_finite, "triangle(s) with a vertex that is not a finite number"),
            (self.too_large, "triangle(s) with a coordinate beyond 2^40"),
            (self.out_of_range, "triangle(s) with an index beyond the vertices"),
            (self.points, "point(s) that are not a number or too large or have too few others around them"),
            (
                self.other_primitives,
                "primitive(s) that are neither triangle lists nor points (lines, strips, fans)",
            ),
            (self.cameras, "camera(s) that are further ones, orthographic, or make no sense"),
            (self.lights, "light(s) with a direction, cone or range that makes no sense"),
        ]
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
        write!(f, "left out: {}", parts.join(", "))
    }
}
