// Which pixels a round has settled: its samples told nothing new.

// How far the probes may be apart, in values of `seen` from 0 to 1. A range of four stands for about four times its mean's error,
// and an error is what is estimated here.
override THRESHOLD: f32 = 0.02;

@group(0) @binding(1) var before: texture_2d<f32>;
@group(0) @binding(2) var after: texture_2d<f32>;
@group(0) @binding(3) var doubts: texture_2d<u32>;

@fragment
fn fs_settle(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    let pixel = vec2<i32>(position.xy);
    let doubt = textureLoad(doubts, pixel, 0).x;
    if doubt == 0u || (doubt & OUTLINE) != 0u {
        return doubt;
    }
    let earlier = textureLoad(before, pixel, 0);
    let all = textureLoad(after, pixel, 0);
    let added = all - earlier;
    // The standard deviation of all samples' mean, in that of the difference of the two means it is made of.
    let share = sqrt(earlier.a * added.a) / all.a;
    let surprise = share * abs(seen(added.rgb / added.a) - seen(earlier.rgb / earlier.a));
    return select(0u, doubt, max3(surprise) > 0.25 * THRESHOLD);
}
