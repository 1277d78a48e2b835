//! The lower bound on aliasing: the least worst aliasing of any parameterization of the light's rays with as many texels.

use crate::focus::Focus;
use crate::input::view::Lens;
use crate::map::integral::{Fineness, Grading, Simplex, triangles};
use crate::math::bounds::most;
use crate::settings::Settings;
use glam::{DVec2, DVec3};

impl Focus<'_> {
    /// Lower bound on the worst aliasing over R for any parameterization with the settings' number of texels, warped,
    /// split or bent: the mark to hold the aliasing of a map against. 0 without receivers, or where the light sees R from
    /// its edge.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let map = focus.fit(&settings).into_map().expect("as before");
    /// let (found, bound) = (map.aliasing_over(&focus).expect("receivers").worst, focus.aliasing_lower_bound(&settings));
    /// assert!(0.0 < bound && bound < found);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// Texels that are squares of `bound` pixels everywhere would just do; no single matrix makes them. It is the bound of
    /// Lloyd, Tuft, Yoon & Manocha (2006), ln(f/n) for light from overhead, for any R and any light. `docs/design.md` derives
    /// it. By quadrature, with a relative error below 1e-5; a hundred times the cost of a fit, without allocation.
    #[doc(alias = "optimal parameterization")]
    #[doc(alias = "limit")]
    #[must_use]
    pub fn aliasing_lower_bound(&self, settings: &Settings) -> f64 {
        let (view, visible) = (self.view(), self.receiver_volume());
        let Some((min, max)) = visible.bounds() else { return 0.0 };
        let (l, position) = (self.light().homogeneous(), self.light().position());
        let unit = if view.lens() == Lens::Perspective { view.depth_row().on(l) } else { l.w };
        let side = if unit > 0.0 { 1.0 } else { -1.0 };
        let grading = Grading::new(view, position, (max - min).length(), Fineness::FINE);
        // Rounding may leave a point of R just before the near plane.
        let half_height = |point: DVec3| view.half_height(most(view.depth(point), view.near()));
        let mut sum = 0.0;
        for [a, b, c] in triangles(&visible) {
            let outwards = (b - a).cross(c - a).normalize_or_zero();
            let ray = |point: DVec3| position.map_or(-l.truncate(), |position| point - position);
            // Which side of the triangle faces the light; the same all over it.
            if side * outwards.dot(ray(a)) <= 0.0 {
                continue;
            }
            sum += grading.integral(Simplex::triangle([a, b, c]), 0.0, |point| {
                let across = outwards.dot(ray(point).normalize_or_zero()).abs();
                let half = half_height(point);
                across / (half * half)
            });
        }
        // The image is twice half its height.
        // A vector's square root is there without the standard library too.
        let [sum, side] = DVec2::new(sum, settings.sides().element_product()).sqrt().to_array();
        0.5 * f64::from(settings.image_height()) * sum / side
    }
}
