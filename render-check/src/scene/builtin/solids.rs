//! Simple solids for the built-in scenes: turned ones, boxes and cut-out shapes.

use std::f64::consts::TAU;

use shadowfit::glam::{DMat4, DVec2, DVec3, Vec3};

use crate::scene::{MeshBuilder, Part};

/// How many flat sides stand for a turned surface.
const SIDES: u32 = 72;

/// The cosine of the angle between two stretches of a profile from which on the edge between them looks sharp.
const SHARP_EDGE_COSINE: f64 = 0.7;

/// Adds a solid of revolution about the y axis. The profile runs from bottom to top as (radius, height).
pub(super) fn add_turned(builder: &mut MeshBuilder, profile: &[DVec2], world_from_solid: DMat4, colour: [f32; 3]) {
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    let mut triangles = Vec::new();
    // The outward normal of each stretch, in the plane of the profile.
    let outward: Vec<DVec2> =
        profile.windows(2).map(|ends| -(ends[1] - ends[0]).perp().normalize_or_zero()).collect();
    let blended = |a: usize, b: Option<&DVec2>| match b {
        Some(b) if outward[a].dot(*b) > SHARP_EDGE_COSINE => (outward[a] + *b).normalize(),
        _ => outward[a],
    };
    for (i, ends) in profile.windows(2).enumerate() {
        let first = positions.len() as u32;
        let end_normals = [blended(i, i.checked_sub(1).map(|j| &outward[j])), blended(i, outward.get(i + 1))];
        for side in 0..=SIDES {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
            for (end, normal) in ends.iter().zip(end_normals) {
                positions.push(DVec3::new(end.x * cos, end.y, end.x * sin));
                normals.push(DVec3::new(normal.x * cos, normal.y, normal.x * sin).as_vec3());
            }
        }
        for side in 0..SIDES {
            let (low, high) = (first + 2 * side, first + 2 * side + 1);
            // Where an end lies on the axis, one of the two has no area.
            if ends[1].x > 0.0 {
                triangles.push([low, high, high + 2]);
            }
            if ends[0].x > 0.0 {
                triangles.push([low, high + 2, low + 2]);
            }
        }
    }
    builder
        .add(&Part { positions: &positions, normals: &normals, triangles: &triangles, colour }, world_from_solid);
}

/// Adds a box between two corners.
pub(super) fn add_box(
    builder: &mut MeshBuilder,
    min: DVec3,
    max: DVec3,
    world_from_solid: DMat4,
    colour: [f32; 3],
) {
    let outline = [[min.x, max.x], [min.x, max.x]];
    let rows: Vec<[DVec2; 2]> =
        outline.iter().zip([min.y, max.y]).map(|(ends, y)| ends.map(|x| DVec2::new(x, y))).collect();
    add_cut_out(builder, &rows, [min.z, max.z], world_from_solid, colour);
}

/// Adds a shape cut out of a board that lies between two z coordinates. The outline is given as rows from bottom to
/// top, each with its left and its right end.
pub(super) fn add_cut_out(
    builder: &mut MeshBuilder,
    rows: &[[DVec2; 2]],
    [back, front]: [f64; 2],
    world_from_solid: DMat4,
    colour: [f32; 3],
) {
    let mut positions: Vec<DVec3> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let mut add_quad = |corners: [DVec3; 4]| {
        let first = positions.len() as u32;
        positions.extend(corners);
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    };
    for pair in rows.windows(2) {
        let [[low_left, low_right], [high_left, high_right]] = [pair[0], pair[1]];
        add_quad([low_left, low_right, high_right, high_left].map(|p| p.extend(front)));
        add_quad([low_right, low_left, high_left, high_right].map(|p| p.extend(back)));
        add_quad([
            low_right.extend(front),
            low_right.extend(back),
            high_right.extend(back),
            high_right.extend(front),
        ]);
        add_quad([low_left.extend(back), low_left.extend(front), high_left.extend(front), high_left.extend(back)]);
    }
    if let (Some([low_left, low_right]), Some([high_left, high_right])) = (rows.first(), rows.last()) {
        add_quad([low_left.extend(back), low_right.extend(back), low_right.extend(front), low_left.extend(front)]);
        add_quad([
            high_left.extend(front),
            high_right.extend(front),
            high_right.extend(back),
            high_left.extend(back),
        ]);
    }
    let flat: [Vec3; 0] = [];
    builder.add(&Part { positions: &positions, normals: &flat, triangles: &triangles, colour }, world_from_solid);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice six times the volume is the sum over the triangles; positive where the fronts face outwards.
    fn volume(builder: MeshBuilder) -> f64 {
        let (mesh, left_out) = builder.finish();
        assert!(left_out.is_nothing(), "{left_out}");
        (0..mesh.triangles.len()).map(|t| mesh.corners(t)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn a_turned_cylinder_is_closed_and_faces_outwards() {
        let profile = [(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
        let mut builder = MeshBuilder::default();
        add_turned(&mut builder, &profile, DMat4::IDENTITY, [1.0; 3]);
        let polygon_area = f64::from(SIDES) / 2.0 * (TAU / f64::from(SIDES)).sin();
        assert!((volume(builder) - 2.0 * polygon_area).abs() < 1e-9);
    }

    #[test]
    fn turned_normals_agree_with_the_winding() {
        let profile = [(0.0, 0.0), (1.0, 0.2), (0.5, 1.0), (0.0, 1.2)].map(DVec2::from);
        let mut builder = MeshBuilder::default();
        add_turned(&mut builder, &profile, DMat4::IDENTITY, [1.0; 3]);
        let (mesh, _) = builder.finish();
        for triangle in 0..mesh.triangles.len() {
            let stored = mesh.normals[mesh.triangles[triangle][1] as usize].as_dvec3();
            assert!(stored.dot(mesh.face_normal(triangle)) > 0.6, "triangle {triangle}");
        }
    }

    #[test]
    fn a_box_is_closed_and_faces_outwards() {
        let mut builder = MeshBuilder::default();
        add_box(&mut builder, DVec3::new(-1.0, 2.0, 3.0), DVec3::new(1.0, 5.0, 7.0), DMat4::IDENTITY, [1.0; 3]);
        assert!((volume(builder) - 24.0).abs() < 1e-9);
    }
}
