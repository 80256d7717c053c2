//! Metrics of single channel differences, over all pixels and red, green and blue.

use super::{Figure, Pair};

/// Decibels of a mean squared error at peak 1; infinite for equal pictures.
pub(super) fn psnr_of(mean_squared_error: f64) -> Figure {
    Figure::from(-10.0 * mean_squared_error.log10())
}

/// Peak signal to noise ratio of display values, peak 1.
pub(super) fn psnr(pair: &Pair<'_>) -> Figure {
    psnr_of(pair.display().mean(|t, r| (t - r).powi(2)))
}

/// Peak signal to noise ratio of exposed linear values, clamped to [0, 1] on both sides.
pub(super) fn psnr_linear(pair: &Pair<'_>) -> Figure {
    let clamped = |t: f64, r: f64| (t.clamp(0.0, 1.0) - r.clamp(0.0, 1.0)).powi(2);
    pair.linear().map_or(Figure::NotApplicable, |linear| psnr_of(linear.mean(clamped)))
}

/// Largest absolute difference of display values, in steps of an 8 bit display.
pub(super) fn max_error(pair: &Pair<'_>) -> Figure {
    // f32 pictures hold multiples of 1/255 to some 1e-5 of a step: what is less is no difference.
    let steps = 255.0 * pair.display().max(|t, r| (t - r).abs());
    Figure::from((steps * 1e4).round() / 1e4)
}

/// Relative root mean square error of exposed linear values without a clamp. The 0.01 in the denominator bounds the weight of
/// what is darker than a tenth of white.
pub(super) fn relative_rmse(pair: &Pair<'_>) -> Figure {
    let relative = |t: f64, r: f64| (t - r).powi(2) / (r * r + 0.01);
    pair.linear().map_or(Figure::NotApplicable, |linear| Figure::from(linear.mean(relative).sqrt()))
}

/// Mean of the candidate over mean of the reference, in exposed linear values without a clamp. Two black pictures have ratio 1,
/// light out of nothing is infinite, and a mean below 0 against a black reference has no ratio.
pub(super) fn energy(pair: &Pair<'_>) -> Figure {
    let Some(linear) = pair.linear() else {
        return Figure::NotApplicable;
    };
    let (candidate, reference) = (linear.mean(|t, _| t), linear.mean(|_, r| r));
    if reference != 0.0 {
        return Figure::from(candidate / reference);
    }
    match candidate {
        0.0 => Figure::Number(1.0),
        light if light > 0.0 => Figure::Infinite,
        _ => Figure::NotApplicable,
    }
}
