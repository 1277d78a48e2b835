// The least and the greatest depth of a depth buffer, but for zeros, which nothing was drawn to.

@group(0) @binding(0) var depths: texture_depth_2d;
// As the bits of floats: those of positive ones are in the order of the floats.
@group(0) @binding(1) var<storage, read_write> ends: Ends;

struct Ends {
    least: atomic<u32>,
    greatest: atomic<u32>,
}

var<workgroup> least: atomic<u32>;
var<workgroup> greatest: atomic<u32>;

@compute @workgroup_size(16, 16)
fn reduce(@builtin(global_invocation_id) pixel: vec3<u32>, @builtin(local_invocation_index) index: u32) {
    if (index == 0u) {
        atomicStore(&least, 0xffffffffu);
        atomicStore(&greatest, 0u);
    }
    workgroupBarrier();
    if (all(pixel.xy < textureDimensions(depths))) {
        let bits = bitcast<u32>(textureLoad(depths, pixel.xy, 0));
        if (bits != 0u) {
            atomicMin(&least, bits);
            atomicMax(&greatest, bits);
        }
    }
    workgroupBarrier();
    if (index == 0u) {
        atomicMin(&ends.least, atomicLoad(&least));
        atomicMax(&ends.greatest, atomicLoad(&greatest));
    }
}
