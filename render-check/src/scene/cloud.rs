//! Point clouds as surfaces: each point becomes a small disc in the plane fitted to its neighbours.

use parry3d_f64::math::{Matrix, SymmetricEigen};
use rayon::prelude::*;
use rstar::RTree;
use shadowfit::glam::{DMat3, DVec3};

/// A disc that stands for a point of a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The point.
    pub centre: DVec3,
    /// The unit normal, oriented upwards, as a point cloud does not tell inside from outside.
    pub normal: DVec3,
    /// The radius, in world units.
    pub radius: f64,
}

/// Neighbours that the plane is fitted to.
const NEIGHBOURS: usize = 8;

/// The neighbour whose distance is the spacing: in a square grid, the last of those next to a point.
const LAST_BESIDE: usize = 4;

impl Disc {
    /// The corners of the hexagon that is drawn for the disc, counter-clockwise about its normal, on its rim.
    #[must_use]
    pub fn hexagon(&self) -> [DVec3; 6] {
        let (x, y) = self.normal.any_orthonormal_pair();
        let half_height = 0.75_f64.sqrt();
        let rim = |across: f64, up: f64| self.centre + self.radius * (across * x + up * y);
        [
            rim(1.0, 0.0),
            rim(0.5, half_height),
            rim(-0.5, half_height),
            rim(-1.0, 0.0),
            rim(-0.5, -half_height),
            rim(0.5, -half_height),
        ]
    }

    /// The triangles of a hexagon.
    pub const TRIANGLES: [[u32; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];

    /// The disc of a point among its neighbours, nearest first; `None` where there are too few of them.
    ///
    /// Its normal is the direction of least variance (Hoppe et al. 1992, §3.2). No place of a square grid of
    /// spacing s is farther than s/√2 from a point, so discs of that radius leave no hole; as a hexagon is drawn,
    /// whose inradius is √3/2 of its radius, the radius is s·√(2/3).
    fn among(centre: DVec3, neighbours: &[DVec3]) -> Option<Self> {
        let spacing = neighbours.get(LAST_BESIDE - 1)?.distance(centre);
        let points = || neighbours.iter().chain([&centre]);
        let mean = points().sum::<DVec3>() / (neighbours.len() + 1) as f64;
        // In units of the spacing, so that the eigenvalues are those of a cloud of any size.
        let spread = points().fold(DMat3::ZERO, |sum, point| {
            let off = (point - mean) / spacing;
            sum + DMat3::from_cols(off * off.x, off * off.y, off * off.z)
        });
        let eigen = SymmetricEigen::new(Matrix::from_cols_array(&spread.to_cols_array()));
        // Collinear points have variance in one direction only, which leaves the normal undetermined.
        let in_row = eigen.eigenvalues.y < 1e-9 * eigen.eigenvalues.z;
        let normal = match in_row {
            true => (neighbours[0] - centre).normalize().any_orthonormal_vector(),
            false => DVec3::from_array(eigen.eigenvectors.x_axis.to_array()).normalize_or(DVec3::Y),
        };
        let normal = if normal.y < 0.0 { -normal } else { normal };
        Some(Self { centre, normal, radius: (2.0_f64 / 3.0).sqrt() * spacing })
    }
}

/// The discs of a cloud's points, which must be finite. Coincident points have one disc each; points with too few
/// distinct neighbours have none.
#[must_use]
pub(super) fn discs(points: &[DVec3]) -> Vec<Disc> {
    let tree = RTree::bulk_load(points.iter().map(DVec3::to_array).collect());
    let disc = |point: &DVec3| {
        let nearest = tree.nearest_neighbor_iter_with_distance_2(point.to_array());
        let others = nearest.filter(|&(_, squared)| squared > 0.0).take(NEIGHBOURS);
        let neighbours: Vec<DVec3> = others.map(|(&other, _)| other.into()).collect();
        Disc::among(*point, &neighbours)
    };
    points.par_iter().filter_map(disc).collect()
}

/// Groups discs by proximity into at most `most` each, and passes each group on.
pub(super) fn grouped(discs: &mut [Disc], most: usize, each: &mut impl FnMut(&[Disc])) {
    if discs.len() <= most {
        return each(discs);
    }
    let (min, max) = discs.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), disc| {
        (min.min(disc.centre), max.max(disc.centre))
    });
    let axis = (max - min).max_position();
    let middle = discs.len() / 2;
    discs.select_nth_unstable_by(middle, |a, b| a.centre[axis].total_cmp(&b.centre[axis]));
    let (low, high) = discs.split_at_mut(middle);
    grouped(low, most, each);
    grouped(high, most, each);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square grid of points on a slope, and the slope's normal.
    fn slope(spacing: f64) -> (Vec<DVec3>, DVec3) {
        let normal = DVec3::new(0.3, 0.9, -0.2).normalize();
        let (x, y) = normal.any_orthonormal_pair();
        let steps = || (-10..=10).map(|i| spacing * f64::from(i));
        (steps().flat_map(|i| steps().map(move |j| x * i + y * j)).collect(), normal)
    }

    #[test]
    fn the_discs_of_a_plane_lie_in_it_and_leave_no_hole() {
        for spacing in [1e-3, 1.0, 1e4] {
            let (points, normal) = slope(spacing);
            let discs = discs(&points);
            assert_eq!(discs.len(), points.len());
            for disc in &discs {
                assert!(disc.normal.dot(normal) > 1.0 - 1e-9, "{disc:?}");
            }
            // A disc in the middle: its hexagon covers everything nearer to it than to another.
            let disc = discs[10 * 21 + 10];
            assert!((disc.radius / spacing - (2.0_f64 / 3.0).sqrt()).abs() < 1e-9, "{disc:?}");
            let corners = disc.hexagon();
            for i in 0..6 {
                let (a, b) = (corners[i], corners[(i + 1) % 6]);
                assert!((a - disc.centre).cross(b - disc.centre).dot(disc.normal) > 0.0, "counter-clockwise");
                let to_side = (0.5 * (a + b) - disc.centre).length();
                assert!((to_side / spacing - 0.5_f64.sqrt()).abs() < 1e-9, "{to_side}");
            }
        }
    }

    #[test]
    fn points_in_one_place_and_points_alone_are_no_trouble() {
        assert!(discs(&[]).is_empty());
        assert!(discs(&[DVec3::ONE; 100]).is_empty());
        let (mut points, _) = slope(1.0);
        points.extend([points[0]; 20]);
        let discs = discs(&points);
        assert_eq!(discs.len(), points.len());
        // Collinear points have no normal.
        let row: Vec<DVec3> = (0..30).map(|i| DVec3::X * f64::from(i)).collect();
        for disc in super::discs(&row) {
            assert!(disc.normal.is_normalized() && disc.normal.x.abs() < 1e-6, "{disc:?}");
        }
    }

    #[test]
    fn groups_hold_every_disc_once_and_lie_apart() {
        let (points, _) = slope(1.0);
        let mut discs = discs(&points);
        let all = discs.len();
        let mut groups = Vec::new();
        grouped(&mut discs, 50, &mut |group| groups.push(group.to_vec()));
        assert!(groups.iter().all(|group| (20..=50).contains(&group.len())));
        assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), all);
    }
}
