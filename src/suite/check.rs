//! The results of `dejag check`, as its `--json` prints them: cases of a manifest, each held against its golden.
//!
//! As in [`super::Results`], whatever depends on the clock stands under a key named `timing`. Paths are relative, with `/`, so that
//! two machines write the same: of goldens to the manifest's folder, of candidates and pictures of differences to the output folder,
//! where the results themselves lie as `check.json`.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{DiffPair, OutcomeCounts, Stamp};

/// Version of the JSON's shape; it rises when a key changes its meaning or goes away.
pub const CHECK_SCHEMA_VERSION: u32 = 1;

/// A whole run, or one shard of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CheckResults {
    /// [`CHECK_SCHEMA_VERSION`].
    pub schema_version: u32,
    /// Version of this crate.
    pub dejag: String,
    /// The command line that makes this run again, without the name of the program, output files and shards.
    pub command: Vec<String>,
    /// BLAKE3 of the manifest, in hexadecimal: results of different manifests are not merged.
    pub manifest: String,
    /// Where the run took place.
    pub environment: Environment,
    /// Which part of the run this is; absent for a whole one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ShardStamp>,
    /// How many pictures came out how.
    pub counts: OutcomeCounts,
    /// Goldens of this environment that no case of the manifest uses, whichever of them were run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unused_goldens: Vec<String>,
    /// In the order of the manifest.
    pub cases: Vec<CheckedCase>,
}

/// Where a run took place. Goldens and tolerances may depend on it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Environment {
    /// The folder below the goldens that is looked into first, such as `llvmpipe-mesa-22.3.6`.
    pub key: String,
    /// Operating system and architecture, such as `linux-x86_64`.
    pub platform: String,
    /// What drew; absent if nothing was drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stamp: Option<Stamp>,
}

/// Which part of a run a shard is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ShardStamp {
    /// From 1.
    pub index: u32,
    /// How many shards there are.
    pub count: u32,
    /// What is dealt, of all shards, in order.
    pub dealt: Vec<String>,
    /// Those of it that are this shard's.
    pub own: Vec<String>,
}

/// A picture of a case, and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CheckedCase {
    /// Unique in the run, with `/`: the case's id, of a sequence followed by the frame, of a folder by the file.
    pub id: String,
    /// The entry of the manifest that it belongs to, which is drawn and dealt to shards as a whole.
    pub entry: String,
    /// What it shows, in a line.
    pub about: String,
    /// The golden that was found; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub golden: Option<Golden>,
    /// BLAKE3 of the candidate's file in hexadecimal; absent if there is no candidate.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub candidate_hash: Option<String>,
    /// Where `bless` puts the candidate, relative to the manifest's folder.
    pub blessed_as: String,
    /// What probably explains a difference that is no change of one's own, in words: another driver, another version.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub likely_causes: Vec<String>,
    /// Outcome, figures, limits. `expected` is the golden, `actual` the candidate.
    #[serde(flatten)]
    pub pair: DiffPair,
    /// Depends on the clock.
    pub timing: CaseTiming,
}

/// What a candidate was held against.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Golden {
    /// The environment whose golden it is: the run's own, or one further down the chain.
    pub environment: String,
    /// BLAKE3 of its file in hexadecimal; absent if it could not be read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// What its file says of its making: adapter, driver, version, command.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub provenance: BTreeMap<String, String>,
}

/// How long a case took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CaseTiming {
    /// Seconds to draw or copy and to compare; of a sequence its share.
    pub seconds: f64,
}
