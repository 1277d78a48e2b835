//! What a view or projection matrix must not hold: each entry by itself, each axis by itself.

use shadowfit::glam::{DMat4, DVec3, DVec4};
use shadowfit::{ClipSpace, Problem, View};

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

fn view(eye_from_world: DMat4, [x, y, z, w]: [DVec4; 4]) -> Result<View, (&'static str, Problem)> {
    let clip_from_eye = DMat4::from_cols(x, y, z, w).transpose();
    View::from_matrices(eye_from_world, clip_from_eye, ClipSpace::WGPU)
        .map_err(|error| (error.field, error.problem))
}

/// The entries that are 0 in both forms and must be, by row and column; in each form there are two more, of the shear that
/// only the other one may have.
#[test]
fn each_entry_that_must_be_zero_is_looked_at() {
    let both = [(0, 1), (1, 0), (2, 0), (2, 1), (3, 0), (3, 1)];
    for (rows, more) in [(perspective(), [(0, 3), (1, 3), (3, 3)]), (orthographic(), [(0, 2), (1, 2), (3, 2)])] {
        assert!(view(DMat4::IDENTITY, rows).is_ok());
        for (row, column) in both.into_iter().chain(more) {
            for value in [0.25, -0.25] {
                let mut rows = rows;
                rows[row][column] = value;
                let found = view(DMat4::IDENTITY, rows);
                assert_eq!(found, Err(("clip_from_eye", Problem::NotAProjection)), "row {row}, column {column}");
            }
        }
    }
}

/// A w that is negative everywhere is no orthographic projection, and one of any size is the same as 1.
#[test]
fn w_of_an_orthographic_projection_is_positive() {
    let scaled = |factor: f64| orthographic().map(|row| row * factor);
    assert_eq!(view(DMat4::IDENTITY, scaled(-1.0)), Err(("clip_from_eye", Problem::NotAProjection)));
    assert_eq!(view(DMat4::IDENTITY, scaled(4.0)), view(DMat4::IDENTITY, orthographic()));
}

/// Rotations, reflections, uniform scales and translations are rigid, and nothing else: each axis may be neither longer
/// nor shorter than the others by more than a thousandth, nor lean towards another by more.
#[test]
fn each_axis_of_a_view_matrix_is_looked_at() {
    let columns = |[x, y, z]: [DVec3; 3]| DMat4::from_cols(x.extend(0.0), y.extend(0.0), z.extend(0.0), DVec4::W);
    let refused = Err(("eye_from_world", Problem::NotRigid));
    for scale in [1.0, 8.0, 0.015_625] {
        for axis in 0..3 {
            for (off, is_rigid) in [(0.000_5, true), (-0.000_5, true), (0.004, false), (-0.004, false)] {
                let mut axes = DVec3::AXES.map(|axis| axis * scale);
                axes[axis] *= 1.0 + off;
                let longer = view(columns(axes), perspective());
                assert_eq!(longer.is_ok(), is_rigid, "axis {axis} by {off}, scale {scale}");
                for other in (0..3).filter(|&other| other != axis) {
                    let mut axes = DVec3::AXES.map(|axis| axis * scale);
                    axes[axis][other] = off * scale;
                    let leaning = view(columns(axes), perspective());
                    assert_eq!(leaning.is_ok(), is_rigid, "axis {axis} to {other} by {off}, scale {scale}");
                }
            }
        }
    }
    for entry in 0..4 {
        let mut matrix = DMat4::IDENTITY;
        *matrix.col_mut(entry) += DVec4::W * 0.25;
        assert_eq!(view(matrix, perspective()), refused, "last row, column {entry}");
    }
}

/// What is left after small errors is orthonormal, and on the side that the matrix had it on.
#[test]
fn axes_become_orthonormal() {
    let leaning = DMat4::from_cols(
        DVec4::new(1.0, 0.000_25, -0.000_125, 0.0),
        DVec4::new(-0.000_5, 1.000_25, 0.000_25, 0.0),
        DVec4::new(0.000_125, 0.000_5, 0.999_75, 0.0),
        DVec4::new(3.0, -2.0, 5.0, 1.0),
    );
    for mirror in [1.0, -1.0] {
        let matrix = DMat4::from_scale(DVec3::new(mirror, 1.0, 1.0)) * leaning;
        let view = view(matrix, perspective()).expect("rigid but for rounding");
        let (right, up, forward) = (view.right(), view.up(), view.forward());
        for (axis, other) in [(right, up), (up, forward), (forward, right)] {
            // Two roundings of a length and three of a product.
            assert!((axis.length() - 1.0).abs() <= 4.0 * f64::EPSILON, "{axis}");
            assert!(axis.dot(other).abs() <= 4.0 * f64::EPSILON, "{axis} {other}");
        }
        // To the thousandth that the matrix was off by.
        for (axis, row) in [(right, matrix.row(0)), (up, matrix.row(1)), (-forward, matrix.row(2))] {
            assert!((axis - row.truncate()).length() <= 0.002, "{axis} {row}");
        }
        // The eye is what the matrix takes to the origin, to the rounding of its entries.
        assert!(matrix.transform_point3(view.eye()).length() <= 32.0 * f64::EPSILON, "{}", view.eye());
    }
}
