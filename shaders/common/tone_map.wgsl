// Exposed linear colour to [0, 1].

fn reinhard(x: vec3<f32>) -> vec3<f32> {
    return x / (1.0 + x);
}

// Narkowicz 2015: a rational fit of the ACES curve, exposure of the original included.
fn aces(x: vec3<f32>) -> vec3<f32> {
    // Above this the fit is 1 to the last bit of 8, and squares of larger values would overflow.
    let v = min(x, vec3<f32>(1e4));
    return (v * (2.51 * v + 0.03)) / (v * (2.43 * v + 0.59) + 0.14);
}

// AgX (Sobotka 2022): inset, a log2 range of 16.5 stops, a sigmoid (Wrensch's sixth-degree fit), outset, display power 2.2 undone.
fn agx(x: vec3<f32>) -> vec3<f32> {
    let inset = mat3x3<f32>(
        vec3<f32>(0.842479062, 0.0423282423, 0.0423756950),
        vec3<f32>(0.0784335999, 0.878468636, 0.0784336000),
        vec3<f32>(0.0792237451, 0.0791661275, 0.879142973),
    );
    let outset = mat3x3<f32>(
        vec3<f32>(1.19687900, -0.0528968518, -0.0529716322),
        vec3<f32>(-0.0980208811, 1.15190313, -0.0980434501),
        vec3<f32>(-0.0990297341, -0.0989611768, 1.15107367),
    );
    const LOWEST: f32 = -12.47393;
    const HIGHEST: f32 = 4.026069;
    let stops = (clamp(log2(max(inset * x, vec3<f32>(1e-10))), vec3<f32>(LOWEST), vec3<f32>(HIGHEST)) - LOWEST) / (HIGHEST - LOWEST);
    let s2 = stops * stops;
    let s4 = s2 * s2;
    let curve = 15.5 * s4 * s2 - 40.14 * s4 * stops + 31.96 * s4 - 6.868 * s2 * stops + 0.4298 * s2 + 0.1191 * stops - 0.00232;
    return pow(max(outset * curve, vec3<f32>(0.0)), vec3<f32>(2.2));
}

fn tone_mapped(exposed: vec3<f32>, tone_map: u32) -> vec3<f32> {
    let x = max(exposed, vec3<f32>(0.0));
    switch tone_map {
        case 1u: { return reinhard(x); }
        case 2u: { return clamp(aces(x), vec3<f32>(0.0), vec3<f32>(1.0)); }
        case 3u: { return clamp(agx(x), vec3<f32>(0.0), vec3<f32>(1.0)); }
        default: { return min(x, vec3<f32>(1.0)); }
    }
}
