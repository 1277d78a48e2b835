//! Half-spaces of known bodies.

/// The box between two corners; equal coordinates make it flat.
pub(crate) fn cuboid(min: [f64; 3], max: [f64; 3]) -> Vec<[f64; 4]> {
    (0..3)
        .flat_map(|axis| {
            let mut lower = [0.0, 0.0, 0.0, -min[axis]];
            let mut upper = [0.0, 0.0, 0.0, max[axis]];
            lower[axis] = 1.0;
            upper[axis] = -1.0;
            [lower, upper]
        })
        .collect()
}

/// The unit cube.
pub(crate) fn unit_cube() -> Vec<[f64; 4]> {
    cuboid([0.0; 3], [1.0; 3])
}

/// The tetrahedron below x + y + z = 1 in the positive octant.
pub(crate) fn tetrahedron() -> Vec<[f64; 4]> {
    vec![[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-1.0, -1.0, -1.0, 1.0]]
}

/// The infinite square pyramid |x|, |y| ≤ z, its eye at the origin, from the distance `near` on.
pub(crate) fn infinite_frustum(near: f64) -> Vec<[f64; 4]> {
    vec![
        [1.0, 0.0, 1.0, 0.0],
        [-1.0, 0.0, 1.0, 0.0],
        [0.0, 1.0, 1.0, 0.0],
        [0.0, -1.0, 1.0, 0.0],
        [0.0, 0.0, 1.0, -near],
    ]
}

/// The pyramid's part between two distances.
pub(crate) fn frustum(near: f64, far: f64) -> Vec<[f64; 4]> {
    let mut planes = infinite_frustum(near);
    planes.push([0.0, 0.0, -1.0, far]);
    planes
}
