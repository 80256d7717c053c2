fn is_number(pixel: vec4<f32>) -> bool {
    return !INPUT_IS_FLOAT || (is_finite(pixel.rgb) && is_finite(pixel.aaa));
}
