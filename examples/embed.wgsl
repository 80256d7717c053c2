// The host's own drawing: a fan of triangles that turns, and a frame around the picture.

struct Turn {
    // Columns; z and w are of no account.
    rotation: mat4x4<f32>,
}
@group(0) @binding(0) var<uniform> turn: Turn;

struct Corner {
    @builtin(position) position: vec4<f32>,
    @location(0) color: vec3<f32>,
}

const BLADES: f32 = 17.0;

// Every other blade of the fan, three corners each, light and dark in turn.
@vertex
fn vs_fan(@builtin(vertex_index) index: u32) -> Corner {
    let blade = f32(index / 3u);
    let angle = 6.2831853 * (blade + 0.5 * f32(index % 3u == 2u)) / BLADES;
    let radius = select(0.95, 0.0, index % 3u == 0u);
    let place = turn.rotation * vec4<f32>(radius * cos(angle), radius * sin(angle), 0.0, 1.0);
    let tint = blade / BLADES;
    return Corner(place, vec3<f32>(0.9 - 0.7 * tint, 0.8, 0.2 + 0.7 * tint));
}

// One triangle that covers the screen.
@vertex
fn vs_overlay(@builtin(vertex_index) index: u32) -> Corner {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u));
    return Corner(vec4<f32>(4.0 * corner - 1.0, 0.0, 1.0), vec3<f32>(1.0));
}

@fragment
fn fs_color(corner: Corner) -> @location(0) vec4<f32> {
    return vec4<f32>(corner.color, 1.0);
}
