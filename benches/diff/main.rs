//! `dejag diff` beside other programs that compare pictures, on the same files in one run:
//! `cargo bench --bench diff --no-default-features --features score,flip-oracle [-- OPTIONS]`; `-- --help` says which.
//!
//! Files are written first, so all are read from memory. Programs take turns, pair by pair, each a process of its own; figures are
//! medians. Then each works off all pairs: `dejag` as two folders in one process, the others a process a pair, as many at once as
//! there are cores.

#![expect(clippy::print_stdout, reason = "its tables are its output")]

mod flip;
mod large;
mod measure;
mod options;
mod pictures;
mod table;
mod tools;

use std::path::Path;

use options::Options;
use pictures::{Kind, Pair};
use table::Row;
use tools::Tool;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let Some(options) = Options::read(std::env::args().skip(1)) else { return Ok(()) };
    let scratch = tempfile::tempdir()?;
    let folder = options.folder.as_deref().unwrap_or(scratch.path());
    let pairs = pictures::write(folder, options.pairs, options.size)?;
    let (tools, absent) = tools::found(&options, scratch.path());
    absent.iter().for_each(|line| println!("{line}"));
    tools.iter().for_each(|tool| println!("{}", tool.version));
    let [width, height] = options.size;
    let cores = std::thread::available_parallelism()?;
    println!("\n{width}x{height}, {} pairs, {cores} cores\n", pairs.len());
    println!("{}", one_by_one(&tools, &pairs[..options.single.min(pairs.len())], scratch.path())?);
    println!("{}", all_at_once(&tools, folder, &pairs)?);
    println!("{}", flip::table(&pairs, &options)?);
    if options.large {
        println!("{}", large::table(scratch.path())?);
    }
    Ok(())
}

/// A process a pair, in turns.
fn one_by_one(tools: &[Tool], pairs: &[Pair], scratch: &Path) -> std::io::Result<String> {
    let mut rows: Vec<Row> = tools.iter().map(|tool| Row::new(&tool.name)).collect();
    for (turn, pair) in pairs.iter().enumerate() {
        for k in 0..tools.len() {
            let index = (turn + k) % tools.len();
            let (times, same) = measure::run(&mut tools[index].command(pair))?;
            rows[index].wrong += usize::from(same != (pair.kind == Kind::Identical));
            rows[index].times.push((pair.kind, times));
        }
    }
    assert_eq!(rows[0].wrong, 0, "{} is wrong", tools[0].name);
    // One of each kind is enough: a program's memory depends on sizes.
    for pair in pairs.iter().take(3) {
        for (row, tool) in rows.iter_mut().zip(tools) {
            row.peak_bytes = row.peak_bytes.max(measure::peak_bytes(&tool.command(pair), scratch)?);
        }
    }
    Ok(table::one_by_one(&rows))
}

/// All pairs on all cores.
fn all_at_once(tools: &[Tool], folder: &Path, pairs: &[Pair]) -> std::io::Result<String> {
    let rows = tools.iter().map(|tool| {
        let seconds = match tool.folders(folder) {
            Some(mut command) => measure::run(&mut command)?.0.wall_s,
            None => measure::seconds_of_all(pairs, |pair| tool.command(pair))?,
        };
        Ok((tool.name.as_str(), seconds))
    });
    Ok(table::all_at_once(&rows.collect::<std::io::Result<Vec<_>>>()?, pairs.len()))
}
