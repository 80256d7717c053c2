// Steps from one object to another.

@group(0) @binding(6) var ids: texture_2d<u32>;

fn id_at(pixel: vec2<i32>) -> u32 {
    return textureLoad(ids, inside(pixel), 0).x;
}

fn ids_at(first: vec2<i32>) -> vec4<u32> {
    let one = vec2<i32>(1, 0);
    return vec4<u32>(id_at(first), id_at(first + one), id_at(first + 2 * one), id_at(first + 3 * one));
}

fn geometry_steps(first: vec2<i32>) -> Edges {
    let here = ids_at(first);
    let left = vec4<u32>(id_at(first - vec2<i32>(1, 0)), here.xyz);
    return Edges(here != ids_at(first - vec2<i32>(0, 1)), here != left);
}
