//! A chapter of the report: its pictures made and measured in turn.

use super::super::super::watch::{Bar, check_interrupt};
use super::source::{Sampled, Source};
use crate::error::Result;
use crate::picture::DisplayPicture;
use crate::report::{DETAIL_PX, SeriesPicture, SeriesReport};
use crate::sampling::PatternSpec;
use crate::suite::{Chapter, SampledPicture, Series, Subject};

/// What a chapter is to show.
pub(super) struct Plan<'a> {
    pub(super) title: &'a str,
    pub(super) about: &'a str,
    pub(super) sources: Vec<Box<dyn Source + 'a>>,
    pub(super) planned: Vec<Planned>,
}

/// A row of pictures.
#[derive(Debug, Clone)]
pub(super) struct Planned {
    pub(super) title: String,
    /// Of the chapter's sources.
    pub(super) source: usize,
    /// Which pattern, and how many samples of it.
    pub(super) pictures: Vec<(PatternSpec, u32)>,
}

impl Planned {
    /// A row of so many samples of a pattern each.
    pub(super) fn rising(spec: &PatternSpec, source: usize, counts: &[u32]) -> Self {
        let pictures = counts.iter().map(|&spp| (spec.clone(), spp)).collect();
        Self { title: spec.to_string(), source, pictures }
    }
}

/// A source's exact picture, and which part of it the first of its samples get worst.
struct Known {
    exact: DisplayPicture,
    detail: Option<[u32; 2]>,
}

impl Plan<'_> {
    /// In samples a pixel.
    pub(super) fn work(&self) -> u64 {
        let sampled = self.planned.iter().flat_map(|row| &row.pictures).map(|(_, spp)| u64::from(*spp));
        self.sources.iter().map(|source| source.work()).chain(sampled).sum()
    }

    /// Makes all pictures and hands each to the report as soon as it is there.
    pub(super) fn carry_out(mut self, number: usize, report: &SeriesReport, bar: &mut Bar) -> Result<Chapter> {
        let mut known = Vec::new();
        for (subject, source) in self.sources.iter_mut().enumerate() {
            bar.say(format!("{}, exact", source.name()));
            let exact = source.exact(bar)?;
            report.add(number, SeriesPicture::Exact { subject }, &exact)?;
            bar.advance(source.work());
            known.push(Known { exact, detail: None });
        }
        let mut series = Vec::new();
        for (place, planned) in self.planned.iter().enumerate() {
            let (source, known) = (&mut self.sources[planned.source], &mut known[planned.source]);
            let keep =
                |picture, shown: &DisplayPicture| report.add(number, SeriesPicture::Sampled { series: place, picture }, shown);
            let pictures = planned.carry_out(source.as_mut(), known, keep, bar)?;
            series.push(Series { title: planned.title.clone(), subject: planned.source, pictures });
        }
        let subject = |source: &dyn Source, known: &Known| Subject {
            name: source.name(),
            about: source.about(),
            exact: source.known_by(),
            size: known.exact.size(),
            detail: known.detail.unwrap_or_default(),
        };
        let subjects = self.sources.iter().zip(&known).map(|(source, known)| subject(source.as_ref(), known)).collect();
        Ok(Chapter { title: self.title.into(), about: self.about.into(), subjects, series })
    }
}

impl Planned {
    fn carry_out(
        &self,
        source: &mut dyn Source,
        known: &mut Known,
        keep: impl Fn(usize, &DisplayPicture) -> Result<()>,
        bar: &mut Bar,
    ) -> Result<Vec<SampledPicture>> {
        let mut pictures = Vec::new();
        for (spec, spp) in &self.pictures {
            bar.say(format!("{}, {spec}, {spp}", source.name()));
            let Sampled { picture, sets, rms } = source.sampled(spec, *spp, bar)?;
            check_interrupt()?;
            keep(pictures.len(), &picture)?;
            known.detail.get_or_insert_with(|| worst_part(&known.exact, &picture));
            pictures.push(SampledPicture { pattern: spec.to_string(), sets: sets.into(), spp: *spp, rms });
            bar.advance(u64::from(*spp));
        }
        Ok(pictures)
    }
}

/// Where a square of [`DETAIL_PX`] has the largest squared error, to a quarter of its side.
fn worst_part(exact: &DisplayPicture, found: &DisplayPicture) -> [u32; 2] {
    let [width, height] = exact.size();
    let error = |x: u32, y: u32| (0..3).map(|k| f64::from(found.pixel(x, y)[k] - exact.pixel(x, y)[k]).powi(2)).sum::<f64>();
    let squares = |[left, top]: [u32; 2]| -> f64 {
        let rows = top..(top + DETAIL_PX).min(height);
        rows.flat_map(|y| (left..(left + DETAIL_PX).min(width)).map(move |x| (x, y))).map(|(x, y)| error(x, y)).sum()
    };
    let places = |side: u32| (0..=side.saturating_sub(DETAIL_PX)).step_by(DETAIL_PX as usize / 4);
    let corners = places(height).flat_map(|top| places(width).map(move |left| [left, top]));
    let measured = corners.map(|corner| (squares(corner), corner));
    // Of equals the first.
    measured.reduce(|best, next| if next.0 > best.0 { next } else { best }).map_or([0, 0], |(_, corner)| corner)
}
