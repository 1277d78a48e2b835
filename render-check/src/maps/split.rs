//! Which of a light's maps covers a point.

use shadowfit::glam::{DVec3, DVec4};
use shadowfit::{cascades::Cascades, omni::CubeFace};

use super::cascading::Cuts;

/// How the domain of a light is split among its maps.
#[derive(Clone, Debug)]
pub enum Split {
    /// By direction from the light. Each part has an axis, and a point belongs to the part with the nearest axis:
    /// the six world axes give cube faces, an axis and its opposite two half spaces, and a single axis the whole
    /// space.
    Directions {
        /// The light's position, in world space; unused with a single part.
        position: DVec3,
        /// The axes of the parts, from the light.
        axes: Vec<DVec3>,
    },
    /// By depth in front of the eye: each part is a cascade.
    Depths {
        /// The splits.
        cuts: Cuts,
        /// The cascades.
        cascades: Box<Cascades<'static>>,
    },
}

impl Split {
    /// A single part, for lights with one map.
    #[must_use]
    pub fn whole() -> Self {
        Self::Directions { position: DVec3::ZERO, axes: vec![DVec3::ZERO] }
    }

    /// The faces of the cube around a light, in the order of [`CubeFace::ALL`].
    #[must_use]
    pub fn cube(position: DVec3) -> Self {
        Self::Directions { position, axes: CubeFace::ALL.map(CubeFace::axis).to_vec() }
    }

    /// The half spaces in front of a light and behind it.
    #[must_use]
    pub fn halves(position: DVec3, axis: DVec3) -> Self {
        Self::Directions { position, axes: vec![axis, -axis] }
    }

    /// The cascades of a view, with their splits.
    #[must_use]
    pub fn cascades(cuts: Cuts, cascades: Cascades<'static>) -> Self {
        Self::Depths { cuts, cascades: Box::new(cascades) }
    }

    /// The number of parts.
    #[must_use]
    pub fn parts(&self) -> usize {
        match self {
            Self::Directions { axes, .. } => axes.len(),
            Self::Depths { cascades, .. } => cascades.len(),
        }
    }

    /// The part that a point belongs to; on a boundary, the first.
    #[must_use]
    pub fn part_of(&self, point: DVec3) -> usize {
        match self {
            Self::Directions { position, axes } => {
                let along = |part: usize| axes[part].dot(point - position);
                (1..axes.len()).fold(0, |nearest, part| if along(part) > along(nearest) { part } else { nearest })
            }
            Self::Depths { cascades, .. } => cascades.index_at(cascades[0].focus.view().depth(point)),
        }
    }

    /// The light's position, in world space; zero where it is unused.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        match self {
            Self::Directions { position, .. } => *position,
            Self::Depths { .. } => DVec3::ZERO,
        }
    }

    /// The axis of a part, from the light; zero where it covers all directions.
    #[must_use]
    pub fn axis(&self, part: usize) -> DVec3 {
        match self {
            Self::Directions { axes, .. } => axes[part],
            Self::Depths { .. } => DVec3::ZERO,
        }
    }

    /// The depth range of a part; `None` where it covers all depths.
    #[must_use]
    pub fn depths(&self, part: usize) -> Option<[f64; 2]> {
        match self {
            Self::Directions { .. } => None,
            Self::Depths { cascades, .. } => Some([cascades[part].near, cascades[part].far]),
        }
    }

    /// The far ends of the cascades in f32, as a shader compares them, the last one unbounded; `None` without
    /// cascades.
    #[must_use]
    pub fn ends(&self) -> Option<[f32; Cascades::MAX]> {
        let Self::Depths { cascades, .. } = self else { return None };
        let mut ends = [f32::MAX; Cascades::MAX];
        for (end, cascade) in ends.iter_mut().zip(&cascades.as_slice()[..cascades.len() - 1]) {
            *end = cascade.far as f32;
        }
        Some(ends)
    }

    /// The row vector whose product with (position relative to `origin`, 1) is the depth in front of the eye; zero
    /// without cascades.
    #[must_use]
    pub fn depth_row(&self, origin: DVec3) -> DVec4 {
        match self {
            Self::Directions { .. } => DVec4::ZERO,
            Self::Depths { cascades, .. } => {
                let view = cascades[0].focus.view();
                view.forward().extend(view.depth(origin))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use shadowfit::{Light, Scene, View};

    use super::*;
    use shadowfit::cascades::{CascadeSplits, SplitScheme};

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
        // Sums with the position are exact, so that points lie on seams exactly.
        let steps = [-1.0, -0.5, 0.0, 0.25, 1.0];
        let arms = steps.iter().flat_map(|&x| steps.iter().flat_map(move |&y| steps.map(|z| DVec3::new(x, y, z))));
        for arm in arms {
            assert_eq!(CubeFace::ALL[cube.part_of(position + arm)], CubeFace::of(arm), "{arm}");
            assert_eq!(Split::whole().part_of(position + arm), 0);
        }
    }

    #[test]
    fn cascades_follow_one_another() {
        let (eye, forward) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.6, 0.0, -0.8));
        let view = View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.5, 64.0).expect("sound");
        let light = Light::directional(DVec3::Y).expect("sound");
        let scene = Scene::from_box(DVec3::splat(-500.0), DVec3::splat(500.0)).expect("sound");
        let cuts = CascadeSplits::View { count: 7, split: SplitScheme::Logarithmic };
        let cascades = Cascades::new(&view, &light, &scene, cuts, 0.0).expect("sound");
        let split = Split::cascades(Cuts::Splits(cuts), cascades);
        let ends = split.ends().expect("cascades");
        assert_eq!((split.parts(), ends[6], ends[7]), (7, f32::MAX, f32::MAX));
        for part in 0..7 {
            let [near, far] = split.depths(part).expect("cascades");
            // From 0.5 to 64 in doublings.
            assert!((near - 0.5 * 2_f64.powi(part as i32)).abs() < 1e-5 && (far / near - 2.0).abs() < 1e-5);
            for depth in [1.001 * near, 0.999 * far] {
                let point = eye + depth * forward + 0.3 * depth * DVec3::Y;
                assert_eq!(split.part_of(point), part);
                let origin = DVec3::new(-4.0, 5.0, 0.3);
                let row = split.depth_row(origin);
                assert!((row.dot((point - origin).extend(1.0)) - depth).abs() < 1e-12);
            }
        }
    }
}
