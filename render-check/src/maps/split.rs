//! Which of a light's maps answers for a point.

use shadowfit::glam::{DVec3, DVec4};
use shadowfit::{
    cascades::{CascadeSplits, Cascades},
    omni::CubeFace,
};

/// How what a light shines on is shared out among its maps.
#[derive(Clone, Debug)]
pub enum Split {
    /// By the direction from the light. Each part has an axis, and a point belongs to the part whose axis its direction is
    /// nearest to: the six axes of the world make the faces of a cube, an axis and its opposite two half spaces, and one
    /// alone all there is.
    Directions {
        /// Where the light is, in world space; of no account where there is one part.
        position: DVec3,
        /// The axes of the parts, from the light.
        axes: Vec<DVec3>,
    },
    /// By the depth before the eye: each part is a slice of the view.
    Depths {
        /// How the view was cut.
        cuts: CascadeSplits<'static>,
        /// The slices.
        slices: Box<Cascades<'static>>,
    },
}

impl Split {
    /// One part, for lights that one map serves.
    #[must_use]
    pub fn whole() -> Self {
        Self::Directions { position: DVec3::ZERO, axes: vec![DVec3::ZERO] }
    }

    /// The faces of the cube around a light, in the order of [`CubeFace::ALL`].
    #[must_use]
    pub fn cube(position: DVec3) -> Self {
        Self::Directions { position, axes: CubeFace::ALL.map(CubeFace::axis).to_vec() }
    }

    /// The half spaces before and behind a light.
    #[must_use]
    pub fn halves(position: DVec3, axis: DVec3) -> Self {
        Self::Directions { position, axes: vec![axis, -axis] }
    }

    /// The slices of a view that was cut so.
    #[must_use]
    pub fn slices(cuts: CascadeSplits<'static>, slices: Cascades<'static>) -> Self {
        Self::Depths { cuts, slices: Box::new(slices) }
    }

    /// How many parts there are.
    #[must_use]
    pub fn parts(&self) -> usize {
        match self {
            Self::Directions { axes, .. } => axes.len(),
            Self::Depths { slices, .. } => slices.len(),
        }
    }

    /// The part that a point belongs to; the first of those that it lies between.
    #[must_use]
    pub fn part_of(&self, point: DVec3) -> usize {
        match self {
            Self::Directions { position, axes } => {
                let along = |part: usize| axes[part].dot(point - position);
                (1..axes.len()).fold(0, |nearest, part| if along(part) > along(nearest) { part } else { nearest })
            }
            Self::Depths { slices, .. } => slices.index_at(slices[0].focus.view().depth(point)),
        }
    }

    /// Where the light is, in world space; zero where that is of no account.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        match self {
            Self::Directions { position, .. } => *position,
            Self::Depths { .. } => DVec3::ZERO,
        }
    }

    /// The axis of a part, from the light; zero where all directions belong to it.
    #[must_use]
    pub fn axis(&self, part: usize) -> DVec3 {
        match self {
            Self::Directions { axes, .. } => axes[part],
            Self::Depths { .. } => DVec3::ZERO,
        }
    }

    /// The depths before the eye that a part is for, from and to; nothing where it is for all.
    #[must_use]
    pub fn depths(&self, part: usize) -> Option<[f64; 2]> {
        match self {
            Self::Directions { .. } => None,
            Self::Depths { slices, .. } => Some([slices[part].near, slices[part].far]),
        }
    }

    /// Where slices end, in f32 as a shader compares it, the last one never; nothing where there are no slices.
    #[must_use]
    pub fn ends(&self) -> Option<[f32; Cascades::MAX]> {
        let Self::Depths { slices, .. } = self else { return None };
        let mut ends = [f32::MAX; Cascades::MAX];
        for (end, slice) in ends.iter_mut().zip(&slices.as_slice()[..slices.len() - 1]) {
            *end = slice.far as f32;
        }
        Some(ends)
    }

    /// What a position relative to an origin, and 1, are to be multiplied by for its depth before the eye; zero where there
    /// are no slices.
    #[must_use]
    pub fn depth_row(&self, origin: DVec3) -> DVec4 {
        match self {
            Self::Directions { .. } => DVec4::ZERO,
            Self::Depths { slices, .. } => {
                let view = slices[0].focus.view();
                view.forward().extend(view.depth(origin))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use shadowfit::{Light, Scene, View};

    use super::*;
    use crate::maps::{Slicing, SplitArg, slices};

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

    #[test]
    fn slices_follow_one_another() {
        let (eye, forward) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.6, 0.0, -0.8));
        let view = View::perspective(eye, forward, DVec3::Y, 1.0, 1.6, 0.5, 64.0).expect("sound");
        let light = Light::directional(DVec3::Y).expect("sound");
        let scene = Scene::from_box(DVec3::splat(-500.0), DVec3::splat(500.0)).expect("sound");
        let cuts = Slicing { count: 7, split: SplitArg(shadowfit::cascades::SplitScheme::Logarithmic) }.cuts(true);
        let split = Split::slices(cuts, slices(&view, &light, &scene, cuts).expect("sound"));
        let ends = split.ends().expect("slices");
        assert_eq!((split.parts(), ends[6], ends[7]), (7, f32::MAX, f32::MAX));
        for part in 0..7 {
            let [near, far] = split.depths(part).expect("slices");
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
