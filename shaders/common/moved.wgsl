// A picture of covered areas, moved by part of a pixel.
//
// A pixel whose value lies between its neighbours' is one that an edge goes through: on one side of it lies one neighbour's colour,
// on the other the other's, and its own value says where they meet. What a moved pixel covers of it follows exactly, where
// interpolation would blur (Hirt and Nichols 1981 move fluids so, cell by cell). A lone bright or dark pixel does not say where in it
// anything lies; it counts as even. First along rows, then along columns of the result.

// What lies in the last `t` of a pixel, between the pixels before and after it.
fn end_of(before: vec4<f32>, pixel: vec4<f32>, after: vec4<f32>, t: f32) -> vec4<f32> {
    let has_edge = (pixel - before) * (after - pixel) > vec4<f32>(0.0);
    let share = (pixel - before) / select(vec4<f32>(1.0), after - before, has_edge);
    let covered = min(vec4<f32>(t), share);
    return select(t * pixel, covered * after + (t - covered) * before, has_edge);
}

// The pixel that begins `t` after the second of four.
fn between(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, d: vec4<f32>, t: f32) -> vec4<f32> {
    return end_of(a, b, c, 1.0 - t) + end_of(d, c, b, t);
}
