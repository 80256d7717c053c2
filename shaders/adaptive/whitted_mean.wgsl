// The mean of a pixel, its squares from the finest up: E/2 + (A + B + C + D)/8, a corner's share (E + A)/8 replaced by the mean of
// the square between them where that is refined.

@group(0) @binding(0) var refined: texture_2d<u32>;
@group(0) @binding(2) var points: texture_2d<u32>;

struct Mean {
    @location(0) color: vec4<f32>,
    // Alpha: how many samples the pixel took.
    @location(1) count: vec4<f32>,
}

fn fine_mean(pixel: vec2<u32>, square: vec2<u32>) -> vec3<f32> {
    var corners = vec3<f32>(0.0);
    for (var i = 0u; i < 4u; i++) {
        corners += point(pixel, square + child(i));
    }
    return 0.5 * fine_centre(pixel, square) + 0.125 * corners;
}

fn quadrant_mean(pixel: vec2<u32>, squares: u32, quadrant: vec2<u32>) -> vec3<f32> {
    let centre = point(pixel, 2u * quadrant + 1u);
    var sum = 2.0 * centre;
    for (var i = 0u; i < 4u; i++) {
        sum += 0.5 * point(pixel, 2u * (quadrant + child(i)));
    }
    for (var rest = fine_squares(squares, quadrant); rest != 0u; rest &= rest - 1u) {
        let i = firstTrailingBit(rest);
        let unrefined = 0.5 * (centre + point(pixel, 2u * (quadrant + child(i))));
        sum += fine_mean(pixel, 2u * quadrant + child(i)) - unrefined;
    }
    return 0.25 * sum;
}

fn pixel_mean(pixel: vec2<u32>, squares: u32) -> vec3<f32> {
    let centre = point(pixel, vec2<u32>(2u));
    var sum = 2.0 * centre;
    for (var i = 0u; i < 4u; i++) {
        sum += 0.5 * point(pixel, 4u * child(i));
    }
    for (var rest = squares >> QUADRANTS; rest != 0u; rest &= rest - 1u) {
        let i = firstTrailingBit(rest);
        let unrefined = 0.5 * (centre + point(pixel, 4u * child(i)));
        sum += quadrant_mean(pixel, squares, child(i)) - unrefined;
    }
    return 0.25 * sum;
}

@fragment
fn fs_mean(@builtin(position) position: vec4<f32>) -> Mean {
    let pixel = vec2<u32>(position.xy);
    let squares = textureLoad(refined, pixel, 0).x;
    // A finest square that is refined adds its centre; all else are points.
    let count = countOneBits(squares & 0xffffu) + countOneBits(textureLoad(points, pixel, 0).x);
    return Mean(vec4<f32>(pixel_mean(pixel, squares), 1.0), vec4<f32>(vec3<f32>(0.0), f32(count)));
}
