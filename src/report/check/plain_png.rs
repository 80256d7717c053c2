//! PNGs that every browser shows as their numbers say, so that their bytes can be taken as they are.

const SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Chunks that leave colours and orientation alone.
const HARMLESS: [&[u8]; 8] = [b"IHDR", b"IDAT", b"IEND", b"sRGB", b"tEXt", b"zTXt", b"iTXt", b"pHYs"];

/// Whether a PNG holds red, green, blue and perhaps alpha in 8 or 16 bits, neither interlaced nor in a colour space of its own.
pub(super) fn is_plain(png: &[u8]) -> bool {
    let Some(mut rest) = png.strip_prefix(SIGNATURE) else { return false };
    if !rest.get(8..21).is_some_and(is_plain_header) {
        return false;
    }
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_be_bytes(*length) as usize;
        // The name, the data, and four bytes of checksum.
        let Some(end) = length.checked_add(8).filter(|end| *end <= after.len()) else { return false };
        if !HARMLESS.contains(&&after[..4]) {
            return false;
        }
        rest = &after[end..];
    }
    rest.is_empty()
}

/// Width and height, then depth, colour type, compression, filters, interlacing.
fn is_plain_header(header: &[u8]) -> bool {
    matches!(header[8..], [8 | 16, 2 | 6, 0, 0, 0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{BitDepth, DisplayPicture};

    fn png() -> Vec<u8> {
        let mut bytes = Vec::new();
        let picture = DisplayPicture::from_fn(3, 2, |x, y| [x as f32 / 3.0, y as f32 / 2.0, 0.5, 1.0]).expect("a size");
        picture.encode_png(&mut bytes, BitDepth::Eight, &[("key", "value")]).expect("encoded");
        bytes
    }

    #[test]
    fn our_own_are_plain() {
        assert!(is_plain(&png()));
    }

    #[test]
    fn palettes_interlacing_colour_spaces_and_stumps_are_not() {
        // In the header: 8 bytes of signature, 8 of length and name, 8 of size, then depth and colour type.
        for (place, value) in [(24, 4), (25, 3), (25, 0), (28, 1)] {
            let mut bytes = png();
            bytes[place] = value;
            assert!(!is_plain(&bytes), "byte {place} as {value}");
        }
        let mut gamma = png();
        gamma.splice(33..33, *b"\0\0\0\x04gAMA\0\0\xb1\x8f\x0b\xfc\x61\x05");
        assert!(!is_plain(&gamma));
        assert!(!is_plain(&png()[..60]) && !is_plain(b"") && !is_plain(b"\xff\xd8\xff"));
    }
}
