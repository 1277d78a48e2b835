//! Scenes: landscapes and rooms, flat ones, segments and points, ones that touch the view.

use proptest::prelude::*;
use shadowfit::glam::DVec3;
use shadowfit::{Aabb, InputError, Scene, View, input::ConvexScene};

use super::primitive::{direction, lattice_direction, magnitude};
use super::similarity::{Similarity, plane};

/// The arguments of one of the constructors of a [`Scene`].
#[derive(Clone, Debug, PartialEq)]
pub enum SceneParams {
    Bounds {
        min: [f64; 3],
        max: [f64; 3],
    },
    /// A box cut by planes.
    Cut {
        min: [f64; 3],
        max: [f64; 3],
        planes: Vec<[f64; 4]>,
    },
    /// Least and largest coordinates of boxes.
    Lists {
        casters: Vec<[[f32; 3]; 2]>,
        receivers: Vec<[[f32; 3]; 2]>,
    },
}

/// What a [`Scene`] borrows from.
pub enum SceneStore {
    Bounds([f64; 3], [f64; 3]),
    Cut(Box<Result<ConvexScene, InputError>>),
    Lists(Vec<Aabb>, Vec<Aabb>),
}

impl SceneStore {
    pub fn scene(&self) -> Result<Scene<'_>, InputError> {
        match self {
            Self::Bounds(min, max) => Scene::from_box(*min, *max),
            Self::Cut(body) => body.as_ref().as_ref().map(Scene::from_convex).map_err(|error| *error),
            Self::Lists(casters, receivers) => Scene::new(casters, receivers),
        }
    }
}

impl SceneParams {
    pub fn store(&self) -> SceneStore {
        let boxes = |list: &[[[f32; 3]; 2]]| list.iter().map(|[min, max]| Aabb::new(*min, *max)).collect();
        match self {
            Self::Bounds { min, max } => SceneStore::Bounds(*min, *max),
            Self::Cut { min, max, planes } => {
                let planes: Vec<_> = planes.iter().copied().map(plane).collect();
                SceneStore::Cut(Box::new(ConvexScene::new(*min, *max, &planes)))
            }
            Self::Lists { casters, receivers } => SceneStore::Lists(boxes(casters), boxes(receivers)),
        }
    }

    pub fn moved(&self, by: &Similarity) -> Self {
        let single =
            |[min, max]: &[[f32; 3]; 2]| [min, max].map(|corner| by.point(corner.map(f64::from)).map(|x| x as f32));
        match self {
            Self::Bounds { min, max } => Self::Bounds { min: by.point(*min), max: by.point(*max) },
            Self::Cut { min, max, planes } => Self::Cut {
                min: by.point(*min),
                max: by.point(*max),
                planes: planes.iter().map(|plane| by.plane(*plane)).collect(),
            },
            Self::Lists { casters, receivers } => Self::Lists {
                casters: casters.iter().map(single).collect(),
                receivers: receivers.iter().map(single).collect(),
            },
        }
    }

    /// The least and largest coordinates of all of it.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        match self {
            Self::Bounds { min, max } | Self::Cut { min, max, .. } => (*min, *max),
            Self::Lists { casters, receivers } => {
                let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
                for [min, max] in casters.iter().chain(receivers) {
                    least = least.min(DVec3::from(min.map(f64::from)));
                    most = most.max(DVec3::from(max.map(f64::from)));
                }
                (least.to_array(), most.to_array())
            }
        }
    }
}

/// A scene in terms of a view yet to be known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    outline: Outline,
    /// Extents left of the box: a flat one lacks one, a segment two, a point all three.
    kept: [f64; 3],
    form: Form,
}

#[derive(Clone, Debug, PartialEq)]
enum Outline {
    /// A landscape about the point below the eye.
    Landscape { half_width: f64, height: f64 },
    /// A box about a point at a depth before the eye, in world units.
    Before { depth: f64, across: [f64; 2], half: [f64; 3] },
    /// A box around the corners of V, of which an infinite one has only a part.
    Around { margin: f64 },
    /// A box inside V, by parts of its depth.
    Inside { depth: f64, half: f64 },
    /// A box with a corner at a corner of V.
    Touching { corner: usize, size: [f64; 3] },
}

#[derive(Clone, Debug, PartialEq)]
enum Form {
    Box,
    /// Cut by planes with these normals, at this part of the way from the middle of the box.
    Cut(Vec<([f64; 3], f64)>),
    /// Boxes by parts of the outline, casters first, then receivers.
    Lists(Vec<[f64; 6]>, Vec<[f64; 6]>),
}

impl Place {
    /// The scene, by a view.
    pub(super) fn about(&self, view: &View) -> SceneParams {
        let (min, max) = self.outline.bounds(view);
        let middle = (min + max) * 0.5;
        let half = (max - min) * 0.5 * DVec3::from(self.kept);
        let (min, max) = (middle - half, middle + half);
        match &self.form {
            Form::Box => SceneParams::Bounds { min: min.to_array(), max: max.to_array() },
            Form::Cut(cuts) => {
                let planes = cuts.iter().map(|&(normal, part)| {
                    let normal = DVec3::from(normal);
                    let reach = normal.abs().dot(half);
                    normal.extend(reach * part - normal.dot(middle)).to_array()
                });
                SceneParams::Cut { min: min.to_array(), max: max.to_array(), planes: planes.collect() }
            }
            Form::Lists(casters, receivers) => {
                let boxes = |list: &[[f64; 6]]| {
                    let one = |[x, y, z, a, b, c]: &[f64; 6]| {
                        let low = min + (max - min) * DVec3::new(*x, *y, *z);
                        let size = (max - min) * DVec3::new(*a, *b, *c);
                        [low, low + size].map(|corner| corner.as_vec3().to_array())
                    };
                    list.iter().map(one).collect()
                };
                SceneParams::Lists { casters: boxes(casters), receivers: boxes(receivers) }
            }
        }
    }
}

impl Outline {
    fn bounds(&self, view: &View) -> (DVec3, DVec3) {
        let corners = || {
            let far = if view.far().is_finite() { view.far() } else { 100.0 * view.near() };
            let narrowed = view.narrowed(view.near(), far).unwrap_or(*view);
            narrowed.corners().unwrap_or([view.eye(); 8])
        };
        match *self {
            Self::Landscape { half_width, height } => {
                let eye = view.eye();
                let ground = DVec3::new(eye.x, 0.0, eye.z);
                let reach = DVec3::new(half_width, 0.0, half_width);
                (ground - reach, ground + reach + DVec3::Y * height)
            }
            Self::Before { depth, across: [x, y], half } => {
                let centre = view.eye() + (view.forward() + view.right() * x + view.up() * y) * depth;
                (centre - DVec3::from(half), centre + DVec3::from(half))
            }
            Self::Around { margin } => {
                let corners = corners();
                let min = corners.into_iter().fold(DVec3::INFINITY, DVec3::min);
                let max = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
                let more = (max - min) * margin;
                (min - more, max + more)
            }
            Self::Inside { depth, half } => {
                let corners = corners();
                let centre = |four: &[DVec3]| four.iter().sum::<DVec3>() / 4.0;
                let (near, far) = (centre(&corners[..4]), centre(&corners[4..]));
                let at = near + (far - near) * depth;
                let half = DVec3::splat(half * view.half_height(view.depth(at)).abs());
                (at - half, at + half)
            }
            Self::Touching { corner, size } => {
                let corner = corners()[corner];
                let other = corner + DVec3::from(size);
                (corner.min(other), corner.max(other))
            }
        }
    }
}

/// Any scene.
pub(super) fn scene_place() -> impl Strategy<Value = Place> {
    let kept = prop_oneof![
        6 => Just([1.0; 3]),
        2 => Just([1.0, 0.0, 1.0]),
        1 => (0..3_usize).prop_map(|axis| std::array::from_fn(|i| if i == axis { 0.0 } else { 1.0 })),
        1 => (0..3_usize).prop_map(|axis| std::array::from_fn(|i| if i == axis { 1.0 } else { 0.0 })),
        1 => Just([0.0; 3]),
        1 => Just([1.0, 1e-9, 1.0]),
    ];
    (outline(), kept, form()).prop_map(|(outline, kept, form)| Place { outline, kept, form })
}

fn outline() -> impl Strategy<Value = Outline> {
    let half = prop::array::uniform3(magnitude(0.05, 200.0));
    prop_oneof![
        4 => (magnitude(5.0, 2000.0), magnitude(0.1, 100.0))
            .prop_map(|(half_width, height)| Outline::Landscape { half_width, height }),
        4 => (magnitude(0.1, 300.0), prop::array::uniform2(-1.5..1.5), half)
            .prop_map(|(depth, across, half)| Outline::Before { depth, across, half }),
        2 => prop_oneof![Just(0.0), magnitude(1e-6, 10.0)].prop_map(|margin| Outline::Around { margin }),
        2 => (0.0..1.0, magnitude(1e-3, 0.7)).prop_map(|(depth, half)| Outline::Inside { depth, half }),
        1 => (0..8_usize, prop::array::uniform3(-5.0..5.0))
            .prop_map(|(corner, size)| Outline::Touching { corner, size }),
    ]
}

fn form() -> impl Strategy<Value = Form> {
    let normal = prop_oneof![direction(), lattice_direction()];
    // At −1 a cut leaves a corner, from 1 on nothing is cut.
    let cut = (normal, prop_oneof![4 => -0.5..1.0, 1 => Just(0.0), 1 => Just(1.0)]);
    let list = || {
        let part = || prop_oneof![3 => 0.0..0.9, 1 => Just(0.0), 1 => Just(0.5)];
        let size = || prop_oneof![3 => 0.0..0.5, 1 => Just(0.0), 1 => Just(0.5), 1 => Just(1.0)];
        prop::collection::vec(((part(), part(), part()), (size(), size(), size())), 1..6)
            .prop_map(|list| list.into_iter().map(|((x, y, z), (a, b, c))| [x, y, z, a, b, c]).collect())
    };
    prop_oneof![
        6 => Just(Form::Box),
        2 => prop::collection::vec(cut, 1..5).prop_map(Form::Cut),
        2 => (list(), list()).prop_map(|(casters, receivers)| Form::Lists(casters, receivers)),
    ]
}

/// Boxes at small integers, flat ones and points among them, and such boxes with cut corners.
pub(super) fn lattice_scene() -> impl Strategy<Value = SceneParams> {
    let corner = prop::array::uniform3(-6..=6_i8);
    let size = prop::array::uniform3(0..=8_i8);
    let cuts = prop_oneof![
        2 => Just(Vec::new()),
        1 => prop::collection::vec((lattice_direction(), -2..8_i8), 1..5),
    ];
    (corner, size, cuts).prop_map(|(corner, size, cuts)| {
        let min = corner.map(f64::from);
        let max: [f64; 3] = std::array::from_fn(|i| f64::from(corner[i]) + f64::from(size[i]));
        if cuts.is_empty() {
            return SceneParams::Bounds { min, max };
        }
        let planes = cuts.into_iter().map(|([x, y, z], offset)| [x, y, z, f64::from(offset)]).collect();
        SceneParams::Cut { min, max, planes }
    })
}
