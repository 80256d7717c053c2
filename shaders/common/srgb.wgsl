// The sRGB coding (IEC 61966-2-1) and back, continued beyond 1 and, mirrored, below 0.

fn srgb_coded(linear: vec3<f32>) -> vec3<f32> {
    let size = abs(linear);
    let high = 1.055 * pow(max(size, vec3<f32>(0.0031308)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return sign(linear) * select(high, 12.92 * size, size <= vec3<f32>(0.0031308));
}

fn srgb_decoded(coded: vec3<f32>) -> vec3<f32> {
    let size = abs(coded);
    let high = pow((max(size, vec3<f32>(0.04045)) + 0.055) / 1.055, vec3<f32>(2.4));
    return sign(coded) * select(high, size / 12.92, size <= vec3<f32>(0.04045));
}
