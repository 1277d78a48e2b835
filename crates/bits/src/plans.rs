//! The same table of plans, which need memory: one line a light, in every view of the set-ups.

use crate::setups::{SetUp, setups};
use crate::table::{Bits, Numbers};
use shadowfit::glam::Vec3;
use shadowfit::{
    Aabb,
    mesh::Solidity,
    plan::{Budget, Object, Objects, Projection, Surface, plan},
};

/// So finely is everything cut, for maps that bend lines.
const EDGE: f32 = 1.0 / 1024.0;

/// A ground and nine things on it, of every kind of surface.
fn objects() -> Vec<Object> {
    let ground = Object::new(Aabb::new(Vec3::new(-16.0, -0.125, -32.0), Vec3::new(16.0, 0.0, 16.0)));
    let surfaces = [Surface::Mesh(Solidity::Open), Surface::FlatSheets, Surface::Points];
    let things = (0..9_u8).map(|at| {
        let low = Vec3::new(f32::from(at % 3) * 8.0 - 10.0, 0.0, f32::from(at / 3) * -9.0 + 4.0);
        let bounds = Aabb::new(low, low + Vec3::new(2.5, 0.5 + f32::from(at * 5 % 7), 1.25));
        Object { surface: surfaces[usize::from(at) % 3], triangles: 100, longest_edge: EDGE, ..Object::new(bounds) }
    });
    std::iter::once(Object { longest_edge: EDGE, ..ground }).chain(things).collect()
}

/// The table of plans.
pub fn plans() -> String {
    let objects = Objects::new(&objects()).expect("objects");
    let mut text = String::new();
    for SetUp { name, view, light, settings, .. } in setups().iter().filter(|setup| setup.name.contains(" here,")) {
        let budget = Budget::new(*settings).with_aliasing(2.0).expect("a budget");
        let plan = plan(view, &[*light], &objects, &budget);
        let mut numbers = Numbers::new(false);
        let light = &plan.lights()[0];
        light.aliasing().put(&mut numbers);
        [plan.view().near(), plan.view().far()].put(&mut numbers);
        for pass in light.passes() {
            match pass.projection() {
                Projection::Frustum(map) | Projection::Face(_, map) => map.clip_from_world().put(&mut numbers),
                Projection::Paraboloid(map) => map.paraboloid_from_world().put(&mut numbers),
            }
            pass.bias().copied().put(&mut numbers);
            plan.casters(pass).iter().for_each(|&caster| (caster as usize).put(&mut numbers));
        }
        let sizes: Vec<_> = light.passes().iter().map(|pass| pass.map_size().to_string()).collect();
        text += &format!("{name}\n{:?} {:?} {}\n", light.kind(), light.test(), sizes.join(" "));
        text += &numbers.line("plan");
    }
    text
}
