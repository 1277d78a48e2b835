//! The largest cluster of faults in an image.

use serde::Serialize;
use shadowfit::glam::DVec2;

use super::mark::{Fault, Mark};
use super::truth::{TruthImage, neighbours};

/// Faulty pixels that touch each other, at sides or corners.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cluster {
    /// Their number.
    pub pixels: usize,
    /// The pixel nearest to their centroid: column from the left and row from the top.
    pub centre: [u32; 2],
    /// The surface point of that pixel, in world space.
    pub position: [f64; 3],
    /// The most frequent fault.
    pub fault: Fault,
}

/// The largest cluster of an image, the first from the top among equals; `None` without faults.
pub(super) fn worst_cluster(truth: &TruthImage, marks: &[Mark]) -> Option<Cluster> {
    let largest = largest_patch(truth.size(), marks);
    let width = truth.size()[0] as usize;
    let column_and_row = |index: usize| [(index % width) as u32, (index / width) as u32];
    let place = |index: usize| DVec2::from(column_and_row(index).map(f64::from));
    let middle = largest.iter().map(|&index| place(index)).sum::<DVec2>() / largest.len() as f64;
    let off_middle = |index: usize| place(index).distance_squared(middle);
    let centre = largest.iter().copied().min_by(|&a, &b| off_middle(a).total_cmp(&off_middle(b)))?;
    let count = |fault: Fault| largest.iter().filter(|&&index| marks[index].fault() == Some(fault)).count();
    let fault = [Fault::FalseShadow, Fault::FalseLight, Fault::Missing].into_iter().max_by_key(|&f| count(f))?;
    let position = truth.pixels()[centre].surface()?.point.to_array();
    Some(Cluster { pixels: largest.len(), centre: column_and_row(centre), position, fault })
}

/// The pixel indices of the largest cluster.
fn largest_patch(size: [u32; 2], marks: &[Mark]) -> Vec<usize> {
    let mut is_waiting: Vec<bool> = marks.iter().map(|mark| mark.fault().is_some()).collect();
    let mut largest = Vec::new();
    for start in 0..marks.len() {
        let mut patch = Vec::new();
        if std::mem::take(&mut is_waiting[start]) {
            patch.push(start);
        }
        let mut reached = 0;
        while let Some(&index) = patch.get(reached) {
            reached += 1;
            patch.extend(neighbours(size, index).filter(|&i| std::mem::take(&mut is_waiting[i])));
        }
        if patch.len() > largest.len() {
            largest = patch;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_patch_holds_what_touches_at_sides_and_corners() {
        let drawing = ["#.....", ".#...#", "..#..#", ".....#", "#....."];
        let marks: Vec<Mark> =
            drawing.concat().chars().map(|c| if c == '#' { Mark::FalseShadow } else { Mark::EdgeTexel }).collect();
        assert_eq!(largest_patch([6, 5], &marks), [0, 7, 14]);
        assert!(largest_patch([6, 5], &[Mark::EdgePixel; 30]).is_empty());
    }
}
