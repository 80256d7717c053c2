//! Pairs of 64x48 pictures that a formula makes, with figures that other implementations agree on: scikit-image 0.26 for the
//! error, PSNR and SSIM, NVIDIA's FLIP 1.7 (and its C++ and Rust ports) for FLIP.

use crate::picture::DisplayPicture;

pub(super) const WIDTH: i32 = 64;
pub(super) const HEIGHT: i32 = 48;

/// A picture by formula, as 8 bit RGB of a column and a row.
type Formula = fn(i32, i32) -> [i32; 3];

/// A reference and a test picture, and what they must score.
pub(super) struct FormulaPair {
    pub(super) name: &'static str,
    reference: Formula,
    test: Formula,
    /// Mean squared error of 8 bit values.
    pub(super) mse: f64,
    pub(super) psnr: f64,
    pub(super) ssim: f64,
    /// Mean and maximum at 67 pixels a degree.
    pub(super) flip_67: [f64; 2],
    /// Mean and maximum at 67.0206 pixels a degree.
    pub(super) flip: [f64; 2],
    pub(super) psnr_linear: f64,
}

impl FormulaPair {
    pub(super) fn reference(&self) -> DisplayPicture {
        picture(self.reference)
    }

    pub(super) fn test(&self) -> DisplayPicture {
        picture(self.test)
    }

    /// Test and reference value of each pixel in one channel, as f64 in [0, 1]: a picture rounds them to f32.
    pub(super) fn exact(&self, channel: usize) -> [Vec<f64>; 2] {
        [self.test, self.reference].map(|formula| {
            let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
            places.map(|(x, y)| f64::from(formula(x, y)[channel]) / 255.0).collect()
        })
    }
}

fn picture(formula: Formula) -> DisplayPicture {
    DisplayPicture::from_fn(WIDTH as u32, HEIGHT as u32, |x, y| {
        let [r, g, b] = formula(x as i32, y as i32).map(|level| level as f32 / 255.0);
        [r, g, b, 1.0]
    })
    .expect("a size")
}

fn a(x: i32, y: i32) -> [i32; 3] {
    [(4 * x) % 256, (5 * y) % 256, (x / 8 + y / 8) % 2 * 255]
}

fn plus(x: i32, y: i32, offset: i32) -> [i32; 3] {
    a(x, y).map(|level| (level + offset).clamp(0, 255))
}

fn noise(x: i32, y: i32) -> [i32; 3] {
    plus(x, y, (7 * x + 13 * y) % 17 - 8)
}

fn shift1(x: i32, y: i32) -> [i32; 3] {
    a((x - 1).max(0), y)
}

fn plus1(x: i32, y: i32) -> [i32; 3] {
    plus(x, y, 1)
}

fn plus16(x: i32, y: i32) -> [i32; 3] {
    plus(x, y, 16)
}

fn box3(x: i32, y: i32) -> [i32; 3] {
    let mut sum = [0; 3];
    for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
        let neighbour = a((x + dx).clamp(0, WIDTH - 1), (y + dy).clamp(0, HEIGHT - 1));
        sum = std::array::from_fn(|k| sum[k] + neighbour[k]);
    }
    sum.map(|s| (2 * s + 9) / 18)
}

fn hard(x: i32, y: i32) -> [i32; 3] {
    [if 6 * x + 3 > 8 * y + 4 { 255 } else { 0 }; 3]
}

fn soft(x: i32, y: i32) -> [i32; 3] {
    let samples = (0..4).flat_map(|j| (0..4).map(move |i| (i, j)));
    let covered = samples.filter(|(i, j)| 3 * (8 * x + 2 * i + 1) > 4 * (8 * y + 2 * j + 1)).count() as i32;
    [(255 * covered + 8) / 16; 3]
}

#[rustfmt::skip]
pub(super) const PAIRS: &[FormulaPair] = &[
    FormulaPair {
        name: "noise", reference: a, test: noise, mse: 19.634549, psnr: 35.200594, ssim: 0.906280626,
        flip_67: [0.046783, 0.155697], flip: [0.0467796, 0.1556802], psnr_linear: 33.317798,
    },
    FormulaPair {
        name: "shift1", reference: a, test: shift1, mse: 2375.953125, psnr: 14.372425, ssim: 0.873115045,
        flip_67: [0.174102, 0.477376], flip: [0.1740685, 0.4772734], psnr_linear: 14.368653,
    },
    FormulaPair {
        name: "plus1", reference: a, test: plus1, mse: 0.833333, psnr: 48.922616, ssim: 0.999748499,
        flip_67: [0.041107, 0.058174], flip: [0.0411074, 0.0581757], psnr_linear: 48.726969,
    },
    FormulaPair {
        name: "plus16", reference: a, test: plus16, mse: 210.104167, psnr: 24.906457, ssim: 0.974779267,
        flip_67: [0.303211, 0.419082], flip: [0.3032143, 0.4190833], psnr_linear: 24.485690,
    },
    FormulaPair {
        name: "box3", reference: a, test: box3, mse: 1003.088976, psnr: 18.117409, ssim: 0.921971178,
        flip_67: [0.243915, 0.383012], flip: [0.2439064, 0.3829508], psnr_linear: 16.066526,
    },
    FormulaPair {
        name: "edge", reference: soft, test: hard, mse: 122.666667, psnr: 27.243538, ssim: 0.981507302,
        flip_67: [0.024551, 0.509003], flip: [0.0245529, 0.5089512], psnr_linear: 25.040584,
    },
];
