//! Which of a light's maps answers for a point.

use shadowfit::CubeFace;
use shadowfit::glam::DVec3;

/// How the directions from a light are shared out among its maps.
///
/// Each part has an axis, and a point belongs to the part whose axis its direction from the light is nearest to: the six
/// axes of the world make the faces of a cube, an axis and its opposite two half spaces, and one alone all there is.
#[derive(Clone, Debug, PartialEq)]
pub struct Split {
    /// Where the light is, in world space; of no account where there is one part.
    position: DVec3,
    axes: Vec<DVec3>,
}

impl Split {
    /// One part, for lights that one map serves.
    #[must_use]
    pub fn whole() -> Self {
        Self { position: DVec3::ZERO, axes: vec![DVec3::ZERO] }
    }

    /// The faces of the cube around a light, in the order of [`CubeFace::ALL`].
    #[must_use]
    pub fn cube(position: DVec3) -> Self {
        Self { position, axes: CubeFace::ALL.map(CubeFace::axis).to_vec() }
    }

    /// The half spaces before and behind a light.
    #[must_use]
    pub fn halves(position: DVec3, axis: DVec3) -> Self {
        Self { position, axes: vec![axis, -axis] }
    }

    /// Where the light is, in world space.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// The axes of the parts, from the light.
    #[must_use]
    pub fn axes(&self) -> &[DVec3] {
        &self.axes
    }

    /// How many parts there are.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.axes.len()
    }

    /// The part that a point belongs to; the first of those that it lies between.
    #[must_use]
    pub fn part_of(&self, point: DVec3) -> usize {
        let from_light = point - self.position;
        let along = |part: usize| self.axes[part].dot(from_light);
        (1..self.parts()).fold(0, |nearest, part| if along(part) > along(nearest) { part } else { nearest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_on_both_sides() {
        let (position, axis) = (DVec3::new(3.0, -2.0, 0.5), DVec3::new(0.6, 0.0, 0.8));
        let halves = Split::halves(position, axis);
        for (along, part) in [(2.0, 0), (1e-9, 0), (0.0, 0), (-1e-9, 1), (-2.0, 1)] {
            assert_eq!(halves.part_of(position + along * axis + DVec3::Y), part, "{along}");
        }
    }

    #[test]
    fn parts_of_a_cube_are_its_faces() {
        let position = DVec3::new(3.0, -2.0, 0.5);
        let cube = Split::cube(position);
        // Sums with the position are exact, so that seams are met.
        let steps = [-1.0, -0.5, 0.0, 0.25, 1.0];
        let arms = steps.iter().flat_map(|&x| steps.iter().flat_map(move |&y| steps.map(|z| DVec3::new(x, y, z))));
        for arm in arms {
            assert_eq!(CubeFace::ALL[cube.part_of(position + arm)], CubeFace::of(arm), "{arm}");
            assert_eq!(Split::whole().part_of(position + arm), 0);
        }
    }
}
