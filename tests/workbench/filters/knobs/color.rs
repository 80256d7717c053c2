//! What counts as an edge, and how colours are mixed.

use super::super::picture::{confetti, star};
use super::Lab;
use super::pictures::{beside_a_strong_edge, dots, faint, slope, two_colors};

pub(super) fn lower_thresholds_find_fainter_edges(lab: &Lab, method: &str) {
    // FXAA has a floor below which it looks at nothing.
    let option = if method == "fxaa" { "fxaa:threshold_min=0,threshold".to_owned() } else { format!("{method}:threshold") };
    let changed = lab.changed_by(&option, ["0.04", "0.1", "0.2", "0.4"], &faint());
    assert!(changed.is_sorted_by(|more, fewer| more > fewer) && changed[3] > 0, "{method}: {changed:?}");
}

pub(super) fn threshold_min_spares_dark_places(lab: &Lab, _: &str) {
    let dark = star([48, 48]).map(|[r, g, b, a]| [0.05 * r, 0.05 * g, 0.05 * b, a]);
    let [least, default] = lab.changed_by("fxaa:threshold_min", ["0.02", "0.0833"], &dark);
    assert!(least > 50 && default == 0, "{least}, {default}");
    let bright = lab.changed("fxaa", &star([48, 48]));
    assert!(bright > 50, "{bright}");
}

pub(super) fn subpix_fades_single_pixels(lab: &Lab, _: &str) {
    let left = ["0", "0.5", "1"].map(|subpix| lab.filtered(&format!("fxaa:subpix={subpix}"), &dots()).at(15, 15)[0]);
    println!("what is left of a single white pixel: {left:?}");
    assert!(left[0] == 1.0 && left[1] < 0.95 && left[2] < left[1], "{left:?}");
}

pub(super) fn green_luma_sees_green_alone(lab: &Lab, _: &str) {
    let red = two_colors([0.8, 0.3, 0.1], [0.0, 0.3, 0.1]);
    let green = two_colors([0.1, 0.5, 0.1], [0.1, 0.3, 0.1]);
    let [by_all, by_green] = lab.changed_by("fxaa:luma", ["rec601", "green"], &red);
    assert!(by_all > 30 && by_green == 0, "{by_all}, {by_green}");
    assert!(lab.changed("fxaa:luma=green", &green) > 30);
}

/// Mixed in light, as much white in black is coded brighter, in every pixel and all together.
pub(super) fn light_is_brighter_than_coded_values(lab: &Lab, method: &str) {
    let picture = slope(12.0);
    let [linear, coded] = ["linear", "coded"].map(|blend| lab.filtered(&format!("{method}:blend={blend}"), &picture));
    let brighter = linear.pixels.iter().zip(&coded.pixels).filter(|(a, b)| a[0] > b[0]).count();
    let darker = linear.pixels.iter().zip(&coded.pixels).filter(|(a, b)| a[0] < b[0]).count();
    println!("{method}: {brighter} pixels are brighter mixed in light, {darker} darker");
    assert!(brighter > 100 && darker == 0, "{method}: {brighter}, {darker}");
}

pub(super) fn stronger_neighbours_take_edges(lab: &Lab, _: &str) {
    let changed = lab.changed_by("smaa:contrast", ["0", "2", "1"], &beside_a_strong_edge());
    assert!(changed.is_sorted_by(|more, fewer| more > fewer) && changed[2] > 0, "{changed:?}");
}

pub(super) fn cmaa2_presets_are_thresholds(lab: &Lab, _: &str) {
    let picture = faint();
    let presets = [("low", "0.15"), ("medium", "0.1"), ("high", "0.07"), ("ultra", "0.05")];
    for (preset, threshold) in presets {
        let by_preset = lab.filtered(&format!("cmaa2:preset={preset}"), &picture);
        assert!(by_preset.same_bits(&lab.filtered(&format!("cmaa2:threshold={threshold}"), &picture)), "{preset}");
    }
    let changed = lab.changed_by("cmaa2:preset", ["low", "medium", "high", "ultra"], &picture);
    assert!(changed.is_sorted_by(|fewer, more| fewer < more), "{changed:?}");
}

pub(super) fn sharp_blends_less(lab: &Lab, _: &str) {
    for picture in [star([61, 61]), confetti([61, 61], 5), slope(12.0)] {
        let [soft, sharp] = ["off", "on"].map(|sharp| {
            let filtered = lab.filtered(&format!("cmaa2:sharp={sharp}"), &picture);
            filtered.mean_difference(&picture)
        });
        println!("cmaa2: mean change {soft:.5}, sharp {sharp:.5}");
        assert!(sharp > 0.0 && sharp < soft, "{sharp}, {soft}");
    }
}
