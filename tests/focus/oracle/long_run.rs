//! Nothing is lost in ten million cases.
//!
//! ```text
//! SHADOWFIT_CASES=10000000 cargo test --release --test focus long_run -- --nocapture
//! ```
//!
//! prints how many cases were certified, how many the exact oracle had to decide, and the worst margins; an ordinary run
//! takes 20,000 cases. Asked of each is that the exact R, paper's H and tight H have no point outside of a computed plane,
//! none outside of the hull of the computed vertices, and that nothing is computed as empty that is not (`focus` asks too
//! how little is gained). Cases come in blocks with a seed for each, so that any number of threads takes the same ones. A case
//! in which something is lost is printed as it is found, and the run goes on.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use glam::DVec3;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use shadowfit::focus::Plane;

use testkit::arbitrary::{Case, SceneParams, case};
use testkit::oracle::body::Body;
use testkit::oracle::certified::half_spaces::HalfSpaces;
use testkit::oracle::certified::precise::admits;
use testkit::oracle::certified::{ENOUGH, Margins, Uncertain, certify, side_of_box, unit};
use testkit::oracle::focus::Input;
use testkit::oracle::loss::{Shape, losses};

/// The names of the three bodies.
const NAMES: [&str; 3] = ["R", "paper", "tight"];

/// Cases of one seed.
const BLOCK: usize = 1000;

/// Cases with something lost that are repeated at the end.
const KEPT: usize = 20;

/// The smallest margin, and its case.
#[derive(Clone)]
struct Worst {
    margin: f64,
    case: String,
}

impl Default for Worst {
    fn default() -> Self {
        Self { margin: ENOUGH, case: "as much or more everywhere".to_owned() }
    }
}

impl Worst {
    fn see(&mut self, margin: f64, case: &Case) {
        if margin < self.margin {
            *self = Self { margin, case: format!("{case:?}") };
        }
    }

    fn merge(&mut self, other: Self) {
        if other.margin < self.margin {
            *self = other;
        }
    }
}

/// What was found.
#[derive(Default)]
struct Found {
    cases: usize,
    passed_over: usize,
    /// Cases with at least one body that was left to the exact oracle.
    decided: usize,
    /// Bodies that were.
    uncertain: [usize; 3],
    /// And why.
    why: Vec<(Uncertain, usize)>,
    /// Cases with something lost.
    lost: usize,
    /// Some of them, with what was lost.
    kept: Vec<String>,
    /// Margins of planes, exactly, and of vertices, what is certain of them. Only of scenes that are boxes.
    worst: [[Worst; 2]; 3],
    generating: Duration,
    computing: Duration,
    certifying: Duration,
    deciding: Duration,
}

impl Found {
    fn merge(&mut self, other: Self) {
        self.cases += other.cases;
        self.passed_over += other.passed_over;
        self.decided += other.decided;
        self.lost += other.lost;
        self.kept.extend(other.kept);
        self.kept.truncate(KEPT);
        for (uncertain, count) in other.why {
            self.because(uncertain, count);
        }
        for (i, worst) in other.worst.into_iter().enumerate() {
            self.uncertain[i] += other.uncertain[i];
            for (mine, theirs) in self.worst[i].iter_mut().zip(worst) {
                mine.merge(theirs);
            }
        }
        self.generating += other.generating;
        self.computing += other.computing;
        self.certifying += other.certifying;
        self.deciding += other.deciding;
    }

    fn lose(&mut self, what: String) {
        eprintln!("{what}");
        self.lost += 1;
        self.kept.push(what);
    }

    fn because(&mut self, uncertain: Uncertain, count: usize) {
        match self.why.iter_mut().find(|(known, _)| *known == uncertain) {
            Some((_, known)) => *known += count,
            None => self.why.push((uncertain, count)),
        }
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |count: usize| 100.0 * count as f64 / self.cases as f64;
        writeln!(
            f,
            "{} cases: {:.2} % lists passed over, {:.2} % certified, {:.3} % decided exactly, {} with something lost",
            self.cases,
            percent(self.passed_over),
            percent(self.cases - self.passed_over - self.decided),
            percent(self.decided),
            self.lost,
        )?;
        writeln!(
            f,
            "time of all threads: {:.1?} generating, {:.1?} computing, {:.1?} certifying, {:.1?} deciding",
            self.generating, self.computing, self.certifying, self.deciding,
        )?;
        for (i, name) in NAMES.iter().enumerate() {
            let [planes, vertices] = &self.worst[i];
            writeln!(f, "{name}: {} bodies decided exactly; smallest margins in ε:", self.uncertain[i])?;
            writeln!(f, "    of planes, exactly, {:.3}: {}", planes.margin, planes.case)?;
            writeln!(f, "    of vertices, at least, {:.3}: {}", vertices.margin, vertices.case)?;
        }
        write!(f, "not certain: {:?}", self.why)
    }
}

/// The half-spaces that hold the exact bodies of a case, unless its numbers are too large or too small.
pub(crate) fn half_spaces(input: &Input, case: &Case) -> Option<[HalfSpaces; 3]> {
    let rows =
        |planes: &[Plane]| -> Vec<[f64; 4]> { planes.iter().map(|plane| plane.to_row().to_array()).collect() };
    let (min, max) = case.scene.bounds();
    // The sides of the box come first.
    let (lit, all, v) = (rows(&input.lit[6..]), rows(&input.planes()), rows(&input.v));
    let numbers = all.iter().flatten().chain(&input.light).copied().collect::<Vec<_>>();
    admits(&numbers).then(|| {
        let lit = || HalfSpaces::new(min.into(), max.into(), &lit);
        let mut bodies = [HalfSpaces::new(min.into(), max.into(), &all[6..]), lit(), lit()];
        bodies[1].meet_hull(&v, input.light);
        bodies[2].meet_hull(&all, input.light);
        bodies
    })
}

fn check(case: &Case, found: &mut Found) {
    found.cases += 1;
    let Some(input) = Input::of(case) else {
        found.passed_over += 1;
        return;
    };
    let start = Instant::now();
    let computed = input.computed(case).map(|body| Shape::of(&body));
    let computing = Instant::now();
    let exact = half_spaces(&input, case);
    let (mut left, mut near) = ([false; 3], [false; 3]);
    for i in 0..3 {
        // Where R is empty so is its hull with the light.
        if i == 2 && computed[0].is_empty() && !left[0] {
            break;
        }
        let verdict = exact.as_ref().map_or(Err(Uncertain::Range), |exact| certify(&computed[i], &exact[i]));
        match verdict {
            // Of a box that is cut the core takes a smaller extent to measure slack by, which is not known here.
            Ok(_) if matches!(case.scene, SceneParams::Cut { .. }) => {}
            Ok(Margins { planes, vertices }) => {
                near[i] = planes < found.worst[i][0].margin;
                found.worst[i][1].see(vertices, case);
            }
            Err(why) => {
                left[i] = true;
                found.uncertain[i] += 1;
                found.because(why, 1);
            }
        }
    }
    let certifying = Instant::now();
    found.decided += usize::from(left.contains(&true));
    decide(&input, &computed, left, near, case, found);
    found.computing += computing - start;
    found.certifying += certifying - computing;
    found.deciding += certifying.elapsed();
}

/// Decides exactly whether something is lost of the bodies that are left, and the margins of these and of those that are
/// near: what is certain of a margin is less than what is true.
fn decide(input: &Input, computed: &[Shape; 3], left: [bool; 3], near: [bool; 3], case: &Case, found: &mut Found) {
    let (min, max) = case.scene.bounds();
    let mut lost = Vec::new();
    for i in (0..3).filter(|&i| left[i] || near[i]) {
        let exact = input.exact_body(i);
        if left[i] {
            lost.extend(losses(&computed[i], &exact).into_iter().map(|loss| format!("{}: {loss}", NAMES[i])));
        }
        if !matches!(case.scene, SceneParams::Cut { .. }) {
            found.worst[i][0].see(margin(&computed[i], &exact, (min.into(), max.into())), case);
        }
    }
    if !lost.is_empty() {
        found.lose(format!("{}\n{case:?}", lost.join("\n")));
    }
}

/// By how much the exact body is inside of the computed planes that are no sides of the scene's box, in ε times the
/// magnitude of a plane's terms.
fn margin(computed: &Shape, exact: &Body, bounds: (DVec3, DVec3)) -> f64 {
    let moved = computed.planes.iter().filter(|plane| side_of_box(plane, bounds).is_none());
    let inside = |plane: &Plane| -exact.violation(plane.to_row().to_array()) * plane.normal.length();
    moved.map(|plane| inside(plane) / unit(plane, bounds)).fold(f64::INFINITY, f64::min)
}

fn block(index: usize, cases: usize) -> Found {
    let mut found = Found::default();
    let mut seed = [11; 32];
    seed[..8].copy_from_slice(&(index as u64).to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let strategy = case();
    for _ in 0..cases {
        let start = Instant::now();
        let case = strategy.new_tree(&mut runner).expect("few cases are refused").current();
        found.generating += start.elapsed();
        if catch_unwind(AssertUnwindSafe(|| check(&case, &mut found))).is_err() {
            found.lose(format!("panicked\n{case:?}"));
        }
    }
    found
}

#[test]
fn long_run_loses_nothing() {
    let asked = std::env::var("SHADOWFIT_CASES").ok();
    let cases: usize = asked.map_or(20_000, |count| count.parse().expect("SHADOWFIT_CASES is a number"));
    let (next, all, start) = (AtomicUsize::new(0), Mutex::new(Found::default()), Instant::now());
    let blocks = cases.div_ceil(BLOCK);
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= blocks {
                return;
            }
            let found = block(index, BLOCK.min(cases - index * BLOCK));
            let mut all = all.lock().expect("no thread has panicked");
            all.merge(found);
            if (index + 1) % 100 == 0 {
                eprintln!("{} cases, {} with something lost, {:.0?}", all.cases, all.lost, start.elapsed());
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let found = all.into_inner().expect("no thread has panicked");
    println!("{found}\n{:.1?} in all", start.elapsed());
    assert!(found.lost == 0, "{} cases with something lost, such as\n{}", found.lost, found.kept.join("\n"));
}
