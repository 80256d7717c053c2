// Edges of four pixels in a row.
struct Edges {
    above: vec4<bool>,
    left: vec4<bool>,
}
