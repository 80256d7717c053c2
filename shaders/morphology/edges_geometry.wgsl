// Edges are steps of the geometry, whatever its colours.
fn edges_of_four(first: vec2<i32>) -> Edges {
    return geometry_steps(first);
}
