// A depth buffer as plain numbers: not every depth format can be copied to a buffer.

@group(0) @binding(0) var depths: texture_depth_2d;

@fragment
fn fragment(@builtin(position) texel: vec4<f32>) -> @location(0) f32 {
    return textureLoad(depths, vec2<u32>(texel.xy), 0);
}
