//! The best map from frame to frame: fitted from the one before, it stays with it, and says when it does not.

use glam::DVec3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use shadowfit::{Effort, Focus, Light, Settings, ShadowMap, View, Warp};
use testkit::outdoors::{self, Kind};

/// A camera that can be moved.
struct Walk {
    eye: DVec3,
    forward: DVec3,
    light: Light,
}

impl Walk {
    fn drawn(random: &mut StdRng, kind: Kind) -> Self {
        let view = outdoors::view(random);
        Self { eye: view.eye(), forward: view.forward(), light: kind.light(random) }
    }

    fn view(&self) -> View {
        View::perspective(self.eye, self.forward, DVec3::Y, 1.0, 1.6, 0.5, 300.0).expect("a legal view")
    }

    /// The map from the one before, and how far it moves any vertex of R, in parts of the map.
    fn next(&self, before: &ShadowMap) -> Option<(ShadowMap, f64)> {
        let (view, scene) = (self.view(), outdoors::town());
        let focus = Focus::new(&view, &self.light, &scene);
        let map = focus.fit_warm(before, &settings()).into_map()?;
        let place = |map: &ShadowMap, point: DVec3| {
            let clip = map.texture_from_world() * point.extend(1.0);
            clip.truncate().truncate() / clip.w
        };
        let moved = |&point: &DVec3| (place(&map, point) - place(before, point)).abs().max_element();
        let moved = focus.receiver_volume().vertices().iter().map(moved).fold(0.0, f64::max);
        Some((map, moved))
    }

    /// The map on its own, and then from itself until it rests.
    fn settled(&self) -> Option<ShadowMap> {
        let (view, scene) = (self.view(), outdoors::town());
        let mut map = Focus::new(&view, &self.light, &scene).fit(&settings()).into_map()?;
        for _ in 0..MOST_FRAMES {
            let (next, moved) = self.next(&map)?;
            map = next;
            if moved < AT_REST {
                return Some(map);
            }
        }
        panic!("still on the move after {MOST_FRAMES} frames");
    }
}

/// What moves by less than that part of the map is at rest: a thousandth of a texel.
const AT_REST: f64 = 1e-6;

/// Frames after which a map rests while nothing moves.
const MOST_FRAMES: usize = 16;

fn settings() -> Settings {
    Settings::default().with_warp(Warp::Best(Effort::Good))
}

/// Once at rest a map changes as little as the view does: by less than a thousandth of it for a millionth of a metre. What
/// moves farther has jumped.
#[test]
fn a_map_at_rest_moves_with_the_view() {
    let mut random = StdRng::seed_from_u64(3);
    let mut jumps = 0;
    for kind in Kind::ALL {
        for _ in 0..60 {
            let mut walk = Walk::drawn(&mut random, kind);
            let Some(map) = walk.settled() else { continue };
            walk.eye += DVec3::new(random.random_range(-1e-6..1e-6), 0.0, random.random_range(-1e-6..1e-6));
            let Some((next, moved)) = walk.next(&map) else { continue };
            jumps += u32::from(next.jumped());
            assert!(moved < 1e-3 || next.jumped(), "{kind:?} {} {}: {moved}", walk.eye, walk.forward);
        }
    }
    assert!(jumps <= 2, "{jumps} jumps for nothing");
}

/// A map that does not say that it jumped moves nothing by more than a 32nd of it, but for what its border and its padding
/// change by; and few switch in steps of two centimetres.
#[test]
fn jumps_are_told() {
    let mut random = StdRng::seed_from_u64(4);
    let (mut frames, mut jumps) = (0, 0);
    for kind in Kind::ALL {
        for _ in 0..8 {
            let mut walk = Walk::drawn(&mut random, kind);
            let Some(mut map) = walk.settled() else { continue };
            let ahead = DVec3::new(walk.forward.x, 0.0, walk.forward.z).normalize_or_zero() * 0.02;
            for _ in 0..100 {
                walk.eye += ahead;
                let Some((next, moved)) = walk.next(&map) else { break };
                frames += 1;
                jumps += u32::from(next.jumped());
                assert!(
                    moved < 1.0 / 32.0 + 0.005 || next.jumped(),
                    "{kind:?} {} {}: {moved}",
                    walk.eye,
                    walk.forward
                );
                map = next;
            }
        }
    }
    println!("{jumps} jumps in {frames} frames");
    assert!(jumps * 100 <= frames, "{jumps} jumps in {frames} frames");
}
