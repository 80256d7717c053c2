// The space that colours are compared and averaged in.

// How luminance L (exposed) is compressed, colours with it. 0 not at all. 1 to L / (1 + L): the mean of that is a mean weighted by
// 1 / (1 + L) (Karis 2014). 2 beyond white only, to 2 - 1 / L: what the display can show is averaged as light.
override COMPRESSION: u32 = 2u;
// Whether channels are brightness, orange and green (Malvar and Sullivan 2003): boxes along those fit colours closer.
override IN_YCOCG: bool = true;

const LARGEST_HALF: f32 = 65504.0;

fn to_working(linear: vec3<f32>) -> vec3<f32> {
    var color = linear;
    let exposed = frame.exposure * luminance(linear);
    if COMPRESSION == 1u {
        color /= 1.0 + exposed;
    } else if COMPRESSION == 2u && exposed > 1.0 {
        color *= (2.0 - 1.0 / exposed) / exposed;
    }
    if IN_YCOCG {
        let half_sum = 0.5 * (color.r + color.b);
        color = vec3<f32>(0.5 * (half_sum + color.g), 0.5 * (color.r - color.b), 0.5 * (color.g - half_sum));
    }
    return color;
}

// Never negative, and finite for whatever lies in the box of real colours.
fn from_working(working: vec3<f32>) -> vec3<f32> {
    var color = working;
    if IN_YCOCG {
        let rest = working.x - working.z;
        color = vec3<f32>(rest + working.y, working.x + working.z, rest - working.y);
    }
    color = max(color, vec3<f32>(0.0));
    let compressed = frame.exposure * luminance(color);
    // What an infinite luminance becomes is never reached.
    let dimmest = 1.0 / (1.0 + frame.exposure * LARGEST_HALF);
    if COMPRESSION == 1u {
        color /= max(1.0 - compressed, dimmest);
    } else if COMPRESSION == 2u && compressed > 1.0 {
        color /= compressed * max(2.0 - compressed, dimmest);
    }
    return min(color, vec3<f32>(LARGEST_HALF));
}
