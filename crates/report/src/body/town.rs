//! A town of boxes: ground in tiles, houses along streets, and what stands about between them.

use rand::rngs::StdRng;
use rand::{RngExt as _, SeedableRng as _};
use shadowfit::Aabb;
use shadowfit::glam::{DVec3, Vec3};

/// Half of the town's width in metres: that of the random views' town.
const HALF: f32 = 200.0;

/// Tiles of the ground a side.
const TILES: u16 = 16;

/// Lots a side; a house stands on most of them.
const LOTS: u16 = 22;

/// Cars, trees, lamp posts.
const SMALL_THINGS: usize = 300;

/// What casts and what receives, as boxes.
#[derive(Clone, Debug)]
pub(crate) struct Town {
    /// Houses and small things.
    pub(crate) casters: Vec<Aabb>,
    /// The same, and the ground.
    pub(crate) receivers: Vec<Aabb>,
}

impl Town {
    /// The same town for the same seed.
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = StdRng::seed_from_u64(seed);
        let mut casters = Vec::new();
        let lot = 2.0 * HALF / f32::from(LOTS);
        for (x, z) in squares(LOTS) {
            let mut number = |low: f32, high: f32| random.random_range(low..high);
            let size = Vec3::new(number(0.4, 0.8) * lot, number(4.0, 15.0), number(0.4, 0.8) * lot);
            let corner = Vec3::new(x as f32 * lot - HALF, 0.0, z as f32 * lot - HALF);
            let min = corner + Vec3::new(number(0.0, 0.2), 0.0, number(0.0, 0.2)) * lot;
            // Here and there is a square.
            if random.random_bool(0.85) {
                casters.push(Aabb::new(min, min + size));
            }
        }
        for _ in 0..SMALL_THINGS {
            let mut number = |low: f32, high: f32| random.random_range(low..high);
            let size = Vec3::new(number(0.2, 4.0), number(0.5, 6.0), number(0.2, 4.0));
            let min = Vec3::new(number(-HALF, HALF - size.x), 0.0, number(-HALF, HALF - size.z));
            casters.push(Aabb::new(min, min + size));
        }
        let tile = 2.0 * HALF / f32::from(TILES);
        let ground = squares(TILES).map(|(x, z)| {
            let min = Vec3::new(f32::from(x) * tile - HALF, -0.1, f32::from(z) * tile - HALF);
            Aabb::new(min, min + Vec3::new(tile, 0.1, tile))
        });
        let receivers = ground.chain(casters.iter().copied()).collect();
        Self { casters, receivers }
    }

    /// The least box around all of it.
    pub(crate) fn bounds(&self) -> (DVec3, DVec3) {
        bounds(&self.receivers)
    }
}

/// The least box around boxes.
pub(crate) fn bounds(boxes: &[Aabb]) -> (DVec3, DVec3) {
    boxes.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(min, max), one| {
        (min.min(one.min.as_dvec3()), max.max(one.max.as_dvec3()))
    })
}

/// The squares of a grid.
fn squares(side: u16) -> impl Iterator<Item = (u16, u16)> {
    (0..side).flat_map(move |x| (0..side).map(move |z| (x, z)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_town_is_some_hundreds_of_sound_boxes() {
        let town = Town::new(7);
        assert!((500..1000).contains(&town.casters.len()), "{}", town.casters.len());
        assert_eq!(town.receivers.len(), town.casters.len() + usize::from(TILES) * usize::from(TILES));
        assert!(town.receivers.iter().all(|one| one.min.cmplt(one.max).all()));
        let (min, max) = town.bounds();
        assert!(
            min.cmpge(DVec3::new(-200.0, -0.2, -200.0)).all() && max.cmple(DVec3::new(205.0, 15.0, 205.0)).all()
        );
        assert_eq!(town.casters, Town::new(7).casters);
    }
}
