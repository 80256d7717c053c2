//! A method's options: what can be set, and what was.

use crate::error::{Error, Result, unknown};

/// One option of a method, as `list` and the error texts show it.
#[derive(Debug)]
pub struct OptionSpec {
    /// As in `NAME=VALUE`.
    pub name: &'static str,
    /// What it does, in a line.
    pub help: &'static str,
    /// Which values it takes.
    pub kind: Kind,
    /// The value if none is given, written as a user would.
    pub default: &'static str,
}

/// Which values an option takes.
#[derive(Debug)]
pub enum Kind {
    /// A whole number between two, both included.
    Integer {
        /// The least.
        min: u32,
        /// The greatest.
        max: u32,
    },
    /// A number between two, both included.
    Number {
        /// The least.
        min: f64,
        /// The greatest.
        max: f64,
    },
    /// Either a number between two, both included, or the word `auto`.
    NumberOrAuto {
        /// The least.
        min: f64,
        /// The greatest.
        max: f64,
    },
    /// Either a whole number between two, both included, or the word `auto`.
    IntegerOrAuto {
        /// The least.
        min: u32,
        /// The greatest.
        max: u32,
    },
    /// One of some names.
    Choice(fn() -> Vec<&'static str>),
    /// `on` or `off`.
    Switch,
}

impl Kind {
    /// The range in words.
    #[must_use]
    pub fn range(&self) -> String {
        match self {
            Self::Integer { min, max } => format!("{min} to {max}"),
            Self::Number { min, max } => format!("{min} to {max}"),
            Self::NumberOrAuto { min, max } => format!("{min} to {max}, or auto"),
            Self::IntegerOrAuto { min, max } => format!("{min} to {max}, or auto"),
            Self::Choice(names) => names().join("|"),
            Self::Switch => "on|off".into(),
        }
    }

    fn parse(&self, method: &str, option: &str, text: &str) -> Result<Value> {
        let out_of_range = || {
            let hint = if text.contains(':') { "; options are separated by commas" } else { "" };
            let kind =
                if matches!(self, Self::Integer { .. } | Self::IntegerOrAuto { .. }) { "a whole number from " } else { "" };
            Error::Request(format!("{method}: {option}={text} is out of range; {option} takes {kind}{}{hint}", self.range()))
        };
        let number = |min: f64, max: f64| {
            text.parse().ok().filter(|x| (min..=max).contains(x)).map(Value::Number).ok_or_else(out_of_range)
        };
        match self {
            Self::NumberOrAuto { .. } | Self::IntegerOrAuto { .. } if text == "auto" => Ok(Value::Auto),
            Self::Integer { min, max } | Self::IntegerOrAuto { min, max } => {
                text.parse().ok().filter(|x| (min..=max).contains(&x)).map(Value::Integer).ok_or_else(out_of_range)
            }
            Self::Number { min, max } | Self::NumberOrAuto { min, max } => number(*min, *max),
            Self::Choice(names) => {
                let names = names();
                let name = names.iter().find(|name| **name == text);
                name.map(|name| Value::Word(name)).ok_or_else(|| unknown(&format!("{option} of {method}"), text, &names))
            }
            Self::Switch => match text {
                "on" => Ok(Value::Switch(true)),
                "off" => Ok(Value::Switch(false)),
                _ => Err(out_of_range()),
            },
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Value {
    Integer(u32),
    Number(f64),
    Auto,
    Word(&'static str),
    Switch(bool),
}

/// The values of all of a method's options, checked against their ranges.
#[derive(Debug, Clone)]
pub struct Options {
    values: Vec<(&'static str, Value)>,
    given: Vec<&'static str>,
}

impl Options {
    /// Reads `key=value,key=value`; what is not given has its default.
    ///
    /// # Errors
    /// [`Error::Request`] for an unknown or repeated key, a missing value, or a value out of range.
    pub fn parse(method: &'static str, specs: &'static [OptionSpec], text: Option<&str>) -> Result<Self> {
        let mut given = Vec::new();
        for assignment in text.map(|t| t.split(',')).into_iter().flatten() {
            let Some((key, value)) = assignment.split_once('=') else {
                return Err(Error::Request(format!("{method}: '{assignment}' is no option; write it as NAME=VALUE")));
            };
            let (key, value) = (key.trim(), value.trim());
            let Some(spec) = specs.iter().find(|spec| spec.name == key) else {
                if specs.is_empty() {
                    return Err(Error::Request(format!("{method} has no options; write just '{method}'")));
                }
                let names: Vec<_> = specs.iter().map(|spec| spec.name).collect();
                return Err(unknown(&format!("{method} option"), key, &names));
            };
            if given.iter().any(|(name, _)| *name == spec.name) {
                return Err(Error::Request(format!("{method}: {key} is given twice; give it once")));
            }
            given.push((spec.name, spec.kind.parse(method, key, value)?));
        }
        let value_of = |spec: &OptionSpec| {
            let explicit = given.iter().find(|(name, _)| *name == spec.name).map(|(_, value)| *value);
            Ok((spec.name, explicit.map_or_else(|| spec.kind.parse(method, spec.name, spec.default), Ok)?))
        };
        let values = specs.iter().map(value_of).collect::<Result<_>>()?;
        Ok(Self { values, given: given.into_iter().map(|(name, _)| name).collect() })
    }

    /// Those that were given, in that order, be it with their defaults.
    #[must_use]
    pub fn given(&self) -> &[&'static str] {
        &self.given
    }

    fn value(&self, name: &str) -> Option<Value> {
        self.values.iter().find(|(key, _)| *key == name).map(|(_, value)| *value)
    }

    /// Of an [`Kind::Integer`] option of this method.
    #[must_use]
    pub fn integer(&self, name: &str) -> u32 {
        match self.value(name) {
            Some(Value::Integer(x)) => x,
            other => unreachable!("option {name} is no integer: {other:?}"),
        }
    }

    /// Of a [`Kind::IntegerOrAuto`] option of this method; `auto` stands for what is given here.
    #[must_use]
    pub fn integer_or(&self, name: &str, auto: u32) -> u32 {
        if self.value(name) == Some(Value::Auto) { auto } else { self.integer(name) }
    }

    /// Of a [`Kind::Number`] or [`Kind::NumberOrAuto`] option of this method; none for `auto`.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        match self.value(name) {
            Some(Value::Number(x)) => Some(x),
            Some(Value::Auto) => None,
            other => unreachable!("option {name} is no number: {other:?}"),
        }
    }

    /// Of a [`Kind::Choice`] option of this method.
    #[must_use]
    pub fn word(&self, name: &str) -> &'static str {
        match self.value(name) {
            Some(Value::Word(word)) => word,
            other => unreachable!("option {name} is no choice: {other:?}"),
        }
    }

    /// Of a [`Kind::Switch`] option of this method.
    #[must_use]
    pub fn switch(&self, name: &str) -> bool {
        match self.value(name) {
            Some(Value::Switch(on)) => on,
            other => unreachable!("option {name} is no switch: {other:?}"),
        }
    }
}
