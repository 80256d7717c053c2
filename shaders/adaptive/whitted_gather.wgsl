// Which of its points a pixel takes: all that squares of its own or of its neighbours touch. A bit a point, x + 5 y.

@group(0) @binding(0) var refined: texture_2d<u32>;

// What is taken of every pixel: its corners and its centre.
const CORNERS_AND_CENTRE: u32 = 0x1101011u;
// x = 4, and y = 4: the next pixel's, where there is one.
const RIGHT: u32 = 0x1084210u;
const BOTTOM: u32 = 0x1f00000u;

// Four bits of a row of finest squares -> five bits of the points above or below them.
fn fine_row(squares: u32) -> u32 {
    return squares | (squares << 1u);
}

// Two bits of a row of quadrants -> five bits of the points at their middles.
fn middles(quadrants: u32) -> u32 {
    return ((quadrants & 1u) | ((quadrants & 2u) << 1u)) << 1u;
}

// All points that touch a pixel's refined squares.
fn touched(refined: u32) -> u32 {
    var points = CORNERS_AND_CENTRE;
    for (var y = 0u; y < 4u; y++) {
        let row = fine_row((refined >> (4u * y)) & 15u);
        points |= (row << (5u * y)) | (row << (5u * y + 5u));
    }
    for (var y = 0u; y < 2u; y++) {
        let centres = middles((refined >> (16u + 2u * y)) & 3u);
        let row = (centres >> 1u) | (centres << 1u);
        points |= (row << (10u * y)) | (centres << (10u * y + 5u)) | (row << (10u * y + 10u));
    }
    return points;
}

@fragment
fn fs_gather(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let pixel = vec2<u32>(position.xy);
    var points = touched(textureLoad(refined, pixel, 0).x);
    if pixel.x > 0u {
        points |= (touched(textureLoad(refined, pixel - vec2<u32>(1u, 0u), 0).x) & RIGHT) >> 4u;
    }
    if pixel.y > 0u {
        points |= (touched(textureLoad(refined, pixel - vec2<u32>(0u, 1u), 0).x) & BOTTOM) >> 20u;
    }
    let is_last = pixel + 1u == textureDimensions(refined);
    return points & select(~RIGHT, ~0u, is_last.x) & select(~BOTTOM, ~0u, is_last.y);
}
