// The recursive scheme: samples by their place, and the squares that are refined.

// Owned samples, a layer each: 16 points (x + 4 y quarters from the upper left), then the 16 centres of the finest squares. One
// column and row more than the picture: the points on its right and lower border are nobody else's.
@group(0) @binding(1) var samples: texture_2d_array<f32>;

// First bit of the quadrants in a map of refined squares (x + 2 y); the finest squares (x + 4 y) come before. Loops go over the bits
// that are set: a rasteriser on a CPU spends a branch's time whether it is taken or not.
const QUADRANTS: u32 = 16u;

// Upper left, upper right, lower left, lower right.
fn child(index: u32) -> vec2<u32> {
    return vec2<u32>(index & 1u, index >> 1u);
}

// A point of the pixel's 5 by 5; the last of each row and column are the first of the next pixel's.
fn point(pixel: vec2<u32>, place: vec2<u32>) -> vec3<f32> {
    let within = place % 4u;
    return textureLoad(samples, pixel + place / 4u, within.x + 4u * within.y, 0).rgb;
}

// Of one of the pixel's 4 by 4 finest squares.
fn fine_centre(pixel: vec2<u32>, square: vec2<u32>) -> vec3<f32> {
    return textureLoad(samples, pixel, 16u + square.x + 4u * square.y, 0).rgb;
}

fn fine_bit(square: vec2<u32>) -> u32 {
    return 1u << (square.x + 4u * square.y);
}

// Those of a quadrant, a bit a child.
fn fine_squares(squares: u32, quadrant: vec2<u32>) -> u32 {
    let rows = squares >> (2u * quadrant.x + 8u * quadrant.y);
    return (rows & 3u) | ((rows >> 2u) & 12u);
}
