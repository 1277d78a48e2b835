//! The choice of the camera, and of its near and far planes.

use anyhow::{Result, bail};
use shadowfit::View;
use shadowfit::glam::DVec3;

use crate::scene::{Camera, LoadedScene, Mesh};
use crate::trace::{Lens, Tracer};

/// The default vertical field of view, in degrees.
const DEFAULT_FOV_DEGREES: f64 = 50.0;

/// Probe rays across and down the image, which find the visible surfaces.
const PROBE: (u32, u32) = (96, 60);

/// The default near plane relative to the depth of the nearest probed surface: nearer surfaces may lie between the
/// probe rays.
const NEAR_PLANE_MARGIN: f64 = 0.5;

/// The smallest default near plane, relative to the far end of the scene.
const LEAST_NEAR: f64 = 1e-4;

/// Options of the camera; each defaults to the scene's camera, or to a value that suits the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraRequest {
    /// Position, in world space.
    pub eye: Option<DVec3>,
    /// The point to look at from `eye`; defaults to the middle of the scene.
    pub target: Option<DVec3>,
    /// The vertical field of view, in degrees.
    pub fov: Option<f64>,
    /// The near plane's distance, in world units.
    pub near: Option<f64>,
    /// The far plane's distance, in world units; may be infinite.
    pub far: Option<f64>,
}

/// The requested camera; else the scene's own; else one that shows the whole scene.
///
/// # Errors
///
/// When the eye is at its target.
pub fn choose_camera(request: &CameraRequest, aspect: f64, scene: &LoadedScene) -> Result<Camera> {
    let (min, max) = scene.mesh.bounds();
    let fov_y = request.fov.unwrap_or(DEFAULT_FOV_DEGREES).to_radians();
    let mut camera = match (request.eye, scene.camera) {
        (Some(eye), _) => Camera::looking_at(eye, request.target.unwrap_or(0.5 * (min + max)), fov_y)?,
        (None, Some(camera)) => Camera { fov_y: request.fov.map_or(camera.fov_y, f64::to_radians), ..camera },
        (None, None) => Camera::showing(min, max, fov_y, aspect)?,
    };
    camera.near = request.near.or(camera.near);
    camera.far = request.far.or(camera.far);
    Ok(camera)
}

/// The result of the probe rays.
struct Probe {
    /// The depth of the nearest surface, along the camera's axis.
    nearest: f64,
    /// The fraction of hits on back faces.
    back_faces: f64,
}

/// The view of a camera with its own near and far planes; by default the near plane is close in front of the
/// nearest visible surface and the far plane just beyond the scene. The second value is a warning where the image
/// is probably not what was wanted.
///
/// # Errors
///
/// When the camera is invalid, or nothing is in view.
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
    // From inside a watertight object all visible surfaces are back faces, and close.
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
    use std::path::Path;

    use super::*;
    use crate::scene::{self, MeshBuilder, Part};
    use shadowfit::glam::DMat4;

    fn chess_view(request: CameraRequest) -> Result<(View, Option<String>)> {
        let scene = scene::load(Path::new("chess-board"))?;
        let camera = choose_camera(&request, 1.6, &scene)?;
        choose_view(&camera, 1.6, &Tracer::new(&scene.mesh)?)
    }

    fn looking(eye: [f64; 3], target: [f64; 3]) -> CameraRequest {
        CameraRequest { eye: Some(eye.into()), target: Some(target.into()), ..CameraRequest::default() }
    }

    #[test]
    fn the_scenes_own_camera_is_used_where_no_other_is_given() {
        let (view, warning) = chess_view(CameraRequest::default()).expect("the chess board is in view");
        assert_eq!((view.near(), view.far(), warning), (1.0, 28.0, None));
    }

    #[test]
    fn planes_that_nobody_gave_enclose_what_is_in_view() {
        let (view, _) = chess_view(looking([0.0, 2.0, 3.0], [0.0, 0.0, -4.0])).expect("the chess board is in view");
        assert!(view.near() > 0.5 && view.near() < 3.0, "near {}", view.near());
        assert!(view.far() > 27.0 && view.far() < 30.0, "far {}", view.far());
    }

    #[test]
    fn a_camera_that_nobody_placed_shows_the_whole_scene() {
        let mut scene = scene::load(Path::new("chess-board")).expect("built in");
        scene.camera = None;
        let camera = choose_camera(&CameraRequest::default(), 1.6, &scene).expect("the scene has an extent");
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
        let behind = chess_view(looking([0.0, 2.0, 3.0], [0.0, 2.0, 9.0])).expect_err("the board is behind");
        assert!(behind.to_string().contains("--target"), "{behind}");
        let beside = chess_view(looking([0.0, 2.0, 3.0], [0.0, 30.0, 1.0])).expect_err("only sky");
        assert!(beside.to_string().contains("nothing is in view"), "{beside}");
        let beyond = chess_view(CameraRequest { near: Some(27.9), ..CameraRequest::default() })
            .expect_err("the board ends before");
        assert!(beyond.to_string().contains("--near"), "{beyond}");
    }

    #[test]
    fn a_camera_inside_a_solid_is_warned_about() {
        let corners =
            |x: f64| [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(y, z)| DVec3::new(x, y, z));
        let positions = [corners(-1.0), corners(40.0)].concat();
        // The two ends of a long beam, front faces outwards: its sides are not in view.
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
