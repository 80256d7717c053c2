//! Marked pixels that touch each other, as regions.

use crate::suite::ChangedObject;

/// Regions that are listed.
const LISTED: usize = 10;

/// A region that may go on in the next row.
#[derive(Debug, Clone, Copy)]
struct Region {
    /// Left, top, right, bottom, the last two outside.
    bounds: [u32; 4],
    pixels: u64,
}

/// Marked pixels beside each other.
#[derive(Debug, Clone, Copy)]
struct Run {
    start: u32,
    end: u32,
    region: usize,
}

/// How many regions there are, pixels touching diagonally too, and the largest of them; of equals the one that ends first.
pub(super) fn of(marked: &[bool], width: u32) -> (u64, Vec<ChangedObject>) {
    let mut found = Found::default();
    let (mut above, mut open): (Vec<Run>, Vec<Region>) = (Vec::new(), Vec::new());
    for (y, row) in marked.chunks_exact(width as usize).enumerate() {
        let mut runs = runs_of(row);
        let mut regions = Merging::new(open);
        for run in &mut runs {
            run.region = regions.add(*run, y as u32, &above);
        }
        open = regions.settle(&mut runs, &mut found);
        above = runs;
    }
    open.into_iter().for_each(|region| found.close(region));
    (found.count, found.largest)
}

fn runs_of(row: &[bool]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for x in row.iter().enumerate().filter_map(|(x, marked)| marked.then_some(x as u32)) {
        match runs.last_mut() {
            Some(run) if run.end == x => run.end += 1,
            _ => runs.push(Run { start: x, end: x + 1, region: 0 }),
        }
    }
    runs
}

/// The regions of the row above, to which those of this row are added.
struct Merging {
    regions: Vec<Region>,
    /// What a region was merged into, itself if into none.
    into: Vec<usize>,
}

impl Merging {
    fn new(regions: Vec<Region>) -> Self {
        Self { into: (0..regions.len()).collect(), regions }
    }

    fn root(&self, mut region: usize) -> usize {
        while self.into[region] != region {
            region = self.into[region];
        }
        region
    }

    /// Adds a run to the regions above that it touches, which become one.
    fn add(&mut self, run: Run, y: u32, above: &[Run]) -> usize {
        let own = self.regions.len();
        let bounds = [run.start, y, run.end, y + 1];
        self.regions.push(Region { bounds, pixels: u64::from(run.end - run.start) });
        self.into.push(own);
        let first = above.partition_point(|other| other.end < run.start);
        for other in above[first..].iter().take_while(|other| other.start <= run.end) {
            let old = self.root(other.region);
            let new = self.root(own);
            if old != new {
                self.regions[new] = self.regions[new].with(&self.regions[old]);
                self.into[old] = new;
            }
        }
        own
    }

    /// Closes the regions that this row does not touch; the others, to which its runs point now.
    fn settle(self, runs: &mut [Run], found: &mut Found) -> Vec<Region> {
        let mut kept: Vec<Option<usize>> = vec![None; self.regions.len()];
        let mut open = Vec::new();
        for run in runs {
            let root = self.root(run.region);
            run.region = *kept[root].get_or_insert_with(|| {
                open.push(self.regions[root]);
                open.len() - 1
            });
        }
        for (region, _) in kept.iter().enumerate().filter(|(region, kept)| self.into[*region] == *region && kept.is_none()) {
            found.close(self.regions[region]);
        }
        open
    }
}

impl Region {
    fn with(&self, other: &Self) -> Self {
        let ([left, top, right, bottom], [l, t, r, b]) = (self.bounds, other.bounds);
        Self { bounds: [left.min(l), top.min(t), right.max(r), bottom.max(b)], pixels: self.pixels + other.pixels }
    }
}

#[derive(Default)]
struct Found {
    count: u64,
    largest: Vec<ChangedObject>,
}

impl Found {
    fn close(&mut self, Region { bounds: [left, top, right, bottom], pixels }: Region) {
        self.count += 1;
        let place = self.largest.partition_point(|other| other.pixels >= pixels);
        self.largest.insert(place, ChangedObject { bounds: [left, top, right - left, bottom - top], pixels });
        self.largest.truncate(LISTED);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn regions(picture: &[&str]) -> (u64, Vec<([u32; 4], u64)>) {
        let marked: Vec<bool> = picture.iter().flat_map(|row| row.bytes().map(|byte| byte == b'#')).collect();
        let (count, largest) = of(&marked, picture[0].len() as u32);
        (count, largest.into_iter().map(|object| (object.bounds, object.pixels)).collect())
    }

    #[test]
    fn what_touches_is_one_diagonally_too() {
        assert_eq!(regions(&["....", "...."]), (0, vec![]));
        assert_eq!(regions(&["#...", ".#..", "..#."]), (1, vec![([0, 0, 3, 3], 3)]));
        assert_eq!(regions(&["##.#", "...#"]), (2, vec![([0, 0, 2, 1], 2), ([3, 0, 1, 2], 2)]));
    }

    #[test]
    fn branches_join_from_below() {
        assert_eq!(regions(&["#.#.#", "#.#.#", "#####"]), (1, vec![([0, 0, 5, 3], 11)]));
        assert_eq!(regions(&["#...#", "#.#.#", "#.#.#", "##.##"]), (1, vec![([0, 0, 5, 4], 12)]));
    }

    #[test]
    fn only_the_largest_are_listed() {
        let row = "#.".repeat(15) + "##";
        let (count, largest) = regions(&[&row]);
        assert_eq!((count, largest.len(), largest[0].1), (16, 10, 2));
    }
}
