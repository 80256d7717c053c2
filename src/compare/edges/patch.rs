//! A tile of a picture with what lies around it.

use crate::picture::{Channels, Pixel, Raster};

/// Pixels around a tile that are looked at: the radius of the contrast.
pub(super) const MARGIN: u32 = 3;

/// Pixels around and in a tile, the border's repeated outside the picture, colours weighted by alpha.
#[derive(Debug)]
pub(super) struct Patch {
    pub(super) side: usize,
    pixels: Vec<Pixel>,
}

impl Patch {
    /// Of the tile of `tile` x `tile` pixels whose first is `corner`.
    pub(super) fn around(raster: &Raster, corner: [u32; 2], tile: u32) -> Self {
        let side = tile + 2 * MARGIN;
        let [width, height] = raster.size();
        let inside = |start: u32, offset: u32, length: u32| (start + offset).saturating_sub(MARGIN).min(length - 1);
        let straight = raster.has_alpha() && !matches!(raster.channels(), Channels::Float(_));
        let weighted = |[r, g, b, a]: Pixel| if straight { [r * a, g * a, b * a, a] } else { [r, g, b, a] };
        let mut pixels = Vec::with_capacity((side * side) as usize);
        for j in 0..side {
            let y = inside(corner[1], j, height);
            pixels.extend((0..side).map(|i| weighted(raster.pixel([inside(corner[0], i, width), y]))));
        }
        Self { side: side as usize, pixels }
    }

    /// A pixel in the values of its file.
    pub(super) fn pixel(&self, x: usize, y: usize) -> Pixel {
        self.pixels[y * self.side + x]
    }
}
