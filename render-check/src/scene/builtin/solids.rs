//! Simple solids for the built-in scenes: turned ones, boxes and cut-out shapes.

use std::f64::consts::TAU;

use shadowfit::glam::{DMat4, DVec2, DVec3, Vec3};

use crate::scene::{MeshBuilder, Part};

/// Facets of a surface of revolution.
const SIDES: u32 = 72;

/// The cosine of the angle between two segments of a profile beyond which their edge is shaded as sharp.
const SHARP_EDGE_COSINE: f64 = 0.7;

/// Adds a solid of revolution about the y axis. The profile runs from bottom to top as (radius, height).
pub(super) fn add_turned(builder: &mut MeshBuilder, profile: &[DVec2], world_from_solid: DMat4, colour: [f32; 3]) {
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    let mut triangles = Vec::new();
    // The outward normal of each segment, in the plane of the profile.
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
            // The last facet ends exactly where the first begins, or the solid would be open along a seam.
            let (sin, cos) = (TAU * f64::from(side % SIDES) / f64::from(SIDES)).sin_cos();
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

/// Adds several boxes, each between its least and its greatest corner, as one object.
pub(super) fn add_boxes(
    builder: &mut MeshBuilder,
    boxes: &[[DVec3; 2]],
    world_from_solid: DMat4,
    colour: [f32; 3],
) {
    /// The corners of each side, counter-clockwise from outside; a bit of a corner's number picks the greater end.
    const SIDES_OF_BOX: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for [min, max] in boxes {
        let first = positions.len() as u32;
        let end = |corner: u32, bit: u32, ends: [f64; 2]| ends[(corner >> bit & 1) as usize];
        positions.extend(
            (0..8).map(|i| {
                DVec3::new(end(i, 0, [min.x, max.x]), end(i, 1, [min.y, max.y]), end(i, 2, [min.z, max.z]))
            }),
        );
        triangles.extend(SIDES_OF_BOX.iter().flat_map(|side| {
            let [a, b, c, d] = side.map(|corner| first + corner);
            [[a, b, c], [a, c, d]]
        }));
    }
    builder.add(&Part { positions: &positions, normals: &[], triangles: &triangles, colour }, world_from_solid);
}

/// Adds several straight round bars as one object. Each is given by its two ends with the radius there, which is
/// not zero. Bars have few facets, as they are meant to be thin.
pub(super) fn add_bars(
    builder: &mut MeshBuilder,
    bars: &[[(DVec3, f64); 2]],
    world_from_solid: DMat4,
    colour: [f32; 3],
) {
    const SIDES_OF_BAR: u32 = 8;
    let mut positions = Vec::new();
    let mut normals = Vec::new();
    let mut triangles = Vec::new();
    for ends in bars {
        let axis = (ends[1].0 - ends[0].0).normalize_or(DVec3::Y);
        let across = axis.any_orthonormal_vector();
        let around = axis.cross(across);
        // Four rings: the foot's disc, the round side's lower and upper edge, the top's disc.
        let first = positions.len() as u32;
        for ((centre, radius), disc) in
            [(ends[0], Some(-axis)), (ends[0], None), (ends[1], None), (ends[1], Some(axis))]
        {
            for side in 0..SIDES_OF_BAR {
                let (sin, cos) = (TAU * f64::from(side) / f64::from(SIDES_OF_BAR)).sin_cos();
                let outward = across * cos + around * sin;
                positions.push(centre + radius * outward);
                normals.push(disc.unwrap_or(outward).as_vec3());
            }
        }
        let corner = |ring: u32, side: u32| first + ring * SIDES_OF_BAR + side % SIDES_OF_BAR;
        for side in 0..SIDES_OF_BAR {
            triangles.push([corner(1, side), corner(1, side + 1), corner(2, side + 1)]);
            triangles.push([corner(1, side), corner(2, side + 1), corner(2, side)]);
        }
        for side in 1..SIDES_OF_BAR - 1 {
            triangles.push([corner(0, 0), corner(0, side + 1), corner(0, side)]);
            triangles.push([corner(3, 0), corner(3, side), corner(3, side + 1)]);
        }
    }
    builder
        .add(&Part { positions: &positions, normals: &normals, triangles: &triangles, colour }, world_from_solid);
}

/// A pseudo-random number from 0 up to 1, a function of an object and one of its properties.
pub(super) fn scattered(thing: u32, property: u32) -> f64 {
    let mut bits = thing.wrapping_mul(0x9e37_79b9) ^ property.wrapping_add(1).wrapping_mul(0x85eb_ca6b);
    for factor in [0x7feb_352d, 0x846c_a68b, 1] {
        bits = (bits ^ (bits >> 16)).wrapping_mul(factor);
    }
    f64::from(bits) / (f64::from(u32::MAX) + 1.0)
}

/// The number of boundary edges of an object: zero where it is watertight. Corners less than 1e-7 apart count as
/// one.
#[cfg(test)]
pub(super) fn open_edges(mesh: &crate::scene::Mesh, object: &crate::scene::Object) -> usize {
    let mut balance = std::collections::HashMap::new();
    for triangle in object.triangles.clone() {
        let corners = mesh.corners(triangle as usize).map(|p| p.to_array().map(|x| (x * 1e7).round() as i64));
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            *balance.entry([corners[a].min(corners[b]), corners[a].max(corners[b])]).or_insert(0) +=
                if corners[a] < corners[b] { 1 } else { -1 };
        }
    }
    balance.values().filter(|&&sum| sum != 0).count()
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

    #[test]
    fn boxes_in_one_object_are_closed_and_face_outwards() {
        let boxes =
            [[DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0)], [DVec3::new(4.0, -1.0, 0.0), DVec3::new(6.0, 0.0, 1.0)]];
        let mut builder = MeshBuilder::default();
        add_boxes(&mut builder, &boxes, DMat4::IDENTITY, [1.0; 3]);
        assert!((volume(builder) - 8.0).abs() < 1e-9);
    }

    #[test]
    fn a_bar_is_closed_and_faces_outwards() {
        let bar = [(DVec3::new(1.0, 2.0, -3.0), 0.2), (DVec3::new(-1.0, 0.5, -3.5), 0.1)];
        let mut builder = MeshBuilder::default();
        add_bars(&mut builder, &[bar], DMat4::IDENTITY, [1.0; 3]);
        let (mesh, _) = builder.finish();
        assert_eq!(open_edges(&mesh, &mesh.objects[0]), 0);
        let middle = 0.5 * (bar[0].0 + bar[1].0);
        for triangle in 0..mesh.triangles.len() {
            let [a, b, c] = mesh.corners(triangle);
            assert!(mesh.face_normal(triangle).dot((a + b + c) / 3.0 - middle) > 0.0, "triangle {triangle}");
        }
    }

    #[test]
    fn scattered_numbers_fill_the_range_evenly() {
        let numbers: Vec<f64> = (0..4000).map(|thing| scattered(thing / 4, thing % 4)).collect();
        assert!(numbers.iter().all(|number| (0.0..1.0).contains(number)));
        for quarter in 0..4 {
            let from = 0.25 * f64::from(quarter);
            let share = numbers.iter().filter(|&&number| (from..from + 0.25).contains(&number)).count();
            assert!((900..1100).contains(&share), "{share} of 1000 from {from}");
        }
    }
}
