//! Maps that are fitted to what the camera sees: what is seen is in them, a frame later too.

use glam::{DVec2, DVec3};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::input::{DAabb, DepthRange};
use shadowfit::seen::{DepthTile, Seen, SeenPoint};
use shadowfit::{Focus, Light, Settings, ShadowMap, View};
use testkit::outdoors::{self, Kind};

/// The pixels of the small depth buffers here, and of a tile.
const IMAGE: [u32; 2] = [32, 18];
const TILE: u32 = 4;

const RANGE: DepthRange = DepthRange::ZeroToOneReversed;

/// A depth buffer with what its pixels show.
struct Frame {
    points: Vec<SeenPoint>,
    tiles: Vec<DepthTile>,
}

impl Frame {
    fn drawn(view: &View, boxes: &[DAabb]) -> Self {
        let mut points = outdoors::seen(view, boxes, IMAGE);
        points.retain(|point| view.depth(point.position) > view.near() && view.depth(point.position) < view.far());
        let clip_from_world = view.clip_from_world();
        let mut depths = vec![0.0_f32; (IMAGE[0] * IMAGE[1]) as usize];
        for point in &points {
            let place = clip_from_world.project_point3(point.position).truncate() * 0.5 + 0.5;
            let [x, y] = [place.x * f64::from(IMAGE[0]), (1.0 - place.y) * f64::from(IMAGE[1])].map(|at| at as u32);
            let ratio = view.near() / view.far();
            let stored = (view.near() / view.depth(point.position) - ratio) / (1.0 - ratio);
            depths[(y * IMAGE[0] + x) as usize] = stored as f32;
        }
        let tiles = DepthTile::reduce(&depths, IMAGE, TILE, RANGE).expect("a legal image").collect();
        Self { points, tiles }
    }

    fn seen(&self, view: &View) -> Seen<'_> {
        Seen::from_tiles(view, RANGE, IMAGE, TILE, &self.tiles).expect("as many tiles as the image has")
    }
}

/// Whether a point is a receiver of a focus: in view, and in the scene and the light's region.
fn is_receiver(focus: &Focus<'_>, whole: &Focus<'_>, point: DVec3) -> bool {
    focus.view().planes().iter().chain(focus.light().planes().iter()).all(|plane| plane.at(point) >= 1e-9)
        && whole.receiver_volume().contains(point)
}

/// Whether a point is in a map, within its border.
fn is_in(map: &ShadowMap, point: DVec3) -> bool {
    let place = map.texture_from_world().project_point3(point);
    let place = DVec2::new(place.x, place.y);
    map.w_at(point) > 0.0 && place.min_element() >= 0.0 && place.max_element() <= 1.0
}

fn cases() -> usize {
    std::env::var("SHADOWFIT_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(1500)
}

fn boxes(random: &mut StdRng) -> Vec<DAabb> {
    let mut boxes = outdoors::buildings(random);
    boxes.truncate(60);
    boxes
}

/// A light, with the scene's box around it all.
fn light(random: &mut StdRng, step: usize) -> Light {
    Kind::ALL[step % 3].light(random)
}

#[test]
fn all_that_is_seen_is_in_the_map() {
    let mut random = StdRng::seed_from_u64(5);
    let scene = outdoors::town();
    let mut maps = 0;
    for step in 0..cases() / 4 {
        let boxes = boxes(&mut random);
        let (view, light) = (outdoors::view(&mut random), light(&mut random, step));
        let frame = Frame::drawn(&view, &boxes);
        let whole = Focus::new(&view, &light, &scene);
        for seen in [frame.seen(&view), Seen::from_points(&frame.points).expect("legal points")] {
            let focus = whole.clone().with_seen(&seen);
            let Some(map) = focus.fit(&Settings::default()).into_map() else { continue };
            maps += 1;
            for point in &frame.points {
                let point = point.position;
                assert!(!is_receiver(&focus, &whole, point) || is_in(&map, point), "{step}: {point}");
            }
        }
    }
    assert!(maps > cases() / 4, "{maps} maps");
}

/// The camera steps and turns, and everything moves, between the frame whose tiles are known and the one that is fitted: what was
/// seen is in the map, wherever it is in view now.
#[test]
fn what_was_seen_is_in_the_next_frames_map() {
    let mut random = StdRng::seed_from_u64(6);
    let scene = outdoors::town();
    let (mut maps, mut kept, mut new, mut lost) = (0, 0_u64, 0_u64, 0_u64);
    let mut town = boxes(&mut random);
    for step in 0..cases() {
        if step % 64 == 0 {
            town = boxes(&mut random);
        }
        let (view, light) = (outdoors::view(&mut random), light(&mut random, step));
        let before = Frame::drawn(&view, &town);
        let mut small = |size: f64| {
            let mut number = || random.random_range(-1.0..1.0);
            DVec3::new(number(), number(), number()) * (size / 3.0_f64.sqrt())
        };
        let (margin, stepped) = (0.1, small(0.3));
        let forward = (view.forward() + small(0.05)).normalize();
        let now = View::perspective(view.eye() + stepped, forward, DVec3::Y, 1.0, 1.6, view.near(), view.far());
        let now = now.expect("a legal view");
        let seen = before.seen(&view).with_margin(margin).expect("a legal margin");
        let whole = Focus::new(&now, &light, &scene);
        let focus = whole.clone().with_seen(&seen);
        let Some(map) = focus.fit(&Settings::default()).into_map() else { continue };
        maps += 1;
        for point in &before.points {
            let moved = point.position + small(margin);
            if is_receiver(&focus, &whole, moved) {
                assert!(is_in(&map, moved), "{step}: {moved} was at {}", point.position);
                kept += 1;
            }
        }
        // What is seen now besides, next to the borders of the image or from behind something else.
        for point in Frame::drawn(&now, &town).points {
            if is_receiver(&focus, &whole, point.position) {
                new += 1;
                lost += u64::from(!is_in(&map, point.position));
            }
        }
    }
    println!(
        "{maps} maps hold {kept} points of the frame before; of {new} pixels now, {lost} show what is outside"
    );
    assert!(maps * 2 > cases(), "{maps} maps");
    assert!(lost * 50 < new, "{lost} of {new} outside");
}

#[test]
fn after_a_cut_the_tiles_say_nothing() {
    let mut random = StdRng::seed_from_u64(7);
    let (scene, boxes) = (outdoors::town(), boxes(&mut random));
    let view = outdoors::view(&mut random);
    let frame = Frame::drawn(&view, &boxes);
    let seen = frame.seen(&view);
    assert_eq!(seen.unseen(&view), 0.0);
    let behind = View::perspective(view.eye(), -view.forward(), DVec3::Y, 1.0, 1.6, view.near(), view.far());
    let behind = behind.expect("a legal view");
    assert_eq!(seen.unseen(&behind), 1.0);
    let sun = Light::directional((0.3, 1.0, 0.2)).expect("a direction");
    let focus = Focus::new(&behind, &sun, &scene);
    let with_seen = focus.clone().with_seen(&seen);
    assert_eq!(with_seen.receiver_volume().vertices(), focus.receiver_volume().vertices());
}
