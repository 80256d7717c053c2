// Interpolation of the history.

// Weights of six pixels in a row for a place between the middle two. Sum 1.
struct Weights {
    outer: vec2<f32>,
    inner: vec4<f32>,
}

fn sinc(x: f32) -> f32 {
    let angle = 3.14159265 * max(abs(x), 1e-4);
    return sin(angle) / angle;
}

fn weights_at(t: f32) -> Weights {
    var found: Weights;
    let u = 1.0 - t;
    if HISTORY_FILTER == 1u {
        // Catmull and Rom 1974.
        let near = vec2<f32>(1.0 + t * t * (1.5 * t - 2.5), 1.0 + u * u * (1.5 * u - 2.5));
        found = Weights(vec2<f32>(0.0), vec4<f32>(-0.5 * t * u * u, near.x, near.y, -0.5 * u * t * t));
    } else {
        // Lanczos 1956, three lobes.
        found.outer = vec2<f32>(sinc(2.0 + t) * sinc((2.0 + t) / 3.0), sinc(2.0 + u) * sinc((2.0 + u) / 3.0));
        found.inner = vec4<f32>(
            sinc(1.0 + t) * sinc((1.0 + t) / 3.0),
            sinc(t) * sinc(t / 3.0),
            sinc(u) * sinc(u / 3.0),
            sinc(1.0 + u) * sinc((1.0 + u) / 3.0),
        );
    }
    let sum = dot(found.inner, vec4<f32>(1.0)) + found.outer.x + found.outer.y;
    return Weights(found.outer / sum, found.inner / sum);
}

fn weight_of(weights: Weights, i: i32) -> f32 {
    let six = array<f32, 6>(
        weights.outer.x, weights.inner.x, weights.inner.y, weights.inner.z, weights.inner.w, weights.outer.y,
    );
    return six[i];
}

fn row_between(first: vec2<i32>, t: f32) -> vec4<f32> {
    return between(
        textureLoad(history, inside(first - vec2<i32>(1, 0)), 0),
        textureLoad(history, inside(first), 0),
        textureLoad(history, inside(first + vec2<i32>(1, 0)), 0),
        textureLoad(history, inside(first + vec2<i32>(2, 0)), 0),
        t,
    );
}

// `first` is the pixel above left of the place, `share` how far it is to the next.
fn interpolated_at(first: vec2<i32>, share: vec2<f32>) -> vec3<f32> {
    if HISTORY_FILTER == 3u {
        let above = row_between(first - vec2<i32>(0, 1), share.x);
        let here = row_between(first, share.x);
        let below = row_between(first + vec2<i32>(0, 1), share.x);
        return between(above, here, below, row_between(first + vec2<i32>(0, 2), share.x), share.y).rgb;
    }
    let columns = weights_at(share.x);
    let rows = weights_at(share.y);
    let reach = select(1, 0, HISTORY_FILTER == 2u);
    var sum = vec3<f32>(0.0);
    for (var y = reach; y < 6 - reach; y++) {
        for (var x = reach; x < 6 - reach; x++) {
            let at = inside(first + vec2<i32>(x, y) - 2);
            sum += weight_of(columns, x) * weight_of(rows, y) * textureLoad(history, at, 0).rgb;
        }
    }
    return sum;
}
