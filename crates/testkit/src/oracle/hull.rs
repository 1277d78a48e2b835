//! The half-spaces of conv(V ∪ {l}), from the vertices of V.

use super::cone::{Ray, generators};
use super::homogeneous::{ExactPlane, ExactPoint, Homogeneous};

/// The half-spaces of the closed convex hull of the view V and the light l.
///
/// `view` holds the half-spaces of V, `[nx, ny, nz, offset]` with n·x + offset ≥ 0 inside; V may
/// be unbounded. `light` is `[x, y, z, 1]` for a point and `[x, y, z, 0]` for the direction
/// towards a light at infinity, whose hull is V extended by the rays towards it.
///
/// The half-spaces are the facets of the hull where it has a volume, without repetition; a flat
/// hull has its affine hull as opposite pairs. No half-space is left when the hull is all of
/// space. An empty view has an empty hull, whatever the light: there is nothing to shadow.
pub fn hull(view: &[[f64; 4]], light: [f64; 4]) -> Vec<ExactPlane> {
    assert!(light[3] >= 0.0, "a light's weight is not negative");
    let planes: Vec<ExactPlane> = view.iter().copied().map(Homogeneous::from_f64).collect();
    let mut points: Vec<ExactPoint> = homogeneous_vertices(&planes).into_iter().map(|ray| ray.vector).collect();
    if points.iter().all(|point| point.w().is_zero()) {
        return vec![nothing()];
    }
    points.push(Homogeneous::from_f64(light));
    facets(&points)
}

/// Finite vertices and directions at infinity whose convex hull is the closed intersection of the
/// half-spaces. When it is empty, at most directions remain.
pub fn homogeneous_vertices(planes: &[ExactPlane]) -> Vec<Ray> {
    let infinity = Homogeneous::from_f64([0.0, 0.0, 0.0, 1.0]);
    let mut rays = generators(&[planes, &[infinity]].concat());
    for ray in &mut rays {
        ray.tight.retain(|&index| index < planes.len());
    }
    rays
}

/// The half-space that holds no finite point.
fn nothing() -> ExactPlane {
    Homogeneous::from_f64([0.0, 0.0, 0.0, -1.0])
}

/// The half-spaces of the hull of points.
pub fn facets(points: &[ExactPoint]) -> Vec<ExactPlane> {
    // The plane at infinity, which has none, bounds every set of points.
    let has_normal = |plane: &ExactPlane| plane.xyz().iter().any(|component| !component.is_zero());
    generators(points).into_iter().map(|ray| ray.vector).filter(has_normal).collect()
}
