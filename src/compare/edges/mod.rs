//! Tells a resampled edge from a changed object.
//!
//! Anti-aliasing, whatever its pattern and filter, and a shift of less than a pixel put other mixtures of the same colours into the
//! pixels of an edge: every colour is still found nearby, as one of the two sides or as a mixture of them, displaced by about the
//! same vector as its neighbours. A changed object brings a colour that is not found there, or one that is only found further away.
//! So the pictures are taken as surfaces, interpolated bilinearly, and a differing pixel is an edge's if there is one displacement
//! of at most 0.75 pixels for which all nine points of a lattice of half a pixel around it lie in the other picture's hull: the
//! range of colours within 0.56 pixels of the displaced point, a little wider for the overshoot of filters. This must hold both
//! ways, the actual picture explained by the expected one and the other way round: what was added has no explanation in the one
//! direction, what was lost none in the other. A flat place has a hull of one colour, so any change there is an object.
//!
//! The hull is bounded in seven directions (red, green, blue, their differences, their sum) and in alpha, all in the values of the
//! files. Mixtures are straight lines there or in linear light, according to who mixed them: along a single channel both lie
//! between the same ends, and the other directions are left as much room as the two can differ by.
//!
//! What it cannot tell: a change within the hull, such as a pixel that an edge runs through, another colour of what is thinner than
//! a pixel, or a step in a smooth gradient that moving it by a pixel would also make. What is thinner than about a pixel and a half
//! counts as an object when it moves: one of its pictures has peaks that the other has lost. `docs/diff.md` has how often it is right.
//!
//! Cost: some milliseconds for each tile of 32 x 32 pixels that holds a difference.

mod hull;
mod patch;
mod regions;
#[cfg(test)]
mod tests;

use self::hull::{Hull, WINDOW};
use self::patch::{MARGIN, Patch};
use super::sides::Sides;
use crate::suite::ClassFigures;
use rayon::prelude::*;

/// Part of results: figures of another version must not be compared.
const CLASSIFIER: &str = "edge-hull/1";

/// Side of a tile in pixels.
const TILE: u32 = 32;

/// Which differing pixels belong to changed objects.
#[derive(Debug)]
pub(super) struct Classes {
    pub(super) figures: ClassFigures,
    width: u32,
    /// For each pixel in reading order whether it is an object's.
    objects: Vec<bool>,
}

impl Classes {
    /// Whether a differing pixel is an object's, not an edge's.
    pub(super) fn is_object(&self, x: u32, y: u32) -> bool {
        self.objects[y as usize * self.width as usize + x as usize]
    }
}

/// Classes of all pixels that count and differ by more than `per_channel`.
pub(super) fn classify(sides: &Sides<'_>, per_channel: f64) -> Classes {
    let [width, height] = sides.size();
    let mut objects = vec![false; width as usize * height as usize];
    let bands = objects.par_chunks_mut((width * TILE) as usize).enumerate();
    let edge_pixels = bands.map(|(band, objects)| Band { sides, top: band as u32 * TILE }.classify(per_channel, objects)).sum();
    let object_pixels = objects.iter().filter(|object| **object).count() as u64;
    let (object_count, largest) = regions::of(&objects, width);
    let figures =
        ClassFigures { classifier: CLASSIFIER.into(), edge_pixels, object_pixels, object_count, largest_objects: largest };
    Classes { figures, width, objects }
}

/// The tiles beside each other from one row on.
struct Band<'a> {
    sides: &'a Sides<'a>,
    top: u32,
}

impl Band<'_> {
    /// Marks the objects' pixels, given the band's part of all; how many others are edges'.
    fn classify(&self, per_channel: f64, objects: &mut [bool]) -> u64 {
        let [width, height] = self.sides.size();
        let tiles = width.div_ceil(TILE) as usize;
        let mut differing: Vec<Vec<[u32; 2]>> = vec![Vec::new(); tiles];
        for y in self.top..height.min(self.top + TILE) {
            self.sides.differing_in_row(y, |gap| {
                if gap.largest > per_channel {
                    differing[gap.x / TILE as usize].push([gap.x as u32, y]);
                }
            });
        }
        let mut edges = 0;
        for (tile, pixels) in differing.iter().enumerate().filter(|(_, pixels)| !pixels.is_empty()) {
            let rest = self.unexplained([tile as u32 * TILE, self.top], pixels);
            edges += (pixels.len() - rest.len()) as u64;
            for [x, y] in rest {
                objects[(y - self.top) as usize * width as usize + x as usize] = true;
            }
        }
        edges
    }

    /// Those of a tile's pixels that the other picture does not explain, either way.
    fn unexplained(&self, corner: [u32; 2], pixels: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let hull = |side| Hull::of(&Patch::around(side, corner, TILE));
        let [expected, actual] = [self.sides.expected, self.sides.actual].map(hull);
        let is_explained = |[x, y]: [u32; 2]| {
            let at = [x - corner[0] + MARGIN, y - corner[1] + MARGIN];
            let tolerance = hull::tolerance(&expected, &actual, at);
            expected.explains(&actual, at, &tolerance) && actual.explains(&expected, at, &tolerance)
        };
        pixels.iter().copied().filter(|pixel| !is_explained(*pixel)).collect()
    }
}

const _: () = assert!(WINDOW < MARGIN as i32 * hull::GRID, "the window lies inside the patch");
