// One tile of a reduced depth buffer, as DepthTile has it.
struct shadowfit_DepthTile {
    least: f32,
    greatest: f32,
    depth: f32,
    slope_x: f32,
    slope_y: f32,
    pixel: u32,
    pixels: u32,
}

var<workgroup> shadowfit_tile_least: atomic<u32>;
var<workgroup> shadowfit_tile_greatest: atomic<u32>;
var<workgroup> shadowfit_tile_pixels: atomic<u32>;
var<workgroup> shadowfit_tile_apart: atomic<u32>;
var<workgroup> shadowfit_tile_sample: atomic<u32>;

// The stored depth of a pixel that shows a surface, or −1.
fn shadowfit_surface_depth(depths: texture_depth_2d, image: vec2<u32>, clear: f32, pixel: vec2<i32>) -> f32 {
    if any(pixel < vec2(0)) || any(pixel >= vec2<i32>(image)) {
        return -1.0;
    }
    let depth = textureLoad(depths, pixel, 0);
    return select(-1.0, depth, depth != clear && depth >= 0.0 && depth <= 1.0);
}

// The change of stored depth to the next pixel: the smaller one of both sides.
fn shadowfit_depth_change(
    depths: texture_depth_2d, image: vec2<u32>, clear: f32, pixel: vec2<i32>, step: vec2<i32>, depth: f32,
) -> f32 {
    let next = shadowfit_surface_depth(depths, image, clear, pixel + step);
    let previous = shadowfit_surface_depth(depths, image, clear, pixel - step);
    let after = next - depth;
    let before = depth - previous;
    if next < 0.0 && previous < 0.0 {
        return 0.0;
    }
    if previous < 0.0 {
        return after;
    }
    if next < 0.0 {
        return before;
    }
    return select(after, before, abs(before) < abs(after));
}

fn shadowfit_reduce_tile(
    depths: texture_depth_2d, image: vec2<u32>, tile: u32, clear: f32, workgroup: vec2<u32>, invocation: u32,
) -> shadowfit_DepthTile {
    if invocation == 0u {
        atomicStore(&shadowfit_tile_least, 0x3f800000u);
        atomicStore(&shadowfit_tile_greatest, 0u);
        atomicStore(&shadowfit_tile_pixels, 0u);
        atomicStore(&shadowfit_tile_apart, 0xffffffffu);
        atomicStore(&shadowfit_tile_sample, 0xffffffffu);
    }
    workgroupBarrier();

    let first = workgroup * tile;
    let end = min(first + tile, image);
    let size = end - first;
    let count = size.x * size.y;
    var least = 0x3f800000u;
    var greatest = 0u;
    var pixels = 0u;
    var nearest = 0xffffffffu;
    var sample = 0xffffffffu;
    for (var index = invocation; index < count; index += 64u) {
        let pixel = first + vec2(index % size.x, index / size.x);
        let depth = shadowfit_surface_depth(depths, image, clear, vec2<i32>(pixel));
        if depth >= 0.0 {
            // Positive floats are in the order of their bits; without the sign −0 is the least, as it should be.
            let bits = bitcast<u32>(depth) & 0x7fffffffu;
            least = min(least, bits);
            greatest = max(greatest, bits);
            pixels += 1u;
            let from_middle = vec2<i32>(2u * pixel + 1u) - vec2<i32>(first + end);
            let apart = u32(dot(from_middle, from_middle));
            if apart < nearest {
                nearest = apart;
                sample = index;
            }
        }
    }
    atomicMin(&shadowfit_tile_least, least);
    atomicMax(&shadowfit_tile_greatest, greatest);
    atomicAdd(&shadowfit_tile_pixels, pixels);
    atomicMin(&shadowfit_tile_apart, nearest);
    workgroupBarrier();
    if nearest == atomicLoad(&shadowfit_tile_apart) {
        atomicMin(&shadowfit_tile_sample, sample);
    }
    workgroupBarrier();

    if atomicLoad(&shadowfit_tile_pixels) == 0u {
        return shadowfit_DepthTile(1.0, 0.0, 0.0, 0.0, 0.0, 0u, 0u);
    }
    let index = atomicLoad(&shadowfit_tile_sample);
    let pixel = first + vec2(index % size.x, index / size.x);
    let at = vec2<i32>(pixel);
    let depth = shadowfit_surface_depth(depths, image, clear, at);
    return shadowfit_DepthTile(
        bitcast<f32>(atomicLoad(&shadowfit_tile_least)),
        bitcast<f32>(atomicLoad(&shadowfit_tile_greatest)),
        depth,
        shadowfit_depth_change(depths, image, clear, at, vec2(1, 0), depth),
        shadowfit_depth_change(depths, image, clear, at, vec2(0, 1), depth),
        pixel.x | pixel.y << 16u,
        atomicLoad(&shadowfit_tile_pixels),
    );
}
