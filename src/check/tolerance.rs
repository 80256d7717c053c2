//! What a case must meet: the manifest's own tolerance, the case's, and what is said for its environment, each over the one before.

use globset::{GlobBuilder, GlobMatcher};
use serde::Deserialize;

use super::words;
use crate::compare::{Allowance, Limits, Measure, MetricLimit};

/// Limits of which some may be left open. What they mean is what the options of `dejag diff` mean.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default, expecting = "a table of limits")]
pub struct Tolerance {
    /// How many pixels may differ.
    #[serde(deserialize_with = "words::allowance")]
    pub max_pixels: Option<Allowance>,
    /// How much a channel may differ before its pixel does.
    #[serde(deserialize_with = "words::difference")]
    pub per_channel: Option<f64>,
    /// Largest root mean square difference.
    #[serde(deserialize_with = "words::limit")]
    pub max_rmse: Option<f64>,
    /// Least PSNR in decibels.
    #[serde(deserialize_with = "words::limit")]
    pub min_psnr: Option<f64>,
    /// Least structural similarity.
    #[serde(deserialize_with = "words::limit")]
    pub min_ssim: Option<f64>,
    /// Largest mean FLIP error.
    #[serde(deserialize_with = "words::limit")]
    pub max_flip: Option<f64>,
    /// Whether pixels of resampled edges may differ.
    pub allow_edges: Option<bool>,
    /// Whether to compare numbers that mean different colours.
    pub ignore_profile: Option<bool>,
}

impl Tolerance {
    /// This one where `over` leaves a limit open.
    #[must_use]
    pub fn with(self, over: &Self) -> Self {
        Self {
            max_pixels: over.max_pixels.or(self.max_pixels),
            per_channel: over.per_channel.or(self.per_channel),
            max_rmse: over.max_rmse.or(self.max_rmse),
            min_psnr: over.min_psnr.or(self.min_psnr),
            min_ssim: over.min_ssim.or(self.min_ssim),
            max_flip: over.max_flip.or(self.max_flip),
            allow_edges: over.allow_edges.or(self.allow_edges),
            ignore_profile: over.ignore_profile.or(self.ignore_profile),
        }
    }

    /// As a comparison takes them.
    #[must_use]
    pub fn limits(&self) -> Limits {
        let metrics = [
            (Measure::Rmse, self.max_rmse),
            (Measure::Psnr, self.min_psnr),
            (Measure::Ssim, self.min_ssim),
            (Measure::Flip, self.max_flip),
        ];
        let given = metrics.into_iter().filter_map(|(measure, limit)| Some(MetricLimit { measure, limit: limit? }));
        Limits {
            max_pixels: self.max_pixels,
            per_channel: self.per_channel,
            metrics: given.collect(),
            allow_edges: self.allow_edges.unwrap_or(false),
        }
    }
}

/// A tolerance for some cases, environments or platforms.
#[derive(Debug, Clone)]
pub struct Override {
    /// What ids must match; `*` reaches across `/`.
    pub(super) case: Option<GlobMatcher>,
    pub(super) environment: Option<GlobMatcher>,
    pub(super) platform: Option<GlobMatcher>,
    pub(super) tolerance: Tolerance,
}

impl Override {
    pub(super) fn concerns(&self, id: &str) -> bool {
        self.case.as_ref().is_none_or(|glob| glob.is_match(id))
    }

    pub(super) fn depends_on_place(&self) -> bool {
        self.environment.is_some() || self.platform.is_some()
    }

    pub(super) fn holds(&self, id: &str, environment: &str, platform: &str) -> bool {
        let matches = |glob: &Option<GlobMatcher>, text: &str| glob.as_ref().is_none_or(|glob| glob.is_match(text));
        matches(&self.case, id) && matches(&self.environment, environment) && matches(&self.platform, platform)
    }
}

/// A pattern for ids, environments and platforms. A backslash takes the meaning from the character after it, on every system.
///
/// # Errors
///
/// What is wrong with it.
pub(super) fn glob(pattern: &str) -> Result<GlobMatcher, String> {
    let built = GlobBuilder::new(pattern).backslash_escape(true).build();
    built.map(|glob| glob.compile_matcher()).map_err(|error| format!("{error}; write a pattern such as 'edges-*'"))
}

/// What stands for more than itself in a pattern.
const SPECIAL: [char; 9] = ['\\', '*', '?', '[', ']', '{', '}', '!', ','];

/// The pattern that matches this and nothing else.
pub(super) fn escape(id: &str) -> String {
    id.chars().flat_map(|c| SPECIAL.contains(&c).then_some('\\').into_iter().chain([c])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_later_holds_where_it_says_something() {
        let base = Tolerance { max_pixels: Some(Allowance::Count(3)), max_flip: Some(0.1), ..Tolerance::default() };
        let over = Tolerance { max_flip: Some(0.2), allow_edges: Some(true), ..Tolerance::default() };
        let both = base.with(&over);
        assert_eq!((both.max_pixels, both.max_flip), (Some(Allowance::Count(3)), Some(0.2)));
        let limits = both.limits();
        assert!(limits.allow_edges);
        assert_eq!(limits.of(Measure::Flip), Some(0.2));
        assert_eq!(limits.of(Measure::Psnr), None);
    }

    #[test]
    fn an_override_holds_where_all_it_names_match() {
        let matcher = |text: &str| Some(glob(text).expect("a glob"));
        let all = Override { case: None, environment: None, platform: None, tolerance: Tolerance::default() };
        assert!(all.holds("any/id", "env", "linux-x86_64"));
        let some = Override { case: matcher("any*"), environment: matcher("llvmpipe-*"), ..all };
        assert!(some.holds("any/id", "llvmpipe-mesa-25", "linux-x86_64"));
        assert!(!some.holds("any/id", "nvidia", "linux-x86_64"));
        assert!(!some.holds("other", "llvmpipe-mesa-25", "linux-x86_64"));
        assert!(glob("a[").is_err());
        assert!(glob("a\\[b").expect("a glob").is_match("a[b"));
        for id in ["plain/a.png", "[a-z]*?{x,y}!.png", "c\\d.png"] {
            let exactly = glob(&escape(id)).expect("a glob");
            assert!(exactly.is_match(id) && !exactly.is_match("cd.png") && !exactly.is_match("ax.png"), "{id}");
        }
    }
}
