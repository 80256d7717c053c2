// Lambert and GGX under one directional light and a constant ambient.

struct Surface {
    albedo: vec3<f32>,
    metallic: f32,
    // Perceptual roughness.
    roughness: f32,
    normal: vec3<f32>,
    to_camera: vec3<f32>,
}

// GGX distribution times height-correlated Smith visibility (Walter et al. 2007, Heitz 2014).
fn specular(surface: Surface, n_dot_l: f32) -> vec3<f32> {
    let half_vector = normalize(frame.to_light.xyz + surface.to_camera);
    let n_dot_h = clamp(dot(surface.normal, half_vector), 0.0, 1.0);
    let l_dot_h = clamp(dot(frame.to_light.xyz, half_vector), 0.0, 1.0);
    let n_dot_v = max(dot(surface.normal, surface.to_camera), 1e-4);
    // A perfectly smooth surface would be infinitely bright in one direction.
    let alpha = max(surface.roughness * surface.roughness, 0.002);
    let alpha_2 = alpha * alpha;
    // 1 - n.h^2 by the cross product: the subtraction would lose all digits at the highlight's centre.
    let n_cross_h = cross(surface.normal, half_vector);
    let spread = dot(n_cross_h, n_cross_h) + alpha_2 * n_dot_h * n_dot_h;
    let distribution = alpha_2 / (0.5 * TAU * spread * spread);
    let visibility = 0.5 / (n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - alpha_2) + alpha_2)
        + n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha_2) + alpha_2));
    let f0 = mix(vec3<f32>(0.04), surface.albedo, surface.metallic);
    let away = 1.0 - l_dot_h;
    let away_2 = away * away;
    // Schlick's fifth power by products: pow costs a logarithm and an exponential.
    let fresnel = f0 + (1.0 - f0) * (away_2 * away_2 * away);
    return distribution * visibility * fresnel;
}

fn lit(surface: Surface) -> vec3<f32> {
    let diffuse = surface.albedo * (1.0 - surface.metallic);
    let ambient = frame.ambient.rgb * (diffuse + mix(vec3<f32>(0.04), surface.albedo, surface.metallic));
    let n_dot_l = dot(surface.normal, frame.to_light.xyz);
    if n_dot_l <= 0.0 {
        return ambient;
    }
    // The light's colour is irradiance over pi.
    return ambient + frame.light_color.rgb * n_dot_l * (diffuse + 0.5 * TAU * specular(surface, n_dot_l));
}
