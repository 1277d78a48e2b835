//! Boxes in groups of neighbours, so that most are passed over without a look at each.

use crate::convex::Plane;
use crate::focus::farthest_corner;
use crate::input::scene::Aabb;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// Boxes with their names, in groups with a box around each.
#[derive(Clone, Debug, Default)]
pub(super) struct Groups {
    ids: Vec<u32>,
    boxes: Vec<Aabb>,
    /// Around each group of [`Self::SIZE`] boxes in turn.
    bounds: Vec<Aabb>,
}

impl Groups {
    /// Large enough that a scene of ten thousand boxes has few hundred groups, small enough that a group met by a point light
    /// is mostly met by it.
    const SIZE: usize = 32;

    /// Boxes sorted along a curve that keeps neighbours together (Morton 1966).
    pub(super) fn sorted(mut named: Vec<(u32, Aabb)>) -> Self {
        let around = around(named.iter().map(|(_, one)| one));
        let place = |one: &Aabb| {
            // From 0 to 1 across the scene; NaN where it has no extent, which is cast to 0.
            let part = ((one.min + one.max) * 0.5 - around.min) / (around.max - around.min);
            morton((part * 1023.0).to_array().map(|part| part as u32))
        };
        named.sort_by_cached_key(|(id, one)| (place(one), *id));
        Self::new(named.into_iter())
    }

    /// Boxes in an order that has neighbours together already.
    pub(super) fn new(named: impl Iterator<Item = (u32, Aabb)>) -> Self {
        let (ids, boxes): (Vec<u32>, Vec<Aabb>) = named.unzip();
        let bounds = boxes.chunks(Self::SIZE).map(|group| around(group.iter())).collect();
        Self { ids, boxes, bounds }
    }

    /// Passes each box that is not wholly outside of one of the planes, and its name, to `each`.
    pub(super) fn for_each_inside(&self, planes: &[Plane], mut each: impl FnMut(u32, &Aabb)) {
        for ((bounds, ids), boxes) in
            self.bounds.iter().zip(self.ids.chunks(Self::SIZE)).zip(self.boxes.chunks(Self::SIZE))
        {
            if meets(bounds, planes) {
                for (&id, one) in ids.iter().zip(boxes) {
                    if meets(one, planes) {
                        each(id, one);
                    }
                }
            }
        }
    }
}

/// Whether a box is not wholly outside of one of the planes.
pub(super) fn meets(one: &Aabb, planes: &[Plane]) -> bool {
    let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
    planes.iter().all(|plane| plane.at(farthest_corner(min, max, plane.normal)) >= 0.0)
}

/// Planes moved outwards by what rounding can do to a box no farther out than `extent`.
pub(super) fn loosened(planes: &[Plane], extent: DVec3) -> Vec<Plane> {
    planes.iter().map(|plane| plane.loosened(extent)).collect()
}

fn around<'a>(boxes: impl Iterator<Item = &'a Aabb>) -> Aabb {
    boxes.fold(Aabb::new(Vec3::INFINITY, Vec3::NEG_INFINITY), |all, one| {
        Aabb::new(all.min.min(one.min), all.max.max(one.max))
    })
}

/// The bits of three numbers of ten bits, one of each in turn.
fn morton([x, y, z]: [u32; 3]) -> u32 {
    let spread = |bits: u32| {
        let bits = (bits | bits << 16) & 0x0300_00ff;
        let bits = (bits | bits << 8) & 0x0300_f00f;
        let bits = (bits | bits << 4) & 0x030c_30c3;
        (bits | bits << 2) & 0x0924_9249
    };
    spread(x) | spread(y) << 1 | spread(z) << 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_taken_in_turn() {
        assert_eq!(morton([1023, 0, 0]), 0x0924_9249);
        assert_eq!(morton([0b11, 0b01, 0b10]), 0b101_011);
        assert_eq!(morton([1023; 3]), 0x3fff_ffff);
    }

    /// A grid of boxes, some of which a slanted plane and a second one leave.
    #[test]
    fn groups_pass_over_none_that_is_inside() {
        let boxes: Vec<(u32, Aabb)> = (0..4000)
            .map(|id| {
                let min = Vec3::from([id % 20, id / 20 % 20, id / 400].map(|place| place as f32));
                (id, Aabb::new(min, min + 0.5))
            })
            .collect();
        let planes = [Plane::new(DVec3::new(1.0, 2.0, -0.5), -21.3), Plane::new(DVec3::NEG_Z, 4.2)];
        let expected: Vec<u32> = boxes.iter().filter(|(_, one)| meets(one, &planes)).map(|(id, _)| *id).collect();
        assert!(expected.len() > 500 && expected.len() < 3500);
        let mut found = Vec::new();
        Groups::sorted(boxes).for_each_inside(&planes, |id, _| found.push(id));
        found.sort_unstable();
        assert_eq!(found, expected);
    }

    #[test]
    fn boxes_in_one_place_are_sorted_too() {
        let one = Aabb::new(Vec3::ONE, Vec3::ONE);
        let mut found = Vec::new();
        Groups::sorted((0..100).map(|id| (id, one)).collect()).for_each_inside(&[], |id, _| found.push(id));
        assert_eq!(found, (0..100).collect::<Vec<u32>>());
    }
}
