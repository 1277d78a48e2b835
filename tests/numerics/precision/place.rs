//! A small town that may stand anywhere, and what is seen and shadowed in it, by rays.

use parry3d_f64::bounding_volume::Aabb as Solid;
use parry3d_f64::math::Vector;
use parry3d_f64::query::{Ray, RayCast};
use rand::RngExt;
use rand::rngs::StdRng;
use shadowfit::glam::DVec3;
use shadowfit::{Light, View};

/// Ground and boxes on it.
pub(crate) struct Town {
    solids: Vec<Solid>,
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

/// Half a side of the ground, and the height of the tallest box.
const HALF: f64 = 60.0;
const HEIGHT: f64 = 9.0;

/// A point on a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
}

/// A surface that is seen and faces the light, and the caster that shadows it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    pub(crate) hit: Hit,
    pub(crate) caster: Option<Hit>,
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

impl Town {
    /// A town around a place.
    pub(crate) fn at(place: DVec3, random: &mut StdRng) -> Self {
        let (min, max) = (place - DVec3::new(HALF, 1.0, HALF), place + DVec3::new(HALF, HEIGHT, HALF));
        let solid = |min: DVec3, max: DVec3| Solid::new(vector(min), vector(max));
        let mut solids = vec![solid(min, place + DVec3::new(HALF, 0.0, HALF))];
        solids.extend((0..60).map(|_| {
            let mut number = |low: f64, high: f64| random.random_range(low..high);
            let size = DVec3::new(number(0.3, 6.0), number(0.5, HEIGHT), number(0.3, 6.0));
            let corner = place + DVec3::new(number(-HALF, HALF - 6.0), 0.0, number(-HALF, HALF - 6.0));
            solid(corner, corner + size)
        }));
        Self { solids, min, max }
    }

    /// The first surface along a ray.
    fn first(&self, from: DVec3, direction: DVec3) -> Option<Hit> {
        let ray = Ray::new(vector(from), vector(direction));
        let hits = self.solids.iter().filter_map(|solid| solid.cast_local_ray_and_get_normal(&ray, 1e9, false));
        let hit = hits.min_by(|a, b| a.time_of_impact.total_cmp(&b.time_of_impact))?;
        let normal = DVec3::new(hit.normal.x, hit.normal.y, hit.normal.z);
        Some(Hit { point: from + direction * hit.time_of_impact, normal })
    }

    /// Whether a point is inside of something.
    pub(crate) fn holds(&self, point: DVec3) -> bool {
        self.solids.iter().any(|solid| solid.contains_local_point(vector(point)))
    }

    /// The surfaces at points spread over the image that face the light and that it may reach.
    pub(crate) fn receivers(&self, view: &View, light: &Light) -> Vec<Receiver> {
        const ACROSS: i32 = 16;
        const DOWN: i32 = 10;
        let corners = view.corners().expect("a finite view");
        let at = |right: f64, up: f64| {
            let [low, high] =
                [(corners[4], corners[5]), (corners[6], corners[7])].map(|(left, far)| left.lerp(far, right));
            low.lerp(high, up)
        };
        let places = (0..ACROSS * DOWN).map(|i| {
            let part = |i: i32, of: i32| (f64::from(i) + 0.5) / f64::from(of);
            at(part(i % ACROSS, ACROSS), part(i / ACROSS, DOWN))
        });
        let seen = places.filter_map(|place| {
            let hit = self.first(view.eye(), (place - view.eye()).normalize())?;
            let depth = view.depth(hit.point);
            (depth > view.near() && depth < view.far()).then_some(hit)
        });
        let lit = seen.filter_map(|hit| {
            let towards = light.direction_from(hit.point);
            let distance = light.position().map_or(1e3, |position| position.distance(hit.point));
            let reaches = light.planes().iter().all(|plane| plane.normal.dot(hit.point) + plane.offset >= 0.0);
            if !(reaches && hit.normal.dot(towards) > 0.1) {
                return None;
            }
            let start = (distance - light.near()).max(0.0);
            let caster = self.first(hit.point + towards * start, -towards)?;
            let between = caster.point.distance(hit.point);
            Some(Receiver { hit, caster: (between > 1e-3 && between < start).then_some(caster) })
        });
        lit.collect()
    }
}
