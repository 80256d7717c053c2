// A neighbour to blend with, or what else there is.
fn neighbor(pixel: vec2<i32>, otherwise: vec4<f32>) -> vec4<f32> {
    let loaded = textureLoad(picture, inside(pixel), 0);
    // A pixel that is no number is no neighbour.
    if INPUT_IS_FLOAT && !(is_finite(loaded.rgb) && is_finite(loaded.aaa)) {
        return otherwise;
    }
    return blendable(loaded);
}
