//! Normal-offset bias: how far receivers are moved along their normals, in world units.

use crate::depth::bias::{DepthBias, away};
use crate::focus::Focus;
use crate::input::numbers::vector;
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::most;
use glam::{DVec2, DVec3};

impl ShadowMap {
    /// How far to move a receiver along its normal before lookup, in world units, so that its plane has no shadow acne:
    /// `bias` done in space instead of in depth.
    ///
    /// It is for renderers that bias so (Holbert, *Normal Offset Shadows*, GDC 2011; Bevy's `shadow_normal_bias`, the
    /// normal bias of Unity and Godot): casters are drawn and receivers tested without any other bias, and the receiver X
    /// is looked up at X + d n. Engines that take a multiple of the texel's size take d over
    /// [`Footprint::longest`](crate::map::Footprint::longest). Unlike a slope it stays small where the light grazes a
    /// surface, and it moves shadows sideways. `docs/depth.md` derives it.
    ///
    /// `normal` may have any length and point to either side; the move is towards the light's side. Infinite outside of
    /// the map, and where no distance suffices.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let bias = map.bias(DepthFormat::Float32, 1.0)?;
    /// let of_ground = map.normal_offset(ground, up, &bias);
    /// let any = map.largest_normal_offset(&focus, &bias); // one number for all receivers
    /// assert!(0.0 < of_ground && of_ground < any);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[doc(alias = "normal bias")]
    #[doc(alias = "shadow_normal_bias")]
    #[must_use]
    pub fn normal_offset<F: Into<f64>, G: Into<f64>>(
        &self,
        point: impl Into<[F; 3]>,
        normal: impl Into<[G; 3]>,
        bias: &DepthBias,
    ) -> f64 {
        let (point, normal) = (vector(point), vector(normal));
        let Some(slopes) = self.depth_slopes(point, normal) else {
            return f64::INFINITY;
        };
        let light = self.light.homogeneous();
        let towards = light.truncate() - point * light.w;
        let normal = normal.normalize_or_zero();
        let normal = if normal.dot(towards) < 0.0 { -normal } else { normal };
        let [_, _, depth, w] = &self.rows;
        let of_light = depth.on(light).abs();
        let kappa = of_light / normal.dot(towards);
        let needed = bias.receiver + away(bias, *bias.format.bias_unit(1.0).end(), slopes.max_element());
        let over_w = bias.relative * of_light;
        let change_of_w = w.normal.dot(normal);
        let change = kappa - needed * change_of_w;
        if change <= 0.0 {
            return f64::INFINITY;
        }
        let offset = (needed * w.at(point) + over_w) / change;
        // Next to a light at a position there may be no room for it before the light.
        if w.at(point) + offset * change_of_w > 0.0 { offset } else { f64::INFINITY }
    }

    /// The largest [`Self::normal_offset`] at a point over all normals, in world units. Infinite outside of the map.
    ///
    /// At an angle θ between normal and light it is at most `a cos θ + b sin θ`, with b the slope times the longer side of a
    /// texel and a the noise of depth along the ray, over the change that w allows.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let bias = map.bias(DepthFormat::Float32, 1.0)?;
    /// assert!(map.normal_offset(ground, up, &bias) <= map.normal_offset_at(ground, &bias));
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn normal_offset_at<F: Into<f64>>(&self, point: impl Into<[F; 3]>, bias: &DepthBias) -> f64 {
        let point = vector(point);
        let Some(texel) = self.footprint(point) else { return f64::INFINITY };
        let light = self.light.homogeneous();
        let [_, _, depth, w] = &self.rows;
        let (of_light, at) = (depth.on(light).abs(), w.at(point));
        let distance = (light.truncate() - point * light.w).length();
        // Depth's own change across a texel, times w.
        let stored = depth.at(point) / at;
        let across = |side: DVec3| (depth.normal - w.normal * stored).dot(side).abs();
        let across = most(across(texel.along_x), across(texel.along_y));
        let side = most(texel.along_x.length(), texel.along_y.length());
        let slope = f64::from(bias.slope_scale.abs());
        let constant = bias.receiver + away(bias, *bias.format.bias_unit(1.0).end(), 0.0);
        let along = (constant * at + bias.relative * of_light + slope * across) * (distance / of_light);
        let moved = DVec2::new(along, slope * side).length();
        let left = 1.0 - moved * w.normal.length() / at;
        // With less than half left, w could come to nothing on the way.
        if left > 0.5 { moved / left } else { f64::INFINITY }
    }

    /// One normal offset for all receivers, in world units: the largest [`Self::normal_offset_at`] over the vertices of R
    /// and the middles of its edges that are no nearer to the light than its near distance. `focus` is the one that the
    /// map was fitted from.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// let bias = map.bias(DepthFormat::Float32, 1.0)?;
    /// let any = map.largest_normal_offset(&focus, &bias);
    /// assert!(map.normal_offset_at(ground, &bias) <= any && any.is_finite());
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn largest_normal_offset(&self, focus: &Focus<'_>, bias: &DepthBias) -> f64 {
        let visible = focus.visible_beyond_light();
        let is_away = |point: &DVec3| {
            self.light.position().is_none_or(|position| position.distance(*point) >= self.light.near())
        };
        let middles = visible.edges().map(|(a, b)| (a + b) * 0.5);
        let points = visible.vertices().iter().copied().chain(middles).filter(is_away);
        points.map(|point| self.normal_offset_at(point, bias)).fold(0.0, most)
    }
}
