//! Caster culling: boxes and spheres against a focus body.

use crate::convex::{ConvexBody, Plane};
use crate::focus::{Focus, FocusForm, farthest_corner};
use crate::input::light::Light;
use crate::input::numbers::vector;
use crate::input::scene::Aabb;
use glam::{DVec3, Vec3, Vec4};

impl<'a> Focus<'a> {
    /// The casters to draw, for a scene of lists: the indices, in order, of boxes that may intersect H
    /// ([`FocusForm::ReceiverHull`]). Empty without receivers or casters, and for a scene without lists.
    ///
    /// ```
    /// use shadowfit::{Aabb, Focus, Light, Scene, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 500.0)?;
    /// let sun = Light::directional((0.4, 1.0, 0.2))?;
    /// let ground = Aabb::new([-200.0, 0.0, -200.0], [200.0, 0.0, 200.0]);
    /// let (tree, behind) = (Aabb::new([3.0, 0.0, -9.0], [5.0, 4.0, -7.0]), Aabb::new([3.0, 0.0, 90.0], [5.0, 4.0, 92.0]));
    /// let (casters, receivers) = ([ground, behind, tree], [ground]);
    /// let focus = Focus::new(&view, &sun, &Scene::new(&casters, &receivers)?);
    /// assert!(focus.casters().eq([0, 2]));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "culling")]
    pub fn casters(&self) -> impl Iterator<Item = usize> + use<'a> {
        let body = self.caster_volume(FocusForm::ReceiverHull);
        let list = self.caster_list.filter(|_| !body.is_empty());
        let indices = 0..list.map_or(0, |boxes| boxes.len());
        indices.filter(move |&index| {
            list.and_then(|boxes| boxes.get(index)).is_some_and(|one| body.intersects_aabb(one.min, one.max))
        })
    }
}

impl ConvexBody {
    /// Whether a world-space box may intersect the body. Conservative: never false for a box that does; sometimes true for a box
    /// near an edge that does not. An inverted box intersects nothing.
    ///
    /// ```
    /// # use shadowfit::{Focus, FocusForm, Light, Scene, View};
    /// # let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
    /// # let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
    /// # let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
    /// let body = focus.caster_volume(FocusForm::ReceiverHull);
    /// assert!(body.intersects_aabb([3.0, 0.0, -9.0], [5.0, 4.0, -7.0])); // a tree in view
    /// assert!(!body.intersects_aabb([3.0, 0.0, 90.0], [5.0, 4.0, 92.0])); // one behind the eye
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "caster culling")]
    #[must_use]
    pub fn intersects_aabb<F: Into<f64>, G: Into<f64>>(
        &self,
        min: impl Into<[F; 3]>,
        max: impl Into<[G; 3]>,
    ) -> bool {
        let Some((low, high)) = self.bounds() else { return false };
        // Only the part within the body's bounds counts, and the planes' slack covers corners there.
        let (min, max) = (vector(min).max(low), vector(max).min(high));
        min.cmple(max).all() && self.planes().all(|plane| plane.at(farthest_corner(min, max, plane.normal)) >= 0.0)
    }

    /// Whether a world-space bounding sphere may intersect the body; conservative as [`Self::intersects_aabb`]. A negative radius
    /// intersects nothing.
    ///
    /// ```
    /// # use shadowfit::{Focus, FocusForm, Light, Scene, View};
    /// # let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
    /// # let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
    /// # let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
    /// let body = focus.caster_volume(FocusForm::ReceiverHull);
    /// assert!(body.intersects_sphere([4.0, 2.0, -8.0], 2.5));
    /// assert!(!body.intersects_sphere([4.0, 2.0, 91.0], 2.5));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "caster culling")]
    #[must_use]
    pub fn intersects_sphere<F: Into<f64>>(&self, centre: impl Into<[F; 3]>, radius: f64) -> bool {
        let centre = vector(centre);
        let slack = 8.0 * f64::EPSILON * (centre.abs().element_sum() + radius);
        let inside = |plane: Plane| plane.normalized().at(centre) + radius + slack >= 0.0;
        !self.is_empty() && radius >= 0.0 && self.planes().all(inside)
    }

    /// A culler for the body, to test many boxes or spheres: [`Culler`] has an example.
    ///
    /// ```
    /// # use shadowfit::{Aabb, Focus, FocusForm, Light, Scene, View};
    /// # let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
    /// # let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
    /// # let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
    /// let culler = focus.caster_volume(FocusForm::ReceiverHull).culler();
    /// let mut drawn = [false];
    /// culler.boxes(&[Aabb::new([3.0, 0.0, -9.0], [5.0, 4.0, -7.0])], &mut drawn);
    /// assert_eq!(drawn, [true]);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn culler(&self) -> Culler {
        let mut culler = Culler {
            planes: [CullPlane::default(); Culler::MAX_PLANES],
            len: 0,
            min: Vec3::INFINITY,
            max: Vec3::NEG_INFINITY,
        };
        let Some((low, high)) = self.bounds() else { return culler };
        (culler.min, culler.max) = (low.as_vec3().map(f32::next_down), high.as_vec3().map(f32::next_up));
        let extent = culler.min.abs().max(culler.max.abs()).as_dvec3();
        for plane in self.planes() {
            if let Some(slot) = culler.planes.get_mut(culler.len) {
                *slot = CullPlane::new(&plane.normalized(), extent);
                culler.len += 1;
            }
        }
        culler
    }
}

/// Bulk caster culling: tests many boxes or spheres against a body in f32, eight at a time.
///
/// Conservative as [`ConvexBody::intersects_aabb`] and [`ConvexBody::intersects_sphere`]: it errs on the side of drawing.
///
/// ```
/// use shadowfit::{Aabb, Focus, FocusForm, Light, Scene, View, glam::Vec4};
/// # let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 40.0)?;
/// # let scene = Scene::from_box((-200.0, 0.0, -200.0), (200.0, 30.0, 200.0))?;
/// # let focus = Focus::new(&view, &Light::directional((0.4, 1.0, 0.2))?, &scene);
///
/// let culler = focus.caster_volume(FocusForm::ReceiverHull).culler();
/// let (tree, behind) = (Aabb::new([3.0, 0.0, -9.0], [5.0, 4.0, -7.0]), Aabb::new([3.0, 0.0, 90.0], [5.0, 4.0, 92.0]));
/// let mut drawn = [false; 2];
/// culler.boxes(&[tree, behind], &mut drawn);
/// assert_eq!(drawn, [true, false]);
/// culler.spheres(&[Vec4::new(4.0, 2.0, 91.0, 2.5), Vec4::new(4.0, 2.0, -8.0, 2.5)], &mut drawn);
/// assert_eq!(drawn, [false, true]);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "caster culling")]
#[doc(alias = "frustum culling")]
#[derive(Clone, Debug)]
pub struct Culler {
    planes: [CullPlane; Self::MAX_PLANES],
    len: usize,
    /// The body's bounds, rounded outwards.
    min: Vec3,
    max: Vec3,
}

/// A plane in f32, moved outwards by the rounding of its evaluation within the body's bounds.
#[derive(Clone, Copy, Debug, Default)]
struct CullPlane {
    normal: [f32; 3],
    offset: f32,
    /// The corner of a box that lies farthest along the normal: for each axis 0 for `min`, 1 for `max`.
    farthest: [usize; 3],
}

impl CullPlane {
    fn new(plane: &Plane, extent: DVec3) -> Self {
        // Seven roundings, of the normal, of its products and of their sums, each at most 2⁻²⁴ of the terms.
        const UNITS: f64 = 8.0 / 16_777_216.0;
        let magnitude = plane.normal.abs().dot(extent) + plane.offset.abs();
        let normal = plane.normal.to_array();
        Self {
            normal: normal.map(|entry| entry as f32),
            offset: (plane.offset + UNITS * magnitude) as f32,
            farthest: normal.map(|entry| usize::from(entry >= 0.0)),
        }
    }
}

/// The number of boxes or spheres tested at a time.
const LANES: usize = 8;

impl Culler {
    const MAX_PLANES: usize = 64;

    /// Sets `meets[i]` to whether world-space box i may intersect the body, up to the end of the shorter slice.
    pub fn boxes(&self, boxes: &[Aabb], meets: &mut [bool]) {
        for (boxes, meets) in boxes.chunks(LANES).zip(meets.chunks_mut(LANES)) {
            // By axis, by end (min, max), by lane: the part of each box within the body's bounds.
            let mut corners = [[[0.0_f32; LANES]; 2]; 3];
            let mut least = [f32::NEG_INFINITY; LANES];
            for (lane, one) in boxes.iter().enumerate() {
                let (low, high) = (one.min.max(self.min), one.max.min(self.max));
                for axis in 0..3 {
                    corners[axis][0][lane] = low[axis];
                    corners[axis][1][lane] = high[axis];
                }
                least[lane] = if low.cmple(high).all() { 0.0 } else { -1.0 };
            }
            for plane in &self.planes[..self.len] {
                let [x, y, z] = [0, 1, 2].map(|axis| &corners[axis][plane.farthest[axis] & 1]);
                let [nx, ny, nz] = plane.normal;
                for lane in 0..LANES {
                    let value = nx * x[lane] + ny * y[lane] + nz * z[lane] + plane.offset;
                    least[lane] = if value < least[lane] { value } else { least[lane] };
                }
            }
            for (meets, least) in meets.iter_mut().zip(least) {
                *meets = least >= 0.0;
            }
        }
    }

    /// Sets `meets[i]` to whether world-space sphere i, with centre (x, y, z) and radius w, may intersect the body, up to the end of
    /// the shorter slice.
    pub fn spheres(&self, spheres: &[Vec4], meets: &mut [bool]) {
        const UNITS: f32 = 8.0 / 16_777_216.0;
        for (spheres, meets) in spheres.chunks(LANES).zip(meets.chunks_mut(LANES)) {
            let [mut x, mut y, mut z, mut reach] = [[0.0_f32; LANES]; 4];
            let mut least = [f32::NEG_INFINITY; LANES];
            for (lane, ball) in spheres.iter().enumerate() {
                [x[lane], y[lane], z[lane]] = ball.truncate().to_array();
                // The planes' slack covers rounding within the body's bounds; a centre may be anywhere.
                reach[lane] = ball.w + UNITS * (ball.truncate().abs().element_sum() + ball.w);
                least[lane] = if ball.w >= 0.0 && self.len > 0 { 0.0 } else { -1.0 };
            }
            for plane in &self.planes[..self.len] {
                let [nx, ny, nz] = plane.normal;
                for lane in 0..LANES {
                    let value = nx * x[lane] + ny * y[lane] + nz * z[lane] + plane.offset + reach[lane];
                    least[lane] = if value < least[lane] { value } else { least[lane] };
                }
            }
            for (meets, least) in meets.iter_mut().zip(least) {
                *meets = least >= 0.0;
            }
        }
    }
}

impl Light {
    /// The largest near distance that clips no caster, in world units: the distance from a local light to the nearest of the boxes
    /// within its region. 0 where the light stands in a box; `None` for a directional light, and where no box is within reach.
    ///
    /// Use it for `near`: hyperbolic depth spends most of its steps close to the light, and a smaller near distance wastes them on air
    /// ([`ShadowMap::depth_beside_light`](crate::ShadowMap::depth_beside_light)).
    ///
    /// ```
    /// use shadowfit::{Aabb, Light};
    ///
    /// let bulb = Light::point((0.0, 3.0, 0.0), 0.05, 20.0)?;
    /// let table = Aabb::new([-1.0, 0.0, -1.0], [1.0, 1.0, 1.0]);
    /// assert_eq!(bulb.distance_to_casters(&[table]), Some(2.0));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "near plane")]
    #[must_use]
    pub fn distance_to_casters(&self, casters: &[Aabb]) -> Option<f64> {
        let position = self.position()?;
        let planes = self.planes();
        let distance = |one: &Aabb| {
            let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
            let outside = |plane: &Plane| {
                plane.loosened(min.abs().max(max.abs())).at(farthest_corner(min, max, plane.normal)) < 0.0
            };
            (!planes.iter().any(outside)).then(|| position.distance(position.clamp(min, max)))
        };
        casters.iter().filter_map(distance).min_by(f64::total_cmp)
    }
}
