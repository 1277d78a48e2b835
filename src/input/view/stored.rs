//! The serialised form of a view, checked when it is read.

use super::{DVec2, DVec3, InputError, InputErrorKind, Lens, Plane, check};

#[derive(serde::Deserialize)]
pub(super) struct View {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    lean: f64,
    lens: Lens,
    frame_min: DVec2,
    frame_max: DVec2,
    near: f64,
    #[serde(with = "crate::math::infinity")]
    far: f64,
    near_cut: Option<Plane>,
    far_cut: Option<Plane>,
}

impl TryFrom<View> for super::View {
    type Error = InputError;
    fn try_from(view: View) -> Result<Self, InputError> {
        let View { eye, right, up, forward, lean, lens, frame_min, frame_max, near, far, near_cut, far_cut } = view;
        let units = [right, up, forward].map(|axis| axis.length_squared() - 1.0);
        let square = [right.dot(up) - lean, up.dot(forward), forward.dot(right)];
        let is_image = lean.abs() < 1.0 && 1.0 - lean * lean > 1e-12;
        if !(is_image && units.iter().chain(&square).all(|error| error.abs() < 1e-9)) {
            return check::fail("forward", InputErrorKind::NotOrthonormal);
        }
        for (field, cut) in [("near_cut", near_cut), ("far_cut", far_cut)] {
            if cut.is_some_and(|plane| !plane.to_row().is_finite()) {
                return check::fail(field, InputErrorKind::NotFinite);
            }
        }
        Self { eye, right, up, forward, lean, lens, frame_min, frame_max, near, far, near_cut, far_cut }.checked()
    }
}
