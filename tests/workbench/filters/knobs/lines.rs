//! How far lines are followed, and what is made of staircases and corners.

use super::super::picture::confetti;
use super::Lab;
use super::pictures::{slope, square, staircase};

pub(super) fn fxaa_presets_follow_longer_edges(lab: &Lab, _: &str) {
    let changed = lab.changed_by("fxaa:subpix=0,preset", ["low", "medium", "high", "ultra"], &slope(90.0));
    assert!(changed.is_sorted_by(|fewer, more| fewer < more), "{changed:?}");
    // 1, 1.5, four of 2, 4, 8.
    let picture = confetti([61, 61], 5);
    assert!(lab.filtered("fxaa:preset=high", &picture).same_bits(&lab.filtered("fxaa:steps=8", &picture)));
}

pub(super) fn more_steps_follow_longer_edges(lab: &Lab, _: &str) {
    let changed = lab.changed_by("fxaa:subpix=0,steps", ["4", "8", "16", "32"], &slope(160.0));
    assert!(changed.is_sorted_by(|fewer, more| fewer < more), "{changed:?}");
    let [auto, none] = lab.changed_by("fxaa:subpix=0,preset=low,steps", ["auto", "4"], &slope(160.0));
    assert_ne!(auto, none, "steps win over the preset, auto does not");
}

pub(super) fn longer_searches_smooth_longer_lines(lab: &Lab, method: &str) {
    let option = if method == "mlaa" { "mlaa:max_search" } else { "smaa:search" };
    let changed = lab.changed_by(option, ["4", "8", "16", "32"], &slope(90.0));
    assert!(changed.is_sorted_by(|fewer, more| fewer < more), "{method}: {changed:?}");
    // Longer than all there is: no more comes of it.
    let [all, more] = lab.changed_by(option, ["100", "112"], &slope(90.0));
    assert_eq!(all, more, "{method}");
}

pub(super) fn smaa_presets_are_what_they_stand_for(lab: &Lab, _: &str) {
    const PRESETS: [(&str, &str); 4] = [
        ("low", "threshold=0.15,search=4,diag=0,corner=100"),
        ("medium", "threshold=0.1,search=8,diag=0,corner=100"),
        ("high", "threshold=0.1,search=16,diag=8,corner=25"),
        ("ultra", "threshold=0.05,search=32,diag=16,corner=25"),
    ];
    let picture = confetti([61, 61], 5);
    let filtered = PRESETS.map(|(preset, options)| {
        let by_preset = lab.filtered(&format!("smaa:preset={preset}"), &picture);
        assert!(by_preset.same_bits(&lab.filtered(&format!("smaa:{options}"), &picture)), "{preset} is not {options}");
        by_preset
    });
    assert!(filtered.windows(2).all(|pair| !pair[0].same_bits(&pair[1])), "two presets do the same");
}

fn light(coded: f32) -> f64 {
    let coded = f64::from(coded);
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

pub(super) fn diagonals_are_nearer_to_exact_coverage(lab: &Lab, _: &str) {
    let (picture, exact) = staircase();
    let rms = ["0", "2", "8"].map(|diag| {
        let filtered = lab.filtered(&format!("smaa:diag={diag}"), &picture);
        let squares = filtered.pixels.iter().zip(&exact).map(|(pixel, share)| (light(pixel[0]) - share).powi(2));
        (squares.sum::<f64>() / exact.len() as f64).sqrt()
    });
    println!("smaa: RMS error of a staircase with diag=0, 2, 8: {rms:.4?}");
    assert!(rms[2] < 0.8 * rms[0] && rms[2] <= rms[1], "{rms:?}");
}

pub(super) fn corners_stay_sharper_unrounded(lab: &Lab, _: &str) {
    let picture = square();
    let at_corner = ["0", "25", "100"].map(|corner| {
        let filtered = lab.filtered(&format!("smaa:corner={corner}"), &picture);
        // The corner's own pixel, and what it lost to those beside it.
        [[12, 12], [31, 12], [12, 31], [31, 31]].map(|[x, y]: [u32; 2]| 1.0 - filtered.at(x, y)[0])
    });
    println!("smaa: a white square's corners are darker by {at_corner:.3?} with corner=0, 25, 100");
    for [sharp, between, round] in [0, 1, 2, 3].map(|k| at_corner.map(|corners| corners[k])) {
        assert!(sharp < between && between < round, "{at_corner:?}");
    }
}
