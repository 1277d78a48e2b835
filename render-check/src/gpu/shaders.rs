//! The shaders, concatenated from small files and the crate's WGSL functions.

use shadowfit::wgsl;

/// The camera pass: writes positions and triangle indices.
pub(super) const SURFACES: &str = include_str!("shaders/surfaces.wgsl");

/// Casters into a shadow map.
pub(super) const SHADOW_MAP: &str = include_str!("shaders/shadow_map.wgsl");

/// The second layer: fragments of the first layer are discarded.
pub(super) fn second_layer() -> String {
    let own = include_str!("shaders/second_layer.wgsl");
    [wgsl::MAP, wgsl::FILTERS, wgsl::BETWEEN_LAYERS, SHADOW_MAP, own].concat()
}

/// Casters into a paraboloid map.
pub(super) fn paraboloid_map() -> String {
    [wgsl::PARABOLOID, include_str!("shaders/paraboloid_map.wgsl")].concat()
}

/// The discs of points into a shadow map.
pub(super) fn splats() -> String {
    [wgsl::SPLAT, include_str!("shaders/splats.wgsl")].concat()
}

/// Copies a depth buffer to a colour target.
pub(super) const COPY_DEPTH: &str =
    concat!(include_str!("shaders/full_screen.wgsl"), include_str!("shaders/copy_depth.wgsl"));

/// Reduces a depth buffer to tiles.
pub(super) fn depth_tiles() -> String {
    [wgsl::DEPTH_TILES, include_str!("shaders/depth_tiles.wgsl")].concat()
}

/// The projection of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LayoutText {
    /// A matrix.
    Frustum,
    /// A paraboloid, which supports no virtual samples.
    Paraboloid,
}

/// The shadow test with this filter.
pub(super) fn nearest(layout: LayoutText) -> String {
    shadow_test(layout, include_str!("shaders/nearest.wgsl"))
}

/// See [`nearest`].
pub(super) fn hardware(layout: LayoutText) -> String {
    shadow_test(layout, include_str!("shaders/hardware.wgsl"))
}

/// See [`nearest`].
pub(super) fn percentage_closer(layout: LayoutText) -> String {
    shadow_test(layout, include_str!("shaders/percentage_closer.wgsl"))
}

/// See [`nearest`].
pub(super) fn virtual_samples() -> String {
    shadow_test(LayoutText::Frustum, include_str!("shaders/virtual_samples.wgsl"))
}

/// See [`nearest`].
pub(super) fn between_layers() -> String {
    shadow_test(LayoutText::Frustum, include_str!("shaders/between_layers.wgsl"))
}

fn shadow_test(layout: LayoutText, lookup: &str) -> String {
    let (functions, layout) = match layout {
        LayoutText::Frustum => (wgsl::PROJECT, include_str!("shaders/frustum.wgsl")),
        LayoutText::Paraboloid => (wgsl::PARABOLOID, include_str!("shaders/paraboloid.wgsl")),
    };
    let own = [include_str!("shaders/full_screen.wgsl"), include_str!("shaders/shadow_test.wgsl"), layout, lookup];
    let functions =
        [functions, wgsl::CASCADES, wgsl::MAP_ARRAY, wgsl::FILTERS, wgsl::VIRTUAL_SAMPLES, wgsl::BETWEEN_LAYERS];
    functions.into_iter().chain(own).collect()
}

#[cfg(test)]
mod tests {
    use naga::front::wgsl;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    use super::*;

    #[test]
    fn every_shader_is_valid_without_any_device() {
        for (name, source) in [
            ("surfaces", SURFACES),
            ("shadow map", SHADOW_MAP),
            ("second layer", &second_layer()),
            ("splats", &splats()),
            ("copy depth", COPY_DEPTH),
            ("depth tiles", &depth_tiles()),
            ("paraboloid map", &paraboloid_map()),
            ("nearest", &nearest(LayoutText::Frustum)),
            ("hardware", &hardware(LayoutText::Frustum)),
            ("percentage closer", &percentage_closer(LayoutText::Frustum)),
            ("nearest in paraboloids", &nearest(LayoutText::Paraboloid)),
            ("hardware in paraboloids", &hardware(LayoutText::Paraboloid)),
            ("percentage closer in paraboloids", &percentage_closer(LayoutText::Paraboloid)),
            ("virtual samples", &virtual_samples()),
            ("between layers", &between_layers()),
        ] {
            let module = wgsl::parse_str(source).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
            let result = validator.validate(&module);
            assert!(result.is_ok(), "{name}: {}", result.unwrap_err().emit_to_string(source));
            // `textureSampleCompare` needs uniform control flow, which naga does not check.
            assert!(!source.contains("textureSampleCompare("), "{name}");
        }
    }
}
