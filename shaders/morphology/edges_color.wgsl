// Edges where colour or luma steps by more than a threshold, local contrast considered.

override THRESHOLD: f32 = 0.1;
// An edge is dropped where a step beside it is more than this many times larger; 0 keeps all.
override CONTRAST_FACTOR: f32 = 2.0;

fn edges_of_four(first: vec2<i32>) -> Edges {
    let here = strip_at(first);
    let left = moved_left(here, feature_at(first - vec2<i32>(1, 0)));
    let above = strip_at(first - vec2<i32>(0, 1));
    let to_left = step_between(here, left);
    let to_above = step_between(here, above);
    let thresholds = thresholds_of_four(first);
    var edges = Edges(to_above >= thresholds.above, to_left >= thresholds.left);
    if CONTRAST_FACTOR > 0.0 {
        let right = moved_right(here, feature_at(first + vec2<i32>(4, 0)));
        let below = strip_at(first + vec2<i32>(0, 1));
        let left_of_left = moved_left(left, feature_at(first - vec2<i32>(2, 0)));
        let above_above = strip_at(first - vec2<i32>(0, 2));
        let beside = max(max(step_between(here, right), step_between(here, below)), max(step_between(left, left_of_left), step_between(above, above_above)));
        let largest = max(beside, max(to_left, to_above));
        edges.above &= CONTRAST_FACTOR * to_above >= largest;
        edges.left &= CONTRAST_FACTOR * to_left >= largest;
    }
    return edges;
}
