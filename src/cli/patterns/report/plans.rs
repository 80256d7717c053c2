//! What the chapters show.

use super::super::uses_seed;
use super::chapter::{Plan, Planned};
use super::function::Function;
use super::source::{Source, boxed};
use crate::error::Result;
use crate::sampling::PatternSpec;

/// A sample in the middle of each pixel, then many.
pub(super) fn moire<'a>(checker: Box<dyn Source + 'a>, fence: Box<dyn Source + 'a>) -> Result<Plan<'a>> {
    let pictures = vec![(PatternSpec::parse("regular")?, 1), (PatternSpec::parse("jittered")?, 256)];
    let row = |(source, title): (usize, &str)| Planned { title: title.into(), source, pictures: pictures.clone() };
    Ok(Plan {
        title: "Moire",
        about: "One sample in each pixel's middle makes new patterns of detail that is finer than pixels; 256 jittered ones leave its \
                mean.",
        sources: vec![checker, fence],
        planned: ["checker", "fence"].into_iter().enumerate().map(row).collect(),
    })
}

/// For each pattern a row of the function, another set a pixel, and one of the scene.
pub(super) fn floor<'a>(drawn: Box<dyn Source + 'a>, seed: u32, specs: &[PatternSpec], counts: &[u32]) -> Result<Plan<'a>> {
    let function = Function::new(
        "checker",
        "a checkered floor on the CPU, another set in each pixel; errors of the rows below the horizon",
        seed,
    )?;
    Ok(Plan {
        title: "Floor",
        about: "Squares that shrink below a pixel towards the horizon. Another set in each pixel turns what is missed into noise; the \
                same set in all of them turns it into patterns. Patterns without a seed have one set everywhere.",
        sources: vec![boxed(function), drawn],
        planned: specs.iter().flat_map(|spec| [0, 1].map(|source| Planned::rising(spec, source, counts))).collect(),
    })
}

/// For each pattern a row of another set a pixel, and one of the same set in all, if there is a difference.
pub(super) fn zone_plate(seed: u32, specs: &[PatternSpec], counts: &[u32]) -> Result<Plan<'static>> {
    let fresh =
        Function::new("zone", "0.5 + 0.5 cos(4 pi r^2 / 256) on the CPU, r from the corner; another set in each pixel", seed)?;
    let fixed = Function::new("zone", "the same, one set for all pixels", seed)?.with_one_set();
    let mut planned = Vec::new();
    for spec in specs {
        planned.push(Planned::rising(spec, 0, counts));
        if uses_seed(spec)? {
            planned.push(Planned::rising(spec, 1, counts));
        }
    }
    Ok(Plan {
        title: "Zone plate",
        about: "Frequencies from none in the corner to 4 cycles a pixel, in all directions. Rings around any other place than the \
                corner are aliases.",
        sources: vec![boxed(fresh), boxed(fixed)],
        planned,
    })
}
