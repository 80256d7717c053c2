//! Methods by name: `ssaa`, `ssaa:spp=64,pattern=r2`, `msaa:samples=4+cmaa2`.

use std::fmt;

use super::METHODS;
use crate::error::{Error, Result, unknown};
use crate::pass::{Method, Needs, Options, Role, Technique};

/// A method with its options, or a combination of several, as a user names it.
#[derive(Debug)]
pub struct Spec {
    text: String,
    /// In the order they run; at least one.
    pub stages: Vec<Stage>,
}

/// One method of a combination.
#[derive(Debug)]
pub struct Stage {
    /// The registry's entry.
    pub method: &'static Method,
    /// With its options set.
    pub technique: Box<dyn Technique>,
}

impl Spec {
    /// Reads `METHOD[:OPTION=VALUE,...][+METHOD...]`.
    ///
    /// # Errors
    /// [`Error::Request`] for what does not exist, is out of range, or cannot be combined.
    pub fn parse(text: &str) -> Result<Self> {
        let text = text.trim();
        if text.contains('+') && text.split('+').any(|stage| stage.trim().is_empty()) {
            return Err(Error::Request(format!("'{text}': a method is missing beside a '+'; write it as METHOD+METHOD")));
        }
        let stages: Vec<Stage> = text.split('+').map(Stage::parse).collect::<Result<_>>()?;
        if let Some(late) = stages.iter().skip(1).find(|stage| matches!(stage.technique.needs().role, Role::Draws(_))) {
            return Err(Error::Request(format!(
                "'{text}': {} draws the scene itself and can only come first in a combination",
                late.method.name
            )));
        }
        Ok(Self { text: text.to_owned(), stages })
    }

    /// What the first stage needs: it is the one that draws.
    #[must_use]
    pub fn first_needs(&self) -> Needs {
        self.stages[0].technique.needs()
    }
}

impl fmt::Display for Spec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Stage {
    fn parse(text: &str) -> Result<Self> {
        let (name, options) = match text.trim().split_once(':') {
            Some((name, options)) => (name.trim(), Some(options)),
            None => (text.trim(), None),
        };
        let method = METHODS.iter().find(|m| m.name == name).ok_or_else(|| {
            let names: Vec<_> = METHODS.iter().map(|m| m.name).collect();
            unknown("method", name, &names)
        })?;
        let options = Options::parse(method.name, method.options, options)?;
        Ok(Self { method, technique: (method.configure)(&options)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        Spec::parse(text).expect_err("should be refused").to_string()
    }

    #[test]
    fn specs_are_read() {
        for text in ["none", "ssaa", "ssaa:spp=64", "ssaa:spp=7,pattern=r2,filter=mitchell,radius=1.5", "msaa:samples=4,a2c=on"] {
            assert_eq!(Spec::parse(text).expect(text).to_string(), text);
        }
        assert_eq!(Spec::parse(" ssaa : spp = 4 ").expect("spaces are fine").stages[0].technique.needs().samples_per_pixel, 4);
    }

    #[test]
    fn refusals_say_what_exists() {
        assert!(refusal("sssa").contains("did you mean 'ssaa'"));
        assert!(refusal("").contains("none, ssaa"));
        assert!(refusal("ssaa:sp=4").contains("did you mean 'spp'"));
        assert!(refusal("ssaa:spp=0").contains("1 to 4096"));
        assert!(refusal("ssaa:spp=4097").contains("1 to 4096"));
        assert!(refusal("ssaa:spp=").contains("1 to 4096"));
        assert!(refusal("ssaa:radius=nan").contains("takes"));
        assert!(refusal("ssaa:spp=4,spp=5").contains("twice"));
        assert!(refusal("ssaa:spp").contains("NAME=VALUE"));
        assert!(refusal("ssaa:pattern=haltn").contains("'halton'"));
        assert!(refusal("none:spp=1").contains("no options"));
        assert!(refusal("msaa:samples=3").contains("2, 4, 8, 16"));
        assert!(refusal("SSAA").contains("did you mean 'ssaa'"));
        assert!(refusal("ssaa:spp=16:filter=box").contains("commas"));
        assert!(refusal("msaa+").contains("missing"));
        assert!(refusal("none+ssaa").contains("only come first"));
        assert!(refusal("ssaa:filter=catmull-rom,spp=1,pattern=random,seed=3,radius=8").contains("sum"));
    }

    #[test]
    fn names_of_methods_and_options_are_unique_and_plain() {
        let plain = |name: &str| name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_".contains(c));
        for (i, method) in METHODS.iter().enumerate() {
            assert!(plain(method.name) && !method.summary.is_empty(), "{}", method.name);
            assert!(METHODS[..i].iter().all(|other| other.name != method.name), "{}", method.name);
            for (k, option) in method.options.iter().enumerate() {
                assert!(plain(option.name) && !option.help.is_empty(), "{}", option.name);
                assert!(method.options[..k].iter().all(|other| other.name != option.name), "{}", option.name);
            }
            // Defaults parse and configure.
            Spec::parse(method.name).expect(method.name);
        }
    }

    mod fuzz {
        use super::*;
        use proptest::prelude::*;

        /// Words that get a parser further than noise does.
        fn spec_like() -> impl Strategy<Value = String> {
            let words = prop::sample::select(vec![
                "none", "ssaa", "msaa", ":", ",", "=", "+", "spp", "pattern", "filter", "radius", "samples", "weight", "a2c",
                "on", "larcher", "box", "lanczos", "auto", "0", "1", "4", "4096", "-1", "1e300", "nan", "inf", "0x10", "\u{e9}",
                " ",
            ]);
            prop::collection::vec(words, 0..12).prop_map(|words| words.concat())
        }

        proptest! {
            #![proptest_config(ProptestConfig::with_cases(5000))]

            #[test]
            fn anything_is_read_or_refused(text in ".*") {
                if let Err(error) = Spec::parse(&text) {
                    prop_assert_eq!(error.blame(), crate::error::Blame::Request);
                }
            }

            #[test]
            fn what_looks_like_a_spec_is_read_or_refused(text in spec_like()) {
                match Spec::parse(&text) {
                    Ok(spec) => prop_assert!((1..=4096).contains(&spec.first_needs().samples_per_pixel)),
                    Err(error) => prop_assert!(!error.to_string().is_empty()),
                }
            }
        }
    }
}
