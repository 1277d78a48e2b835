//! Raw bits in every public constructor: a typed error, or a value that gives results.

use shadowfit::glam::{DMat4, DVec3, Vec3, Vec4};
use shadowfit::{
    Aabb, ClipSpace, DepthFormat, Focus, FocusForm, InputError, Light, Origin, Outcome, Scene, Settings, ShadowMap,
    View,
    cascades::{CascadeLayout, CascadeSplits, Cascades, SplitScheme},
    depth::{ComparisonTolerance, ReceiverOffset, TangentPlane},
    focus::Plane,
    input::{ConvexScene, DAabb, DepthRange, Tangents, TextureOrigin, YAxis},
    omni::{CubeFace, Paraboloid},
    warp::Shift,
};

use super::results::exercise;
use crate::arbitrary::WARPS;

/// Numbers from bytes, zeros where there are no more.
struct Bits<'a>(&'a [u8]);

impl Bits<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let mut taken = [0; N];
        let (first, rest) = self.0.split_at(N.min(self.0.len()));
        taken[..first.len()].copy_from_slice(first);
        self.0 = rest;
        taken
    }

    fn below(&mut self, count: usize) -> usize {
        usize::from(u8::from_le_bytes(self.take())) % count
    }

    fn whole(&mut self) -> u32 {
        let bits = u32::from_le_bytes(self.take());
        // Any number, or one of the size of maps.
        if self.below(2) == 0 { bits } else { bits % 70_000 }
    }

    /// Any number there is, more of them such as scenes are made of.
    fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 12] = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            f64::EPSILON,
            -0.0,
            1e-300,
            shadowfit::input::MAX_COORDINATE,
            -shadowfit::input::MAX_COORDINATE,
            shadowfit::input::MIN_DISTANCE,
            std::f64::consts::FRAC_PI_2,
        ];
        match self.below(8) {
            0 => f64::from_bits(u64::from_le_bytes(self.take())),
            1 => f32::from_bits(u32::from_le_bytes(self.take())).into(),
            2 => SPECIAL[self.below(SPECIAL.len())],
            3 => f64::powi(2.0, i32::from(i8::from_le_bytes(self.take()))),
            _ => f64::from(i16::from_le_bytes(self.take())) / 256.0,
        }
    }

    fn triple(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.number())
    }

    fn point(&mut self) -> DVec3 {
        self.triple().into()
    }

    fn single(&mut self) -> Vec3 {
        self.point().as_vec3()
    }

    fn list<T>(&mut self, most: usize, one: impl Fn(&mut Self) -> T) -> Vec<T> {
        (0..self.below(most + 1)).map(|_| one(self)).collect()
    }

    fn clip(&mut self) -> ClipSpace {
        let depths = [
            DepthRange::ZeroToOne,
            DepthRange::ZeroToOneReversed,
            DepthRange::NegativeOneToOne,
            DepthRange::NegativeOneToOneReversed,
        ];
        ClipSpace {
            depth: depths[self.below(4)],
            y: [YAxis::Up, YAxis::Down][self.below(2)],
            texture_origin: [TextureOrigin::TopLeft, TextureOrigin::BottomLeft][self.below(2)],
        }
    }

    fn view(&mut self) -> Result<View, InputError> {
        let view = match self.below(5) {
            0 => {
                let [eye, forward, up] = [(); 3].map(|()| self.triple());
                View::perspective(eye, forward, up, self.number(), self.number(), self.number(), self.number())
            }
            1 => {
                let [eye, forward, up] = [(); 3].map(|()| self.triple());
                View::orthographic(eye, forward, up, self.number(), self.number(), self.number(), self.number())
            }
            2 => {
                let [eye, forward, up] = [(); 3].map(|()| self.triple());
                let [left, right, bottom, top] = [(); 4].map(|()| self.number());
                let tangents = if self.below(2) == 0 {
                    Tangents { left, right, bottom, top }
                } else {
                    Tangents::from_angles(left, right, bottom, top)?
                };
                View::from_tangents(eye, forward, up, tangents, self.number(), self.number())
            }
            which => {
                // A rigid motion and a lens, with some entries changed: any sixteen numbers are hardly ever either.
                let mut of = |mut matrix: [f64; 16]| {
                    for (entry, number) in self.list(12, |bits| (bits.below(16), bits.number())) {
                        matrix[entry] = number;
                    }
                    DMat4::from_cols_array(&matrix)
                };
                let eye_from_world = of(DMat4::IDENTITY.to_cols_array());
                let lens = [1.5, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, -1.01, -1.0, 0.0, 0.0, -0.101, 0.0];
                let clip_from_eye = of(lens);
                if which == 3 {
                    View::from_matrices(eye_from_world, clip_from_eye, self.clip())
                } else {
                    View::from_clip_from_world(clip_from_eye * eye_from_world, self.clip())
                }
            }
        }?;
        if self.below(4) == 0 { view.narrowed(self.number(), self.number()) } else { Ok(view) }
    }

    fn light(&mut self) -> Result<Light, InputError> {
        let light = match self.below(4) {
            0 => Light::directional(self.triple()),
            1 => Light::point(self.triple(), self.number(), self.number()),
            2 => Light::spot(self.triple(), self.triple(), self.number(), self.number(), self.number()),
            _ => Light::hemisphere(self.triple(), self.triple(), self.number(), self.number()),
        }?;
        if self.below(4) == 0 { light.cube_face(CubeFace::ALL[self.below(6)], self.number()) } else { Ok(light) }
    }

    fn settings(&mut self) -> Result<Settings, InputError> {
        let settings = Settings::new(self.whole(), self.whole())?;
        let settings = match self.below(3) {
            0 => settings.with_map_size(self.whole())?,
            1 => settings.with_map_sides(self.whole(), self.whole())?,
            _ => settings,
        };
        let shifts = [Shift::None, Shift::Back(FocusForm::ViewHull), Shift::Back(FocusForm::ReceiverHull)];
        Ok(settings
            .with_border(self.whole())?
            .with_warp(WARPS[self.below(WARPS.len())])
            .with_shift(shifts[self.below(2)])
            .with_clip(self.clip())
            .with_origin([Origin::World, Origin::Eye, Origin::Light][self.below(3)]))
    }

    fn boxes(&mut self) -> Vec<Aabb> {
        self.list(4, |bits| Aabb::new(bits.single(), bits.single()))
    }
}

/// Asserts that whatever the bytes make gives results or an error.
pub fn take_any_bits(bytes: &[u8]) {
    let mut bits = Bits(bytes);
    let settings = bits.settings().unwrap_or_default();
    let (view, light) = (bits.view(), bits.light());
    match bits.below(3) {
        0 => {
            let _: Result<_, InputError> =
                ReceiverOffset::world(bits.number()).and_then(|offset| offset.and_depth(bits.number()));
            solids(&mut bits);
        }
        1 => refiner(&mut bits),
        _ => {}
    }
    let (Ok(view), Ok(light)) = (view, light) else { return };
    match bits.below(4) {
        0 => {
            let scene = Scene::from_box(bits.triple(), bits.triple());
            with_scene(&mut bits, &view, &light, scene, &settings);
        }
        convex @ (1 | 2) => {
            let body = if convex == 1 {
                let planes = |bits: &mut Bits<'_>| bits.list(14, |bits| Plane::new(bits.point(), bits.number()));
                ConvexScene::new(bits.triple(), bits.triple(), &planes(&mut bits))
            } else {
                ConvexScene::around(bits.list(8, Bits::point))
            };
            let scene = body.as_ref().map(Scene::from_convex).map_err(|error| *error);
            with_scene(&mut bits, &view, &light, scene, &settings);
        }
        _ => {
            let (casters, receivers) = (bits.boxes(), bits.boxes());
            with_scene(&mut bits, &view, &light, Scene::new(&casters, &receivers), &settings);
        }
    }
    #[cfg(feature = "alloc")]
    planned(&mut bits, &view, &light, &settings);
    if let Ok(scene) = Scene::from_box(bits.triple(), bits.triple()) {
        cascaded(&mut bits, &view, &light, &scene, &settings);
    }
    through_wide_doors(&mut bits, &view, &light, &settings);
}

/// Pyramids, lights that turn and are within planes, scenes of many planes, and lists in double precision about any origin.
fn through_wide_doors(bits: &mut Bits<'_>, view: &View, light: &Light, settings: &Settings) {
    let plane = |bits: &mut Bits<'_>| Plane::new(bits.point(), bits.number());
    let other = match bits.below(3) {
        0 => Light::pyramid(
            bits.triple(),
            bits.triple(),
            bits.triple(),
            [bits.number(), bits.number()],
            bits.number(),
            bits.number(),
        ),
        1 => light.with_up(bits.triple()),
        _ => Ok(*light),
    };
    let light = other.and_then(|light| light.within(&bits.list(7, plane)));
    let Ok(light) = light else { return };
    if bits.below(2) == 0 {
        let body = ConvexScene::new(bits.triple(), bits.triple(), &bits.list(70, plane));
        let scene = body.as_ref().map(Scene::from_convex).map_err(|error| *error);
        with_scene(bits, view, &light, scene, settings);
    } else {
        let list = |bits: &mut Bits<'_>| bits.list(4, |bits| DAabb::new(bits.triple(), bits.triple()));
        let (casters, receivers) = (list(bits), list(bits));
        let Ok(scene) = Scene::relative_to(bits.triple(), &casters, &receivers) else { return };
        let drawn = Focus::new(view, &light, &scene).casters().count();
        assert!(drawn <= casters.len());
        std::hint::black_box(view.narrowed_to(&scene));
        with_scene(bits, view, &light, Ok(scene), settings);
    }
}

/// Asserts that a view is cut at any bytes, or refused with the name of an argument.
pub fn cut_at_any_bits(bytes: &[u8], view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) {
    cascaded(&mut Bits(bytes), view, light, scene, settings);
}

/// Asserts that any bytes through the wide doors give results or an error.
pub fn widen_by_any_bits(bytes: &[u8], view: &View, light: &Light, settings: &Settings) {
    through_wide_doors(&mut Bits(bytes), view, light, settings);
}

fn with_scene(
    bits: &mut Bits<'_>,
    view: &View,
    light: &Light,
    scene: Result<Scene<'_>, InputError>,
    settings: &Settings,
) {
    let Ok(scene) = scene else { return };
    exercise(view, light, &scene, settings);
    let focus = Focus::new(view, light, &scene);
    culled(bits, &focus);
    if let Outcome::Map(map) = focus.fit(settings) {
        asked(bits, &map);
    }
    if let Ok(paraboloids) = focus.paraboloids_about(bits.triple(), settings) {
        paraboloids.maps().iter().for_each(|map| asked_paraboloid(bits, map));
    }
    focus.paraboloids(settings).maps().iter().for_each(|map| asked_paraboloid(bits, map));
}

fn culled(bits: &mut Bits<'_>, focus: &Focus<'_>) {
    let body = focus.caster_volume(FocusForm::ReceiverHull);
    let (boxes, balls) = (bits.boxes(), bits.list(4, |bits| bits.single().extend(bits.number() as f32)));
    let mut meets = [false; 4];
    body.culler().boxes(&boxes, &mut meets[..boxes.len()]);
    for (one, meets) in boxes.iter().zip(meets) {
        let (min, max) = (one.min.as_dvec3(), one.max.as_dvec3());
        // Bulk culling is less exact, and to the side of keeping.
        let is_sound = min.is_finite() && max.is_finite() && min.cmple(max).all();
        assert!(!is_sound || meets || !body.intersects_aabb(min, max), "{one:?} is dropped in bulk");
    }
    body.culler().spheres(&balls, &mut meets[..balls.len()]);
    balls.iter().for_each(|ball: &Vec4| {
        std::hint::black_box(body.intersects_sphere(ball.truncate().as_dvec3(), ball.w.into()));
    });
    std::hint::black_box(CubeFace::of(bits.point()));
    assert!((0.0..=CubeFace::MAX_OVERLAP).contains(&CubeFace::overlap(bits.number(), bits.whole(), bits.whole())));
}

const FORMATS: [DepthFormat; 4] =
    [DepthFormat::Unorm8, DepthFormat::Unorm16, DepthFormat::Unorm24, DepthFormat::Float32];

/// Asks a map about any point.
fn asked(bits: &mut Bits<'_>, map: &ShadowMap) {
    let (point, normal) = (bits.point(), bits.point());
    let format = FORMATS[bits.below(4)];
    if let Some(plane) = TangentPlane::new(map, point, normal) {
        assert!(plane.place().is_finite() && plane.depth().is_finite() && plane.slopes().is_finite(), "{plane:?}");
        let taps = bits.below(9) as u32;
        let tolerance = ComparisonTolerance::constant(1e-6);
        let share = plane.mean(taps, &tolerance, |x, y| f64::from(x ^ y) / 65_536.0).share;
        assert!((0.0..=1.0).contains(&share), "{share}");
        assert!((0.0..=1.0).contains(&plane.blended(&tolerance, |_, _| 0.5).share));
    }
    for splat in
        [map.splat(point, bits.number()), map.disc_splat(point, normal, bits.number())].into_iter().flatten()
    {
        assert!(splat.centre.is_finite() && splat.half.is_finite(), "{splat:?}");
    }
    std::hint::black_box((map.footprint(point), map.aliasing(point), map.pixel_size(point)));
    std::hint::black_box((map.depth_slopes(point, normal), map.depth_rounding(point), map.place_rounding(point)));
    std::hint::black_box((map.depth_resolution(point, format), map.linear_depth_resolution(point, format)));
    if let Ok(bias) = map.bias(format, bits.number()) {
        assert!(bias.slope_scale.is_finite() && bias.receiver.is_finite() && bias.relative.is_finite(), "{bias:?}");
        std::hint::black_box(map.bias_distance(point, normal, &bias));
        let (offset, most) = (map.normal_offset(point, normal, &bias), map.normal_offset_at(point, &bias));
        assert!(offset >= 0.0 && most >= 0.0, "{offset}, {most}");
        assert!(map.receiver_matrix_with(&bias.offset()).is_finite(), "{bias:?}");
    }
    if let Ok(tolerance) = map.comparison_tolerance(format, bits.number()) {
        assert!(tolerance.to_array().into_iter().all(|part| part.is_finite() && part >= 0.0), "{tolerance:?}");
    }
    let offset = match bits.below(3) {
        0 => ReceiverOffset::world(bits.number()),
        1 => ReceiverOffset::relative(bits.number()),
        _ => ReceiverOffset::depth(bits.number()),
    };
    if let Ok(offset) = offset.and_then(|offset| offset.and_depth(bits.number())) {
        assert!(map.texture_from_world_with(&offset).is_finite(), "{offset:?}");
        assert!(map.clip_from_world_with(&offset).is_finite(), "{offset:?}");
    }
}

/// Asks a paraboloid about any point.
fn asked_paraboloid(bits: &mut Bits<'_>, map: &Paraboloid) {
    let (point, normal) = (bits.point(), bits.point());
    assert!(map.caster_matrix().is_finite() && map.paraboloid_from_world().is_finite(), "{map:?}");
    assert!(map.clip_scale().is_finite() && map.texture_scale().is_finite(), "{map:?}");
    std::hint::black_box((map.project(point), map.unproject(normal), map.footprint(point), map.rounding(point)));
    std::hint::black_box((map.edge_error(bits.number()), map.edge_depth_error(point, normal), map.aliasing(point)));
    let angle = map.largest_edge(bits.number());
    assert!((0.0..=std::f64::consts::FRAC_PI_2).contains(&angle), "{angle}");
    if let Ok(bias) = map.bias(FORMATS[bits.below(4)], bits.number()) {
        assert!(bias.slope_scale.is_finite() && bias.receiver.is_finite(), "{bias:?}");
        std::hint::black_box((map.bias_distance(point, normal, &bias), map.distance_slopes(point, normal)));
    }
}

/// Cuts a view anywhere, and asks its cascades about any depth.
fn cascaded(bits: &mut Bits<'_>, view: &View, light: &Light, scene: &Scene<'_>, settings: &Settings) {
    let split =
        [SplitScheme::Uniform, SplitScheme::Logarithmic, SplitScheme::Practical(bits.number())][bits.below(3)];
    let (count, depths) = (bits.below(10), bits.list(9, Bits::number));
    let cuts =
        [CascadeSplits::Visible { count, split }, CascadeSplits::View { count, split }, CascadeSplits::At(&depths)]
            [bits.below(3)];
    let cascades = match Cascades::new(view, light, scene, cuts, bits.number()) {
        Ok(cascades) => cascades,
        Err(error) => {
            assert!(["count", "overlap", "split", "view", "cuts"].contains(&error.field), "{error}");
            return;
        }
    };
    let depth = bits.number();
    assert!(
        cascades.index_at(depth) < cascades.len() && (0.0..=1.0).contains(&cascades.blend_at(depth)),
        "{depth}"
    );
    let maps = cascades.fit(settings);
    let report = maps.report();
    assert!(!report.aliasing.is_nan() && !report.texel.is_nan(), "{report:?}");
    for layout in [CascadeLayout::Array, CascadeLayout::Atlas] {
        let uniform = maps.uniform(layout, |_| None);
        let floats = uniform.texture_from_origin.as_flattened().iter().chain(uniform.inner.as_flattened());
        assert!(floats.chain(&uniform.far).chain(&uniform.blend).all(|float| float.is_finite()), "{uniform:?}");
    }
}

#[cfg(feature = "alloc")]
fn solids(bits: &mut Bits<'_>) {
    let positions = bits.list(8, Bits::point);
    let triangles = bits.list(12, |bits| [(); 3].map(|()| bits.below(9) as u32));
    if let Ok(report) = shadowfit::mesh::Solidity::of(&positions, &triangles) {
        assert!(report.sheet.is_none_or(|sheet| (0.0..=2.0).contains(&sheet.bend)), "{report:?}");
        std::hint::black_box(shadowfit::plan::Surface::from(&report));
    }
}

#[cfg(not(feature = "alloc"))]
fn solids(_: &mut Bits<'_>) {}

#[cfg(feature = "spade")]
fn refiner(bits: &mut Bits<'_>) {
    let Ok(refiner) = shadowfit::mesh::Tessellator::new(bits.triple(), bits.number(), bits.number()) else {
        return;
    };
    let positions = bits.list(6, Bits::point);
    let triangles = bits.list(4, |bits| [(); 3].map(|()| bits.below(7) as u32));
    let Ok(refined) = refiner.with_limit(bits.below(200) as u32).tessellate(&positions, &triangles) else { return };
    let count = positions.len() + refined.added.len();
    assert_eq!(refined.triangles.len(), refined.sources.len());
    assert!(refined.triangles.iter().flatten().all(|&corner| (corner as usize) < count), "{refined:?}");
    for added in &refined.added {
        let of_weights = (added.weights.iter().sum::<f64>() - 1.0).abs();
        assert!(added.position.is_finite() && of_weights <= 4.0 * f64::EPSILON, "{added:?}");
    }
}

#[cfg(not(feature = "spade"))]
fn refiner(_: &mut Bits<'_>) {}

#[cfg(feature = "alloc")]
fn planned(bits: &mut Bits<'_>, view: &View, light: &Light, settings: &Settings) {
    use shadowfit::Filter;
    use shadowfit::plan::{Budget, Object, Objects, Surface, plan};

    let filters = [Filter::Nearest, Filter::Hardware2x2, Filter::Pcf(bits.below(256) as u8)];
    let Ok(budget) = Budget::new(*settings).with_aliasing(bits.number()) else { return };
    let budget = budget.with_format(FORMATS[bits.below(4)]).with_filter(filters[bits.below(3)]);
    let budget = budget.with_texels(bits.whole().into());
    let objects = bits.list(5, |bits| Object {
        casts: bits.below(4) != 0,
        receives: bits.below(4) != 0,
        surface: [
            Surface::Mesh(shadowfit::mesh::Solidity::Watertight),
            Surface::FlatSheets,
            Surface::Points,
            Surface::default(),
        ][bits.below(4)],
        triangles: bits.whole(),
        longest_edge: bits.number() as f32,
        bounds: Aabb::new(bits.single(), bits.single()),
    });
    let Ok(objects) = Objects::new(&objects) else { return };
    let plan = plan(view, &[*light, *light], &objects, &budget);
    for light in plan.lights() {
        assert!(!light.aliasing().is_nan() && !light.reasons().is_empty(), "{light:?}");
        assert!(light.passes().iter().all(|pass| !plan.casters(pass).is_empty()), "{light:?}");
    }
}
