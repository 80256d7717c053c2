//! Runs in parts, on the command line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};
use crate::suite::{Shard, ShardStamp};

/// Which part of a run.
#[derive(Debug, Args)]
pub(super) struct ShardOptions {
    /// Run the Kth of N parts only; `dejag merge` puts them together
    #[arg(long, value_name = "K/N")]
    pub(super) shard: Option<Shard>,
    /// Results of an earlier run, by whose times parts are levelled; the same for all of them
    #[arg(long, value_name = "FILE", requires = "shard")]
    costs: Option<PathBuf>,
}

/// Results that say how long each thing that is dealt took.
pub(super) trait Costs: DeserializeOwned {
    /// Seconds, by id.
    fn costs(&self) -> Vec<(String, f64)>;
}

impl ShardOptions {
    /// Deals ids, if only a part is run; costs are read as results of the same kind.
    pub(super) fn deal<R: Costs>(&self, ids: &[&str]) -> Result<Option<ShardStamp>> {
        let Some(shard) = self.shard else { return Ok(None) };
        let earlier: Option<R> = self.costs.as_deref().map(read_results).transpose()?;
        let costs = earlier.map(|earlier| {
            let mut costs = BTreeMap::new();
            for (id, seconds) in earlier.costs() {
                *costs.entry(id).or_insert(0.0) += seconds;
            }
            costs
        });
        Ok(Some(shard.deal(ids, costs.as_ref())))
    }
}

/// Whether an id is run in this part.
pub(super) fn is_own(shard: Option<&ShardStamp>, id: &str) -> bool {
    shard.is_none_or(|shard| shard.own.iter().any(|own| own == id))
}

/// Whether a part has nothing to do, and so has done all that was asked of it.
pub(super) fn is_idle(shard: Option<&ShardStamp>) -> bool {
    shard.is_some_and(|shard| shard.own.is_empty())
}

/// Results that an earlier run wrote.
pub(super) fn read_results<R: DeserializeOwned>(path: &Path) -> Result<R> {
    let bytes = std::fs::read(path).map_err(Error::io("read", path))?;
    parse_results(path, &bytes)
}

/// Of a file's bytes.
pub(super) fn parse_results<R: DeserializeOwned>(path: &Path, bytes: &[u8]) -> Result<R> {
    serde_json::from_slice(bytes).map_err(|error| Error::Format {
        path: path.to_path_buf(),
        expected: "result of such a run",
        message: error.to_string(),
    })
}
