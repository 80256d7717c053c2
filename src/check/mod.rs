//! Pictures in CI: a manifest of cases, each drawn or read, held against its golden, accepted or refused. No GPU: what draws is
//! handed in as a [`Drawer`].

mod bless;
mod causes;
mod entry;
mod environment;
mod journal;
mod learn;
mod manifest;
mod merge;
mod run;
mod shard;
mod slot;
#[cfg(test)]
mod tests;
mod tolerance;
mod words;

pub use bless::{Blessing, bless};
pub use entry::{Drawing, Entry, Format, Subject};
pub use environment::{ANY, chain, environment};
pub use journal::Journal;
pub use learn::{Learned, Lesson, learn};
pub use manifest::Manifest;
pub use merge::{folders_of, gather, merge};
pub use run::{Drawer, Run};
pub use shard::{Shard, check_whole};
pub use tolerance::{Override, Tolerance};
