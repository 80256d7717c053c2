//! What probes say of methods whose faults are known.

use dejag::bench::sequence::{Contestant, Course, Probe};
use dejag::metrics::Figure;
use dejag::suite::{ProbeFigures, SequenceResult};

use super::laggard::Laggard;
use super::{figures, request, run, scene, spec, with_probes};
use crate::common;

fn probed(course: Course, probes: &[Probe], contestants: &[Contestant<'_>]) -> SequenceResult {
    let request = with_probes(request(course, [160, 90], "ssaa:spp=64"), probes);
    run(&common::gpu(), &scene("courtyard"), &request, contestants)
}

fn of(result: &SequenceResult, method: usize) -> &ProbeFigures {
    &figures(&result.methods[method]).probes
}

#[test]
fn half_of_the_last_picture_takes_four_frames_to_respond_and_blurs_what_moves() {
    let (none, lag) = (spec("none"), Laggard { keep: 0.5 });
    let contestants = [Contestant::of(&none), Contestant { label: "lag".into(), techniques: vec![("lag", &lag)] }];
    let result = probed(Course::still(0, 1), &Probe::ALL, &contestants);
    let frames = |method| of(&result, method).response.as_ref().expect("run").frames;
    println!("after a change of the light: {:?}", of(&result, 1).response.as_ref().map(|r| &r.shares[..6]));
    // 1 - 0.5^4 is the first above nine tenths.
    assert_eq!((frames(0), frames(1)), (Figure::Number(1.0), Figure::Number(4.0)));
    let sharpness = |method| -> Vec<f64> {
        of(&result, method).sharpness.iter().flatten().map(|figure| figure.ratio.number().expect("a ratio")).collect()
    };
    let (sharp, blurred) = (sharpness(0), sharpness(1));
    println!("sharpness at 0, 0.25, 0.5, 1.37, 8 px a frame: none {sharp:.3?}, lag {blurred:.3?}");
    assert!(sharp.iter().all(|ratio| (ratio - sharp[0]).abs() < 0.01 * sharp[0]), "{sharp:?}");
    assert!((blurred[0] - sharp[0]).abs() < 0.02 && blurred[4] < 0.6 * blurred[0] && blurred[2] < 0.95 * blurred[0]);
    for method in 0..2 {
        let crawl = of(&result, method).crawl.as_ref().expect("run");
        assert!(crawl.mean.number().expect("a number") < 1e-5, "a still picture stands still: {crawl:?}");
        let convergence = of(&result, method).convergence.as_ref().expect("run");
        assert_eq!((convergence.frames, convergence.psnr.len()), (Figure::Number(1.0), 64));
    }
}

#[test]
fn edges_of_one_sample_are_off_as_theory_says_and_more_samples_are_nearer() {
    let specs = ["none", "ssaa:spp=4,pattern=rotated", "ssaa:spp=256"].map(spec);
    let contestants: Vec<_> = specs.iter().map(Contestant::of).collect();
    let result = probed(Course::still(0, 1), &[Probe::Position], &contestants);
    let position = |method| of(&result, method).position.as_ref().expect("run");
    let rms: Vec<f64> = (0..3).map(|method| position(method).rms_px.number().expect("a number")).collect();
    let max: Vec<f64> = (0..3).map(|method| position(method).max_px.number().expect("a number")).collect();
    println!("RMS {rms:.4?}, max {max:.4?} px");
    // Uniform within half a pixel, less where the edge is slanted: at most sqrt(1/12).
    assert!((0.2..0.289).contains(&rms[0]) && (0.4..=0.5).contains(&max[0]));
    assert!(rms[1] < 0.5 * rms[0] && rms[2] < 0.1 * rms[1]);
    assert_eq!(position(0).angles.len(), 13);
    assert!(of(&result, 0).crawl.is_none());
}
