// Which squares are refined: those between a centre and a corner that differ.

// In values of `seen`, 0 to 1.
override THRESHOLD: f32 = 0.02;
// How often a pixel is halved: the samples of deeper squares are not there yet.
override DEPTH: u32 = 2u;

fn differ(a: vec3<f32>, b: vec3<f32>) -> bool {
    return max3(abs(seen(a) - seen(b))) > THRESHOLD;
}

fn refined_in(pixel: vec2<u32>, quadrant: vec2<u32>) -> u32 {
    let centre = point(pixel, 2u * quadrant + 1u);
    var refined = 0u;
    for (var i = 0u; i < 4u; i++) {
        let corner = point(pixel, 2u * (quadrant + child(i)));
        refined |= select(0u, fine_bit(2u * quadrant + child(i)), differ(centre, corner));
    }
    return refined;
}

@fragment
fn fs_refine(@builtin(position) position: vec4<f32>) -> @location(0) u32 {
    if DEPTH == 0u {
        return 0u;
    }
    let pixel = vec2<u32>(position.xy);
    let centre = point(pixel, vec2<u32>(2u));
    var quadrants = 0u;
    for (var i = 0u; i < 4u; i++) {
        quadrants |= select(0u, 1u << i, differ(centre, point(pixel, 4u * child(i))));
    }
    var refined = quadrants << QUADRANTS;
    if DEPTH == 2u {
        for (var rest = quadrants; rest != 0u; rest &= rest - 1u) {
            refined |= refined_in(pixel, child(firstTrailingBit(rest)));
        }
    }
    return refined;
}
