//! Shards put together again.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::shard::check_whole;
use super::{CheckResults, OutcomeCounts, Results, SequenceResults, ShardStamp};
use crate::{Error, Result};

/// Results that may be of a part of a run.
pub trait Part: Clone {
    /// Which part; none of a whole run.
    fn shard(&self) -> Option<&ShardStamp>;

    /// What the parts of one run share, each with its name.
    fn shared(&self) -> Vec<(&'static str, Value)>;

    /// The whole, of parts that are known to be of one run; `order` is the place of what was dealt.
    #[must_use]
    fn whole(parts: &[&Self], order: &BTreeMap<&str, usize>) -> Self;
}

/// The run that these are the shards of, as if it had been made in one, but for what depends on the clock.
///
/// # Errors
///
/// [`Error::Request`] if a shard is absent or there twice, or if they are not of one run.
pub fn merge<P: Part>(shards: &[(PathBuf, P)]) -> Result<P> {
    let stamp = |(path, part): &'_ (PathBuf, P)| match part.shard() {
        Some(stamp) => Ok((path.to_string_lossy().into_owned(), stamp.clone())),
        None => Err(format!("{} is no shard: it was run without --shard", path.display())),
    };
    let stamps: Vec<(String, ShardStamp)> = shards.iter().map(stamp).collect::<Result<_, _>>().map_err(Error::Request)?;
    let (first_path, first) = &shards[0];
    for (path, other) in shards {
        if let Some(what) = strangeness(first, other) {
            let (a, b) = (first_path.display(), path.display());
            return Err(Error::Request(format!("{a} and {b} are not shards of one run: they differ in {what}")));
        }
    }
    let named: Vec<(&str, &ShardStamp)> = stamps.iter().map(|(name, stamp)| (name.as_str(), stamp)).collect();
    check_whole(&named).map_err(Error::Request)?;
    let order = stamps[0].1.dealt.iter().enumerate().map(|(place, id)| (id.as_str(), place)).collect();
    Ok(P::whole(&shards.iter().map(|(_, part)| part).collect::<Vec<_>>(), &order))
}

/// In what two parts differ that parts of one run do not.
fn strangeness(a: &impl Part, b: &impl Part) -> Option<&'static str> {
    a.shared().into_iter().zip(b.shared()).find(|((_, ours), (_, theirs))| ours != theirs).map(|((what, _), _)| what)
}

/// What a shard has of each id that it was dealt, brought into the order of the whole.
fn in_order<T: Clone>(parts: impl Iterator<Item = (Option<ShardStamp>, Vec<T>)>, order: &BTreeMap<&str, usize>) -> Vec<T> {
    let own = parts.flat_map(|(shard, items)| shard.map(|shard| shard.own).unwrap_or_default().into_iter().zip(items));
    let mut all: Vec<(String, T)> = own.collect();
    all.sort_by_key(|(id, _)| order.get(id.as_str()).copied());
    all.into_iter().map(|(_, item)| item).collect()
}

impl Part for CheckResults {
    fn shard(&self) -> Option<&ShardStamp> {
        self.shard.as_ref()
    }

    fn shared(&self) -> Vec<(&'static str, Value)> {
        vec![
            ("the version of dejag", json!([self.dejag, self.schema_version])),
            ("the manifest", json!(self.manifest)),
            ("the command", json!(self.command)),
            ("the environment", json!(self.environment)),
        ]
    }

    fn whole(parts: &[&Self], order: &BTreeMap<&str, usize>) -> Self {
        let mut cases: Vec<_> = parts.iter().flat_map(|part| part.cases.iter().cloned()).collect();
        cases.sort_by_key(|case| order.get(case.entry.as_str()).copied());
        let counts = OutcomeCounts::of(cases.iter().map(|case| case.pair.outcome));
        Self { shard: None, counts, cases, ..parts[0].clone() }
    }
}

impl Part for Results {
    fn shard(&self) -> Option<&ShardStamp> {
        self.shard.as_ref()
    }

    fn shared(&self) -> Vec<(&'static str, Value)> {
        vec![
            ("the version of dejag", json!([self.stamp.dejag, self.schema_version])),
            ("the command", json!(self.command)),
            ("the driver", json!(self.stamp)),
        ]
    }

    fn whole(parts: &[&Self], order: &BTreeMap<&str, usize>) -> Self {
        let scenes = in_order(parts.iter().map(|part| (part.shard.clone(), part.scenes.clone())), order);
        // Straight edges are no scene: one shard has them.
        let edges = parts.iter().find_map(|part| part.edges.clone());
        Self { shard: None, scenes, edges, ..parts[0].clone() }
    }
}

impl Part for SequenceResults {
    fn shard(&self) -> Option<&ShardStamp> {
        self.shard.as_ref()
    }

    fn shared(&self) -> Vec<(&'static str, Value)> {
        vec![
            ("the version of dejag", json!([self.stamp.dejag, self.schema_version])),
            ("the command", json!(self.command)),
            ("the driver", json!(self.stamp)),
            ("the frames", json!(self.result.frames)),
        ]
    }

    fn whole(parts: &[&Self], order: &BTreeMap<&str, usize>) -> Self {
        let methods = in_order(parts.iter().map(|part| (part.shard.clone(), part.result.methods.clone())), order);
        let mut whole = parts[0].clone();
        whole.shard = None;
        whole.result.methods = methods;
        whole
    }
}
