//! H by a general-purpose library of convex geometry, in f32 and in f64: parry's convex hull, cut by parry's half-spaces.

use shadowfit::focus::Plane;
use shadowfit::glam::{DVec3, Mat4};

use super::case::Case;
use super::contender::{Contender, Culling, Fitted, NearSide, clip_planes};
use super::naive::matrix_of_box;

/// The names of the contenders here.
pub(crate) const SINGLE: &str = "parry3d, H";
pub(crate) const DOUBLE: &str = "parry3d-f64, H";
pub(crate) const NAMES: [&str; 2] = [SINGLE, DOUBLE];

/// The contenders.
pub(crate) fn libraries<'a>() -> Vec<Contender<'a>> {
    vec![
        Contender::new(
            SINGLE,
            |case| single::cut_hull(case).map(|hull| hull.with_map(case)),
            |_, hull| hull.finish(),
        ),
        Contender::new(
            DOUBLE,
            |case| double::cut_hull(case).map(|hull| hull.with_map(case)),
            |_, hull| hull.finish(),
        ),
    ]
}

/// A body as a library left it.
struct Hull {
    /// Inside ≥ 0.
    planes: Vec<Plane>,
    points: Vec<DVec3>,
    /// The box around it, of a light infinitely far away.
    shadow_from_world: Option<Mat4>,
}

impl Hull {
    fn new(planes: Vec<Plane>, points: Vec<DVec3>) -> Self {
        Self { planes, points, shadow_from_world: None }
    }

    /// The same with the box around it across the light, whose axes are those of the crate's uniform map: turned to what
    /// the view looks along.
    fn with_map(self, case: &Case<'_>) -> Self {
        let matrix = |to_light: DVec3| {
            let right = case.view.forward().cross(to_light).try_normalize();
            let right = right.unwrap_or_else(|| to_light.any_orthonormal_vector());
            let axes = [right, to_light.cross(right), to_light];
            let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            for point in &self.points {
                let seen = DVec3::from_array(axes.map(|axis| axis.dot(*point)));
                (min, max) = (min.min(seen), max.max(seen));
            }
            // A flat body has a box with some room too, more than f32 rounds there.
            let room = 1e-6 * ((max - min).length() + min.abs().max(max.abs()).max_element());
            matrix_of_box(&axes, min - room, max + room).as_mat4()
        };
        let shadow_from_world = case.direction_to_light().filter(|_| !self.points.is_empty()).map(matrix);
        Self { shadow_from_world, ..self }
    }

    /// Casters are culled by its planes, and clipped by its box where it has one.
    fn finish(self) -> Fitted {
        if self.points.is_empty() {
            return Fitted { shadow_from_world: None, clip: Vec::new(), culling: Culling::Nobody };
        }
        let shadow_from_world = self.shadow_from_world.map(|matrix| matrix.as_dmat4());
        let boxed = |matrix| clip_planes(matrix, false, NearSide::Closed);
        let clip = shadow_from_world.as_ref().map_or_else(|| self.planes.clone(), boxed);
        Fitted { shadow_from_world, clip, culling: Culling::Planes(self.planes) }
    }
}

/// The same in one of the two precisions of the library.
macro_rules! precision {
    ($module:ident, $parry:ident, $real:ty) => {
        mod $module {
            use shadowfit::focus::Plane;
            use shadowfit::glam::DVec3;
            use $parry::math::Vector;
            use $parry::query::details::clip_halfspace_polygon;
            use $parry::shape::ConvexPolyhedron;

            use super::super::case::{Case, corners_of};
            use super::Hull;

            /// A half-space as the library takes it: a point on its plane, and its outward normal.
            #[derive(Clone, Copy)]
            struct HalfSpace {
                centre: Vector,
                outward: Vector,
            }

            impl HalfSpace {
                fn of(plane: &Plane) -> Self {
                    let plane = plane.normalized();
                    Self { centre: vector(plane.normal * -plane.offset), outward: -vector(plane.normal) }
                }

                fn plane(&self) -> Plane {
                    Plane::through(-wide(self.outward), wide(self.centre))
                }

                /// A square on its plane, around the foot of a point.
                fn square(&self, around: Vector, reach: $real) -> Vec<Vector> {
                    let foot = around - self.outward * (around - self.centre).dot(self.outward);
                    let (x, y) = wide(self.outward).any_orthonormal_pair();
                    let (x, y) = (vector(x) * reach, vector(y) * reach);
                    vec![foot - x - y, foot + x - y, foot + x + y, foot - x + y]
                }
            }

            fn vector(from: DVec3) -> Vector {
                Vector::new(from.x as $real, from.y as $real, from.z as $real)
            }

            fn wide(from: Vector) -> DVec3 {
                DVec3::new(f64::from(from.x), f64::from(from.y), f64::from(from.z))
            }

            /// The hull of the view and the light, cut by the planes of scene and light: the faces of the hull, then those
            /// of the planes, each cut by all others. `None` where the library makes no hull.
            pub(super) fn cut_hull(case: &Case<'_>) -> Option<Hull> {
                let mut points: Vec<Vector> = case.corners.iter().copied().map(vector).collect();
                let scene = corners_of(case.bounds);
                match (case.direction_to_light(), case.light.position()) {
                    (Some(to_light), _) => {
                        // Swept until all of it is beyond the scene.
                        let along = |corners: &[DVec3; 8]| corners.map(|corner| corner.dot(to_light));
                        let last = along(&scene).into_iter().fold(f64::NEG_INFINITY, f64::max);
                        let first = along(&case.corners).into_iter().fold(f64::INFINITY, f64::min);
                        let sweep = (last - first).max(0.0) * 1.01 + case.view.near();
                        points.extend(case.corners.iter().map(|&corner| vector(corner + to_light * sweep)));
                    }
                    (None, position) => points.extend(position.map(vector)),
                }
                let hull = ConvexPolyhedron::from_convex_hull(&points)?;
                // A face whose plane has all of the scene inside has no part there and cuts nothing.
                let scene = scene.map(vector);
                let cuts_scene =
                    |face: &HalfSpace| scene.iter().any(|&corner| (corner - face.centre).dot(face.outward) > 0.0);
                let faces: Vec<(HalfSpace, Vec<Vector>)> = hull
                    .faces()
                    .iter()
                    .filter_map(|face| {
                        let first = face.first_vertex_or_edge as usize;
                        let corners =
                            &hull.vertices_adj_to_face()[first..first + face.num_vertices_or_edges as usize];
                        let polygon: Vec<Vector> =
                            corners.iter().map(|&index| hull.points()[index as usize]).collect();
                        // The library merges faces that nearly lie in one plane: through the farthest point, none is lost.
                        let outward = face.normal;
                        let by_reach = |a: &&Vector, b: &&Vector| outward.dot(**a).total_cmp(&outward.dot(**b));
                        let centre = hull.points().iter().max_by(by_reach).copied()?;
                        Some((HalfSpace { centre, outward }, polygon))
                    })
                    .filter(|(plane, _)| cuts_scene(plane))
                    .collect();
                let light = case.light.planes();
                let cuts: Vec<HalfSpace> =
                    case.scene_planes().iter().chain(light.iter()).map(HalfSpace::of).collect();

                let (min, max) = case.bounds;
                let (middle, reach) = (vector(0.5 * (min + max)), 2.0 * (max - min).length() as $real);
                let squares = cuts.iter().map(|cut| (*cut, cut.square(middle, reach)));
                let hull_planes: Vec<HalfSpace> = faces.iter().map(|(plane, _)| *plane).collect();
                let (mut planes, mut left, mut cut) = (Vec::new(), Vec::new(), Vec::new());
                let count = faces.len();
                for (index, (plane, mut polygon)) in faces.into_iter().chain(squares).enumerate() {
                    let others = cuts.iter().enumerate().filter(|(other, _)| count + other != index);
                    // A face of the hull is inside of the hull as it is.
                    let hull_planes = if index < count { &[][..] } else { &hull_planes[..] };
                    for HalfSpace { centre, outward } in others.map(|(_, other)| other).chain(hull_planes) {
                        if polygon.is_empty() {
                            break;
                        }
                        clip_halfspace_polygon(*centre, *outward, &polygon, &mut cut);
                        std::mem::swap(&mut polygon, &mut cut);
                    }
                    if !polygon.is_empty() {
                        planes.push(plane.plane());
                        left.extend(polygon.into_iter().map(wide));
                    }
                }
                Some(Hull::new(planes, left))
            }
        }
    };
}

precision!(single, parry3d, f32);
precision!(double, parry3d_f64, f64);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::case::box_planes;
    use crate::body::truth::Truth;
    use shadowfit::{Light, Scene, View};

    #[test]
    fn double_precision_holds_the_body() {
        let bounds = (DVec3::new(-200.0, 0.0, -200.0), DVec3::new(200.0, 20.0, 200.0));
        let scene = Scene::from_box(bounds.0, bounds.1).expect("a legal box");
        let view = View::perspective((0.0, 2.0, 0.0), (0.3, -0.1, -1.0), DVec3::Y, 1.0, 1.6, 0.5, 100.0)
            .expect("a legal view");
        let lights = [
            Light::directional((0.3, 1.0, 0.2)),
            Light::point((0.0, 15.0, -30.0), 0.1, 300.0),
            Light::spot((0.0, 15.0, -30.0), (0.1, -1.0, -0.5), 0.6, 0.1, 300.0),
        ];
        for light in lights {
            let light = light.expect("a legal light");
            let case = Case::new(view, light, scene, bounds, Vec::new()).expect("a legal case");
            let truth =
                Truth::new(&view, &light, &box_planes(bounds), &box_planes(bounds)).expect("much is visible");
            for contender in libraries() {
                let fitted = contender.fitted(&case).expect("it makes a hull");
                let Culling::Planes(planes) = &fitted.culling else { panic!("it is not empty") };
                for plane in planes.iter().chain(&fitted.clip) {
                    let outside = truth.body.body.violation(plane.to_row().to_array());
                    assert!(outside < 1e-2, "{}: {outside} outside of {plane:?}", contender.name);
                }
            }
        }
    }
}
