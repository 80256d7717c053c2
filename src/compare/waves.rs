//! How many pairs are compared at once.

use crate::picture::Raster;
use std::path::{Path, PathBuf};

/// Bytes of decoded pictures at once; a larger pair goes alone.
const BYTES_AT_ONCE: u64 = 1 << 30;

/// Pairs at once for each core: more than one, so that no core waits long for the slowest.
const PAIRS_PER_CORE: usize = 8;

/// How many of the first pairs fit into memory together; at least one.
pub fn wave_length<T>(pairs: &[T], paths: impl Fn(&T) -> [&Option<PathBuf>; 2]) -> usize {
    let mut bytes = 0;
    let most = PAIRS_PER_CORE * rayon::current_num_threads();
    let fits = |pair: &&T| {
        bytes += paths(pair).into_iter().flatten().map(|path| bytes_of(path)).sum::<u64>();
        bytes <= BYTES_AT_ONCE
    };
    pairs.iter().take(most).take_while(fits).count().max(1)
}

/// What a picture takes decoded. What cannot be read takes nothing.
fn bytes_of(path: &Path) -> u64 {
    // Opening a pipe would wait for whoever writes into it.
    if path.is_file() { Raster::measure_bytes(path).unwrap_or(0) } else { 0 }
}
