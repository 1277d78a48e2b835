//! The scene that the card works on: a hilly square of as many triangles as are asked for, all of it in view.

use anyhow::Result;
use render_check::scene::{Mesh, MeshBuilder, Part};
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{InputError, Light, View};

/// Half of its side, in metres.
const HALF: f64 = 50.0;

/// A square of about so many triangles. However many they are, the hills are the same, and they are one object, drawn by one
/// call.
pub(super) fn mesh(triangles: usize) -> Mesh {
    let cells = (0.5 * triangles as f64).sqrt().round().max(1.0) as u32;
    let corner = |index: u32| {
        let [x, z] = [index % (cells + 1), index / (cells + 1)]
            .map(|step| HALF * (2.0 * f64::from(step) / f64::from(cells) - 1.0));
        DVec3::new(x, 3.0 * (0.11 * x).sin() * (0.13 * z + 0.4).cos(), z)
    };
    let positions: Vec<DVec3> = (0..(cells + 1) * (cells + 1)).map(corner).collect();
    let cell = |index: u32| {
        let first = index / cells * (cells + 1) + index % cells;
        let [second, below] = [first + 1, first + cells + 1];
        [[first, below, second], [second, below, below + 1]]
    };
    let triangles: Vec<[u32; 3]> = (0..cells * cells).flat_map(cell).collect();
    let mut builder = MeshBuilder::default();
    let hills = Part { positions: &positions, normals: &[], triangles: &triangles, colour: [0.4; 3] };
    builder.add(&hills, DMat4::IDENTITY);
    builder.finish().0
}

/// A view of all of it.
pub(super) fn view() -> Result<View, InputError> {
    View::perspective((0.0, 110.0, 90.0), (0.0, -110.0, -90.0), (0.0, 1.0, 0.0), 1.0, 1.6, 10.0, 400.0)
}

/// An afternoon's sun.
pub(super) fn sun() -> Result<Light, InputError> {
    Light::directional((0.5, 1.0, 0.35))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_about_as_many_triangles_as_asked_for_and_shows_their_fronts() -> Result<()> {
        let view = view()?;
        for triangles in [1_000, 10_000] {
            let mesh = mesh(triangles);
            assert!(mesh.triangles.len().abs_diff(triangles) < triangles / 20, "{}", mesh.triangles.len());
            assert_eq!(mesh.objects.len(), 1);
            assert!((0..mesh.triangles.len()).all(|triangle| mesh.face_normal(triangle).y > 0.0));
            let in_view = |point: &DVec3| view.planes().iter().all(|plane| plane.at(*point) > 0.0);
            assert!(mesh.vertices.iter().all(in_view), "all of it is in view");
        }
        Ok(())
    }
}
