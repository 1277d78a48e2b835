//! What a view or projection matrix may hold: each entry by itself, each axis by itself.

use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{
    ClipSpace, View,
    input::{InputErrorKind, Lens},
};

/// A projection as rows, depth from 0 to 1: with w = −z, or with w = 1.
fn perspective() -> [DVec4; 4] {
    [
        DVec4::new(1.0, 0.0, 0.125, 0.0),
        DVec4::new(0.0, 1.5, -0.25, 0.0),
        DVec4::new(0.0, 0.0, -1.0625, -0.5),
        DVec4::new(0.0, 0.0, -1.0, 0.0),
    ]
}

fn orthographic() -> [DVec4; 4] {
    [
        DVec4::new(0.5, 0.0, 0.0, 0.25),
        DVec4::new(0.0, 0.75, 0.0, -0.125),
        DVec4::new(0.0, 0.0, -0.0625, 0.5),
        DVec4::new(0.0, 0.0, 0.0, 1.0),
    ]
}

fn matrix([x, y, z, w]: [DVec4; 4]) -> DMat4 {
    DMat4::from_cols(x, y, z, w).transpose()
}

fn view(eye_from_world: DMat4, rows: [DVec4; 4]) -> Result<View, (&'static str, InputErrorKind)> {
    View::from_matrices(eye_from_world, matrix(rows), ClipSpace::WGPU).map_err(|error| (error.field, error.problem))
}

/// Asserts that a view is that of a matrix from world to clip space: what the matrix has inside of its clip volume is inside
/// of all planes, and what it has outside is outside of one, at points a part of 10⁻⁹ to either side of each corner.
fn assert_holds(view: &View, clip_from_world: DMat4) {
    let inverse = clip_from_world.inverse();
    let planes = view.planes();
    for corner in 0..8 {
        let sign = |bit: u32| if corner >> bit & 1 == 0 { -1.0 } else { 1.0 };
        // Where w is not positive the corner is beyond the far plane at infinity.
        let at = DVec4::new(sign(0), sign(1), 0.5 + 0.5 * sign(2), 1.0);
        if (inverse * at).w <= 0.0 {
            continue;
        }
        for side in [-1e-9, 1e-9] {
            let (x, y) = (sign(0) * (1.0 + side), sign(1) * (1.0 + side));
            let z = 0.5 + 0.5 * sign(2) * (1.0 + side);
            let point = inverse.project_point3(DVec3::new(x, y, z));
            let is_inside = planes.iter().all(|plane| plane.at(point) >= 0.0);
            assert_eq!(
                is_inside,
                side < 0.0,
                "corner {corner}, {side:e}: {point}, {:?}",
                planes.iter().map(|plane| plane.at(point)).collect::<Vec<_>>()
            );
        }
    }
}

/// Every entry may be anything that leaves a camera: images turn and shear, near planes lean, lines of sight meet elsewhere.
#[test]
fn each_entry_may_be_anything() {
    for (rows, entries) in [(perspective(), 16), (orthographic(), 12)] {
        for (row, column) in (0..entries).map(|entry| (entry / 4, entry % 4)) {
            for value in [0.031_25, -0.031_25] {
                let mut rows = rows;
                rows[row][column] += value;
                let of_both = view(DMat4::IDENTITY, rows).expect("a camera");
                assert_holds(&of_both, matrix(rows));
                let of_one = View::from_clip_from_world(matrix(rows), ClipSpace::WGPU).expect("a camera");
                assert_holds(&of_one, matrix(rows));
            }
        }
    }
}

/// Where w varies along parallel lines of sight they meet in an eye; where it varies across them there is none.
#[test]
fn the_last_row_decides_where_lines_of_sight_meet() {
    let with = |column: usize, value: f64| {
        let mut rows = orthographic();
        rows[3][column] = value;
        view(DMat4::IDENTITY, rows)
    };
    for value in [0.031_25, -0.031_25] {
        assert_eq!(with(0, value), Err(("clip_from_eye", InputErrorKind::NotAProjection)));
        assert_eq!(with(1, value), Err(("clip_from_eye", InputErrorKind::NotAProjection)));
    }
    let view = with(2, -0.031_25).expect("a camera");
    assert_eq!((view.lens(), view.near(), view.far()), (Lens::Perspective, 24.0, 48.0));
    assert!((view.eye() - DVec3::new(-0.5, 1.0 / 6.0, 32.0)).length() < 1e-14, "{}", view.eye());
    // The other way round the near plane is beyond the far one.
    assert_eq!(with(2, 0.031_25), Err(("clip", InputErrorKind::LooksReversed)));
}

/// A w that is negative everywhere is no orthographic projection, and one of any size is the same as 1.
#[test]
fn w_of_an_orthographic_projection_is_positive() {
    let scaled = |factor: f64| orthographic().map(|row| row * factor);
    assert_eq!(view(DMat4::IDENTITY, scaled(-1.0)), Err(("clip_from_eye", InputErrorKind::NotAProjection)));
    assert_eq!(view(DMat4::IDENTITY, scaled(4.0)), view(DMat4::IDENTITY, orthographic()));
}

/// An image whose sides are at right angles has axes that are, to the last bit; one that is sheared has axes across its sides.
/// The eye is what the matrix takes to the origin, and the corners are where the matrices have them.
#[test]
fn axes_of_views_that_are_not_rigid() {
    for off in [0.25, 0.004, 0.000_5, 1e-5] {
        for (row, column) in (0..9).map(|entry| (entry / 3, entry % 3)) {
            for (lens, rows) in [(Lens::Perspective, perspective()), (Lens::Orthographic, orthographic())] {
                let mut turned = DMat4::from_rotation_y(0.7) * DMat4::from_rotation_x(-0.4);
                turned.col_mut(column)[row] += off;
                let eye_from_world = turned * DMat4::from_translation(DVec3::new(-3.0, 2.0, 5.0));
                // Three times as large it is the same camera, and no matrix of f32.
                let view = view(eye_from_world, rows.map(|row| row / 3.0)).expect("a camera");
                assert_eq!(view.lens(), lens);
                assert!((view.eye() - DVec3::new(3.0, -2.0, -5.0)).length() < 1e-13, "{}", view.eye());
                for (axis, other) in [(view.right(), view.forward()), (view.up(), view.forward())] {
                    assert!((axis.length() - 1.0).abs() <= 4.0 * f64::EPSILON, "{axis}");
                    assert!(axis.dot(other).abs() <= 8.0 * f64::EPSILON, "{axis} {other}");
                }
                assert_holds(&view, matrix(rows) * eye_from_world);
            }
        }
    }
}

/// Roundings of a rotation are made good: what is left is orthonormal, and on the side that the matrix had it on.
#[test]
fn axes_become_orthonormal() {
    let turn = DMat4::from_rotation_y(0.7) * DMat4::from_rotation_x(-0.4) * DMat4::from_rotation_z(2.1);
    for mirror in [1.0, -1.0] {
        let matrix = (DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0)) * turn).as_mat4().as_dmat4();
        let view = view(matrix, perspective()).expect("rigid but for rounding");
        let (right, up, forward) = (view.right(), view.up(), view.forward());
        for (axis, other) in [(right, up), (up, forward), (forward, right)] {
            // Two roundings of a length and three of a product.
            assert!((axis.length() - 1.0).abs() <= 4.0 * f64::EPSILON, "{axis}");
            assert!(axis.dot(other).abs() <= 4.0 * f64::EPSILON, "{axis} {other}");
        }
        for (axis, row) in [(right, matrix.row(0)), (up, matrix.row(1)), (-forward, matrix.row(2))] {
            assert!((axis - row.truncate()).length() <= 4.0 * f64::from(f32::EPSILON), "{axis} {row}");
        }
    }
}
