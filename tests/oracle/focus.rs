//! survey
use std::cmp::Ordering;

use glam::DVec3;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadowfit::{Focus, Form, Plane};

use crate::arbitrary::{Case, SceneParams, case};
use crate::body::Body;
use crate::cone::generators;
use crate::exact::sqrt_ratio;
use crate::homogeneous::{ExactPlane, ExactPoint, Homogeneous};
use crate::hull::hull;

const SLACK: f64 = 48.0 * f64::EPSILON;

fn row(plane: &Plane) -> [f64; 4] {
    plane.to_row().to_array()
}

fn exact(planes: &[Plane]) -> Vec<ExactPlane> {
    planes.iter().map(|plane| Homogeneous::from_f64(row(plane))).collect()
}

fn outside(plane: &ExactPlane, point: &ExactPoint) -> f64 {
    let height = plane.dot(point);
    let [x, y, z] = plane.xyz();
    let norm2 = x.sqr() + y.sqr() + z.sqr();
    let distance = sqrt_ratio(height.sqr(), point.w().sqr() * norm2);
    if plane.side(point) == Ordering::Less { distance } else { -distance }
}

fn hull_of_points(points: &[ExactPoint]) -> Vec<ExactPlane> {
    generators(points)
        .into_iter()
        .map(|ray| ray.vector)
        .filter(|plane| plane.xyz().iter().any(|c| !c.is_zero()))
        .collect()
}

fn moved(plane: &Plane, by: f64) -> Plane {
    Plane::new(plane.normal, (plane.offset + by).next_up())
}

struct Exact {
    s: Vec<Plane>,
    l: Vec<Plane>,
    v: Vec<Plane>,
    light: [f64; 4],
    extent: DVec3,
}

fn magnitude(plane: &Plane, extent: DVec3) -> f64 {
    plane.normal.abs().dot(extent) + plane.offset.abs()
}

impl Exact {
    fn of(case: &Case) -> Option<Self> {
        let (view, light) = case.build();
        let (min, max) = case.scene.bounds();
        let mut s: Vec<Plane> = Vec::new();
        for axis in 0..3 {
            let mut n = DVec3::ZERO;
            n[axis] = 1.0;
            s.push(Plane::new(n, -min[axis]));
            s.push(Plane::new(-n, max[axis]));
        }
        if let SceneParams::Cut { planes, .. } = &case.scene {
            s.extend(planes.iter().map(|p| crate::arbitrary::plane(*p)));
        }
        if matches!(case.scene, SceneParams::Lists { .. }) {
            return None;
        }
        let extent = DVec3::from(min).abs().max(DVec3::from(max).abs());
        Some(Self { s, l: light.planes().to_vec(), v: view.planes().to_vec(), light: light.homogeneous().to_array(), extent })
    }

    fn fixed(&self) -> Vec<Plane> {
        [&self.s[..], &self.l].concat()
    }
}

#[derive(Default, Debug)]
pub(crate) struct Tally {
    n: usize,
    empty: usize,
    a_planes: Vec<(f64, usize)>,
    a_hull: Vec<(f64, usize)>,
    b: Vec<(f64, usize)>,
    b_over: Vec<(f64, usize)>,
    radius: Vec<(f64, usize)>,
    lost: Vec<usize>,
    extra: Vec<usize>,
}

fn compare(tally: &mut Tally, index: usize, computed: &shadowfit::Body, exact: &Body, outer: &[(ExactPlane, f64)], scale: f64) {
    tally.n += 1;
    if exact.is_empty() {
        tally.empty += 1;
    }
    if computed.is_empty() {
        if !exact.is_empty() {
            tally.lost.push(index);
        }
        return;
    }
    if exact.is_empty() {
        tally.extra.push(index);
    }
    let points: Vec<_> = computed.vertices().iter().map(|v| Homogeneous::from_position(v.to_array())).collect();
    if !exact.is_empty() {
        let worst = computed.planes().map(|p| exact.violation(row(&p))).fold(f64::NEG_INFINITY, f64::max);
        tally.a_planes.push((worst / scale, index));
        let facets = hull_of_points(&points);
        let mut worst = f64::NEG_INFINITY;
        for facet in &facets {
            for vertex in &exact.vertices {
                if facet.side(&vertex.point) == Ordering::Less {
                    worst = worst.max(outside(facet, &vertex.point));
                }
            }
        }
        tally.a_hull.push((worst / scale, index));
        let worst = computed.vertices().iter().map(|v| exact.distance(v.to_array())).fold(0.0, f64::max);
        tally.b.push((worst / scale, index));
    }
    tally.radius.push((outer.iter().map(|x| x.1).fold(0.0, f64::max) / scale, index));
    let mut worst: f64 = 0.0;
    for (plane, by) in outer {
        for point in &points {
            if plane.side(point) == Ordering::Less {
                worst = worst.max(outside(plane, point) / by);
            }
        }
    }
    tally.b_over.push((worst, index));
}

/// How far a meeting point of three of the planes moves when each moves by its `by` (in units of the plane's value).
fn displacement(planes: &[Plane], by: &[f64]) -> f64 {
    let mut worst: f64 = 0.0;
    for (p, b) in planes.iter().zip(by) {
        worst = worst.max(b / p.normal.length());
    }
    for i in 0..planes.len() {
        for j in i + 1..planes.len() {
            for k in j + 1..planes.len() {
                let [a, b, c] = [i, j, k].map(|x| planes[x].normal);
                let det = a.dot(b.cross(c)).abs();
                if det < 1e-9 * a.length() * b.length() * c.length() {
                    continue;
                }
                let sum = by[i] * b.cross(c).length() + by[j] * c.cross(a).length() + by[k] * a.cross(b).length();
                worst = worst.max(sum / det);
            }
        }
    }
    worst
}

pub(crate) fn check(tallies: &mut [Tally; 3], index: usize, case: &Case, times: &mut [f64; 4]) {
    let Some(e) = Exact::of(case) else { return };
    let (view, light) = case.build();
    let store = case.scene.store();
    let scene = store.scene().unwrap();
    let focus = Focus::new(&view, &light, &scene);
    let fixed = e.fixed();
    let scale = e.extent.length();
    let unit = |plane: &Plane, by: f64| by / plane.normal.length();
    let loose = |planes: &[Plane], k: f64| -> Vec<(ExactPlane, f64)> {
        planes
            .iter()
            .map(|p| (Homogeneous::from_f64(row(p)), unit(p, k * SLACK * magnitude(p, e.extent))))
            .collect()
    };
    let all_planes = [&fixed[..], &e.v].concat();
    let t0 = std::time::Instant::now();
    let r = Body::from_exact_planes(exact(&all_planes));
    compare(&mut tallies[0], index, &focus.visible(), &r, &loose(&all_planes, 2.0), scale);
    times[0] += t0.elapsed().as_secs_f64();

    // Paper.
    let t0 = std::time::Instant::now();
    let rows: Vec<_> = e.v.iter().map(row).collect();
    let facets = hull(&rows, e.light);
    let h = Body::from_exact_planes([exact(&fixed), facets.clone()].concat());
    let l = DVec3::from_slice(&e.light[..3]);
    let w = e.light[3];
    let far = if view.far().is_finite() { view.far() } else { view.near() + 4.0 * (scale + view.eye().length()) };
    let reach = view.narrowed(view.near(), far).unwrap().corners().unwrap();
    let size = 2.0 * reach.iter().map(|c| c.length()).fold(scale, f64::max);
    let beta = if w == 0.0 { size } else { (size / (l.length() - size).max(0.0)).min(1.0) };
    let by = |p: &Plane, k: f64| {
        k * SLACK * magnitude(p, e.extent) + beta * 4.0 * f64::EPSILON * (p.normal.abs().dot(l.abs()) + p.offset.abs() * w)
    };
    let bys: Vec<_> = e.v.iter().map(|p| by(p, 2.1)).collect();
    let radius = displacement(&e.v, &bys);
    let mut outer = loose(&fixed, 2.0);
    outer.extend(facets.into_iter().map(|f| (f, radius)));
    compare(&mut tallies[1], index, &focus.body(Form::Paper), &h, &outer, scale);
    times[1] += t0.elapsed().as_secs_f64();

    // Tight.
    let t0 = std::time::Instant::now();
    let light_point = Homogeneous::from_f64(e.light);
    let tight = |r: &Body| -> Vec<ExactPlane> {
        let mut points: Vec<ExactPoint> = r.vertices.iter().map(|v| v.point.clone()).collect();
        points.push(light_point.clone());
        hull_of_points(&points)
    };
    let h = if r.is_empty() {
        Body::from_exact_planes(vec![Homogeneous::from_f64([0.0, 0.0, 0.0, -1.0])])
    } else {
        Body::from_exact_planes([exact(&fixed), tight(&r)].concat())
    };
    times[2] += t0.elapsed().as_secs_f64();
    let t0 = std::time::Instant::now();
    let beta = if w == 0.0 { 2.0 * scale } else { (2.0 * scale / (l.length() - 2.0 * scale).max(0.0)).min(1.0) };
    let by = |p: &Plane| {
        (4.0 + w * beta) * SLACK * magnitude(p, e.extent)
            + beta * 4.0 * f64::EPSILON * (p.normal.abs().dot(l.abs()) + p.offset.abs() * w)
    };
    let grown = |k: f64| -> Body {
        let planes: Vec<_> = all_planes.iter().map(|p| moved(p, k * by(p))).collect();
        Body::from_exact_planes(exact(&planes))
    };
    let r1 = grown(1.0);
    let outer = if r1.is_empty() {
        vec![(Homogeneous::from_f64([0.0, 0.0, 0.0, -1.0]), 0.0)]
    } else {
        let r2 = grown(2.0);
        let radius = 2.0 * r2.vertices_f64().into_iter().map(|v| r1.distance(v)).fold(0.0, f64::max);
        let mut outer = loose(&fixed, 2.0);
        outer.extend(tight(&r1).into_iter().map(|f| (f, radius)));
        outer
    };
    compare(&mut tallies[2], index, &focus.body(Form::Tight), &h, &outer, scale);
    times[3] += t0.elapsed().as_secs_f64();
}

#[test]
fn survey() {
    let cases: usize = std::env::var("SHADOWFIT_CASES").ok().and_then(|v| v.parse().ok()).unwrap_or(2000);
    let seed: u8 = std::env::var("SEED").ok().and_then(|v| v.parse().ok()).unwrap_or(7);
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = case();
    let mut tallies: [Tally; 3] = Default::default();
    let mut all = Vec::new();
    let mut times = [0.0; 4];
    let mut refused = 0;
    for index in 0..cases {
        let Ok(tree) = strategy.new_tree(&mut runner) else { refused += 1; continue };
        let case = tree.current();
        let shown = format!("{case:?}");
        all.push(case.clone());
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| check(&mut tallies, index, &case, &mut times)));
        if result.is_err() {
            println!("PANIC {shown}");
        }
    }
    println!("times {times:?} refused {refused}");
    for (name, t) in ["R", "paper", "tight"].iter().zip(&mut tallies) {
        println!("== {name}: n {} empty {} lost {:?} extra {:?}", t.n, t.empty, t.lost, t.extra.len());
        for (what, list) in [("a planes", &mut t.a_planes), ("a hull", &mut t.a_hull), ("b dist", &mut t.b), ("b over", &mut t.b_over), ("radius", &mut t.radius)] {
            list.sort_by(|a, b| b.0.total_cmp(&a.0));
            let bad = list.iter().filter(|x| x.0 > if what.len() == 6 { 1.0 } else { 0.0 }).count();
            let q = |p: f64| list.get((list.len() as f64 * p) as usize).map(|x| x.0);
            println!("  {what}: bad {bad}/{} 1% {:?} 10% {:?} median {:?} top {:?}", list.len(), q(0.01), q(0.1), q(0.5), &list[..list.len().min(12)]);
        }
    }
    if let Ok(show) = std::env::var("SHOW") {
        for i in show.split(',') {
            let i: usize = i.parse().unwrap();
            println!("#{i} {:#?}", all[i]);
        }
    }
}
