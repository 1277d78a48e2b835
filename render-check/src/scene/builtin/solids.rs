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

/// Adds a board with a rectangular opening, between two z coordinates: a wall with a window, a frame. The rectangles
/// are given as their least and greatest corners, and the opening lies inside the outline.
pub(super) fn add_board_with_opening(
    builder: &mut MeshBuilder,
    outline: [DVec2; 2],
    opening: [DVec2; 2],
    [back, front]: [f64; 2],
    world_from_solid: DMat4,
    colour: [f32; 3],
) {
    let corners = |[min, max]: [DVec2; 2]| [min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
    let (outer, inner) = (corners(outline), corners(opening));
    let mut quads = Vec::new();
    for i in 0..4 {
        let j = (i + 1) % 4;
        quads.push([outer[i], outer[j], inner[j], inner[i]].map(|p| p.extend(front)));
        quads.push([outer[j], outer[i], inner[i], inner[j]].map(|p| p.extend(back)));
        // Each pair of corners runs so that the solid lies to its left.
        for [a, b] in [[outer[i], outer[j]], [inner[j], inner[i]]] {
            quads.push([a.extend(front), a.extend(back), b.extend(back), b.extend(front)]);
        }
    }
    add_quads(builder, &quads, world_from_solid, colour);
}

/// Adds a paving slab: a box between two corners whose sides lean in towards its foot by `inset`, so that slabs laid
/// edge to edge share their upper edges but no face.
pub(super) fn add_slab(builder: &mut MeshBuilder, min: DVec3, max: DVec3, inset: f64, colour: [f32; 3]) {
    let ring = |y: f64, inset: f64| {
        let (left, right, far, near) = (min.x + inset, max.x - inset, min.z + inset, max.z - inset);
        [(left, near), (right, near), (right, far), (left, far)].map(|(x, z)| DVec3::new(x, y, z))
    };
    let (foot, top) = (ring(min.y, inset), ring(max.y, 0.0));
    let mut quads = vec![top, [foot[3], foot[2], foot[1], foot[0]]];
    quads.extend([0, 1, 2, 3].map(|i: usize| (i, (i + 1) % 4)).map(|(i, j)| [foot[i], foot[j], top[j], top[i]]));
    add_quads(builder, &quads, DMat4::IDENTITY, colour);
}

/// Adds flat faces of four corners each, counter-clockwise seen from the front, as one part.
fn add_quads(builder: &mut MeshBuilder, quads: &[[DVec3; 4]], world_from_solid: DMat4, colour: [f32; 3]) {
    let first_of_quad = (0..quads.len() as u32).map(|quad| 4 * quad);
    let triangles: Vec<[u32; 3]> =
        first_of_quad.flat_map(|first| [[first, first + 1, first + 2], [first, first + 2, first + 3]]).collect();
    let part = Part { positions: quads.as_flattened(), normals: &[], triangles: &triangles, colour };
    builder.add(&part, world_from_solid);
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
    #[test]
    fn a_board_with_an_opening_is_closed_and_faces_outwards() {
        let rectangle = |min: (f64, f64), max: (f64, f64)| [min, max].map(DVec2::from);
        let mut builder = MeshBuilder::default();
        let (outline, opening) = (rectangle((-1.0, 0.0), (4.0, 3.0)), rectangle((1.0, 1.0), (3.0, 2.5)));
        add_board_with_opening(&mut builder, outline, opening, [5.0, 5.5], DMat4::IDENTITY, [1.0; 3]);
        assert!((volume(builder) - 0.5 * (15.0 - 3.0)).abs() < 1e-9);
    }

    #[test]
    fn a_slab_is_closed_and_faces_outwards() {
        let mut builder = MeshBuilder::default();
        add_slab(&mut builder, DVec3::new(2.0, -0.5, 3.0), DVec3::new(4.0, 0.0, 6.0), 0.5, [1.0; 3]);
        // A frustum between a top of 2 × 3 and a foot of 1 × 2, by the prismatoid's rule with 1.5 × 2.5 in the middle.
        assert!((volume(builder) - 0.5 / 6.0 * (6.0 + 4.0 * 3.75 + 2.0)).abs() < 1e-9);
    }
}
