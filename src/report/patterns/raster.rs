//! Values over the square or over frequencies as colours.

use crate::error::Result;
use crate::picture::{DisplayPicture, Pixel};

/// Powers in rows of `side`: black for none, grey for white noise's 1, and the more the whiter.
///
/// # Errors
/// [`crate::Error::Request`] if they do not fill a square.
pub fn power_map(powers: &[f64], side: u32) -> Result<DisplayPicture> {
    let grey = |power: f64| (power / (1.0 + power)) as f32;
    picture(powers, side, |power| [grey(power), grey(power), grey(power), 1.0])
}

/// Deviations in rows of `side`: red where a box has too many points, blue where it has too few, white where it is right. The
/// largest deviation, either way, has the full colour.
///
/// # Errors
/// [`crate::Error::Request`] if they do not fill a square.
pub fn deviation_map(deviations: &[f64], side: u32) -> Result<DisplayPicture> {
    const TOO_MANY: [f32; 3] = [0.75, 0.10, 0.13];
    const TOO_FEW: [f32; 3] = [0.10, 0.30, 0.75];
    let most = deviations.iter().fold(0.0f64, |most, d| most.max(d.abs()));
    picture(deviations, side, |deviation| {
        let share = if most > 0.0 { (deviation.abs() / most) as f32 } else { 0.0 };
        let [r, g, b] = if deviation > 0.0 { TOO_MANY } else { TOO_FEW }.map(|full| 1.0 - share * (1.0 - full));
        [r, g, b, 1.0]
    })
}

fn picture(values: &[f64], side: u32, color: impl Fn(f64) -> Pixel) -> Result<DisplayPicture> {
    DisplayPicture::new(side, side, values.iter().map(|value| color(*value)).collect())
}
