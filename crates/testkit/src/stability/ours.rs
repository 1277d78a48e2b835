//! The crate's map, by the formulas of its documentation, in exact numbers.
//!
//! What is a choice and not a result is taken as it is: the vertices of R, which grows in doubt (the tables of bodies say
//! by how much), and from the map's report how large the padded window is, where the depth range begins and ends and by how much
//! the warp is weakened. Everything else, from the axes of the camera to the warp, is made again from the input, in another
//! arithmetic, and by other means where there are any: the light's axis by trying all faces.

use super::arithmetic::{Big, Real};
use super::linear::{M4, V3, V4, add, at, cross, dot, length, one, sub, through, times, unit, vector};
use super::setup::{Frame, Lamp, Setup};
use shadowfit::ShadowMap;

fn big(value: f64) -> Big {
    Big::of(value)
}

/// World to clip space, z from 0 to 1.
pub fn ours(setup: &Setup, map: &ShadowMap) -> M4<Big> {
    let frame = setup.camera.frame::<Big>();
    let visible: Vec<V3<Big>> = setup.visible().into_iter().map(vector).collect();
    let chart = Chart::new(setup, &frame, &visible);
    let middle = middle(&visible.iter().map(|p| chart.through(p)).collect::<Vec<_>>());
    let warp = warp(setup, &frame, &visible, &chart, &middle, map.weakening());

    let zero = {
        let (min, max) = extent(visible.iter().map(|p| at(&chart.along, p)));
        (min + max) / big(2.0)
    };
    let a = sub(&chart.u, &times(&chart.w, &middle[0]));
    let b = sub(&chart.v, &times(&chart.w, &middle[1]));
    let e = sub(&chart.along, &times(&one(), &zero));
    let place = |p: &V3<Big>| [at(&a, p) / at(&warp, p), at(&b, p) / at(&warp, p)];
    let centre = self::middle(&visible.iter().map(place).collect::<Vec<_>>());
    let (window, depth) = (map.window(), map.depth());
    let half = [big(window.width / 2.0), big(window.height / 2.0)];
    let value = |along: f64| match setup.lamp {
        Lamp::Sun(_) => big(along) - zero.clone(),
        Lamp::At(_) => big(1.0) - zero.clone() / big(along),
    };
    let (first, last) = (value(depth.near), value(depth.far));
    let across =
        |row: &V4<Big>, i: usize| times(&sub(row, &times(&warp, &centre[i])), &(big(1.0) / half[i].clone()));
    [
        across(&a, 0),
        across(&b, 1),
        times(&sub(&e, &times(&warp, &first)), &(big(1.0) / (last - first.clone()))),
        warp,
    ]
}

fn extent(values: impl Iterator<Item = Big>) -> (Big, Big) {
    let bound = values.fold(None, |bound: Option<(Big, Big)>, value| match bound {
        None => Some((value.clone(), value)),
        Some((min, max)) => Some((min.least(value.clone()), max.most(value))),
    });
    bound.expect("something is visible")
}

/// The middle of the rectangle around places.
fn middle(places: &[[Big; 2]]) -> [Big; 2] {
    [0, 1].map(|axis| {
        let (min, max) = extent(places.iter().map(|place| place[axis].clone()));
        (min + max) / big(2.0)
    })
}

/// Two axes and w, on which a ray from the light is one place.
struct Chart {
    local: bool,
    axis: V3<Big>,
    u_axis: V3<Big>,
    v_axis: V3<Big>,
    origin: V3<Big>,
    u: V4<Big>,
    v: V4<Big>,
    w: V4<Big>,
    along: V4<Big>,
}

impl Chart {
    fn new(setup: &Setup, frame: &Frame<Big>, visible: &[V3<Big>]) -> Self {
        let (local, origin, axis) = match setup.lamp {
            Lamp::Sun(direction) => (false, frame.eye.clone(), unit(&vector(-direction))),
            Lamp::At(position) => {
                let position = vector(position);
                let arms: Vec<_> = visible.iter().map(|p| unit(&sub(p, &position))).collect();
                (true, position, widest_margin(&arms))
            }
        };
        let (u_axis, v_axis) = across(&axis, &frame.forward, &frame.up);
        let along = through(&axis, &origin);
        Self {
            local,
            u: through(&u_axis, &origin),
            v: through(&v_axis, &origin),
            w: if local { along.clone() } else { one() },
            along,
            axis,
            u_axis,
            v_axis,
            origin,
        }
    }

    fn through(&self, p: &V3<Big>) -> [Big; 2] {
        let w = at(&self.w, p);
        [at(&self.u, p) / w.clone(), at(&self.v, p) / w]
    }

    /// A covector that vanishes at the light as slopes and a constant on the chart.
    fn functional(&self, covector: &V4<Big>) -> V3<Big> {
        let [x, y, z, _] = covector.clone();
        let normal = [x, y, z];
        let constant = if self.local { dot(&normal, &self.axis) } else { at(covector, &self.origin) };
        [dot(&normal, &self.u_axis), dot(&normal, &self.v_axis), constant]
    }
}

/// The axes across a direction: see the crate's `frame`.
pub fn across<T: Real>(along: &V3<T>, forward: &V3<T>, up: &V3<T>) -> (V3<T>, V3<T>) {
    let seen = sub(forward, &times(along, &dot(forward, along)));
    let sum = sub(along, up);
    let turned = sub(forward, &times(&sum, &(T::of(2.0) * dot(forward, &sum) / dot(&sum, &sum))));
    let mixed = add(&seen, &times(&turned, &(T::of(1.0) - length(&seen)).most(T::of(0.0))));
    let second = unit(&sub(&mixed, &times(along, &dot(&mixed, along))));
    (unit(&cross(along, &second)), second)
}

/// The direction to the point of the hull of unit directions that is nearest to the origin: on a corner, an edge or a
/// triangle, and no other foot inside of one is nearer.
fn widest_margin(directions: &[V3<Big>]) -> V3<Big> {
    let zero = big(0.0);
    let mut nearest = directions[0].clone();
    let mut consider = |foot: V3<Big>| {
        if dot(&foot, &foot) < dot(&nearest, &nearest) {
            nearest = foot;
        }
    };
    for (i, a) in directions.iter().enumerate() {
        for (j, b) in directions.iter().enumerate().skip(i + 1) {
            let edge = sub(b, a);
            let t = -dot(a, &edge) / dot(&edge, &edge);
            if t > zero && t < big(1.0) {
                consider(add(a, &times(&edge, &t)));
            }
            for c in directions.iter().skip(j + 1) {
                let normal = cross(&edge, &sub(c, a));
                let inside = [cross(b, c), cross(c, a), cross(a, b)].iter().all(|side| dot(&normal, side) > zero);
                if inside {
                    consider(times(&normal, &(dot(&normal, a) / dot(&normal, &normal))));
                }
            }
        }
    }
    unit(&nearest)
}

/// c, 1 at the middle of what is visible.
fn warp(
    setup: &Setup,
    frame: &Frame<Big>,
    visible: &[V3<Big>],
    chart: &Chart,
    middle: &[Big; 2],
    weakening: f64,
) -> V4<Big> {
    let (first, last) = extent(visible.iter().map(|p| at(&frame.depth, p)));
    let near = first.most(big(setup.camera.near));
    let far = last.most(near.clone() * big(1.0 + 1.0 / 1024.0));
    let ratio = near.clone() / far;
    let z = times(
        &sub(&times(&frame.depth, &(big(1.0) + ratio.clone())), &times(&one(), &(big(2.0) * near))),
        &(big(1.0) / (big(1.0) - ratio)),
    );
    let l = {
        let [x, y, z, w] = setup.lamp.homogeneous();
        let [x, y, z] = if chart.local { [x, y, z] } else { unit(&[x, y, z]) };
        [x, y, z, w]
    };
    let lambda = [&frame.across[0], &frame.across[1], &z, &frame.depth].map(|row| dot(row, &l));
    let [x, y, z_light, w] = lambda;
    let towards = add(&add(&times(&frame.across[0], &x), &times(&frame.across[1], &y)), &times(&z, &z_light));
    let square = dot(&[x.clone(), y.clone(), z_light.clone()], &[x, y, z_light]);
    let polar = sub(&times(&frame.depth, &square), &times(&towards, &w));

    // Mixed with the uniform map's w by as much as the map says.
    let slopes = chart.functional(&polar);
    let in_middle =
        slopes[0].clone() * middle[0].clone() + slopes[1].clone() * middle[1].clone() + slopes[2].clone();
    let part = big(weakening);
    add(&times(&polar, &((big(1.0) - part.clone()) / in_middle)), &times(&chart.w, &part))
}
