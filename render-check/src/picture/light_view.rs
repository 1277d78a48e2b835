//! The scene from the light, with the camera's frustum and the caster volume H drawn over it.

use anyhow::Result;
use image::{Rgb, RgbImage};
use shadowfit::glam::{DVec2, DVec3};
use shadowfit::{View, focus::ConvexBody};

use super::canvas::{BODY_COLOUR, Canvas, FRUSTUM_COLOUR, Sample, encode};
use super::lines::{Line, Pen, draw_lines};
use super::shade::background;
use super::text;
use crate::output::progress;
use crate::scene::{LightSpec, Mesh};
use crate::trace::{Lens, Tracer};

/// The margin around the picture's contents, relative to their size.
const MARGIN: f64 = 1.12;

/// The largest factor by which the picture may grow to include the camera and its frustum besides H.
const MOST_SHRINKING: f64 = 1.7;

/// The largest tangent of half the field of view from a local light: 70 degrees.
const WIDEST_SLOPE: f64 = 2.747;

/// The brightness of surfaces outside H, relative to those inside.
const OUTSIDE_BRIGHTNESS: f32 = 0.3;

/// A lens at the light that shows all of H, and the camera and its frustum as far as they leave H large. The
/// camera's forward direction points up in the picture where possible.
///
/// # Errors
///
/// When H is empty.
pub fn light_lens(light: &LightSpec, view: &View, body: &ConvexBody, mesh: &Mesh, aspect: f64) -> Result<Lens> {
    let (min, max) = mesh.bounds();
    let subject = if body.is_empty() { vec![min, max] } else { body.vertices().to_vec() };
    let axes_towards = |forward: DVec3| {
        let up = view.forward().reject_from_normalized(forward).try_normalize();
        let up = up.unwrap_or_else(|| {
            view.up().reject_from_normalized(forward).normalize_or(forward.any_orthonormal_vector())
        });
        [forward.cross(up), up, forward]
    };
    match *light {
        LightSpec::Sun { direction_to_light } => {
            let axes = axes_towards(-direction_to_light.normalize_or(DVec3::Y));
            parallel_lens(axes, view, &subject, [min, max], aspect)
        }
        LightSpec::Point { position, .. } | LightSpec::Spot { position, .. } => {
            let forward = match *light {
                LightSpec::Spot { target, .. } => target - position,
                _ => middle_direction(position, &subject),
            };
            let axes = axes_towards(forward.normalize_or(DVec3::NEG_Y));
            // The largest slope to any point of H, capped for points beside the light or behind it.
            let slope = |axis: DVec3, p: DVec3| {
                let depth = axes[2].dot(p - position);
                if depth > 0.0 { (axis.dot(p - position) / depth).abs() } else { f64::INFINITY }
            };
            let widest = |axis: DVec3| subject.iter().map(|&p| slope(axis, p)).fold(0.0, f64::max);
            let vertical = (MARGIN * widest(axes[1]).max(widest(axes[0]) / aspect)).clamp(0.05, WIDEST_SLOPE);
            let far =
                1.01 * corners(min, max).iter().chain(&subject).map(|p| p.distance(position)).fold(0.0, f64::max);
            Lens::perspective(position, axes, DVec2::new(vertical * aspect, vertical), [1e-3 * far, far])
        }
    }
}

/// The axis of the narrowest cone around all points, seen from a position: the centre of the smallest enclosing
/// ball of their directions by Bădoiu and Clarkson's iteration. Where points lie all around and no such cone
/// exists, the direction to their centroid.
fn middle_direction(position: DVec3, points: &[DVec3]) -> DVec3 {
    let directions: Vec<DVec3> = points.iter().map(|&p| (p - position).normalize_or_zero()).collect();
    let mut middle = directions.iter().sum::<DVec3>() / directions.len() as f64;
    for step in 1..=100 {
        let off = |direction: &&DVec3| direction.distance_squared(middle);
        if let Some(&farthest) = directions.iter().max_by(|a, b| off(a).total_cmp(&off(b))) {
            middle = middle.lerp(farthest, 1.0 / f64::from(step + 1));
        }
    }
    let is_wide = directions.iter().any(|direction| direction.dot(middle.normalize_or_zero()) < 0.2);
    if is_wide { points.iter().sum::<DVec3>() / points.len() as f64 - position } else { middle }
}

fn parallel_lens(
    axes: [DVec3; 3],
    view: &View,
    subject: &[DVec3],
    bounds: [DVec3; 2],
    aspect: f64,
) -> Result<Lens> {
    let [right, up, forward] = axes;
    let window = |points: &[DVec3]| {
        points
            .iter()
            .map(|&p| DVec2::new(right.dot(p), up.dot(p)))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
    };
    // Better to cut off the far end of a long frustum than to shrink H to a speck.
    let size = |points: &[DVec3]| window(points).1 - window(points).0;
    let mut shown = subject.to_vec();
    let frustum = view.corners().map_or_else(Vec::new, |corners| corners.to_vec());
    for candidates in [&[view.eye()][..], &frustum] {
        let with_candidates = [&shown, candidates].concat();
        if size(&with_candidates).max_element() <= MOST_SHRINKING * size(subject).max_element() {
            shown = with_candidates;
        }
    }
    let (low, high) = window(&shown);
    let half = 0.5 * MARGIN * (high - low);
    let half_height = half.y.max(half.x / aspect);
    let depths: Vec<f64> = corners(bounds[0], bounds[1]).iter().chain(&shown).map(|&p| forward.dot(p)).collect();
    let (nearest, farthest) =
        depths.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &d| (a.min(d), b.max(d)));
    let room = 0.01 * (farthest - nearest).max(half_height);
    let middle = 0.5 * (low + high);
    let centre = middle.x * right + middle.y * up + (nearest - room) * forward;
    Lens::parallel(centre, axes, DVec2::new(half_height * aspect, half_height), farthest - nearest + 2.0 * room)
}

fn corners(min: DVec3, max: DVec3) -> [DVec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
        let pick = |axis: usize| {
            if i >> axis & 1 == 1 { max[axis] } else { min[axis] }
        };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}

/// Ray-casts the picture through the light's lens and draws the camera's frustum and the edges of H over it.
#[must_use]
pub fn light_view(
    lens: &Lens,
    view: &View,
    tracer: &Tracer,
    body: &ConvexBody,
    [width, height]: [u32; 2],
) -> RgbImage {
    let bar = progress::bar("the light's view", 0);
    // The outermost surfaces of a scene lie exactly on faces of its box and so of H, hence the tolerance.
    let (min, max) = tracer.bounds();
    let hair = 1e-9 * (max - min).length();
    let is_inside = |point: DVec3| {
        !body.is_empty() && body.planes().all(|plane| plane.at(point) >= -hair * plane.normal.length())
    };
    let mut canvas = Canvas::render(width, height, &bar, |x, y, width, height| {
        let seen = lens.ray_through_pixel(x, y, width, height).and_then(|ray| Some((ray, tracer.first_hit(&ray)?)));
        let Some((ray, hit)) = seen else {
            return Sample { colour: background(1.0 - y as f32 / height as f32), distance: f64::INFINITY };
        };
        let facing = hit.shading_normal.dot(-ray.direction).max(0.0) as f32;
        let inside = if is_inside(hit.point) { 1.0 } else { OUTSIDE_BRIGHTNESS };
        let light = inside * (0.25 + 0.75 * facing);
        Sample { colour: tracer.mesh().colours[hit.triangle].map(|c| c * light), distance: hit.distance }
    });
    draw_lines(&mut canvas, lens, &frustum_lines(view, tracer.mesh()), &Pen::new(FRUSTUM_COLOUR));
    let edges: Vec<Line> = body.edges().collect();
    draw_lines(&mut canvas, lens, &edges, &Pen::new(BODY_COLOUR));
    let mut image = canvas.to_image();
    let [body_colour, frustum_colour] = [BODY_COLOUR, FRUSTUM_COLOUR].map(|c| Rgb(c.map(|c| encode(1.3 * c))));
    text::caption(
        &mut image,
        &[("H ", body_colour), ("camera ", frustum_colour), ("dark: outside H", Rgb([210; 3]))],
    );
    image
}

/// The frustum's edges; an infinite frustum is drawn to well beyond the scene. The four edges along the view start
/// at the eye, so that the shape is recognisable.
fn frustum_lines(view: &View, mesh: &Mesh) -> Vec<Line> {
    let (min, max) = mesh.bounds();
    let end = 2.0 * (max - min).length() + view.eye().distance(0.5 * (min + max));
    let far = view.far().min(end);
    let Ok(lens) = Lens::of_view(view) else {
        return Vec::new();
    };
    let corners_at = |depth: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let ray = lens.ray(DVec2::new(x, y));
            ray.map_or(view.eye(), |ray| {
                let cosine = ray.direction.dot(view.forward());
                view.eye() + depth / cosine * ray.direction
            })
        })
    };
    let (near_corners, far_corners) = (corners_at(view.near()), corners_at(far));
    let ring = |corners: [DVec3; 4]| [0, 1, 2, 3].map(|i| (corners[i], corners[(i + 1) % 4]));
    let mut lines: Vec<_> = far_corners.iter().map(|&corner| (view.eye(), corner)).collect();
    lines.extend(ring(near_corners));
    if view.far() <= end {
        lines.extend(ring(far_corners));
    }
    lines
}
