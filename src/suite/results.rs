//! The results of `dejag score`, as its `--json` prints them.
//!
//! Whatever depends on the clock stands under a key named `timing`, everything else is the same for the same command on the
//! same machine, byte for byte.

use serde::{Deserialize, Serialize};

use super::{EdgeErrors, ShardStamp};
use crate::metrics::Figure;
use crate::picture::NonFinite;

/// Version of the JSON's shape; it rises when a key changes its meaning or goes away.
pub const SCHEMA_VERSION: u32 = 1;

/// A whole run: scenes by methods.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`SCHEMA_VERSION`].
    pub schema_version: u32,
    /// What drew the pictures.
    pub stamp: Stamp,
    /// The command line that makes this run again, without the name of the program.
    pub command: Vec<String>,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Which part of the run this is; absent of a whole one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ShardStamp>,
    /// One entry a scene, in the order asked for.
    pub scenes: Vec<SceneResult>,
    /// Filters on straight edges; absent if the run has no filter that takes a picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edges: Option<EdgeErrors>,
}

/// What drew a picture: results are comparable only between equal stamps.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stamp {
    /// Version of this crate.
    pub dejag: String,
    /// The adapter's name.
    pub adapter: String,
    /// `discrete`, `integrated`, `software`, `virtual` or `other`.
    pub kind: String,
    /// The driver's name.
    pub driver: String,
    /// The driver's version, as it states it.
    pub driver_version: String,
    /// `vulkan`, `metal` or `dx12`.
    pub backend: String,
}

/// One scene against its reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneResult {
    /// The scene's name.
    pub name: String,
    /// What it tests, in a line.
    pub about: String,
    /// The frame that was captured, from 0.
    pub frame: u32,
    /// The picture everything is held against.
    pub reference: ReferenceResult,
    /// One entry a method, in the order asked for.
    pub methods: Vec<MethodResult>,
    /// Depends on the clock.
    #[serde(default)]
    pub timing: SceneTiming,
}

/// How long a scene took.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneTiming {
    /// Seconds for its reference and all methods.
    pub seconds: f64,
}

/// The reference and its own error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReferenceResult {
    /// The method it was made with (`ssaa:spp=2500,...`), or `analytic`.
    pub spec: String,
    /// How much two halves of its samples differ; absent for an analytic reference.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise_floor: Option<NoiseFloor>,
    /// Its distance to the exact answer, where the scene has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub analytic: Option<AnalyticDistance>,
    /// Depends on the clock and the cache.
    pub timing: ReferenceTiming,
}

/// Root mean square and largest difference of the two halves of the reference's samples, over all channels, in exposed linear
/// values clamped to [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct NoiseFloor {
    /// Root mean square difference.
    pub rms: f64,
    /// Largest absolute difference.
    pub max: f64,
}

/// Distance of the supersampled reference to the exact answer, in exposed linear values clamped to [0, 1].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AnalyticDistance {
    /// Root mean square over all pixels.
    pub rms: f64,
    /// Largest absolute difference.
    pub max: f64,
}

/// How long the reference took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReferenceTiming {
    /// Seconds to make or load it.
    pub seconds: f64,
    /// Whether it came from the cache.
    pub cached: bool,
}

/// One method on one scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MethodResult {
    /// The method with its options, as given.
    pub spec: String,
    /// What came of it.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Scored, or not and why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "status", rename_all = "kebab-case")]
pub enum Outcome {
    /// A picture was made and scored.
    Scored {
        /// Samples shaded a pixel, on average.
        samples_per_pixel: f64,
        /// Bytes of all the targets that the scene's draw and the method's passes hold.
        target_bytes: u64,
        /// One entry a metric, in the registry's order.
        scores: Vec<Score>,
        /// Pixels that are NaN or infinite; absent if there are none.
        #[serde(skip_serializing_if = "Option::is_none")]
        non_finite: Option<NonFinite>,
        /// Depends on the clock.
        timing: Timing,
    },
    /// The method could not run here.
    Failed {
        /// Why, and what would help.
        error: String,
    },
}

/// One metric's verdict.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The metric's versioned id, such as `psnr/1`. Figures of different ids must not be compared.
    pub metric: String,
    /// The figure.
    pub value: Figure,
}

/// In JSON: a number, `"inf"`, `"non-finite"` or `null`.
impl Serialize for Figure {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(x) => serializer.serialize_f64(*x),
            Self::Infinite => serializer.serialize_str("inf"),
            Self::NonFinite => serializer.serialize_str("non-finite"),
            Self::NotApplicable => serializer.serialize_none(),
        }
    }
}

impl<'de> Deserialize<'de> for Figure {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Raw {
            Number(f64),
            Word(String),
        }
        match Option::<Raw>::deserialize(deserializer)? {
            None => Ok(Self::NotApplicable),
            Some(Raw::Number(x)) => Ok(Self::Number(x)),
            Some(Raw::Word(word)) if word == "inf" => Ok(Self::Infinite),
            Some(Raw::Word(word)) if word == "non-finite" => Ok(Self::NonFinite),
            Some(Raw::Word(word)) => Err(serde::de::Error::custom(format!(
                "'{word}' is no figure; expected a number, \"inf\", \"non-finite\" or null"
            ))),
        }
    }
}

/// What a method costs on one scene. All in milliseconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The scene's own draws, all of them together.
    pub draw_ms: Spread,
    /// The method's passes, a pass at a time, in order.
    pub passes: Vec<PassTiming>,
    /// Draws and passes together.
    pub total_ms: Spread,
    /// `timestamps`, or `wall clock` of a submission of its own.
    pub clock: String,
    /// Whether no other method of the scene is at least as fast and as near to the reference (mean FLIP), and better in one.
    pub unbeaten: bool,
}

/// One pass of a method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassTiming {
    /// The pass's label.
    pub pass: String,
    /// How many times it ran for one picture.
    pub runs: u32,
    /// All its runs together.
    pub ms: Spread,
}

/// Median and extremes of a figure that was measured a few times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The smallest.
    pub min: f64,
    /// The largest.
    pub max: f64,
    /// How often it was measured, after warming up.
    pub repeats: u32,
}

impl Spread {
    /// Of a non-empty list of measurements.
    #[must_use]
    pub fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        let n = samples.len();
        let median = match n {
            0 => f64::NAN,
            _ if n % 2 == 1 => samples[n / 2],
            _ => 0.5 * (samples[n / 2 - 1] + samples[n / 2]),
        };
        Self {
            median,
            min: samples.first().copied().unwrap_or(f64::NAN),
            max: samples.last().copied().unwrap_or(f64::NAN),
            repeats: n as u32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_survive_json() {
        for value in [Figure::Number(1.5), Figure::Infinite, Figure::NonFinite, Figure::NotApplicable] {
            let json = serde_json::to_string(&value).expect("serializable");
            assert_eq!(serde_json::from_str::<Figure>(&json).expect("readable"), value, "{json}");
        }
        assert!(serde_json::from_str::<Figure>("\"often\"").is_err());
    }

    #[test]
    fn a_spread_has_the_middle_one() {
        assert_eq!(Spread::of(vec![3.0, 1.0, 2.0]).median, 2.0);
        assert_eq!(Spread::of(vec![4.0, 1.0, 2.0, 3.0]).median, 2.5);
        assert_eq!(Spread::of(vec![4.0, 1.0]).max, 4.0);
    }
}
