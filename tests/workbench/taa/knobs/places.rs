//! Where history is looked for, how it is read, and where there is none.

use dejag::gpu::Gpu;
use dejag::picture::Pixel;

use super::super::rig::{Facts, Rig};
use super::{BASE, MIDDLE, SIZE, close, history_read, picture};

/// Each pixel says which column it is.
fn columns() -> Facts {
    Facts::still(picture(|x, _| x as f32))
}

/// How far to the right of itself each pixel found its history, in pixels.
fn found_px(history: &[Pixel]) -> Vec<f32> {
    history.iter().zip(columns().color).map(|(found, own)| found[0] - own[0]).collect()
}

pub(super) fn dilation_follows_what_is_near(gpu: &Gpu) {
    let mut now = Facts { motion_px: vec![[0.0; 2]; (SIZE[0] * SIZE[1]) as usize], ..Facts::flat([0.0; 3]) };
    now.depths = vec![0.3; now.motion_px.len()];
    (now.motion_px[MIDDLE], now.depths[MIDDLE]) = ([3.0, 0.0], 0.5);
    for (dilation, expected) in [("off", 1), ("cross", 5), ("full", 9)] {
        let history = history_read(gpu, &format!("clip=off,reject=off,dilation={dilation}"), &columns(), &now);
        let followed = found_px(&history).into_iter().filter(|px| close(*px, 3.0)).count();
        assert_eq!(followed, expected, "{dilation}");
    }
}

pub(super) fn the_background_moves_as_the_camera(gpu: &Gpu) {
    let read = |background: &str, depth: f32| {
        let spec = format!("{BASE},clip=off,reject=off,dilation=off,background={background}");
        let mut rig = Rig::new(gpu, &spec, SIZE);
        rig.take(&columns());
        // Four pixels to the right, in clip space.
        rig.frame.previous_clip_from_clip[3][0] = 8.0 / SIZE[0] as f32;
        let mean = rig.take(&Facts { depths: vec![depth], ..Facts::flat([0.0; 3]) });
        2.0 * mean[MIDDLE][0] - columns().color[MIDDLE][0]
    };
    assert!(close(read("drawn", 0.0), 0.0) && close(read("camera", 0.0), 4.0));
    assert!(close(read("camera", 0.5), 0.0), "a surface has motion of its own");
}

pub(super) fn halves_lose_a_part_of_a_pixel(gpu: &Gpu) {
    // Between 8 and 16 halves have steps of 1/128: this is 8, rounded to nearest or cut off.
    const MOVED_PX: f32 = 8.0 + 0.4 / 128.0;
    let now = Facts::flat([0.0; 3]).moved([MOVED_PX, 0.0]);
    let options = |motion: &str| format!("clip=off,history=bilinear,motion={motion}");
    let found = ["fp32", "fp16"].map(|motion| found_px(&history_read(gpu, &options(motion), &columns(), &now))[MIDDLE]);
    println!("{MOVED_PX} px of motion are {found:.5?} in floats and in halves");
    assert!((found[0] - MOVED_PX).abs() < 2e-4 && found[1] == 8.0, "{found:?}");
}

pub(super) fn wider_filters_keep_contrast(gpu: &Gpu) {
    let waves = Facts::still(picture(|x, _| 1.0 + (x as f32 * std::f32::consts::TAU / 5.0).sin()));
    let now = Facts::flat([0.0; 3]).moved([0.5, 0.0]);
    let contrast = |history: &str| {
        let found = history_read(gpu, &format!("clip=off,history={history}"), &waves, &now);
        let row: Vec<f32> = found[MIDDLE - 10..MIDDLE + 10].iter().map(|pixel| pixel[0] - 1.0).collect();
        (row.iter().map(|value| value * value).sum::<f32>() / 10.0).sqrt()
    };
    let found = ["bilinear", "catmull-rom", "lanczos"].map(contrast);
    println!("of waves 5 px long, half a pixel on, {found:.3?} is left with bilinear, catmull-rom, lanczos");
    assert!(found[0] + 0.02 < found[1] && found[1] < found[2] && found[2] < 1.02, "{found:?}");
}

/// Whether what another surface left is still in the mean.
fn is_kept(gpu: &Gpu, options: &str, ids: u32, depth: f32) -> bool {
    // It moved away; what lies here now stands still.
    let past = Facts::flat([1.0; 3]).moved([-3.0, 0.0]);
    let now = Facts { ids: vec![ids], depths: vec![depth], ..Facts::flat([0.0; 3]) };
    let left = history_read(gpu, &format!("clip=off,{options}"), &past, &now)[MIDDLE][0];
    assert!(close(left, 0.0) || close(left, 1.0), "{options}: {left}");
    left > 0.5
}

pub(super) fn what_was_of_another_surface_is_refused(gpu: &Gpu) {
    let kept = |reject: &str, ids: u32, depth: f32| is_kept(gpu, &format!("reject={reject}"), ids, depth);
    assert!(kept("off", 2, 0.1), "off refuses nothing");
    assert!(!kept("ids", 2, 0.5) && kept("ids", 1, 0.1), "ids go by the object");
    assert!(!kept("depth", 1, 0.1) && kept("depth", 2, 0.5), "depth goes by the depth");
}

pub(super) fn a_larger_depth_step_refuses_less(gpu: &Gpu) {
    let kept = |step: &str, depth: f32| is_kept(gpu, &format!("reject=depth,depth_step={step}"), 1, depth);
    assert!(!kept("0.02", 0.45) && kept("0.2", 0.45));
    assert!(!kept("0.2", 0.3) && kept("0.02", 0.498));
}
