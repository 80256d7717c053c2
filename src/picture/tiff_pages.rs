//! Finds out whether a TIFF holds more than one page, of which decoders would show the first and say nothing.

use super::load::Refusal;
use std::io::{self, Read, Seek, SeekFrom};

/// Refuses a file of several pages; leaves it at its beginning. A damaged directory is left to the decoder to complain of.
pub(super) fn check_single(file: &mut (impl Read + Seek)) -> Result<(), Refusal> {
    let next = next_directory(file);
    file.rewind().map_err(Refusal::Io)?;
    match next {
        Ok(0) => Ok(()),
        Ok(_) => Err(Refusal::Format("it has several pages; save the one you mean as a picture of its own".into())),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(()),
        Err(error) => Err(Refusal::Io(error)),
    }
}

/// Where the second directory stands, 0 if there is none. The first one is a count, its entries, and this offset.
fn next_directory(file: &mut (impl Read + Seek)) -> io::Result<u64> {
    let mut head = [0; 4];
    file.read_exact(&mut head)?;
    let numbers = Numbers { little: head[0] == b'I' };
    // BigTIFF counts in 8 bytes where TIFF does in 2 or 4, and says so in 4 bytes that are always the same.
    let big = head[2] == 43 || head[3] == 43;
    if big {
        file.seek(SeekFrom::Current(4))?;
    }
    let (count_bytes, entry_bytes, offset_bytes) = if big { (8, 20, 8) } else { (2, 12, 4) };
    let first = numbers.read(file, offset_bytes)?;
    file.seek(SeekFrom::Start(first))?;
    let entries = numbers.read(file, count_bytes)?;
    let skipped = entries.checked_mul(entry_bytes).and_then(|bytes| i64::try_from(bytes).ok());
    file.seek(SeekFrom::Current(skipped.ok_or(io::ErrorKind::UnexpectedEof)?))?;
    numbers.read(file, offset_bytes)
}

struct Numbers {
    little: bool,
}

impl Numbers {
    fn read(&self, file: &mut impl Read, bytes: usize) -> io::Result<u64> {
        let mut buffer = [0; 8];
        let digits = &mut buffer[..bytes];
        file.read_exact(digits)?;
        if !self.little {
            digits.reverse();
        }
        Ok(u64::from_le_bytes(buffer))
    }
}
