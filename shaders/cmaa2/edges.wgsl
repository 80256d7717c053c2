// Edges of CMAA2: a step must exceed the threshold by a share of the strongest of the four steps that meet its ends.

override THRESHOLD: f32 = 0.07;
override LOCAL_CONTRAST: f32 = 0.1;

fn max4(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, d: vec4<f32>) -> vec4<f32> {
    return max(max(a, b), max(c, d));
}

fn edges_of_four(first: vec2<i32>) -> Edges {
    let x = vec2<i32>(1, 0);
    let y = vec2<i32>(0, 1);
    let here = strip_at(first);
    let above = strip_at(first - y);
    let below = strip_at(first + y);
    let here_left = moved_left(here, feature_at(first - x));
    let above_left = moved_left(above, feature_at(first - y - x));
    let below_left = moved_left(below, feature_at(first + y - x));
    let here_right = moved_right(here, feature_at(first + 4 * x));
    let above_right = moved_right(above, feature_at(first - y + 4 * x));

    let to_above = step_between(here, above);
    let to_left = step_between(here, here_left);
    // What meets a vertical edge at its ends is horizontal, and the other way round.
    let meets_left = max4(
        to_above,
        step_between(here_left, above_left),
        step_between(below, here),
        step_between(below_left, here_left),
    );
    let meets_above = max4(
        to_left,
        step_between(above, above_left),
        step_between(here_right, here),
        step_between(above_right, above),
    );
    return Edges(
        to_above - LOCAL_CONTRAST * meets_above > vec4<f32>(THRESHOLD),
        to_left - LOCAL_CONTRAST * meets_left > vec4<f32>(THRESHOLD),
    );
}
