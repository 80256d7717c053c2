// Edges of the geometry as quads that cover the centre of every pixel they touch.

const NONE: u32 = 0xffffffffu;

// From an edge to the centre of a pixel that it touches: half a pixel's diagonal, and a little for the rasteriser's grid.
const REACH_PX: f32 = 0.72;

// Relative to depth: what lies on the surface it bounds is not behind it.
const DEPTH_SLACK: f32 = 1e-3;

// As three floats a position, which a vec3 array would pad.
@group(1) @binding(10) var<storage, read> positions: array<f32>;
@group(1) @binding(11) var<storage, read> edges: array<vec4<u32>>;
@group(2) @binding(0) var seen: texture_depth_2d;

struct OutlineVertex {
    @builtin(position) position: vec4<f32>,
    // Reversed; the quad itself lies flat on the screen.
    @location(0) depth: f32,
}

fn corner_clip(instance: u32, corner: u32) -> vec4<f32> {
    let position = vec3<f32>(positions[3u * corner], positions[3u * corner + 1u], positions[3u * corner + 2u]);
    return objects[object_of(instance)].clip_from_object * vec4<f32>(position, 1.0);
}

// Which way round the corners go on the screen; without division, so behind the camera too.
fn turn(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>) -> f32 {
    return dot(a.xyw, cross(b.xyw, c.xyw));
}

// Whether one side of it is seen and the other is not, or it is an edge from everywhere.
fn is_outline(instance: u32, edge: vec4<u32>, a: vec4<f32>, b: vec4<f32>) -> bool {
    if edge.w == NONE {
        return true;
    }
    let one = turn(a, b, corner_clip(instance, edge.z));
    let other = turn(b, a, corner_clip(instance, edge.w));
    return one * other <= 0.0;
}

// What of an edge is in front of the near plane.
fn clipped(inside: vec4<f32>, outside: vec4<f32>) -> vec4<f32> {
    let before = inside.w - inside.z;
    let behind = outside.w - outside.z;
    return mix(inside, outside, before / (before - behind));
}

@vertex
fn vs_outline(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> OutlineVertex {
    let nowhere = OutlineVertex(vec4<f32>(2.0, 2.0, 0.0, 1.0), 0.0);
    let edge = edges[vertex / 6u];
    var a = corner_clip(instance, edge.x);
    var b = corner_clip(instance, edge.y);
    let a_hidden = a.z > a.w || a.w <= 0.0;
    let b_hidden = b.z > b.w || b.w <= 0.0;
    if (a_hidden && b_hidden) || !is_outline(instance, edge, a, b) {
        return nowhere;
    }
    if a_hidden {
        a = clipped(b, a);
    } else if b_hidden {
        b = clipped(a, b);
    }
    let px_from_ndc = 0.5 * frame.size_px;
    let ends = array<vec3<f32>, 2>(a.xyz / a.w, b.xyz / b.w);
    let step = (ends[1].xy - ends[0].xy) * px_from_ndc;
    let along = select(vec2<f32>(1.0, 0.0), normalize(step), dot(step, step) > 1e-12);
    // Corners of two triangles: which end, which side.
    let k = vertex % 6u;
    let end = u32(k == 1u || k == 2u || k == 4u);
    let side = select(-1.0, 1.0, k == 2u || k == 4u || k == 5u);
    let away = REACH_PX * (along * select(-1.0, 1.0, end == 1u) + vec2<f32>(-along.y, along.x) * side);
    return OutlineVertex(vec4<f32>(ends[end].xy + away / px_from_ndc, 0.0, 1.0), ends[end].z);
}

// The farthest that was seen in the pixel and around it: a wire in front of a wall is seen beside the wall's samples.
fn farthest_seen(pixel: vec2<i32>) -> f32 {
    let last = vec2<i32>(textureDimensions(seen)) - 1;
    var farthest = 1.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            farthest = min(farthest, textureLoad(seen, clamp(pixel + vec2<i32>(x, y), vec2<i32>(0), last), 0));
        }
    }
    return farthest;
}

@fragment
fn fs_outline(in: OutlineVertex) -> @location(0) u32 {
    if in.depth * (1.0 + DEPTH_SLACK) < farthest_seen(vec2<i32>(in.position.xy)) {
        discard;
    }
    return 1u;
}
