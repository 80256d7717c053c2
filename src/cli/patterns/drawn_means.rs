//! Means over pixels of a drawn scene, one set for all pixels.

use crate::error::{Error, Result};
use crate::methods::Spec;
use crate::picture::LinearPicture;
use crate::sampling::PatternSpec;

/// The method that draws with this pattern, under a box filter.
pub(super) fn method(spec: &PatternSpec, seed: u32, spp: u32) -> Result<Spec> {
    let name = spec.pattern().name;
    if spec.to_string() != name {
        return Err(Error::Request(format!("{spec}: scenes are drawn with patterns under their defaults; give just {name}")));
    }
    Spec::parse(&format!("ssaa:spp={spp},pattern={name},seed={seed}"))
}

/// Over red, green and blue, of exposed linear values clamped to [0, 1].
pub(super) fn rms(picture: &LinearPicture, exact: &LinearPicture, exposure: f32) -> f64 {
    let shown = |x: f32| f64::from((x * exposure).clamp(0.0, 1.0));
    let squares = picture.pixels().iter().zip(exact.pixels()).flat_map(|(p, q)| (0..3).map(|k| shown(p[k]) - shown(q[k])));
    (squares.map(|d| d * d).sum::<f64>() / (3 * exact.pixels().len()) as f64).sqrt()
}
