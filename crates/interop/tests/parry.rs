//! parry3d, whose glam is not the one that shadowfit uses where both are newest.

use interop::{SUN, map, place};
use parry3d::math::Vector;
use shadowfit::{Light, Scene};

#[test]
fn there() {
    assert_eq!(Light::directional(Vector::new(0.25, 1.0, 0.5)), Light::directional(SUN));
    let bounds = parry3d::bounding_volume::Aabb::new(Vector::new(-1.0, 0.0, -2.0), Vector::new(1.0, 2.0, 3.0));
    assert!(Scene::from_box(bounds.mins, bounds.maxs).is_ok());
}

#[test]
fn and_back() {
    let [x, y, z, _] = place([1.0, 0.5, -1.0]);
    assert!(Vector::new(x, y, z).is_finite());
    assert!(Vector::from_array(map().camera().eye.as_vec3().to_array()).is_finite());
}
