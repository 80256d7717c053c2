//! How near filters come to the exact coverage of a straight edge, by its angle: what a picture without texture, light or
//! overlap says of a filter, and no choice of scene can flatter.

mod pattern;

use glam::DVec2;

use crate::capture::{PictureFilter, Watch};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::methods::Spec;
use crate::pass::{Encoding, Extras, Role, Surface};
use crate::picture::Pixel;
use crate::suite::{EdgeCurve, EdgeErrors};
use pattern::{Pattern, SIDE, blended, centre, shown};

/// Angles in whole degrees from the vertical; those beyond are the same edges turned.
const DEGREES: u32 = 90;

/// Four samples a pixel, no two in a row or column.
const FOUR_SAMPLES: [DVec2; 4] =
    [DVec2::new(-0.125, -0.375), DVec2::new(0.375, -0.125), DVec2::new(-0.375, 0.125), DVec2::new(0.125, 0.375)];

/// A name and the picture it makes of a pattern.
type Baseline = (&'static str, fn(&Pattern) -> Vec<Pixel>);

/// What a filter is held against: no filter at all, samples instead of guesses, and the best that blending display values could
/// come to.
const BASELINES: [Baseline; 3] = [
    ("none", Pattern::aliased),
    ("4 samples (rotated grid)", |pattern| {
        let bright = |pixel, offset: &DVec2| pattern.is_bright(centre(pixel) + *offset);
        Pattern::picture(|pixel| shown(FOUR_SAMPLES.iter().filter(|o| bright(pixel, o)).count() as f64 / 4.0))
    }),
    ("exact, display blend", |pattern| Pattern::picture(|pixel| blended(pattern.share(pixel)))),
];

/// Runs those of the methods that take a picture of display values and need nothing beside it; `None` if there are none. One that
/// the adapter cannot run is left out: the scenes' results say why.
///
/// # Errors
/// [`Error::Gpu`], and what `watch` answers.
pub fn edge_errors(gpu: &Gpu, methods: &[Spec], watch: &mut dyn Watch) -> Result<Option<EdgeErrors>> {
    let mut filters = Vec::new();
    for spec in methods.iter().filter(|spec| takes_a_picture(spec)) {
        match PictureFilter::new(gpu, spec, [SIDE; 2], Surface::display(wgpu::TextureFormat::Rgba8Unorm)) {
            Ok(filter) => filters.push((spec, filter)),
            Err(Error::Unsupported(_)) => {}
            Err(error) => return Err(error),
        }
    }
    if filters.is_empty() {
        return Ok(None);
    }
    let baselines = BASELINES.iter().map(|(name, _)| ((*name).to_owned(), true));
    let names: Vec<(String, bool)> = baselines.chain(filters.iter().map(|(spec, _)| (spec.to_string(), false))).collect();
    let mut columns = vec![Vec::new(); names.len()];
    for degrees in 0..DEGREES {
        watch.tick(0, DEGREES)?;
        let pattern = Pattern::of(degrees);
        let (aliased, truth) = (pattern.aliased(), pattern.truth());
        let mut pictures: Vec<Vec<Pixel>> = BASELINES.iter().map(|(_, picture)| picture(&pattern)).collect();
        for (_, filter) in &mut filters {
            pictures.push(filter.apply(&aliased)?);
        }
        for (column, picture) in columns.iter_mut().zip(&pictures) {
            column.push(truth.rms(picture));
        }
    }
    let curves = names.into_iter().zip(columns).map(|((name, baseline), rms)| curve(name, baseline, rms)).collect();
    Ok(Some(EdgeErrors { degrees: (0..DEGREES).collect(), curves }))
}

fn curve(name: String, baseline: bool, rms: Vec<f64>) -> EdgeCurve {
    let over_all = (rms.iter().map(|x| x * x).sum::<f64>() / rms.len() as f64).sqrt();
    EdgeCurve { name, baseline, over_all, rms }
}

fn takes_a_picture(spec: &Spec) -> bool {
    spec.stages.iter().all(|stage| {
        let needs = stage.technique.needs();
        needs.role == Role::Filters(Encoding::Display) && needs.extras == Extras::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn baselines_come_in_order_of_what_they_know() {
        let over_all = |picture: fn(&Pattern) -> Vec<Pixel>| {
            let errors = (0..DEGREES).step_by(3).map(|degrees| {
                let pattern = Pattern::of(degrees);
                pattern.truth().rms(&picture(&pattern))
            });
            curve(String::new(), true, errors.collect()).over_all
        };
        let [none, four, best] = BASELINES.map(|(_, picture)| over_all(picture));
        assert!(none > 0.2 && four < 0.5 * none && best < 0.5 * none, "{none}, {four}, {best}");
    }
}
