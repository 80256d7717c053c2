//! Pictures written as they are made, row by row, for those that are too large to be held.

use super::integers::level;
use super::save::png_failure;
use super::{Pixel, write_atomically};
use crate::Result;
use std::io::Write;
use std::path::Path;

/// Writes a PNG of 8 bits, RGB, marked as sRGB, whole or not at all. `row` makes each row of display values, from the top; its
/// alpha is dropped.
///
/// # Errors
///
/// [`crate::Error::Io`] if it cannot be written; nothing is left behind then.
///
/// # Panics
///
/// If a row has not `width` pixels.
pub fn write_png_rows(path: &Path, [width, height]: [u32; 2], mut row: impl FnMut(u32) -> Vec<Pixel>) -> Result<()> {
    write_atomically(path, |file| {
        let mut encoder = png::Encoder::new(file, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        let mut writer = encoder.write_header().map_err(png_failure)?;
        let mut stream = writer.stream_writer().map_err(png_failure)?;
        for y in 0..height {
            let row = row(y);
            assert_eq!(row.len(), width as usize, "row {y}");
            stream.write_all(&bytes(&row))?;
        }
        stream.finish().map_err(png_failure)?;
        writer.finish().map_err(png_failure)
    })
}

fn bytes(row: &[Pixel]) -> Vec<u8> {
    row.iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).map(|value| level(value, 255) as u8).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{DisplayPicture, load};

    #[test]
    fn rows_come_back_as_they_were_made() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("rows.png");
        let picture = DisplayPicture::from_fn(300, 200, |x, y| [x as f32 / 299.0, y as f32 / 199.0, 0.5, 1.0]).expect("a size");
        write_png_rows(&path, picture.size(), |y| picture.rows().nth(y as usize).expect("a row").to_vec()).expect("written");
        assert_eq!(load(&path).expect("a picture").into_display().to_rgba8(), picture.to_rgba8());
    }
}
