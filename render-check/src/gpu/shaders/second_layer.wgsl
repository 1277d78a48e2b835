// Of casters what lies behind the first layer. Needs `shadow_map.wgsl` and the crate's functions.

@group(0) @binding(1) var first_layer: texture_depth_2d;

// The parts of what a comparison allows for, see `shadowfit_is_behind`.
override constant_tolerance: f32 = 0.0;
override tolerance_over_w: f32 = 0.0;
override most_over_w: f32 = 0.0;
// Whether depth 1 is next to the light.
override reversed: bool = false;

@fragment
fn fragment(@builtin(position) place: vec4<f32>) {
    let parts = vec4(constant_tolerance, tolerance_over_w, most_over_w, 0.0);
    if (!shadowfit_is_behind(first_layer, 0, place, parts, reversed)) {
        discard;
    }
}
