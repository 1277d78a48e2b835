//! Which camera looks at the scene, and where its near and far planes lie.

use anyhow::{Context, Result, bail};
use shadowfit::View;
use shadowfit::glam::DVec3;

use crate::args::ViewArgs;
use crate::picture::Lens;
use crate::scene::{LoadedScene, Mesh};
use crate::trace::Tracer;

/// The vertical field of view where nobody gives one, in degrees.
const DEFAULT_FOV_DEGREES: f64 = 50.0;

/// The direction from the scene's middle to a camera that nobody placed: in front, to the right and above.
const DEFAULT_DIRECTION_TO_EYE: DVec3 = DVec3::new(0.55, 0.45, 0.8);

/// The probe: so many rays across and down look for what is in view.
const PROBE: (u32, u32) = (96, 60);

/// How far the nearest surface in view is off, compared with the near plane put before it: the probe's rays leave gaps
/// in which something may stand nearer.
const NEAR_PLANE_MARGIN: f64 = 0.5;

/// The least near distance chosen, as a part of the distance to the scene's far end.
const LEAST_NEAR: f64 = 1e-4;

/// A perspective camera, before it is checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it is, in world space.
    pub eye: DVec3,
    /// Where it looks, of length one.
    pub forward: DVec3,
    /// What is up in its picture, roughly; not along `forward`.
    pub up: DVec3,
    /// The vertical field of view, in radians.
    pub fov_y: f64,
    /// The near plane's distance, where somebody chose it.
    pub near: Option<f64>,
    /// The far plane's distance, where somebody chose it; may be infinite.
    pub far: Option<f64>,
}

impl Camera {
    /// A camera at `eye` that looks at `target`, with y up.
    ///
    /// # Errors
    ///
    /// When the two are the same point.
    pub fn looking_at(eye: DVec3, target: DVec3, fov_y: f64) -> Result<Self> {
        let forward = (target - eye).try_normalize().context("the eye is at its target: move --eye or --target")?;
        // Looking straight up or down, y is no help: let −z be up, as on a map.
        let up = if forward.y.abs() > 0.999 { DVec3::NEG_Z } else { DVec3::Y };
        Ok(Self { eye, forward, up, fov_y, near: None, far: None })
    }

    /// A camera that shows the whole of a box, as wide as high at least `aspect` or 1.
    fn showing(min: DVec3, max: DVec3, fov_y: f64, aspect: f64) -> Result<Self> {
        let centre = 0.5 * (min + max);
        let radius = 0.5 * (max - min).length();
        let half_angle = (0.5 * fov_y).min((aspect * (0.5 * fov_y).tan()).atan());
        let distance = radius / half_angle.sin();
        Self::looking_at(centre + distance * DEFAULT_DIRECTION_TO_EYE.normalize(), centre, fov_y)
    }

    /// The view of this camera between two planes.
    ///
    /// # Errors
    ///
    /// When it makes no sense.
    pub fn view(&self, aspect: f64, near: f64, far: f64) -> Result<View> {
        View::perspective(self.eye, self.forward, self.up, self.fov_y, aspect, near, far)
            .context("the camera cannot be used")
    }
}

/// The camera that the arguments ask for; else the scene's own; else one that shows the whole scene.
///
/// # Errors
///
/// When the arguments contradict each other.
pub fn choose_camera(args: &ViewArgs, scene: &LoadedScene) -> Result<Camera> {
    let (min, max) = scene.mesh.bounds();
    let fov_y = args.fov.unwrap_or(DEFAULT_FOV_DEGREES).to_radians();
    let mut camera = match (args.eye, scene.camera) {
        (Some(eye), _) => Camera::looking_at(eye, args.target.unwrap_or(0.5 * (min + max)), fov_y)?,
        (None, Some(camera)) => Camera { fov_y: args.fov.map_or(camera.fov_y, f64::to_radians), ..camera },
        (None, None) => Camera::showing(min, max, fov_y, args.aspect())?,
    };
    camera.near = args.near.or(camera.near);
    camera.far = args.far.or(camera.far);
    Ok(camera)
}

/// What a few rays through the picture meet.
struct Probe {
    /// The depth of the nearest surface, along the camera's axis.
    nearest: f64,
    /// The share of the surfaces met that face away from the camera.
    back_faces: f64,
}

/// The camera with its planes: those it has, else the near plane close before what is in view and the far plane
/// behind the whole scene. The second value is a warning, where the picture is unlikely to be what was wanted.
///
/// # Errors
///
/// When the camera makes no sense, or when nothing is in view.
pub fn choose_view(camera: &Camera, aspect: f64, tracer: &Tracer) -> Result<(View, Option<String>)> {
    let scene_end = farthest_depth(camera, tracer.mesh());
    if scene_end <= 0.0 {
        bail!("nothing is in view: the whole scene is behind the camera; turn it round with --target");
    }
    let far = camera.far.unwrap_or(1.01 * scene_end);
    let least_near = camera.near.unwrap_or(LEAST_NEAR * far.min(scene_end));
    let probe = probe(&camera.view(aspect, least_near, far)?, tracer)?;
    let near = camera.near.unwrap_or((NEAR_PLANE_MARGIN * probe.nearest).max(least_near));
    let view = camera.view(aspect, near, far)?;
    // Inside a closed solid one sees it from behind, all around and close by.
    let (min, max) = tracer.bounds();
    let inside = probe.back_faces > 0.9 && probe.nearest < 0.02 * (max - min).length();
    let warning = inside.then(|| {
        "the camera seems to be inside a wall or a solid: nearly all it sees are back faces; move --eye".to_owned()
    });
    Ok((view, warning))
}

/// The greatest depth along the camera's axis of any corner of the scene's box.
fn farthest_depth(camera: &Camera, mesh: &Mesh) -> f64 {
    let (min, max) = mesh.bounds();
    let corner = DVec3::select(camera.forward.cmpgt(DVec3::ZERO), max, min);
    (corner - camera.eye).dot(camera.forward)
}

fn probe(view: &View, tracer: &Tracer) -> Result<Probe> {
    let lens = Lens::of_view(view)?;
    let (width, height) = PROBE;
    let (mut hits, mut back_faces, mut nearest) = (0_u32, 0_u32, f64::INFINITY);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let Some(ray) = lens.ray_through_pixel(x, y, width, height) else {
            continue;
        };
        let Some(hit) = tracer.first_hit(&ray) else {
            continue;
        };
        hits += 1;
        back_faces += u32::from(hit.is_back_face(&ray));
        nearest = nearest.min((hit.point - view.eye()).dot(view.forward()));
    }
    if hits == 0 {
        bail!(
            "nothing is in view between the near plane at {:.4} and the far plane at {:.4}: \
             look elsewhere with --eye and --target, or move the planes with --near and --far",
            view.near(),
            view.far()
        );
    }
    Ok(Probe { nearest, back_faces: f64::from(back_faces) / f64::from(hits) })
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::args::Args;
    use crate::scene::{self, MeshBuilder, Part};
    use shadowfit::glam::DMat4;

    fn chess_view(arguments: &[&str]) -> Result<(View, Option<String>)> {
        let args = Args::parse_from([&["render-check"], arguments].concat()).check.view;
        let scene = scene::load(&args.scene)?;
        let camera = choose_camera(&args, &scene)?;
        choose_view(&camera, 1.6, &Tracer::new(&scene.mesh)?)
    }

    #[test]
    fn the_scenes_own_camera_is_used_where_no_other_is_given() {
        let (view, warning) = chess_view(&[]).expect("the chess board is in view");
        assert_eq!((view.near(), view.far(), warning), (1.0, 28.0, None));
    }

    #[test]
    fn planes_that_nobody_gave_enclose_what_is_in_view() {
        let (view, _) = chess_view(&["--eye", "0,2,3", "--target", "0,0,-4"]).expect("the chess board is in view");
        assert!(view.near() > 0.5 && view.near() < 3.0, "near {}", view.near());
        assert!(view.far() > 27.0 && view.far() < 30.0, "far {}", view.far());
    }

    #[test]
    fn a_camera_that_nobody_placed_shows_the_whole_scene() {
        let args = Args::parse_from(["render-check"]).check.view;
        let mut scene = scene::load(&args.scene).expect("built in");
        scene.camera = None;
        let camera = choose_camera(&args, &scene).expect("the scene has an extent");
        let tracer = Tracer::new(&scene.mesh).expect("the scene has triangles");
        let (view, _) = choose_view(&camera, 1.6, &tracer).expect("in view");
        let lens = Lens::of_view(&view).expect("invertible");
        let (min, max) = scene.mesh.bounds();
        for corner in [min, max, DVec3::new(min.x, max.y, min.z), DVec3::new(max.x, min.y, max.z)] {
            let [x, y, z] = lens.project(corner).to_array();
            assert!(x.abs() <= 1.0 && y.abs() <= 1.0 && (0.0..=1.0).contains(&z), "{corner} at {x}, {y}, {z}");
        }
    }

    #[test]
    fn an_empty_view_is_an_error_that_says_what_to_do() {
        let behind = chess_view(&["--eye", "0,2,3", "--target", "0,2,9"]).expect_err("the board is behind");
        assert!(behind.to_string().contains("--target"), "{behind}");
        let beside = chess_view(&["--eye", "0,2,3", "--target", "0,30,1"]).expect_err("only sky");
        assert!(beside.to_string().contains("nothing is in view"), "{beside}");
        let beyond = chess_view(&["--near", "27.9"]).expect_err("the board ends before");
        assert!(beyond.to_string().contains("--near"), "{beyond}");
    }

    #[test]
    fn a_camera_inside_a_solid_is_warned_about() {
        let corners =
            |x: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(y, z)| DVec3::new(x, y, z));
        let positions = [corners(-1.0), corners(40.0)].concat();
        // The two ends of a long beam, fronts outwards: its sides are not in view.
        let triangles = [[4, 5, 6], [4, 6, 7], [0, 2, 1], [0, 3, 2]];
        let mut builder = MeshBuilder::default();
        builder.add(
            &Part { positions: &positions, normals: &[], triangles: &triangles, colour: [1.0; 3] },
            DMat4::IDENTITY,
        );
        let (mesh, _) = builder.finish();
        let tracer = Tracer::new(&mesh).expect("the mesh has triangles");
        let warning = |eye: DVec3, target: DVec3| {
            let camera = Camera::looking_at(eye, target, 1.0).expect("apart");
            choose_view(&camera, 1.0, &tracer).expect("in view").1
        };
        assert!(warning(39.7 * DVec3::X, 45.0 * DVec3::X).expect("inside").contains("--eye"));
        assert_eq!(warning(44.0 * DVec3::X, DVec3::ZERO), None);
    }
}
