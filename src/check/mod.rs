//! Pictures in CI: a manifest of cases, each drawn or read, held against its golden, accepted or refused. No GPU: what draws is
//! handed in as a [`Drawer`].

mod bless;
mod candidate;
mod causes;
mod document;
mod entry;
mod environment;
mod gather;
mod journal;
mod judge;
mod learn;
mod manifest;
mod run;
mod slot;
#[cfg(test)]
mod tests;
mod tolerance;
mod unused;
mod words;

pub use bless::{Bless, Blessing};
pub use entry::{Drawing, Entry, Format, Subject};
pub use environment::{ANY, chain, check_key, environment};
pub use gather::{folders_of, gather};
pub use journal::Journal;
pub use learn::{Learned, Lesson, learn};
pub use manifest::Manifest;
pub use run::{Drawer, Run};
pub use tolerance::{Override, Tolerance};
