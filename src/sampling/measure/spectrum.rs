//! The power spectrum of point sets.

use std::f64::consts::TAU;

/// The frequency of a square grid of n points, in cycles a side: the scale that spectra of different counts share.
#[must_use]
pub fn principal_frequency(n: usize) -> f64 {
    (n as f64).sqrt()
}

/// |sum of exp(-2 pi i f x)|^2 / n at whole frequencies f (Ulichney 1987), averaged over sets; 1 everywhere for white noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Periodogram {
    highest: usize,
    sets: u32,
    /// Sums over the sets; rows of fy = 0 to `highest`, in each fx = -`highest` to `highest`. The other half mirrors it.
    power: Vec<f64>,
}

/// What a spectrum says in a few figures. Frequencies are relative to the principal one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumFigures {
    /// Mean power below a quarter of the principal frequency, 0 left out.
    pub low_quarter: f64,
    /// Mean power below half of it.
    pub low_half: f64,
    /// Largest power below half of it: a peak there is an alias in waiting.
    pub low_largest: f64,
    /// Largest radial mean.
    pub peak: f64,
    /// Where that is.
    pub peak_frequency: f64,
    /// The first radial mean above one half is here; none if none is.
    pub onset_frequency: Option<f64>,
    /// Variance over squared mean at equal radius, averaged over radii from 1/4 to 2 that have power, in dB. No lower than
    /// -10 log10(sets), where sets without any preferred direction are.
    pub anisotropy_db: f64,
    /// Mean power on both axes up to twice the principal frequency: near 0 for sets stratified along the axes, large for grids.
    pub axis: f64,
}

/// Power at frequencies of about equal radius.
#[derive(Debug, Clone, Copy, Default)]
struct Ring {
    count: f64,
    sum: f64,
    squares: f64,
}

/// Below this a ring has no power to speak of: rounding, where a grid has exactly none.
const NO_POWER: f64 = 1e-9;

impl Periodogram {
    /// Of one set, for frequencies up to `highest` along both axes. O(n `highest`^2).
    #[must_use]
    pub fn of(points: &[[f64; 2]], highest: usize) -> Self {
        let width = 2 * highest + 1;
        let mut sums = vec![[0.0; 2]; width * (highest + 1)];
        for p in points {
            let along = waves(p[0], -(highest as i32), width);
            let up = waves(p[1], 0, highest + 1);
            for (row, b) in sums.chunks_exact_mut(width).zip(&up) {
                for (sum, a) in row.iter_mut().zip(&along) {
                    sum[0] += a[0] * b[0] - a[1] * b[1];
                    sum[1] += a[0] * b[1] + a[1] * b[0];
                }
            }
        }
        let n = super::count(points);
        Self { highest, sets: 1, power: sums.iter().map(|s| (s[0] * s[0] + s[1] * s[1]) / n).collect() }
    }

    /// Adds the sets of another one up to the same frequency.
    ///
    /// # Panics
    /// If it is not up to the same frequency.
    pub fn add(&mut self, other: &Self) {
        assert_eq!(self.highest, other.highest, "periodograms of different extent");
        self.sets += other.sets;
        self.power.iter_mut().zip(&other.power).for_each(|(sum, power)| *sum += power);
    }

    /// The highest frequency along an axis.
    #[must_use]
    pub fn highest(&self) -> usize {
        self.highest
    }

    /// How many sets it is averaged over.
    #[must_use]
    pub fn sets(&self) -> u32 {
        self.sets
    }

    /// Power at (fx, fy), each from -highest to highest; at (0, 0) the number of points.
    ///
    /// # Panics
    /// Beyond that.
    #[must_use]
    pub fn power(&self, fx: i32, fy: i32) -> f64 {
        let (fx, fy) = if fy < 0 { (-fx, -fy) } else { (fx, fy) };
        let (column, width) = ((fx + self.highest as i32) as usize, 2 * self.highest + 1);
        assert!(column < width, "no frequency ({fx}, {fy})");
        self.power[fy as usize * width + column] / f64::from(self.sets)
    }

    /// Mean power at each radius from 1 to highest: of the frequencies that round to it.
    #[must_use]
    pub fn radial_mean(&self) -> Vec<f64> {
        self.rings().iter().map(Ring::mean).collect()
    }

    /// Variance over squared mean at each radius from 1 to highest, in dB; none where there is no power.
    #[must_use]
    pub fn radial_anisotropy_db(&self) -> Vec<Option<f64>> {
        self.rings().iter().map(|ring| ring.anisotropy().map(decibels)).collect()
    }

    /// The figures of sets of `n` points.
    #[must_use]
    pub fn figures(&self, n: usize) -> SpectrumFigures {
        let principal = principal_frequency(n);
        let below = |share: f64| self.frequencies().filter(move |(f, _)| radius(*f) < share * principal).map(|(_, power)| power);
        let rings = self.rings();
        let radial =
            |wanted: &dyn Fn(f64) -> bool| rings.iter().position(|r| wanted(r.mean())).map(|i| (i + 1) as f64 / principal);
        let peak = rings.iter().map(Ring::mean).fold(0.0, f64::max);
        let of_interest = (1..).zip(&rings).filter(|(f, _)| (0.25 * principal..=2.0 * principal).contains(&f64::from(*f)));
        let on_axes = self.frequencies().filter(|(f, _)| f.contains(&0) && radius(*f) < 2.0 * principal);
        SpectrumFigures {
            low_quarter: mean(below(0.25)),
            low_half: mean(below(0.5)),
            low_largest: below(0.5).fold(0.0, f64::max),
            peak,
            peak_frequency: radial(&|m| m == peak).unwrap_or(0.0),
            onset_frequency: radial(&|m| m > 0.5),
            anisotropy_db: decibels(mean(of_interest.filter_map(|(_, ring): (u32, _)| ring.anisotropy()))),
            axis: mean(on_axes.map(|(_, power)| power)),
        }
    }

    /// Half of all frequencies with their power, the other half being the same, without 0.
    fn frequencies(&self) -> impl Iterator<Item = ([i32; 2], f64)> {
        let highest = self.highest as i32;
        let half = (0..=highest).flat_map(move |fy| (-highest..=highest).map(move |fx| [fx, fy]));
        half.filter(|[fx, fy]| *fy > 0 || *fx > 0).map(|[fx, fy]| ([fx, fy], self.power(fx, fy)))
    }

    fn rings(&self) -> Vec<Ring> {
        let mut rings = vec![Ring::default(); self.highest];
        for (f, power) in self.frequencies() {
            if let Some(ring) = rings.get_mut(radius(f).round() as usize - 1) {
                ring.count += 1.0;
                ring.sum += power;
                ring.squares += power * power;
            }
        }
        rings
    }
}

impl Ring {
    fn mean(&self) -> f64 {
        self.sum / self.count
    }

    fn anisotropy(&self) -> Option<f64> {
        let mean = self.mean();
        (mean > NO_POWER).then(|| (self.squares / self.count / (mean * mean) - 1.0).max(0.0))
    }
}

/// exp(-2 pi i f u) for `count` frequencies from `first` on.
fn waves(u: f64, first: i32, count: usize) -> Vec<[f64; 2]> {
    let wave = |f: i32| {
        let (sin, cos) = (-TAU * (f64::from(f) * u).fract()).sin_cos();
        [cos, sin]
    };
    (first..).take(count).map(wave).collect()
}

fn radius([fx, fy]: [i32; 2]) -> f64 {
    f64::from(fx).hypot(f64::from(fy))
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

fn decibels(ratio: f64) -> f64 {
    10.0 * ratio.log10()
}
