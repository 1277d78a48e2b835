//! The Pareto front: what nothing else beats in both time and error.

/// The points that no other is below in one coordinate without being above it in the other, by index, from the least x on. Of
/// equal points the first counts. Points that are not finite are beaten by all.
#[must_use]
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let mut order: Vec<usize> =
        (0..points.len()).filter(|&index| points[index].0.is_finite() && points[index].1.is_finite()).collect();
    order.sort_by(|&a, &b| {
        let ((ax, ay), (bx, by)) = (points[a], points[b]);
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(a.cmp(&b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&index| {
        let is_on_it = points[index].1 < least;
        least = least.min(points[index].1);
        is_on_it
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points =
            [(3.0, 1.0), (1.0, 3.0), (2.0, 3.0), (2.0, 2.0), (1.0, 4.0), (4.0, 0.5), (5.0, 0.5), (f64::NAN, 0.0)];
        let on_it = front(&points);
        assert_eq!(on_it, [1, 3, 0, 5]);
        let beats = |a: (f64, f64), b: (f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
        for (index, &point) in points.iter().enumerate().filter(|(_, point)| point.0.is_finite()) {
            let beaten = points.iter().any(|&other| beats(other, point));
            assert_eq!(on_it.contains(&index), !beaten, "{point:?}");
        }
    }
}
