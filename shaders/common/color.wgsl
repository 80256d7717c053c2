// Linear colour: luminance, finiteness.

// Relative luminance of linear Rec. 709 primaries.
fn luminance(color: vec3<f32>) -> f32 {
    return dot(color, vec3<f32>(0.2126, 0.7152, 0.0722));
}

fn max3(color: vec3<f32>) -> f32 {
    return max(color.x, max(color.y, color.z));
}

// By the exponent's bits: comparisons may be optimised away where a compiler assumes that nothing is NaN.
fn is_finite(color: vec3<f32>) -> bool {
    let exponent = bitcast<vec3<u32>>(color) & vec3<u32>(0x7f800000u);
    return all(exponent != vec3<u32>(0x7f800000u));
}
