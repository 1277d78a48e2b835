//! Rays through a projection matrix: of a camera, a light's view or a shadow map.

use anyhow::{Context, Result};
use shadowfit::View;
use shadowfit::glam::{DMat4, DVec2, DVec3, DVec4};

use super::ray::Ray;

/// Rays through exact pixel centres tend to hit edges and vertices of scenes laid out on a grid, where parry3d's
/// triangles leave cracks. Rays offset by this, in pixels, do not.
const OFF_CENTRE: DVec2 = DVec2::new(1.3e-4, -0.7e-4);

/// A projection from world space to a clip space with x and y in −1…1, y up, and depth in 0…1.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    clip_from_world: DMat4,
    world_from_clip: DMat4,
}

impl Lens {
    /// A lens from a matrix with depth in 0…1.
    ///
    /// # Errors
    ///
    /// When the matrix has no inverse.
    pub fn new(clip_from_world: DMat4) -> Result<Self> {
        let world_from_clip = clip_from_world.try_inverse().context("a projection that cannot be undone")?;
        Ok(Self { clip_from_world, world_from_clip })
    }

    /// The lens of a view.
    ///
    /// # Errors
    ///
    /// When the view's matrix has no inverse.
    pub fn of_view(view: &View) -> Result<Self> {
        // From depth −1…1 to 0…1.
        let halve_depth = DMat4::from_translation(0.5 * DVec3::Z) * DMat4::from_scale(DVec3::new(1.0, 1.0, 0.5));
        Self::new(halve_depth * view.clip_from_world())
    }

    /// A perspective lens in the frame of three unit axes: `right`, `up` and `forward`. `slopes` are the tangents
    /// of half its horizontal and vertical fields of view.
    ///
    /// # Errors
    ///
    /// When its extents are zero.
    pub fn perspective(eye: DVec3, axes: [DVec3; 3], slopes: DVec2, [near, far]: [f64; 2]) -> Result<Self> {
        let depth = DVec4::new(0.0, 0.0, far / (far - near), -near * far / (far - near));
        let clip_from_eye = DMat4::from_cols(
            DVec4::X / slopes.x,
            DVec4::Y / slopes.y,
            DVec4::new(0.0, 0.0, depth.z, 1.0),
            DVec4::new(0.0, 0.0, depth.w, 0.0),
        );
        Self::new(clip_from_eye * eye_from_world(eye, axes))
    }

    /// An orthographic lens: `centre` is the middle of its near plane, `half_extents` are half its width and
    /// height, and the axes are those of [`Self::perspective`].
    ///
    /// # Errors
    ///
    /// When its extents are zero.
    pub fn parallel(centre: DVec3, axes: [DVec3; 3], half_extents: DVec2, depth: f64) -> Result<Self> {
        let clip_from_eye = DMat4::from_scale(half_extents.extend(depth).recip());
        Self::new(clip_from_eye * eye_from_world(centre, axes))
    }

    /// World space to clip space.
    #[must_use]
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_world
    }

    /// The normalised device coordinates of a point.
    #[must_use]
    pub fn project(&self, point: DVec3) -> DVec3 {
        let clip = self.clip_from_world * point.extend(1.0);
        clip.truncate() / clip.w
    }

    /// The point at given normalised device coordinates; `None` beyond the horizon, which a warped map's window may
    /// include.
    #[must_use]
    pub fn unproject(&self, clip: DVec3) -> Option<DVec3> {
        let point = self.world_from_clip * clip.extend(1.0);
        (point.w > 0.0).then(|| point.truncate() / point.w)
    }

    /// The ray from depth 0 to depth 1 through given normalised device coordinates; `None` beyond the horizon.
    #[must_use]
    pub fn ray(&self, place: DVec2) -> Option<Ray> {
        let origin = self.unproject(place.extend(0.0))?;
        let end = self.world_from_clip * place.extend(1.0).extend(1.0);
        // With an infinite far plane w at the far end is zero up to rounding, so the ray avoids the division.
        let towards_end = end.truncate() - end.w * origin;
        let direction = towards_end.try_normalize()?;
        let length = if end.w > 0.0 { towards_end.length() / end.w } else { f64::INFINITY };
        Some(Ray { origin, direction, length })
    }

    /// The ray through a pixel of a picture; row 0 is at the top.
    #[must_use]
    pub fn ray_through_pixel(&self, x: u32, y: u32, width: u32, height: u32) -> Option<Ray> {
        let pixel = DVec2::new(f64::from(x), f64::from(y)) + 0.5 + OFF_CENTRE;
        let place = 2.0 * pixel / DVec2::new(f64::from(width), f64::from(height)) - 1.0;
        self.ray(DVec2::new(place.x, -place.y))
    }
}

/// Unit axes as rows: x right, y up, z depth.
fn eye_from_world(eye: DVec3, [right, up, forward]: [DVec3; 3]) -> DMat4 {
    let row = |axis: DVec3| axis.extend(-axis.dot(eye));
    DMat4::from_cols(row(right), row(up), row(forward), DVec4::W).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::NEG_Z];

    #[test]
    fn a_perspective_lens_maps_its_corners_to_the_clip_volume() {
        let lens = Lens::perspective(DVec3::Z, AXES, DVec2::new(2.0, 1.0), [1.0, 5.0]).expect("sound");
        let near_corner = lens.project(DVec3::new(2.0, 1.0, 0.0));
        let far_corner = lens.project(DVec3::new(-10.0, -5.0, -4.0));
        assert!((near_corner - DVec3::new(1.0, 1.0, 0.0)).length() < 1e-12, "{near_corner}");
        assert!((far_corner - DVec3::new(-1.0, -1.0, 1.0)).length() < 1e-12, "{far_corner}");
    }

    #[test]
    fn a_ray_runs_from_depth_zero_to_depth_one() {
        let lens = Lens::parallel(DVec3::Z, AXES, DVec2::new(3.0, 2.0), 4.0).expect("sound");
        let ray = lens.ray(DVec2::new(0.5, -1.0)).expect("in front");
        assert!((ray.origin - DVec3::new(1.5, -2.0, 1.0)).length() < 1e-12);
        assert!((ray.direction - DVec3::NEG_Z).length() < 1e-12 && (ray.length - 4.0).abs() < 1e-12);
    }

    #[test]
    fn an_infinite_far_plane_gives_endless_rays() {
        let view = View::perspective(DVec3::ZERO, DVec3::NEG_Z, DVec3::Y, 1.0, 1.5, 0.1, f64::INFINITY);
        let ray = Lens::of_view(&view.expect("a sound view")).expect("sound").ray(DVec2::ZERO).expect("in front");
        assert!((ray.direction - DVec3::NEG_Z).length() < 1e-12);
        assert!(ray.length > 1e9, "{}", ray.length);
    }

    #[test]
    fn the_top_row_is_up() {
        let lens = Lens::parallel(DVec3::ZERO, AXES, DVec2::ONE, 1.0).expect("sound");
        let ray = lens.ray_through_pixel(0, 0, 4, 4).expect("in front");
        assert!(ray.origin.y > 0.7 && ray.origin.x < -0.7, "{}", ray.origin);
    }
}
