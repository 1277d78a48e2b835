//! Verdicts on a renderer whose every fault is known.

use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{ClipSpace, Map, Settings, View, Warp};

use super::fake::{self, Fake, LAMP, SPOT, SUN};
use super::*;
use crate::light::LightSpec;
use crate::scene::Mesh;

fn uniform() -> Settings {
    fake::settings().with_warp(Warp::Uniform)
}

#[test]
fn an_honest_map_is_wrong_only_at_edges() {
    let mesh = fake::mesh();
    let soft = Fake { filter: 3, ..Fake::default() };
    let backs = Fake { faces: Faces::Back, ..Fake::default() };
    let reversed = uniform().with_clip(ClipSpace::OPENGL.reversed());
    for (light, settings, fake) in [
        (SUN, uniform(), Fake::default()),
        (SUN, uniform(), soft),
        (SUN, fake::settings(), Fake::default()),
        (LAMP, uniform(), Fake::default()),
        (LAMP, fake::settings(), soft),
        (SPOT, uniform(), Fake::default()),
        (SUN, reversed, Fake::default()),
        (SUN, uniform(), backs),
    ] {
        let verdict = fake.verdict(&light, &fake::fitted(&light, &settings), &mesh);
        let counts = verdict.counts;
        println!("{light} {counts:?} {:?} {:?}", verdict.worst_cluster, verdict.aliasing);
    }
}
