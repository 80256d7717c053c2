//! Pictures and rows of point sets: right places, stable bytes, no panic on odd ones.

use super::*;
use crate::suite::{IntegralError, IntegralRow, SpectrumRow};

fn panel(points: &[[f64; 2]]) -> Panel {
    Panel { title: "<two> & more".into(), ground: None, points: points.to_vec(), radius: 0.05, round: false }
}

fn panels(count: usize) -> Panels {
    Panels { panels: vec![panel(&[[0.25, 0.5], [0.75, 0.5]]); count], side_px: 64 }
}

#[test]
fn dots_are_where_the_points_are() {
    let one = panels(1);
    let picture = one.picture().expect("small");
    assert_eq!(picture.size(), [64 + 2 * 16, 64 + 2 * 16]);
    let dark = |x: u32, y: u32| picture.pixel(x, y)[0] < 0.5;
    assert!(dark(16 + 16, 16 + 32) && dark(16 + 48, 16 + 32), "a dot each");
    assert!(!dark(16 + 32, 16 + 32) && !dark(16 + 16, 16 + 16), "none between or above them");
    // The area that is covered, in linear light, is that of two disks.
    let inside = picture.to_linear().crop(16, 16, 64, 64).expect("inside");
    let covered: f64 = inside.pixels().iter().map(|p| 1.0 - f64::from(p[0])).sum();
    let disks = 2.0 * std::f64::consts::PI * 3.2 * 3.2;
    assert!((covered / disks - 1.0).abs() < 0.03, "{covered} for {disks}");

    let svg = one.svg();
    assert!(svg.contains("cx=\"32.00\"") && svg.contains("cx=\"64.00\""), "{svg}");
    assert!(svg.contains("&lt;two&gt; &amp; more") && !svg.contains("<two>"));
    assert_eq!(svg, one.svg());
}

#[test]
fn panels_fill_rows() {
    assert_eq!(panels(6).svg_size()[0], 16 + 6 * 80);
    assert_eq!(panels(7).svg_size(), [16 + 6 * 80, 16 + 2 * (64 + 16 + 18)]);
    assert_eq!(panels(7).picture().expect("small").size(), [16 + 6 * 80, 16 + 2 * 80]);
    assert_eq!(panels(7).svg().matches("<circle").count(), 14);
    assert!(panels(0).picture().is_ok() && panels(0).svg().contains("</svg>"));
}

#[test]
fn a_disk_has_a_round_outline() {
    let square = panels(1);
    let disk = Panels { panels: vec![Panel { round: true, points: vec![], ..panel(&[]) }], side_px: 64 };
    let corner = |panels: &Panels| panels.picture().expect("small").pixel(15, 15)[0];
    assert!(corner(&square) < 0.9 && corner(&disk) == 1.0);
    assert_eq!(disk.svg().matches("<circle").count(), 1);
}

#[test]
fn maps_show_sign_and_size() {
    let map = deviation_map(&[0.2, -0.2, 0.0, 0.1], 2).expect("four values");
    let [many, few, right, some] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| map.pixel(x, y));
    assert!(many[0] > many[2] && few[2] > few[0], "red and blue");
    assert_eq!(right, [1.0; 4]);
    assert!(some[1] > many[1] && some[0] > some[2], "paler");
    assert_eq!(deviation_map(&[0.0], 1).expect("one value").pixel(0, 0), [1.0; 4]);
    assert_eq!(power_map(&[0.0, 1.0, 3.0, 1e9], 2).expect("four values").pixel(1, 0)[0], 0.5);
    assert!(power_map(&[0.0; 3], 2).is_err());
}

#[test]
fn spectra_have_pictures_and_curves() {
    let row = |pattern: &str| SpectrumRow {
        pattern: pattern.into(),
        n: 16,
        trials: 3,
        low_quarter: 0.0,
        low_half: 0.1,
        low_largest: 0.2,
        peak: 1.5,
        peak_frequency: 1.0,
        onset_frequency: None,
        anisotropy_db: Some(-4.0),
        anisotropy_floor_db: -4.8,
        axis: 0.7,
        radial_mean: vec![0.0, 0.5, 1.5, 1.0],
        radial_anisotropy_db: vec![None, Some(-3.0), Some(-4.0), Some(-5.0)],
    };
    let mut periodograms = panels(2);
    periodograms.panels[0].ground = Some(power_map(&[0.0, 1.0, 2.0, 3.0], 2).expect("four"));
    let svg = spectrum_svg(&periodograms, &[row("one"), row("other")]);
    for text in ["data:image/png;base64,", "radial mean power", "anisotropy in dB", "other", "-20"] {
        assert!(svg.contains(text), "{text} in {svg}");
    }
    assert_eq!(svg.matches("<svg").count(), 4);
    let even = SpectrumRow { radial_anisotropy_db: vec![None; 4], ..row("even") };
    assert_eq!(spectrum_svg(&panels(1), &[even]).matches("<svg").count(), 3, "no plot without a line");
    assert_eq!(spectrum_svg(&panels(0), &[]).matches("<svg").count(), 2);
}

#[test]
fn commas_in_names_do_not_make_columns() {
    let errors = vec![IntegralError { spp: 4, rms: 0.125 }, IntegralError { spp: 16, rms: 0.0625 }];
    let row = IntegralRow {
        test: "checker".into(),
        part: "far".into(),
        pattern: "lloyd:generations=4,raster=\"9\"".into(),
        sets: "fresh".into(),
        slope: None,
        errors,
    };
    let csv = integral_csv(&[row]);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines[0], "test,part,pattern,sets,spp,rms");
    assert_eq!(lines[1], "checker,far,\"lloyd:generations=4,raster=\"\"9\"\"\",fresh,4,0.125");
    assert_eq!(lines.len(), 3);
}
