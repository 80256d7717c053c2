// What a line cuts off the pixels on both sides of an edge, by its ends' patterns and the distances to them.
fn area(areas: texture_2d<u32>, ends: vec2<i32>, distances: vec2<i32>) -> vec2<f32> {
    let side = i32(textureDimensions(areas).x) / 4;
    return unpack2x16unorm(textureLoad(areas, ends * side + distances, 0).x);
}
