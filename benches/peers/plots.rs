//! Cost by size and by density of edges, as tables and as plots in `captures/out/`.

use std::fs;
use std::path::Path;

use dejag::error::Error;
use dejag::gpu::Gpu;
use dejag::methods::Spec;
use dejag::report::{LinePlot, Scale, Series};

use crate::contestants::{Line, every_default};
use crate::measure::Row;
use crate::options::Options;
use crate::pictures::{self, Picture};

/// Sides of the squares.
const SIDES: [u32; 5] = [256, 512, 1024, 2048, 4096];

/// Percent of the pixels that are noise.
const DENSITIES: [u32; 8] = [0, 1, 2, 5, 10, 20, 50, 100];

/// The same tiles at every size.
pub(crate) fn by_size(gpu: &Gpu, options: &Options) -> dejag::Result<()> {
    let courtyard = pictures::courtyard(gpu, [1920, 1080])?;
    let measured = sweep(gpu, options, &SIDES, |side| pictures::tiled(&courtyard, side))?;
    println!("\ncost by size: ms for a square of that side, tiles of courtyard\n{}", table(&SIDES, &measured));
    let megapixels = SIDES.map(|side| f64::from(side) * f64::from(side) / 1e6);
    let plot = LinePlot {
        x: ("megapixels (logarithmic)".into(), Scale::Logarithmic),
        y: ("ms (logarithmic)".into(), Scale::Logarithmic),
        series: series(&megapixels, &measured),
    };
    save(&plot, "cost-by-size.svg")
}

/// The same size from flat to nothing but noise.
pub(crate) fn by_density(gpu: &Gpu, options: &Options) -> dejag::Result<()> {
    let measured = sweep(gpu, options, &DENSITIES, |percent| pictures::noise([1280, 720], percent))?;
    println!("\ncost by density: ms at 1280x720 where that percentage of the pixels is noise\n{}", table(&DENSITIES, &measured));
    let plot = LinePlot {
        x: ("percent of the pixels that are noise".into(), Scale::LinearTo(100.0)),
        y: ("ms".into(), Scale::Linear),
        series: series(&DENSITIES.map(f64::from), &measured),
    };
    save(&plot, "cost-by-density.svg")
}

/// Name, whether it is a floor, and the median at each step.
type Measured = Vec<(String, bool, Vec<f64>)>;

fn sweep(gpu: &Gpu, options: &Options, steps: &[u32], picture: impl Fn(u32) -> Picture) -> dejag::Result<Measured> {
    let texts = if options.only.is_empty() { every_default() } else { options.only.clone() };
    let specs = texts.iter().map(|text| Spec::parse(text)).collect::<Result<Vec<_>, _>>()?;
    let mut measured: Measured = Vec::new();
    for step in steps {
        let rows = Line::up(gpu, &specs, &picture(*step))?.measure(gpu, options.rounds)?;
        if measured.is_empty() {
            measured = rows.iter().map(|row| (row.name.clone(), row.is_floor(), Vec::new())).collect();
        }
        for ((_, _, medians), row) in measured.iter_mut().zip(&rows) {
            medians.push(Row::median(row));
        }
    }
    Ok(measured)
}

fn table(steps: &[u32], measured: &Measured) -> String {
    let cells = |cells: Vec<String>| cells.iter().map(|cell| format!(" {cell:>9}")).collect::<String>();
    let mut lines = vec![format!("{:<28}{}", "", cells(steps.iter().map(u32::to_string).collect()))];
    for (name, _, medians) in measured {
        lines.push(format!("{name:<28}{}", cells(medians.iter().map(|ms| format!("{ms:.2}")).collect())));
    }
    lines.join("\n")
}

fn series(x: &[f64], measured: &Measured) -> Vec<Series> {
    let one = |(name, floor, ms): &(String, bool, Vec<f64>)| Series {
        label: name.clone(),
        baseline: *floor,
        points: x.iter().copied().zip(ms.iter().copied()).collect(),
    };
    measured.iter().map(one).collect()
}

fn save(plot: &LinePlot, name: &str) -> dejag::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("captures/out");
    fs::create_dir_all(&folder).map_err(Error::io("create the folder", &folder))?;
    let path = folder.join(name);
    fs::write(&path, plot.svg().unwrap_or_default()).map_err(Error::io("write", &path))?;
    println!("{}", path.display());
    Ok(())
}
