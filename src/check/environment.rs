//! Environments: what draws the same bits shares goldens.

use super::manifest::check_id;
use crate::suite::{Environment, Stamp};
use crate::{Error, Result};

/// The last folder that is looked into, and the one of pictures that something else made.
pub const ANY: &str = "any";

/// Whether a key can name an environment: it is a folder's name.
///
/// # Errors
///
/// [`Error::Request`], saying what can.
pub fn check_key(key: &str) -> Result<()> {
    check_id(key).map_err(|why| Error::Request(format!("--environment: {why}")))
}

/// This machine, and what draws on it; `key` as the user names it, or what the driver says of itself.
#[must_use]
pub fn environment(key: Option<&str>, stamp: Option<Stamp>) -> Environment {
    let own = || stamp.as_ref().map_or_else(|| ANY.to_owned(), key_of);
    Environment {
        key: key.map_or_else(own, ToOwned::to_owned),
        platform: format!("{}-{}", std::env::consts::OS, std::env::consts::ARCH),
        stamp,
    }
}

/// `llvmpipe-mesa-22.3.6` from the driver's own words.
fn key_of(stamp: &Stamp) -> String {
    let version: Vec<&str> = stamp.driver_version.split_whitespace().take(2).collect();
    let words = format!("{} {}", stamp.driver, version.join(" ")).to_lowercase();
    let parts = words.split(|c: char| !c.is_ascii_alphanumeric() && c != '.').filter(|part| !part.is_empty());
    let key = parts.collect::<Vec<_>>().join("-");
    if key.is_empty() { ANY.into() } else { key }
}

/// Where a golden is looked for, nearest first: the environment, what is left of its key without its last part again and again, the
/// stand-ins, and what holds anywhere.
#[must_use]
pub fn chain(key: &str, fallback: &[String]) -> Vec<String> {
    let mut chain: Vec<String> = std::iter::successors(Some(key), |key| shorter(key)).map(ToOwned::to_owned).collect();
    chain.extend(fallback.iter().cloned());
    chain.push(ANY.into());
    let mut seen = std::collections::BTreeSet::new();
    chain.retain(|level| seen.insert(level.clone()));
    chain
}

fn shorter(key: &str) -> Option<&str> {
    key.rfind(['.', '-']).map(|at| &key[..at]).filter(|key| !key.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stamp(driver: &str, version: &str) -> Stamp {
        let text = |text: &str| text.to_owned();
        Stamp {
            dejag: text("0"),
            adapter: text("a"),
            kind: text("software"),
            driver: text(driver),
            driver_version: text(version),
            backend: text("vulkan"),
        }
    }

    #[test]
    fn a_key_is_made_of_the_drivers_words() {
        assert_eq!(key_of(&stamp("llvmpipe", "Mesa 22.3.6 (LLVM 15.0.6)")), "llvmpipe-mesa-22.3.6");
        assert_eq!(key_of(&stamp("NVIDIA", "570.86.15")), "nvidia-570.86.15");
        assert_eq!(key_of(&stamp("", "")), ANY);
        assert_eq!(key_of(&stamp("../../etc", "/x \"y\"")), "..-..-etc-x-y");
    }

    #[test]
    fn the_chain_goes_from_the_driver_to_anywhere() {
        let fallback = ["llvmpipe-mesa-22.3.6".to_owned()];
        let found = chain("llvmpipe-mesa-25.0.7", &fallback);
        let expected = [
            "llvmpipe-mesa-25.0.7",
            "llvmpipe-mesa-25.0",
            "llvmpipe-mesa-25",
            "llvmpipe-mesa",
            "llvmpipe",
            "llvmpipe-mesa-22.3.6",
            "any",
        ];
        assert_eq!(found, expected);
        assert_eq!(chain("any", &[]), ["any"]);
    }
}
