//! Vectors and matrices of any library.
//!
//! Every mathematics library converts its vectors into `[f32; 3]` or `[f64; 3]` and its matrices into arrays of four columns.
//! Constructors take those, so that no version of any library is pinned.

use glam::{DMat4, DVec3, Mat4};

/// A vector in f64.
pub(crate) fn vector<F: Into<f64>>(vector: impl Into<[F; 3]>) -> DVec3 {
    DVec3::from(vector.into().map(Into::into))
}

/// A 4×4 matrix for column vectors, of any library, in f32 or f64: an array of four columns, or a type that converts into one.
///
/// | from | as |
/// |---|---|
/// | glam, the version in use | itself |
/// | glam, any other version (Bevy's, parry's) | `matrix.to_cols_array_2d()` |
/// | nalgebra, cgmath, mint's `ColumnMatrix4` | itself |
/// | 16 numbers, column after column | `glam::Mat4::from_cols_array(&numbers)` |
///
/// Results go back the same way: every library's `from` takes `map.caster_matrix().to_cols_array_2d()`.
///
/// The compiler infers `Columns`. A row-major matrix (mint's `RowMatrix4`) converts into an array of its rows, which is the
/// transpose: convert it to columns first.
///
/// ```
/// use shadowfit::{ClipSpace, View, glam::Mat4};
///
/// // The same camera, one metre up, in f64 as arrays and in f32 as glam has it.
/// let view = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 1.0]];
/// let lens = [[0.5, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, -1.0, -1.0], [0.0, 0.0, -0.25, 0.0]];
/// let one = View::from_matrices(view, lens, ClipSpace::WGPU)?;
/// let other = View::from_matrices(
///     Mat4::from_cols_array_2d(&view.map(|column| column.map(|entry| entry as f32))),
///     Mat4::from_cols_array_2d(&lens.map(|column| column.map(|entry| entry as f32))),
///     ClipSpace::WGPU,
/// )?;
/// assert_eq!((one, one.eye().to_array()), (other, [0.0, 1.0, 0.0]));
/// # Ok::<(), shadowfit::InputError>(())
/// ```
pub trait IntoMatrix<Columns> {
    /// The matrix in f64.
    fn into_matrix(self) -> DMat4;
}

impl<F: Into<f64>, M: Into<[[F; 4]; 4]>> IntoMatrix<[[F; 4]; 4]> for M {
    fn into_matrix(self) -> DMat4 {
        DMat4::from_cols_array_2d(&self.into().map(|column| column.map(Into::into)))
    }
}

impl IntoMatrix<Self> for DMat4 {
    fn into_matrix(self) -> DMat4 {
        self
    }
}

impl IntoMatrix<Self> for Mat4 {
    fn into_matrix(self) -> DMat4 {
        self.as_dmat4()
    }
}
