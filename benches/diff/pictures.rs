//! Pairs of pictures as a renderer might have made them: gradients, shaded discs with anti-aliased edges, noise. The same every time.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

/// How far the two pictures of a pair differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Not at all; the files are equal byte for byte, as those of a renderer that did not change are.
    Identical,
    /// By one level, in 12x12 pixels.
    Slight,
    /// In most pixels: another exposure, and discs elsewhere.
    Large,
}

pub(crate) const KINDS: [Kind; 3] = [Kind::Identical, Kind::Slight, Kind::Large];

/// Two files.
#[derive(Debug, Clone)]
pub(crate) struct Pair {
    pub(crate) expected: PathBuf,
    pub(crate) actual: PathBuf,
    pub(crate) kind: Kind,
}

/// Writes `expected/` and `actual/` into the folder, kinds by turns. They must not be there yet: what lay in them would be compared, too.
pub(crate) fn write(folder: &Path, count: usize, size: [u32; 2]) -> io::Result<Vec<Pair>> {
    fs::create_dir_all(folder)?;
    for side in ["expected", "actual"] {
        fs::create_dir(folder.join(side))?;
    }
    let pairs: Vec<Pair> = (0..count).map(|index| pair(folder, index)).collect();
    pairs.par_iter().enumerate().try_for_each(|(index, pair)| {
        let scene = Scene::of(index as u64, size);
        scene.save(&pair.expected)?;
        match pair.kind {
            Kind::Identical => fs::copy(&pair.expected, &pair.actual).map(drop),
            Kind::Slight => scene.patched().save(&pair.actual),
            Kind::Large => scene.relit().save(&pair.actual),
        }
    })?;
    Ok(pairs)
}

fn pair(folder: &Path, index: usize) -> Pair {
    let path = |side: &str| folder.join(side).join(format!("{index:03}.png"));
    Pair { expected: path("expected"), actual: path("actual"), kind: KINDS[index % KINDS.len()] }
}

/// What is drawn.
pub(crate) struct Scene {
    seed: u64,
    size: [u32; 2],
    discs: Vec<Disc>,
    exposure: f32,
    /// Whether a few pixels are a level brighter.
    patch: bool,
}

#[derive(Clone, Copy)]
struct Disc {
    centre: [f32; 2],
    radius: f32,
    colour: [f32; 3],
}

impl Scene {
    pub(crate) fn of(seed: u64, size: [u32; 2]) -> Self {
        let [width, height] = size.map(|side| side as f32);
        let discs = (0..24).map(|k| {
            let random = |channel: u64| unit(seed << 16 | k << 4 | channel);
            Disc {
                centre: [width * random(0), height * random(1)],
                radius: height * (0.02 + 0.15 * random(2)),
                colour: [random(3), random(4), random(5)],
            }
        });
        Self { seed, size, discs: discs.collect(), exposure: 1.0, patch: false }
    }

    pub(crate) fn patched(self) -> Self {
        Self { patch: true, ..self }
    }

    fn relit(&self) -> Self {
        let moved = |disc: &Disc| Disc { centre: disc.centre.map(|x| x + 2.5), ..*disc };
        Self { discs: self.discs.iter().map(moved).collect(), exposure: 0.97, ..*self }
    }

    pub(crate) fn save(&self, path: &Path) -> io::Result<()> {
        let [width, height] = self.size;
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        let mut stream = writer.stream_writer()?;
        for y in 0..height {
            let row: Vec<u8> = (0..width).flat_map(|x| self.pixel(x, y)).collect();
            io::Write::write_all(&mut stream, &row)?;
        }
        stream.finish()?;
        Ok(())
    }

    fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let [width, height] = self.size.map(|side| side as f32);
        let (u, v) = (x as f32 / width, y as f32 / height);
        let mut colour = [0.25 + 0.5 * v, 0.35 + 0.3 * u, 0.8 - 0.4 * v];
        for disc in &self.discs {
            disc.over(&mut colour, [x as f32 + 0.5, y as f32 + 0.5]);
        }
        // The lower third is rough, as grass or gravel is.
        let noise = if v > 0.66 { 0.08 * (unit(self.seed << 48 | u64::from(y) << 24 | u64::from(x)) - 0.5) } else { 0.0 };
        let patch = u8::from(self.patch && (40..52).contains(&x) && (40..52).contains(&y));
        colour.map(|value| (255.0 * (self.exposure * (value + noise)).clamp(0.0, 0.99)) as u8 + patch)
    }
}

impl Disc {
    /// Lit from the left, its edge a pixel wide.
    fn over(&self, colour: &mut [f32; 3], [x, y]: [f32; 2]) {
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        if dx.abs().max(dy.abs()) > self.radius + 1.0 {
            return;
        }
        let coverage = (self.radius - dx.hypot(dy) + 0.5).clamp(0.0, 1.0);
        let light = 0.7 - 0.3 * dx / self.radius;
        for (value, own) in colour.iter_mut().zip(self.colour) {
            *value += coverage * (light * own - *value);
        }
    }
}

/// A number in [0, 1) that looks random, of a counter (splitmix64).
fn unit(counter: u64) -> f32 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
}
