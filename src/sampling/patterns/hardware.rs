//! Where multisampling hardware takes its samples.

use super::stratified::rotated;
use super::{Counts, DensityControl, Job, Pattern};

pub(super) const STANDARD_MSAA: Pattern = Pattern {
    name: "standard-msaa",
    aliases: &["msaa"],
    summary: "the standard positions of multisampling hardware for 1, 2, 4, 8, 16; other counts are those of `rotated`",
    source: "Direct3D 11.3 Functional Specification, section 19.2.4; Vulkan, Standard Sample Locations",
    cost: "O(n)",
    seeded: false,
    progressive: false,
    counts: Counts::These(&[1, 2, 4, 8, 16]),
    density: DensityControl::Warping,
    parameters: &[],
    generate,
};

/// Sample positions in sixteenths of a pixel from its centre, y down, in the hardware's order.
#[must_use]
pub fn standard_positions(samples: u32) -> Option<&'static [[i32; 2]]> {
    match samples {
        1 => Some(&[[0, 0]]),
        2 => Some(&[[4, 4], [-4, -4]]),
        4 => Some(&[[-2, -6], [6, -2], [-6, 2], [2, 6]]),
        8 => Some(&[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]]),
        16 => Some(&SIXTEEN),
        _ => None,
    }
}

const SIXTEEN: [[i32; 2]; 16] = [
    [1, 1],
    [-1, -3],
    [-3, 2],
    [4, -1],
    [-5, -2],
    [2, 5],
    [5, 3],
    [3, -5],
    [-2, 6],
    [0, -7],
    [-4, -6],
    [-6, 4],
    [-8, 0],
    [7, -4],
    [6, 7],
    [-7, -8],
];

fn generate(job: &Job<'_>) -> Vec<[f64; 2]> {
    let Some(positions) = standard_positions(job.n) else { return rotated(job.n) };
    positions.iter().map(|p| p.map(|sixteenths| 0.5 + f64::from(sixteenths) / 16.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standard_positions_are_distinct_and_centred() {
        for samples in [1, 2, 4, 8, 16] {
            let positions = standard_positions(samples).expect("a standard count");
            assert_eq!(positions.len(), samples as usize);
            for axis in 0..2 {
                let mut values: Vec<i32> = positions.iter().map(|p| p[axis]).collect();
                values.sort_unstable();
                values.dedup();
                assert_eq!(values.len(), samples as usize, "an axis value twice");
                let sum: i32 = values.iter().sum();
                assert!(sum.abs() <= samples as i32 / 2, "{sum}");
            }
        }
    }
}
