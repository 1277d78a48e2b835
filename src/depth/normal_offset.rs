//! Normal-offset bias: how far receivers are moved along their normals, in world units.

use crate::depth::bias::{DepthBias, away};
use crate::focus::Focus;
use crate::input::numbers::vector;
use crate::map::shadow_map::ShadowMap;
use crate::math::bounds::most;
use glam::{DVec2, DVec3};

impl ShadowMap {
    /// How far a receiver on a plane is to be moved along its normal before it is looked up, so that the plane does not shadow
    /// itself: what `bias` does in depth, done in space, in world units.
    ///
    /// It is for renderers that bias so (Holbert, *Normal Offset Shadows*, GDC 2011; Bevy's `shadow_normal_bias`, Unity's and
    /// Godot's normal bias): casters are drawn and receivers tested without any other bias, and the receiver X at
    /// X + d n. Engines that take a multiple of the texel's size take d over [`Footprint::longest`](crate::map::Footprint::longest). Unlike a
    /// slope it stays small where the light grazes a surface, and moves shadows across instead of along.
    ///
    /// `normal` may have any length and point to either side; the move is towards the light's side. Infinite outside of the map,
    /// and where no distance does.
    ///
    /// ```
    /// use shadowfit::{DepthFormat, Focus, Light, Scene, Settings, View};
    ///
    /// let view = View::perspective((0.0, 1.7, 0.0), (0.0, -0.2, -1.0), (0.0, 1.0, 0.0), 1.0, 1.6, 0.1, 50.0)?;
    /// let sun = Light::directional((0.4, 1.0, 0.2))?;
    /// let scene = Scene::from_box((-20.0, 0.0, -20.0), (20.0, 5.0, 20.0))?;
    /// let focus = Focus::new(&view, &sun, &scene);
    /// if let Some(map) = focus.fit(&Settings::default()).map() {
    ///     let bias = map.bias(DepthFormat::Float32, 1.0)?;
    ///     let ground = map.normal_offset([0.0, 0.0, -9.0], [0.0, 1.0, 0.0], &bias);
    ///     let any = map.largest_normal_offset(&focus, &bias); // one number for all that is seen
    ///     assert!(0.0 < ground && ground < any);
    /// }
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    ///
    /// # Derivation
    ///
    /// With π the plane's row, of unit length and positive towards the light, the row e of depth is E + κ π, where κ = e·l/π·l and
    /// E vanishes at l as the rows of place and w do: E/w is the plane's own depth at a place. A receiver d above the plane has
    /// π = d, and so is nearer than the plane where it is looked up by
    ///
    /// ```text
    ///     −κ d/(w + d wₙ)        wₙ how w changes along the normal
    /// ```
    ///
    /// which is to be A + B/w: of the bias, A is the constant, the slope times that of the plane, and the receiver's part; B is what
    /// goes with 1/w. It is linear in d.
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

    /// The most that [`Self::normal_offset`] is at a point, whatever the normal. Infinite outside of the map.
    ///
    /// At an angle θ between normal and light it is at most `a cos θ + b sin θ`, with b the slope times the longer side of a
    /// texel and a what the noise of depth takes along the ray, over what w may change by.
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

    /// The largest [`Self::normal_offset_at`] over the vertices of R and the middles of its edges that are no nearer to the light than
    /// its near distance: one number for all that is visible. `focus` is the one that the map was fitted from.
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
