//! Bevy's cascade fit, run as Bevy runs it: its own system over a world with a camera and lights.

use std::cell::RefCell;
use std::f32::consts::FRAC_PI_4;
use std::time::Duration;

use anyhow::{Context as _, Result};
use bevy_camera::{Camera, PerspectiveProjection, Projection};
use bevy_ecs::entity::Entity;
use bevy_ecs::system::{IntoSystem, System};
use bevy_ecs::world::World;
use bevy_light::cascade::build_directional_light_cascades;
use bevy_light::{CascadeShadowConfig, Cascades, DirectionalLight, DirectionalLightShadowMap};
use bevy_math::{Mat3, Quat, Vec3};
use bevy_transform::components::{GlobalTransform, Transform};
use shadowfit::glam::{DMat4, DVec3};
use shadowfit::{View, input::Lens};

use super::case::Case;
use super::contender::{Contender, Fitted, NearSide, frustum};
use crate::timing::taken;

/// The names of the contenders here.
pub(crate) const CLOSED: &str = "Bevy's cascade, near plane closed";
pub(crate) const OPEN: &str = "Bevy's cascade";

/// At least so many lights are in the world that is timed, so that what the world costs by itself is spread.
const LIGHTS: usize = 1024;

/// The cascade as Bevy uses it, its near side open to culling, and the same as a plain clip volume.
///
/// Bevy culls casters with the near plane left out ("as a shadow caster could lie before the near plane",
/// `bevy_light::check_dir_light_mesh_visibility`), and draws them with unclipped depth.
///
/// The cases are those that are timed.
///
/// # Errors
///
/// Where a case is no perspective view and a light infinitely far away.
pub(crate) fn cascades<'a>(cases: &[Case<'_>]) -> Result<Vec<Contender<'a>>> {
    [(OPEN, NearSide::Open), (CLOSED, NearSide::Closed)]
        .into_iter()
        .map(|(name, near)| {
            let timed = RefCell::new(Stage::crowded(cases)?);
            let single = RefCell::new(Stage::new(1)?);
            let turn = move |cases: &[Case<'_>]| timed.borrow_mut().turn(cases.len());
            let fitted = move |case: &Case<'_>| single.borrow_mut().fitted(case, near);
            Ok(Contender::of_turns(name, turn, fitted))
        })
        .collect()
}

/// A world with a camera and lights.
struct Stage {
    world: World,
    system: Box<dyn System<In = (), Out = ()>>,
    camera: Entity,
    lights: Vec<Entity>,
    /// Cameras to take in turn.
    views: Vec<Eye>,
    next: usize,
}

/// A camera in Bevy's terms.
struct Eye {
    transform: GlobalTransform,
    projection: Projection,
    /// One cascade from near to far.
    config: CascadeShadowConfig,
}

impl Stage {
    fn new(lights: usize) -> Result<Self> {
        let mut world = World::new();
        world.insert_resource(DirectionalLightShadowMap { size: 2048 });
        let projection = Projection::Perspective(PerspectiveProjection { fov: FRAC_PI_4, ..Default::default() });
        let camera = world.spawn((Camera::default(), projection, GlobalTransform::IDENTITY)).id();
        let light = DirectionalLight { shadow_maps_enabled: true, ..Default::default() };
        let lights = (0..lights)
            .map(|_| {
                let rest = (CascadeShadowConfig::default(), Cascades::default(), GlobalTransform::IDENTITY);
                world.spawn((light, rest)).id()
            })
            .collect();
        let mut system: Box<dyn System<In = (), Out = ()>> =
            Box::new(IntoSystem::into_system(build_directional_light_cascades));
        let _ = system.initialize(&mut world);
        Ok(Self { world, system, camera, lights, views: Vec::new(), next: 0 })
    }

    /// With the lights of all cases, over and over, and their cameras.
    fn crowded(cases: &[Case<'_>]) -> Result<Self> {
        let times = LIGHTS.div_ceil(cases.len().max(1));
        let mut stage = Self::new(times * cases.len())?;
        for (index, light) in stage.lights.clone().into_iter().enumerate() {
            let transform = light_transform(&cases[index % cases.len()]).context("the light is at a position")?;
            stage.world.entity_mut(light).insert(transform);
        }
        stage.views = cases
            .iter()
            .map(|case| eye(case).context("the view is no plain perspective"))
            .collect::<Result<_>>()?;
        Ok(stage)
    }

    /// Puts a camera in its place, and the cascades' bounds at its ends.
    fn set(&mut self, eye: &Eye) {
        self.world.entity_mut(self.camera).insert((eye.transform, eye.projection.clone()));
        for light in self.lights.clone() {
            self.world.entity_mut(light).insert(eye.config.clone());
        }
    }

    fn run(&mut self) -> bool {
        self.system.run((), &mut self.world).is_ok()
    }

    /// The time for so many fits, of one camera and all lights.
    fn turn(&mut self, fits: usize) -> Duration {
        let views = std::mem::take(&mut self.views);
        if let Some(eye) = views.get(self.next % views.len().max(1)) {
            self.set(eye);
        }
        self.views = views;
        self.next += 1;
        let time = taken(|| self.run());
        time.mul_f64(fits as f64 / self.lights.len().max(1) as f64)
    }

    /// The fit of one case, by the first light.
    fn fitted(&mut self, case: &Case<'_>, near: NearSide) -> Option<Fitted> {
        let light = *self.lights.first()?;
        self.world.entity_mut(light).insert(light_transform(case)?);
        self.set(&eye(case)?);
        if !self.run() {
            return None;
        }
        let cascades = &self.world.get::<Cascades>(light)?.cascades;
        let matrix = cascades.get(&self.camera)?.first()?.clip_from_world;
        let matrix = DMat4::from_cols_array(&matrix.to_cols_array().map(f64::from));
        Some(frustum(matrix, true, near))
    }
}

fn vector(from: DVec3) -> Vec3 {
    Vec3::from_array(from.as_vec3().to_array())
}

/// A light looks along its −z.
fn light_transform(case: &Case<'_>) -> Option<GlobalTransform> {
    let away = -case.direction_to_light()?;
    Some(Transform::default().looking_to(vector(away), Vec3::Y).into())
}

/// A camera looks along its −z, with y up. The view may be mirrored, which changes no corner.
fn eye(case: &Case<'_>) -> Option<Eye> {
    let view = &case.view;
    let (tangent, aspect) = symmetric_lens(view)?;
    let (back, up) = (-view.forward(), view.up());
    let axes = Mat3::from_cols(vector(up.cross(back)), vector(up), vector(back));
    let transform = Transform::from_translation(vector(view.eye())).with_rotation(Quat::from_mat3(&axes));
    let (near, far) = (view.near() as f32, view.depth(case.corners[7]) as f32);
    let projection = PerspectiveProjection {
        fov: 2.0 * (tangent as f32).atan(),
        aspect_ratio: aspect as f32,
        near,
        far,
        near_clip_plane: bevy_math::Vec4::new(0.0, 0.0, -1.0, -near),
    };
    let config = CascadeShadowConfig { bounds: vec![far], overlap_proportion: 0.2, minimum_distance: near };
    Some(Eye { transform: transform.into(), projection: Projection::Perspective(projection), config })
}

/// Half of the height of a view at distance 1, and its width over its height, where it is a perspective view that looks
/// along its own middle. They are those of the camera's matrix, since corners far out are not known so well.
fn symmetric_lens(view: &View) -> Option<(f64, f64)> {
    let clip_from_world = view.clip_from_world();
    let [x, y, w] = [0, 1, 3].map(|row| clip_from_world.row(row).truncate());
    let aside = (x.normalize().dot(view.forward())).abs().max(y.normalize().dot(view.forward()).abs());
    let is_symmetric = view.lens() == Lens::Perspective && aside <= 1e-9;
    is_symmetric.then(|| (w.length() / y.length(), y.length() / x.length()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowfit::{Light, Scene};

    #[test]
    fn a_cascade_holds_the_view() {
        let bounds = (DVec3::new(-200.0, 0.0, -200.0), DVec3::new(200.0, 20.0, 200.0));
        let scene = Scene::from_box(bounds.0, bounds.1).expect("a legal box");
        let view = View::perspective((0.0, 2.0, 0.0), (0.3, -0.1, -1.0), DVec3::Y, 1.0, 1.6, 0.5, 100.0)
            .expect("a legal view");
        let sun = Light::directional((0.3, 1.0, 0.2)).expect("a legal light");
        let case = [Case::new(view, sun, scene, bounds, Vec::new()).expect("a legal case")];
        for contender in cascades(&case).expect("a perspective view and a sun") {
            let fitted = contender.fitted(&case[0]).expect("it is finite");
            let least = |point: DVec3| {
                fitted.clip.iter().map(|plane| plane.normalized().at(point)).fold(f64::INFINITY, f64::min)
            };
            for corner in case[0].corners {
                assert!(least(corner) > -1e-3, "{}: {corner}", contender.name);
            }
            let before = view.eye() + 25.0 * view.forward() + 150.0 * sun.homogeneous().truncate();
            assert_eq!(least(before) > 0.0, contender.name == OPEN, "{}", contender.name);
            assert!(contender.turn(&case) > Duration::ZERO);
        }
    }
}
