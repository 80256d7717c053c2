//! Which pixels count.

use crate::picture::Raster;
use crate::{Error, Result};
use std::str::FromStr;

/// A rectangle of pixels, half-open: its right and lower border are outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rectangle {
    /// Column and row of its top left pixel.
    pub start: [u32; 2],
    /// Columns and rows, each at least 1.
    pub size: [u32; 2],
}

impl Rectangle {
    /// Whether it lies inside pictures of that size.
    fn fits(&self, size: [u32; 2]) -> bool {
        (0..2).all(|axis| self.start[axis].checked_add(self.size[axis]).is_some_and(|end| end <= size[axis]))
    }
}

impl FromStr for Rectangle {
    type Err = String;

    /// Reads `X,Y,W,H` in pixels.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<Option<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
        match numbers[..] {
            [Some(x), Some(y), Some(width @ 1..), Some(height @ 1..)] => Ok(Self { start: [x, y], size: [width, height] }),
            _ => Err(format!("'{text}' is no rectangle; write X,Y,W,H in pixels, W and H at least 1")),
        }
    }
}

/// The pixels that count: all, those where a mask is white, and of them those in no ignored rectangle.
#[derive(Debug, Default)]
pub struct Scope {
    mask: Option<Raster>,
    ignored: Vec<Rectangle>,
}

impl Scope {
    /// `mask` counts where its mean of red, green and blue is at least half of white; its alpha is not asked.
    #[must_use]
    pub fn new(mask: Option<Raster>, ignored: Vec<Rectangle>) -> Self {
        Self { mask, ignored }
    }

    /// Whether every pixel counts.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.mask.is_none() && self.ignored.is_empty()
    }

    /// Whether it fits pictures of that size.
    pub(super) fn check(&self, size @ [width, height]: [u32; 2]) -> Result<()> {
        if let Some(mask) = self.mask.as_ref().map(Raster::size).filter(|mask| *mask != size) {
            let [w, h] = mask;
            return Err(Error::Request(format!(
                "the mask is {w}x{h} and the pictures are {width}x{height}; give a mask of their size"
            )));
        }
        match self.ignored.iter().find(|rectangle| !rectangle.fits(size)) {
            Some(Rectangle { start: [x, y], size: [w, h] }) => Err(Error::Request(format!(
                "the region {x},{y},{w},{h} reaches outside a picture of {width}x{height}; name one that lies inside"
            ))),
            None => Ok(()),
        }
    }

    /// For each pixel of a row of `width` pixels whether it counts; none where all do.
    pub(super) fn row(&self, y: u32, width: u32) -> Option<Vec<bool>> {
        if self.is_whole() {
            return None;
        }
        let white = |[r, g, b, _]: [f32; 4]| r + g + b >= 1.5;
        let mut row =
            self.mask.as_ref().map_or_else(|| vec![true; width as usize], |mask| mask.row(y).into_iter().map(white).collect());
        let crossed = self.ignored.iter().filter(|ignored| (ignored.start[1]..ignored.start[1] + ignored.size[1]).contains(&y));
        for Rectangle { start: [x, _], size: [width, _] } in crossed {
            row[*x as usize..(x + width) as usize].fill(false);
        }
        Some(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles() {
        assert_eq!("1, 2,3,4".parse(), Ok(Rectangle { start: [1, 2], size: [3, 4] }));
        for bad in ["", "1,2,3", "1,2,0,4", "1,2,3,0", "-1,2,3,4", "1,2,3,4,5", "a,b,c,d", "1.5,2,3,4"] {
            assert!(bad.parse::<Rectangle>().is_err(), "{bad}");
        }
    }
}
