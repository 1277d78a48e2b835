//! Similarities, and the planes that they move.

use shadowfit::focus::Plane;
use shadowfit::glam::DVec3;

/// A scaling about the origin followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    pub scale: f64,
    pub offset: [f64; 3],
}

impl Similarity {
    /// A point.
    pub fn point(&self, point: [f64; 3]) -> [f64; 3] {
        (DVec3::from(point) * self.scale + DVec3::from(self.offset)).to_array()
    }

    /// A length.
    pub fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// A plane given by its normal and its offset, inside ≥ 0.
    pub fn plane(&self, [x, y, z, offset]: [f64; 4]) -> [f64; 4] {
        let along = DVec3::new(x, y, z).dot(DVec3::from(self.offset));
        [x, y, z, offset * self.scale - along]
    }
}

/// The crate's plane with these numbers: its normal and its offset.
pub fn plane([x, y, z, offset]: [f64; 4]) -> Plane {
    Plane::new(DVec3::new(x, y, z), offset)
}
