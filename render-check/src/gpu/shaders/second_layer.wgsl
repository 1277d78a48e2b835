// Of casters what lies behind the first layer. Needs `shadow_map.wgsl` and the crate's functions.

@group(0) @binding(1) var first_layer: texture_depth_2d;

// See `shadowfit_is_behind`.
override gap: f32 = 0.0;
// Whether depth 1 is next to the light.
override reversed: bool = false;

@fragment
fn fragment(@builtin(position) place: vec4<f32>) {
    if (!shadowfit_is_behind(first_layer, 0, place, gap, reversed)) {
        discard;
    }
}
