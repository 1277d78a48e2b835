//! Virtual samples (receiver-plane depth): the depth of a receiver's plane at the centre of each texel that is read.

use crate::convex::Plane;
use crate::depth::tolerance::ComparisonTolerance;
use crate::map::shadow_map::ShadowMap;
use glam::{DVec2, DVec3};

/// The least sine of the angle between light and plane for which the plane's slope is taken as it is: 1/256, a quarter of a
/// degree. A matte surface at that angle has less than a step of 8 bits of the light's brightness, so that no shadow shows on
/// it; and the slope, which has a pole where the light sees the plane from its edge, stays bounded.
pub const MIN_SIN_INCIDENCE: f64 = 1.0 / 256.0;

/// The tangent plane of a receiver as a map sees it, for tests with virtual samples: no plane has shadow acne, without any
/// bias.
///
/// A filter compares one depth with those stored for texels around it, each of which is right for its own centre only. The
/// virtual sample of a texel is the depth of the receiver's plane at the texel's centre (Wang & Molnar 1994, §3.3; elsewhere
/// called receiver-plane depth). A projective map takes planes to planes, so that it is exact for every map, warped or not:
///
/// ```text
///     z(u, v) = z₀ + (u − u₀) dz/du + (v − v₀) dz/dv
/// ```
///
/// `docs/depth.md` has the slopes, and what virtual samples cannot know: triangles of less than a texel by a thousand, whose
/// depth a rasteriser itself gets wrong.
///
/// ```
#[doc = include_str!("../examples/sun.txt")]
/// use shadowfit::depth::{Decision, TangentPlane};
///
/// let plane = TangentPlane::new(&map, ground, up).expect("in the map");
/// assert_eq!(plane.depth_at(plane.place()), plane.depth());
/// assert!(plane.slopes().is_finite());
///
/// let tolerance = map.comparison_tolerance(DepthFormat::Float32, 1.0)?;
/// let centre = |x: u32, y: u32| (DVec3::new(x.into(), y.into(), 0.0).truncate() + 0.5) / 2048.0;
/// let own = plane.blended(&tolerance, |x, y| plane.depth_at(centre(x, y))); // the map holds the plane itself
/// assert_eq!(own.share, 1.0);
/// assert_eq!(plane.blended(&tolerance, |_, _| 0.0).rule, Decision::NonePass); // something next to the sun
/// assert!(plane.tolerance(&tolerance) < 1e-4);
/// # Ok::<(), shadowfit::InputError>(())
/// ```
#[doc(alias = "receiver plane depth bias")]
#[doc(alias = "virtual samples")]
#[doc(alias = "receiver-plane depth")]
#[doc(alias = "RPDB")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentPlane {
    place: DVec2,
    depth: f64,
    w: f64,
    slopes: DVec2,
    /// Texels of the map across and down.
    sides: DVec2,
    reversed: bool,
}

/// Which rule decided a test of several texels (Wang & Molnar 1994, Fig. 10).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Decision {
    /// The point passes against every texel: it is lit.
    AllPass,
    /// It passes against none: it is in shadow.
    NonePass,
    /// The texels disagree: virtual samples decided.
    VirtualSamples,
}

/// The result of a test against several texels.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShadowSample {
    /// The share of light that arrives, 0 to 1.
    pub share: f64,
    /// The rule that decided.
    pub rule: Decision,
}

impl TangentPlane {
    /// The plane through a point of a receiver across its normal, both in world space; the normal may have any length and
    /// point to either side.
    ///
    /// `None` where the point lies behind the map (w ≤ 0) or the plane has no direction: a normal that is zero or not finite.
    ///
    /// ```
    #[doc = include_str!("../examples/spot.txt")]
    /// use shadowfit::depth::TangentPlane;
    ///
    /// assert!(TangentPlane::new(&map, floor, up).is_some());
    /// assert_eq!(TangentPlane::new(&map, floor, DVec3::ZERO), None);
    /// assert_eq!(TangentPlane::new(&map, floor + 9.0 * up, up), None); // behind the spot
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn new(map: &ShadowMap, point: DVec3, normal: DVec3) -> Option<Self> {
        let clip = map.settings().clip();
        let [u, v, z, w] = clip.texture_rows_from_wgpu(map.rows);
        let at = w.at(point);
        // Gradients times w, which the ratios below do without.
        let coordinate = |row: &Plane| row.at(point) / at;
        let gradient = |row: &Plane| row.normal - w.normal * coordinate(row);
        let slopes = slopes([gradient(&u), gradient(&v), gradient(&z)], normal.try_normalize()?);
        (at > 0.0 && slopes.is_finite()).then(|| Self {
            place: DVec2::new(coordinate(&u), coordinate(&v)),
            depth: coordinate(&z),
            w: at,
            slopes,
            sides: map.settings().sides(),
            reversed: clip.depth.is_reversed(),
        })
    }

    /// The place of the point in texture coordinates: [0, 1]² inside of the map.
    #[must_use]
    pub const fn place(&self) -> DVec2 {
        self.place
    }

    /// The depth of the point, as the depth buffer would hold it.
    #[must_use]
    pub const fn depth(&self) -> f64 {
        self.depth
    }

    /// The change of the plane's depth with each of the texture coordinates.
    #[must_use]
    pub const fn slopes(&self) -> DVec2 {
        self.slopes
    }

    /// The virtual sample: the depth of the plane at a place in texture coordinates.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::TangentPlane;
    ///
    /// let plane = TangentPlane::new(&map, ground, up).expect("in the map");
    /// let beside = map.texture_from_world().project_point3(ground + DVec3::X); // elsewhere on the ground
    /// assert!((plane.depth_at(beside.truncate()) - beside.z).abs() < 1e-9);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn depth_at(&self, place: DVec2) -> f64 {
        self.depth + self.slopes.dot(place - self.place)
    }

    /// The rounding that comparisons at the point allow for, where the depth range is 1.
    #[must_use]
    pub fn tolerance(&self, tolerance: &ComparisonTolerance) -> f64 {
        // In texels across.
        let slopes = self.slopes.abs() * (self.sides.x / self.sides);
        tolerance.at(self.w) + tolerance.slope / self.sides.x * slopes.element_sum()
    }

    /// Tests the 2 × 2 texels around the point, blended by its distance from their centres, as a comparison sampler does.
    ///
    /// `tolerance` is [`ShadowMap::comparison_tolerance`] for a reach of 1. `stored` reads the map: the depth of a texel
    /// by its column and row in texture space, from 0 to one less than the map's width and height.
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::TangentPlane;
    ///
    /// let plane = TangentPlane::new(&map, ground, up).expect("in the map");
    /// let tolerance = map.comparison_tolerance(DepthFormat::Float32, 1.0)?;
    /// assert_eq!(plane.blended(&tolerance, |_, _| 1.0).share, 1.0); // a cleared map
    /// assert_eq!(plane.blended(&tolerance, |_, _| 0.0).share, 0.0);
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn blended(&self, tolerance: &ComparisonTolerance, stored: impl Fn(u32, u32) -> f64) -> ShadowSample {
        let corner = self.place * self.sides - 0.5;
        let part = corner - corner.floor();
        let weight = |x: u32, y: u32| {
            let of = |offset: u32, part: f64| if offset == 0 { 1.0 - part } else { part };
            of(x, part.x) * of(y, part.y)
        };
        self.sampled(corner.floor(), 2, weight, tolerance, stored)
    }

    /// Tests the `taps` × `taps` texels around the point, each counted alike: percentage-closer filtering (Reeves, Salesin
    /// & Cook 1987).
    ///
    /// One tap is the nearest texel, at which the virtual sample always decides; 0 counts as one. `tolerance` is that for
    /// a reach of half of the taps, `stored` as for [`Self::blended`].
    ///
    /// ```
    #[doc = include_str!("../examples/sun.txt")]
    /// use shadowfit::depth::TangentPlane;
    ///
    /// let plane = TangentPlane::new(&map, ground, up).expect("in the map");
    /// let tolerance = map.comparison_tolerance(DepthFormat::Float32, 1.5)?;
    /// let middle = (plane.place().x * 2048.0) as u32;
    /// let half = plane.mean(3, &tolerance, |x, _| if x < middle { 0.0 } else { 1.0 });
    /// assert!((half.share - 2.0 / 3.0).abs() < 1e-12); // a shadow edge: one of three columns is dark
    /// # Ok::<(), shadowfit::InputError>(())
    /// ```
    #[must_use]
    pub fn mean(
        &self,
        taps: u32,
        tolerance: &ComparisonTolerance,
        stored: impl Fn(u32, u32) -> f64,
    ) -> ShadowSample {
        let taps = taps.max(1);
        // The middle of an odd square is a texel, that of an even one a corner between texels.
        let first = (self.place * self.sides - 0.5 * f64::from(taps - 1)).floor();
        self.sampled(first, taps, |_, _| 1.0 / (f64::from(taps) * f64::from(taps)), tolerance, stored)
    }

    /// The three rules of Wang & Molnar's Fig. 10, with one comparison, ≤:
    ///
    /// 1. The point's depth is at most every stored one: lit.
    /// 2. It is greater than every stored one: in shadow.
    /// 3. They disagree: each texel's virtual sample is compared with its stored depth.
    ///
    /// The first two save the virtual samples and are sound on planes. The point lies between the texels' centres, so that
    /// its depth is a convex combination of the plane's depths there: it can be greater than all of them no more than it
    /// can be less than all of them. A map that holds the plane itself thus never comes to the second rule, and a map that
    /// holds something nearer at every texel never to the first.
    fn sampled(
        &self,
        first: DVec2,
        taps: u32,
        weight: impl Fn(u32, u32) -> f64,
        tolerance: &ComparisonTolerance,
        stored: impl Fn(u32, u32) -> f64,
    ) -> ShadowSample {
        let tolerance = self.tolerance(tolerance);
        let away = if self.reversed { -1.0 } else { 1.0 };
        let passes = |depth: f64, stored: f64| away * (depth.clamp(0.0, 1.0) - stored) <= tolerance;
        let (mut point_passes, mut count, mut share) = (0, 0, 0.0);
        for (x, y) in (0..taps).flat_map(|y| (0..taps).map(move |x| (x, y))) {
            let texel = (first + DVec2::new(f64::from(x), f64::from(y))).clamp(DVec2::ZERO, self.sides - 1.0);
            let stored = stored(texel.x as u32, texel.y as u32);
            let centre = (texel + 0.5) / self.sides;
            count += 1;
            point_passes += u32::from(passes(self.depth, stored));
            share += if passes(self.depth_at(centre), stored) { weight(x, y) } else { 0.0 };
        }
        // A single centre surrounds nothing.
        match (count > 1, point_passes) {
            (true, passed) if passed == count => ShadowSample { share: 1.0, rule: Decision::AllPass },
            (true, 0) => ShadowSample { share: 0.0, rule: Decision::NonePass },
            _ => ShadowSample { share: share.min(1.0), rule: Decision::VirtualSamples },
        }
    }
}

/// The changes of z with u and v on a plane across a unit normal, from the gradients of u, v and z.
fn slopes([u, v, z]: [DVec3; 3], normal: DVec3) -> DVec2 {
    let along = u.cross(v);
    let least = MIN_SIN_INCIDENCE * along.length();
    let facing = normal.dot(along);
    let facing = if facing < 0.0 { facing.min(-least) } else { facing.max(least) };
    DVec2::new(normal.dot(z.cross(v)), normal.dot(u.cross(z))) / facing
}
