//! Axes of a plot: from values to pixels, and where the ticks go.

/// A value's way to a pixel, along one axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    from: f64,
    to: f64,
    logarithmic: bool,
    pixels: [i32; 2],
}

/// Least value on a logarithmic axis: a microsecond, in milliseconds. What is less is drawn there.
const LEAST: f64 = 1e-3;

impl Axis {
    /// A logarithmic axis around the values, with room on both sides; drawn from `pixels[0]` to `pixels[1]`.
    pub(super) fn logarithmic(values: impl Iterator<Item = f64>, pixels: [i32; 2]) -> Self {
        let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(least, most), x| (least.min(x), most.max(x)));
        let (least, most) = if least > most { (1.0, 1.0) } else { (least.max(LEAST), most.max(LEAST)) };
        // At least half a decade, or equal times would be told apart by nothing but noise.
        let (low, high) = (least.log10(), most.log10());
        let room = (0.12 * (high - low)).max(0.25 - 0.5 * (high - low).min(0.26));
        Self { from: low - room, to: high + room, logarithmic: true, pixels }
    }

    /// A linear axis from 0 to the largest value and a little more; drawn from `pixels[0]` to `pixels[1]`.
    pub(super) fn from_zero(values: impl Iterator<Item = f64>, pixels: [i32; 2]) -> Self {
        let most = values.fold(0.0, f64::max);
        Self { from: 0.0, to: if most > 0.0 { 1.12 * most } else { 1.0 }, logarithmic: false, pixels }
    }

    /// A linear axis from `least` to `most`; drawn from `pixels[0]` to `pixels[1]`.
    pub(super) fn between(least: f64, most: f64, pixels: [i32; 2]) -> Self {
        Self { from: least, to: most, logarithmic: false, pixels }
    }

    /// The pixel of a value.
    pub(super) fn pixel(&self, value: f64) -> i32 {
        let place = if self.logarithmic { value.max(LEAST).log10() } else { value };
        let share = ((place - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        let [start, end] = self.pixels.map(f64::from);
        (start + share * (end - start)).round() as i32
    }

    /// Round values along the axis, with their labels.
    pub(super) fn ticks(&self) -> Vec<(f64, String)> {
        let ticks = if self.logarithmic { self.decade_ticks() } else { self.even_ticks() };
        ticks.into_iter().map(|value| (value, label(value))).collect()
    }

    /// 1, 2, 5 of each decade; only each decade where there are many, each digit where there are few.
    fn decade_ticks(&self) -> Vec<f64> {
        let decades = self.to - self.from;
        let digits: &[i32] = match decades {
            _ if decades < 0.8 => &[1, 2, 3, 4, 5, 6, 8],
            _ if decades < 3.5 => &[1, 2, 5],
            _ => &[1],
        };
        let exponents = self.from.floor() as i32..=self.to.ceil() as i32;
        let values = exponents.flat_map(|e| digits.iter().map(move |&d| format!("{d}e{e}").parse().unwrap_or(1.0)));
        values.filter(|value: &f64| (self.from..=self.to).contains(&value.log10())).collect()
    }

    /// Four to eight ticks at multiples of 1, 2 or 5 times a power of ten.
    fn even_ticks(&self) -> Vec<f64> {
        let rough = (self.to - self.from) / 5.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|step| *step >= 0.8 * rough).unwrap_or(rough);
        let first = (self.from / step).ceil();
        (0..=10).map(|i| step * (first + f64::from(i))).take_while(|value| *value <= self.to).collect()
    }
}

/// A round value without the digits of its binary form.
fn label(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) { format!("{rounded:e}") } else { rounded.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks().into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(labels(&Axis::from_zero([0.05].into_iter(), [0, 100])), ["0", "0.01", "0.02", "0.03", "0.04", "0.05"]);
        let times = labels(&Axis::logarithmic([0.3, 40.0].into_iter(), [0, 100]));
        assert_eq!(times, ["0.2", "0.5", "1", "2", "5", "10", "20", "50"]);
    }

    #[test]
    fn odd_ranges_have_ticks_and_stay_on_the_axis() {
        for values in [&[][..], &[0.0], &[5.0, 5.0], &[0.0, 1e9], &[1e-12, 1e-9]] {
            for axis in [Axis::logarithmic(values.iter().copied(), [10, 90]), Axis::from_zero(values.iter().copied(), [90, 10])] {
                assert!(!axis.ticks().is_empty(), "{values:?}");
                assert!(axis.ticks().len() < 16, "{values:?}: {:?}", labels(&axis));
                assert!(values.iter().all(|&value| (10..=90).contains(&axis.pixel(value))), "{values:?}");
            }
        }
    }
}
