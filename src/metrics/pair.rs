//! What a metric sees: a candidate beside its reference.

use super::flip;
use crate::picture::{Display, DisplayPicture, Linear, LinearPicture, NonFinite, Picture, Pixel};
use crate::{Error, Result};
use rayon::prelude::*;
use std::sync::OnceLock;

/// A candidate and its reference, of one size, as displayed and, where both have them, in linear values that were multiplied
/// by the scene's exposure but not tone mapped. What several metrics share is computed once.
#[derive(Debug)]
pub struct Pair<'a> {
    display: Sides<'a, Display>,
    linear: Option<Sides<'a, Linear>>,
    candidate_non_finite: Option<NonFinite>,
    reference_non_finite: Option<NonFinite>,
    flip: OnceLock<Option<Vec<f32>>>,
}

/// The same picture twice: as a method made it, and as it should be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sides<'a, E> {
    pub(super) candidate: &'a Picture<E>,
    pub(super) reference: &'a Picture<E>,
}

impl<'a> Pair<'a> {
    /// A pair of which only display values are known: linear metrics do not apply to it.
    ///
    /// # Errors
    ///
    /// [`Error::SizeMismatch`] if the sizes differ.
    pub fn new(candidate: &'a DisplayPicture, reference: &'a DisplayPicture) -> Result<Self> {
        same_size(reference.size(), candidate.size())?;
        Ok(Self {
            display: Sides { candidate, reference },
            linear: None,
            candidate_non_finite: candidate.non_finite(),
            reference_non_finite: reference.non_finite(),
            flip: OnceLock::new(),
        })
    }

    /// The pair with its linear values, exposed and before the tone map.
    ///
    /// # Errors
    ///
    /// [`Error::SizeMismatch`] if a size differs from the display pictures'.
    pub fn with_linear(mut self, candidate: &'a LinearPicture, reference: &'a LinearPicture) -> Result<Self> {
        same_size(self.size(), candidate.size())?;
        same_size(self.size(), reference.size())?;
        // A tone map may hide a NaN or an infinity, so the linear values are the ones to ask.
        self.candidate_non_finite = candidate.non_finite().or(self.candidate_non_finite);
        self.reference_non_finite = reference.non_finite().or(self.reference_non_finite);
        self.linear = Some(Sides { candidate, reference });
        Ok(self)
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.display.reference.size()
    }

    /// The candidate's pixels that are NaN or infinite; in its linear values if there are any, else in its display values.
    #[must_use]
    pub fn candidate_non_finite(&self) -> Option<NonFinite> {
        self.candidate_non_finite
    }

    /// The reference's pixels that are NaN or infinite: a defect of the reference, not of the candidate.
    #[must_use]
    pub fn reference_non_finite(&self) -> Option<NonFinite> {
        self.reference_non_finite
    }

    /// Whether all pixels of both sides are finite; no figure means anything otherwise.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.candidate_non_finite.is_none() && self.reference_non_finite.is_none()
    }

    pub(super) fn display(&self) -> Sides<'a, Display> {
        self.display
    }

    pub(super) fn linear(&self) -> Option<Sides<'a, Linear>> {
        self.linear
    }

    /// The FLIP error of each pixel in reading order, computed on first use; none if the picture exceeds FLIP's limits.
    pub(super) fn flip_map(&self) -> Option<&[f32]> {
        self.flip.get_or_init(|| flip::compute_map(self, flip::PIXELS_PER_DEGREE)).as_deref()
    }

    /// For each pixel in reading order, whether any of its values is NaN or infinite on either side.
    pub(super) fn broken_pixels(&self) -> Vec<bool> {
        let mut broken = vec![false; self.display.reference.pixels().len()];
        let mut mark = |pixels: &[Pixel]| {
            for (broken, pixel) in broken.iter_mut().zip(pixels) {
                *broken |= !pixel.iter().all(|value| value.is_finite());
            }
        };
        mark(self.display.candidate.pixels());
        mark(self.display.reference.pixels());
        if let Some(linear) = self.linear {
            mark(linear.candidate.pixels());
            mark(linear.reference.pixels());
        }
        broken
    }
}

fn same_size(a: [u32; 2], b: [u32; 2]) -> Result<()> {
    if a == b { Ok(()) } else { Err(Error::SizeMismatch(a, b)) }
}

impl<E: Sync> Sides<'_, E> {
    /// The mean of `term(candidate, reference)` over all pixels and the three colour channels.
    pub(super) fn mean(&self, term: impl Fn(f64, f64) -> f64 + Sync) -> f64 {
        let sums = self.per_row(|candidate, reference| {
            let channels = colours(candidate).zip(colours(reference));
            channels.map(|(c, r)| term(c, r)).sum::<f64>()
        });
        sums.iter().sum::<f64>() / (3.0 * self.reference.pixels().len() as f64)
    }

    /// The largest `term(candidate, reference)` of all pixels and the three colour channels, at least 0.
    pub(super) fn max(&self, term: impl Fn(f64, f64) -> f64 + Sync) -> f64 {
        let maxima = self.per_row(|candidate, reference| {
            let channels = colours(candidate).zip(colours(reference));
            channels.map(|(c, r)| term(c, r)).fold(0.0, f64::max)
        });
        maxima.into_iter().fold(0.0, f64::max)
    }

    /// One figure a row, from the top, so that sums are taken in the same order whatever the number of threads.
    fn per_row(&self, figure: impl Fn(&[Pixel], &[Pixel]) -> f64 + Sync) -> Vec<f64> {
        let width = self.reference.width() as usize;
        let candidates = self.candidate.pixels().par_chunks_exact(width);
        let references = self.reference.pixels().par_chunks_exact(width);
        candidates.zip(references).map(|(candidate, reference)| figure(candidate, reference)).collect()
    }
}

/// Red, green and blue of each pixel; alpha says nothing about what is seen.
fn colours(row: &[Pixel]) -> impl Iterator<Item = f64> + '_ {
    row.iter().flat_map(|&[r, g, b, _]| [f64::from(r), f64::from(g), f64::from(b)])
}
