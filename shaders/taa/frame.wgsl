// What a frame brings beside its pictures.

struct TaaFrame {
    // A clip position of this frame -> where a point that stands still was in the frame before.
    previous_clip_from_clip: mat4x4<f32>,
    // What each sample of the 3 x 3 counts for the pixel in their middle: a column is a row of the picture, from above. Sum 1.
    input_weights: mat3x4<f32>,
    // What the whole of them counts beside other frames', 1 in the mean.
    frame_weight: f32,
    // Factor on linear colour before the tone map.
    exposure: f32,
    // Changes what is rounded up and what down.
    seed: u32,
    // Whether what came before must be forgotten.
    reset: u32,
}

@group(0) @binding(0) var<uniform> frame: TaaFrame;
