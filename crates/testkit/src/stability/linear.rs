//! Vectors, covectors and matrices of any of the numbers.

use super::arithmetic::Real;
use shadowfit::glam::{DMat4, DVec3, DVec4};

/// A vector in space.
pub type V3<T> = [T; 3];
/// A homogeneous point, or a covector: normal and offset.
pub type V4<T> = [T; 4];
/// A matrix by its rows.
pub type M4<T> = [V4<T>; 4];

pub fn vector<T: Real>(v: DVec3) -> V3<T> {
    v.to_array().map(T::of)
}

pub fn homogeneous<T: Real>(v: DVec4) -> V4<T> {
    v.to_array().map(T::of)
}

pub fn add<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> [T; N] {
    std::array::from_fn(|i| a[i].clone() + b[i].clone())
}

pub fn sub<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> [T; N] {
    std::array::from_fn(|i| a[i].clone() - b[i].clone())
}

pub fn times<T: Real, const N: usize>(a: &[T; N], factor: &T) -> [T; N] {
    std::array::from_fn(|i| a[i].clone() * factor.clone())
}

pub fn dot<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0].clone() * b[0].clone();
    for i in 1..N {
        sum = sum + a[i].clone() * b[i].clone();
    }
    sum
}

pub fn cross<T: Real>(a: &V3<T>, b: &V3<T>) -> V3<T> {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].clone() * b[k].clone() - a[k].clone() * b[j].clone()
    })
}

pub fn length<T: Real>(a: &V3<T>) -> T {
    dot(a, a).sqrt()
}

pub fn unit<T: Real>(a: &V3<T>) -> V3<T> {
    let length = length(a);
    std::array::from_fn(|i| a[i].clone() / length.clone())
}

/// A covector that is zero at a point and grows along a direction.
pub fn through<T: Real>(normal: &V3<T>, point: &V3<T>) -> V4<T> {
    let [x, y, z] = normal.clone();
    [x, y, z, -dot(normal, point)]
}

/// The covector that is 1 everywhere.
pub fn one<T: Real>() -> V4<T> {
    [0.0, 0.0, 0.0, 1.0].map(T::of)
}

pub fn point<T: Real>(p: &V3<T>) -> V4<T> {
    let [x, y, z] = p.clone();
    [x, y, z, T::of(1.0)]
}

/// A covector at a point.
pub fn at<T: Real>(covector: &V4<T>, p: &V3<T>) -> T {
    dot(covector, &point(p))
}

pub fn product<T: Real>(a: &M4<T>, b: &M4<T>) -> M4<T> {
    let column = |j: usize| -> V4<T> { std::array::from_fn(|i| b[i][j].clone()) };
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&a[i], &column(j))))
}

/// A matrix of f64 by its rows.
pub fn rows_of(matrix: &DMat4) -> M4<f64> {
    [0, 1, 2, 3].map(|row| matrix.row(row).to_array())
}

/// The same matrix, exactly; `None` when an entry is not finite.
pub fn exactly<T: Real, U: Real>(matrix: &M4<T>) -> Option<M4<U>> {
    let finite = matrix.as_flattened().iter().all(|entry| entry.to_f64().is_finite());
    finite.then(|| matrix.each_ref().map(|row| row.each_ref().map(|entry| U::of(entry.to_f64()))))
}
