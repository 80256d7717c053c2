//! Functions whose mean over each pixel is known exactly, to hold the mean of samples against.
//!
//! Each is what an artefact of rendering comes from: edges of all directions, nearly horizontal and vertical edges, a floor that
//! repeats up to the horizon, a smooth function of every frequency. All values are in [0, 1].

mod checker;
mod edge;
mod fresnel;
#[cfg(test)]
mod tests;
mod zone;

use crate::error::{Error, Result, unknown};

/// Pixels a side of the pictures.
const SIDE: usize = 256;

/// A function over pixels, each the unit square.
pub trait PixelFunction: Send + Sync {
    /// The value at a place of a pixel.
    fn value(&self, pixel: usize, at: [f64; 2]) -> f64;
}

/// What of the pixels' errors a figure is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// All pixels.
    All,
    /// The rows from the first to before the second.
    Rows(usize, usize),
    /// Means over squares of so many pixels a side: errors of high frequency, which filtering or a far viewer takes out, do not count.
    Lowpass(usize),
}

/// Known test.
#[derive(Debug)]
struct Known {
    name: &'static str,
    summary: &'static str,
    parts: &'static [(&'static str, Part)],
}

const KNOWN: &[Known] = &[
    Known {
        name: "halfplane",
        summary: "200 000 half-planes whose edge crosses the pixel, in all directions",
        parts: &[("all", Part::All)],
    },
    Known {
        name: "halfplane-axis",
        summary: "the same within atan(1/8) of the horizontal or the vertical",
        parts: &[("all", Part::All)],
    },
    Known {
        name: "checker",
        summary: "a checkered floor up to the horizon, 256x256: all below it, its first 31 rows (far), the lower half (near)",
        parts: &[
            ("all", Part::Rows(checker::HORIZON + 1, SIDE)),
            ("far", Part::Rows(checker::HORIZON + 1, checker::HORIZON + 32)),
            ("near", Part::Rows(SIDE / 2, SIDE)),
        ],
    },
    Known {
        name: "zone",
        summary: "0.5 + 0.5 cos(4 pi r^2 / 256) with r from a corner of 256x256 pixels: up to 4 cycles a pixel",
        parts: &[("all", Part::All), ("lowpass", Part::Lowpass(8))],
    },
];

/// Every test's name, and what it is in a line.
pub fn pixel_tests() -> impl Iterator<Item = (&'static str, &'static str)> {
    KNOWN.iter().map(|known| (known.name, known.summary))
}

/// A function with the exact mean of each of its pixels.
pub struct PixelTest {
    function: Box<dyn PixelFunction>,
    exact: Vec<f64>,
    parts: &'static [(&'static str, Part)],
}

impl std::fmt::Debug for PixelTest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PixelTest of {} pixels, {:?}", self.exact.len(), self.parts)
    }
}

impl PixelTest {
    /// The test of this name. `yaw_degrees` turns the floor of `checker`, from -180 to 180; the others do not have it.
    ///
    /// Takes up to a second: the exact means of `checker` need the area of each cell in each pixel.
    ///
    /// # Errors
    /// [`Error::Request`] that lists the names, or says that the angle is none.
    pub fn new(name: &str, yaw_degrees: f64) -> Result<Self> {
        let known = KNOWN.iter().find(|known| known.name == name).ok_or_else(|| {
            let names: Vec<_> = KNOWN.iter().map(|known| known.name).collect();
            unknown("test", name, &names)
        })?;
        if !(-180.0..=180.0).contains(&yaw_degrees) {
            return Err(Error::Request(format!("a yaw of {yaw_degrees} degrees is out of range; it goes from -180 to 180")));
        }
        let (function, exact): (Box<dyn PixelFunction>, Vec<f64>) = match name {
            "halfplane" => edge::any_direction(),
            "halfplane-axis" => edge::near_axes(),
            "checker" => checker::Floor::turned(yaw_degrees.to_radians()).with_means(),
            _ => zone::with_means(),
        };
        Ok(Self { function, exact, parts: known.parts })
    }

    /// How many pixels there are.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.exact.len()
    }

    /// The mean over a pixel.
    ///
    /// # Panics
    /// If there is no such pixel.
    #[must_use]
    pub fn exact(&self, pixel: usize) -> f64 {
        self.exact[pixel]
    }

    /// The mean of the function over a set of points less that over the pixel; -exact for no points.
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn error(&self, pixel: usize, points: impl ExactSizeIterator<Item = [f64; 2]>) -> f64 {
        let n = points.len().max(1) as f64;
        points.map(|at| self.function.value(pixel, at)).sum::<f64>() / n - self.exact[pixel]
    }

    /// Root mean square of errors, one of each pixel in order, over each part of the picture that the test tells apart.
    ///
    /// # Panics
    /// If there are fewer errors than pixels.
    #[must_use]
    pub fn rms(&self, errors: &[f64]) -> Vec<(&'static str, f64)> {
        assert_eq!(errors.len(), self.pixels(), "an error for each pixel");
        self.parts.iter().map(|(name, part)| (*name, part.rms(errors))).collect()
    }
}

impl Part {
    fn rms(self, errors: &[f64]) -> f64 {
        match self {
            Self::All => rms(errors.iter().copied()),
            Self::Rows(from, to) => rms(errors[from * SIDE..to * SIDE].iter().copied()),
            Self::Lowpass(side) => {
                let square = |x: usize, y: usize| {
                    let rows = (y..y + side).map(|y| errors[y * SIDE + x..][..side].iter().sum::<f64>());
                    rows.sum::<f64>() / (side * side) as f64
                };
                let corners = || (0..SIDE).step_by(side);
                rms(corners().flat_map(|y| corners().map(move |x| square(x, y))))
            }
        }
    }
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x * x, count + 1.0));
    f64::sqrt(sum / count)
}
