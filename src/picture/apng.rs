//! Animations: display pictures one after another, in a PNG that browsers play.

use super::atomic::Staged;
use super::save::png_failure;
use super::{DisplayPicture, MAX_SIDE};
use crate::{Error, Result};
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// An animated PNG that is written a frame at a time, loops, and appears whole or not at all: dropped unfinished, it leaves nothing.
pub struct Apng {
    writer: png::Writer<BufWriter<File>>,
    staged: Staged,
    size: [u32; 2],
}

impl std::fmt::Debug for Apng {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Apng({}x{}, {})", self.size[0], self.size[1], self.staged.target().display())
    }
}

impl Apng {
    /// Begins an animation of so many frames of one size, each shown for `frame_s` seconds, RGB of 8 bits.
    ///
    /// # Errors
    ///
    /// [`Error::Request`] for no frames or sides beyond [`MAX_SIDE`]; [`Error::Io`] if it cannot be written.
    pub fn begin(path: &Path, size: [u32; 2], frames: u32, frame_s: f64) -> Result<Self> {
        if frames == 0 || size.contains(&0) || size.iter().any(|side| *side > MAX_SIDE) {
            let [width, height] = size;
            return Err(Error::Request(format!(
                "an animation of {frames} frames of {width}x{height} cannot be written; sides are at most {MAX_SIDE}"
            )));
        }
        let staged = Staged::begin(path)?;
        let mut encoder = png::Encoder::new(staged.writer()?, size[0], size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        encoder.validate_sequence(true);
        let [numerator, denominator] = delay(frame_s);
        let begun = encoder
            .set_animated(frames, 0)
            .and_then(|()| encoder.set_frame_delay(numerator, denominator))
            .and_then(|()| encoder.write_header());
        let writer = begun.map_err(|error| Error::io("write", path)(png_failure(error)))?;
        Ok(Self { writer, staged, size })
    }

    /// Writes the next frame.
    ///
    /// # Errors
    ///
    /// [`Error::SizeMismatch`] for another size; [`Error::Io`] if it cannot be written.
    pub fn add(&mut self, frame: &DisplayPicture) -> Result<()> {
        if frame.size() != self.size {
            return Err(Error::SizeMismatch(self.size, frame.size()));
        }
        let rgb: Vec<u8> = frame.to_rgba8().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        self.writer.write_image_data(&rgb).map_err(|error| self.failure(error))
    }

    /// Ends the animation and gives the file its name.
    ///
    /// # Errors
    ///
    /// [`Error::Io`] if it cannot be written, or if frames are missing.
    pub fn finish(self) -> Result<()> {
        let Self { writer, staged, .. } = self;
        writer.finish().map_err(|error| Error::io("write", staged.target())(png_failure(error)))?;
        staged.publish()
    }

    fn failure(&self, error: png::EncodingError) -> Error {
        Error::io("write", self.staged.target())(png_failure(error))
    }
}

/// A frame's time as a fraction of a second: one over a whole number where that is it, else milliseconds.
fn delay(frame_s: f64) -> [u16; 2] {
    let rate = (1.0 / frame_s).round();
    if (1.0..=1000.0).contains(&rate) && (rate * frame_s - 1.0).abs() < 1e-3 {
        return [1, rate as u16];
    }
    [(frame_s * 1000.0).round().clamp(1.0, 65_535.0) as u16, 1000]
}

/// Pictures of one height in a row, with a dark gap between them.
///
/// # Errors
///
/// [`Error::Request`] for no pictures, [`Error::SizeMismatch`] for different heights.
pub fn side_by_side(pictures: &[&DisplayPicture], gap_px: u32) -> Result<DisplayPicture> {
    const GAP: super::Pixel = [0.1, 0.1, 0.1, 1.0];
    let Some(first) = pictures.first() else {
        return Err(Error::Request("no pictures to put side by side".into()));
    };
    if let Some(other) = pictures.iter().find(|picture| picture.height() != first.height()) {
        return Err(Error::SizeMismatch(first.size(), other.size()));
    }
    let mut pixels = Vec::new();
    for y in 0..first.height() as usize {
        for (k, picture) in pictures.iter().enumerate() {
            let gap = if k == 0 { 0 } else { gap_px as usize };
            pixels.extend(std::iter::repeat_n(GAP, gap));
            pixels.extend(picture.rows().nth(y).unwrap_or_default());
        }
    }
    DisplayPicture::new((pixels.len() / first.height() as usize) as u32, first.height(), pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(size: [u32; 2], level: f32) -> DisplayPicture {
        DisplayPicture::from_fn(size[0], size[1], |_, _| [level, level, level, 1.0]).expect("a size")
    }

    #[test]
    fn frames_come_back_in_order_and_time() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        let mut animation = Apng::begin(&path, [5, 3], 3, 1.0 / 60.0).expect("begun");
        for level in [0.0, 0.2, 1.0] {
            animation.add(&grey([5, 3], level)).expect("written");
        }
        assert!(!path.exists());
        assert!(matches!(animation.add(&grey([3, 5], 0.0)), Err(Error::SizeMismatch(..))));
        animation.finish().expect("published");

        let mut reader =
            png::Decoder::new(std::io::BufReader::new(File::open(&path).expect("there"))).read_info().expect("a PNG");
        let control = *reader.info().animation_control().expect("animated");
        assert_eq!((control.num_frames, control.num_plays), (3, 0));
        for level in [0, 51, 255] {
            let mut bytes = vec![0; 5 * 3 * 3];
            reader.next_frame(&mut bytes).expect("a frame");
            assert!(bytes.iter().all(|byte| *byte == level), "{bytes:?}");
            let frame = reader.info().frame_control().expect("a frame's own");
            assert_eq!((frame.delay_num, frame.delay_den), (1, 60));
        }
    }

    #[test]
    fn what_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        let mut animation = Apng::begin(&path, [2, 2], 2, 0.1).expect("begun");
        animation.add(&grey([2, 2], 0.5)).expect("written");
        assert!(animation.finish().is_err(), "a frame is missing");
        drop(Apng::begin(&path, [2, 2], 2, 0.1).expect("begun"));
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
        assert!(Apng::begin(&path, [2, 2], 0, 0.1).is_err());
        assert!(Apng::begin(&path, [0, 2], 1, 0.1).is_err());
    }

    #[test]
    fn times_are_fractions() {
        for (seconds, fraction) in
            [(1.0 / 60.0, [1, 60]), (0.5, [1, 2]), (0.3, [300, 1000]), (1e-9, [1, 1000]), (1e9, [65_535, 1000])]
        {
            assert_eq!(delay(seconds), fraction, "{seconds}");
        }
    }

    #[test]
    fn a_row_has_gaps_between_but_not_around() {
        let row = side_by_side(&[&grey([2, 3], 0.0), &grey([1, 3], 1.0)], 4).expect("of one height");
        assert_eq!(row.size(), [7, 3]);
        let levels: Vec<f32> = (0..7).map(|x| row.pixel(x, 1)[0]).collect();
        assert_eq!(levels, [0.0, 0.0, 0.1, 0.1, 0.1, 0.1, 1.0]);
        assert!(side_by_side(&[&grey([2, 3], 0.0), &grey([2, 2], 0.0)], 0).is_err());
        assert!(side_by_side(&[], 0).is_err());
    }
}
