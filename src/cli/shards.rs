//! Runs in parts, on the command line.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::de::DeserializeOwned;

use crate::error::{Error, Result};
use crate::suite::{
    CHECK_SCHEMA_VERSION, CheckResults, Results, SCHEMA_VERSION, SEQUENCE_SCHEMA_VERSION, SequenceMethod, SequenceOutcome,
    SequenceResults, Shard, ShardStamp,
};

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

/// Results of a kind of run.
pub(super) trait Kind: DeserializeOwned {
    /// What they are, in words.
    const WHAT: &str;
    /// The shape that this program reads.
    const VERSION: u32;

    /// The shape that they have.
    fn version(&self) -> u32;

    /// How long each thing that is dealt took, by id; in any unit, seconds if there is more than one of a thing.
    fn costs(&self) -> Vec<(String, f64)>;
}

impl ShardOptions {
    /// Deals ids, if only a part is run; costs are read as results of the same kind.
    pub(super) fn deal<R: Kind>(&self, ids: &[&str]) -> Result<Option<ShardStamp>> {
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
#[cfg(feature = "workbench")]
pub(super) fn is_own(shard: Option<&ShardStamp>, id: &str) -> bool {
    shard.is_none_or(|shard| shard.own.iter().any(|own| own == id))
}

/// Whether a part has nothing to do, and so has done all that was asked of it.
pub(super) fn is_idle(shard: Option<&ShardStamp>) -> bool {
    shard.is_some_and(|shard| shard.own.is_empty())
}

/// Results that an earlier run wrote.
pub(super) fn read_results<R: Kind>(path: &Path) -> Result<R> {
    let results: R = read_json(path, R::WHAT)?;
    if results.version() == R::VERSION {
        return Ok(results);
    }
    let message =
        format!("it has the shape {}, and this program reads {}; make it with this version", results.version(), R::VERSION);
    Err(Error::Format { path: path.to_path_buf(), expected: R::WHAT, message })
}

/// What a file has as JSON; `expected` says what that should be.
pub(super) fn read_json<T: DeserializeOwned>(path: &Path, expected: &'static str) -> Result<T> {
    let bytes = std::fs::read(path).map_err(Error::io("read", path))?;
    let refused = |error: serde_json::Error| Error::Format { path: path.to_path_buf(), expected, message: error.to_string() };
    serde_json::from_slice(&bytes).map_err(refused)
}

impl Kind for CheckResults {
    const WHAT: &str = "result of `dejag check`";
    const VERSION: u32 = CHECK_SCHEMA_VERSION;

    fn version(&self) -> u32 {
        self.schema_version
    }

    fn costs(&self) -> Vec<(String, f64)> {
        self.cases.iter().map(|case| (case.entry.clone(), case.timing.seconds)).collect()
    }
}

impl Kind for Results {
    const WHAT: &str = "result of `dejag score`";
    const VERSION: u32 = SCHEMA_VERSION;

    fn version(&self) -> u32 {
        self.schema_version
    }

    fn costs(&self) -> Vec<(String, f64)> {
        self.scenes.iter().map(|scene| (scene.name.clone(), scene.timing.seconds)).collect()
    }
}

impl Kind for SequenceResults {
    const WHAT: &str = "result of `dejag sequence`";
    const VERSION: u32 = SEQUENCE_SCHEMA_VERSION;

    fn version(&self) -> u32 {
        self.schema_version
    }

    /// By the time of a frame, of which all methods have as many.
    fn costs(&self) -> Vec<(String, f64)> {
        let measured = |method: &SequenceMethod| match &method.outcome {
            SequenceOutcome::Measured(figures) => Some((method.spec.clone(), figures.timing.frame_ms.median)),
            SequenceOutcome::Failed { .. } => None,
        };
        self.result.methods.iter().filter_map(measured).collect()
    }
}
