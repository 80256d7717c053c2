//! How much a frame counts, and what becomes of the mean.

use dejag::gpu::Gpu;

use super::super::rig::{Facts, Rig};
use super::{BASE, MIDDLE, SIZE, close, picture};

/// What a white frame changes after many black ones.
fn response(gpu: &Gpu, most: &str, most_motion: &str, motion_px: [f32; 2]) -> f32 {
    let spec = format!("taa:clip=off,sharpen=0,storage=fp32,reject=off,most={most},most_motion={most_motion}");
    let mut rig = Rig::new(gpu, &spec, SIZE);
    let black = rig.upload(&Facts::flat([0.0; 3]));
    (0..40).for_each(|_| rig.show(&black));
    rig.take(&Facts::flat([1.0; 3]).moved(motion_px))[MIDDLE][0]
}

pub(super) fn a_frame_counts_one_in_most(gpu: &Gpu) {
    for (most, expected) in [("1", 1.0), ("4", 0.25), ("32", 1.0 / 32.0), ("1024", 1.0 / 41.0)] {
        let found = response(gpu, most, "2", [0.0; 2]);
        assert!(close(found, expected), "most={most}: {found} instead of {expected}");
    }
}

pub(super) fn a_frame_in_motion_counts_one_in_most_motion(gpu: &Gpu) {
    for (most, expected) in [("1", 1.0), ("4", 0.25), ("32", 1.0 / 32.0)] {
        let found = response(gpu, "64", most, [1.5, 0.0]);
        assert!((found / expected - 1.0).abs() < 0.05, "most_motion={most}: {found} instead of {expected}");
    }
}

pub(super) fn sharpening_steepens_edges(gpu: &Gpu) {
    const PROFILE: [f32; 6] = [0.1, 0.1, 0.3, 0.7, 0.9, 0.9];
    let soft = Facts::still(picture(|x, _| PROFILE[(x as usize).saturating_sub(13).min(5)]));
    let profile = |sharpen: &str| {
        let found = Rig::new(gpu, &format!("taa:cycle=1,sharpen={sharpen}"), SIZE).take(&soft);
        let row = (SIZE[0] * 8 + 13) as usize;
        [0, 1, 2, 3, 4, 5].map(|i| found[row + i][0])
    };
    let found = ["0", "0.5", "1", "2"].map(profile);
    let steepness = found.map(|profile| profile[3] - profile[2]);
    println!("a step of 0.4 becomes {steepness:.3?} with sharpen=0, 0.5, 1, 2");
    assert!(steepness.is_sorted_by(|soft, sharp| soft + 0.005 < *sharp), "{steepness:?}");
    let halo = found.iter().flatten().any(|value| !(0.099..=0.901).contains(value));
    assert!(!halo, "{found:?}");
}

pub(super) fn only_what_has_no_history_is_smoothed(gpu: &Gpu) {
    let stairs = Facts::still(picture(|x, y| if x > 4 * y { 0.9 } else { 0.05 }));
    let changed = |fallback: &str| {
        // Nothing of earlier frames is in the mean of one frame.
        let mut rig = Rig::new(gpu, &format!("{BASE},most=1,fallback={fallback}").replace("most=64,", ""), SIZE);
        let mut count = || rig.take(&stairs).iter().zip(&stairs.color).filter(|(a, b)| !close(a[0], b[0])).count();
        [count(), count()]
    };
    let found = ["off", "fxaa", "mlaa", "smaa", "cmaa2"].map(changed);
    println!("pixels smoothed in the first frame and in the second: {found:?} with off, fxaa, mlaa, smaa, cmaa2");
    assert_eq!(found[0], [0, 0]);
    assert!(found[1..].iter().all(|[first, second]| *first > 10 && *second == 0), "{found:?}");
}
