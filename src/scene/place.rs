//! Where in a scene file something stands, so that every complaint names a line and a column.
//!
//! The scene is read twice: into plain structs by serde, and into a tree of spans. A [`Place`] is a path through that tree; it
//! costs nothing until something is wrong.

use std::ops::RangeInclusive;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Error, Result};

/// Larger magnitudes are mistakes, and products of a few of them would overflow.
const LARGEST: f64 = 1e9;
/// Smaller sizes vanish when normals and areas are computed from them.
const SMALLEST: f64 = 1e-6;

/// A scene's text and its parse tree.
pub(super) struct Source<'a> {
    path: &'a str,
    text: &'a str,
    root: Spanned<DeValue<'a>>,
}

impl<'a> Source<'a> {
    /// Parses the text; all its numbers are finite and of a sane magnitude afterwards.
    pub(super) fn parse(path: &'a str, text: &'a str) -> Result<Self> {
        let table = DeTable::parse(text).map_err(|error| syntax_error(path, text, &error))?;
        let span = table.span();
        let source = Self { path, text, root: Spanned::new(span, DeValue::Table(table.into_inner())) };
        source.check_numbers(&source.root)?;
        Ok(source)
    }

    /// The whole file.
    pub(super) fn root(&'a self) -> Place<'a> {
        Place { source: self, step: None }
    }

    /// The text as plain structs.
    pub(super) fn deserialize<T: serde::de::DeserializeOwned>(&self) -> Result<T> {
        toml::from_str(self.text).map_err(|error| syntax_error(self.path, self.text, &error))
    }

    fn error_at(&self, offset: usize, message: String) -> Error {
        Error::at(self.path, self.text, offset, message)
    }

    fn check_numbers(&self, value: &Spanned<DeValue<'_>>) -> Result<()> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
            DeValue::Integer(integer) => {
                i64::from_str_radix(integer.as_str(), integer.radix()).map_or(f64::INFINITY, |i| i as f64)
            }
            DeValue::Array(array) => return array.iter().try_for_each(|item| self.check_numbers(item)),
            DeValue::Table(table) => return table.values().try_for_each(|item| self.check_numbers(item)),
            DeValue::String(_) | DeValue::Boolean(_) | DeValue::Datetime(_) => return Ok(()),
        };
        if number.abs() <= LARGEST {
            return Ok(());
        }
        let written = self.text.get(value.span()).unwrap_or("this");
        Err(self.error_at(
            value.span().start,
            format!("{written} is not a number a scene can use; expected a finite one within ±1e9"),
        ))
    }
}

/// A place in a scene file: the whole, or a key or item of another place.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    source: &'a Source<'a>,
    step: Option<(&'a Place<'a>, Step<'a>)>,
}

#[derive(Clone, Copy)]
enum Step<'a> {
    Key(&'a str),
    Item(usize),
}

impl Place<'_> {
    /// The value of a key of this table.
    pub(super) fn key<'b>(&'b self, key: &'b str) -> Place<'b> {
        Place { source: self.source, step: Some((self, Step::Key(key))) }
    }

    /// An item of this array, from 0.
    pub(super) fn item(&self, index: usize) -> Place<'_> {
        Place { source: self.source, step: Some((self, Step::Item(index))) }
    }

    /// An error at this place, or at the nearest enclosing one where the file leaves this one to its default.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        self.source.error_at(self.value().1.span().start, message.into())
    }

    /// The value here or of the nearest enclosing place that the file has, and whether it is this one.
    fn value(&self) -> (bool, &Spanned<DeValue<'_>>) {
        let Some((parent, step)) = self.step else {
            return (true, &self.source.root);
        };
        let (found, value) = parent.value();
        let child = match step {
            _ if !found => None,
            Step::Key(key) => value.get_ref().get(key),
            Step::Item(index) => value.get_ref().get(index),
        };
        child.map_or((false, value), |child| (true, child))
    }

    /// A size: above 0, and far enough from it to compute with.
    pub(super) fn positive(&self, value: f64) -> Result<f64> {
        if (SMALLEST..=LARGEST).contains(&value) {
            Ok(value)
        } else {
            Err(self.error(format!("{value:?} is too small; expected a number of at least {SMALLEST}")))
        }
    }

    /// Several sizes.
    pub(super) fn all_positive<const N: usize>(&self, values: [f64; N]) -> Result<[f64; N]> {
        for (index, &value) in values.iter().enumerate() {
            self.item(index).positive(value)?;
        }
        Ok(values)
    }

    /// A number in a closed range.
    pub(super) fn within(&self, value: f64, range: RangeInclusive<f64>) -> Result<f64> {
        if range.contains(&value) {
            return Ok(value);
        }
        Err(self.error(format!("{value} is out of range; expected {} to {}", range.start(), range.end())))
    }

    /// A count in a closed range.
    pub(super) fn count(&self, value: u32, range: RangeInclusive<u32>) -> Result<u32> {
        if range.contains(&value) {
            return Ok(value);
        }
        Err(self.error(format!("{value} is out of range; expected {} to {}", range.start(), range.end())))
    }
}

/// What toml says, with the place in the house's own form.
fn syntax_error(path: &str, text: &str, error: &toml::de::Error) -> Error {
    let offset = error.span().map_or(0, |span| span.start);
    Error::at(path, text, offset, in_plain_words(error.message()))
}

/// serde speaks of Rust's types; who writes scenes need not know them.
fn in_plain_words(message: &str) -> String {
    const WORDS: [(&str, &str); 6] = [
        ("expected f64", "expected a number"),
        ("expected u32", "expected a whole number from 0"),
        ("expected a boolean", "expected true or false"),
        ("wanted string or table", "expected a name, or a table with a name as its only key"),
        ("invalid type: unit variant, expected newtype variant", "expected a table: this name as its key, and its settings"),
        ("wanted exactly 1 element, more than 1 element", "expected a table with only one key"),
    ];
    let known = WORDS.iter().find_map(|(theirs, ours)| Some(format!("{}{ours}", message.strip_suffix(theirs)?)));
    known.unwrap_or_else(|| message.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "a = 1\n[b]\nc = [1, 2]\n\n[[d]]\nx = 1\n[[d]]\ny = 'é'\nz = { w = 5 }\n";

    fn at(error: &Error) -> (usize, usize) {
        match error {
            Error::Document { line, column, .. } => (*line, *column),
            other => panic!("{other}"),
        }
    }

    #[test]
    fn errors_name_the_place_of_a_value() {
        let source = Source::parse("s.toml", TEXT).unwrap();
        let root = source.root();
        assert_eq!(at(&root.key("a").error("no")), (1, 5));
        assert_eq!(at(&root.key("b").key("c").item(1).error("no")), (3, 9));
        assert_eq!(at(&root.key("d").item(1).key("y").error("no")), (8, 5));
        assert_eq!(at(&root.key("d").item(1).key("z").key("w").error("no")), (9, 11));
        assert_eq!(root.key("a").error("no").to_string(), "s.toml:1:5: no");
    }

    #[test]
    fn a_missing_key_is_reported_at_what_encloses_it() {
        let source = Source::parse("s.toml", TEXT).unwrap();
        let root = source.root();
        assert_eq!(at(&root.key("b").key("nothing").key("deeper").error("no")), (2, 1));
        assert_eq!(at(&root.key("d").item(1).key("nothing").error("no")), (7, 1));
        assert_eq!(at(&root.key("nothing").error("no")), (1, 1));
    }

    #[test]
    fn numbers_that_are_not_finite_or_huge_are_refused_wherever_they_stand() {
        for bad in ["nan", "-inf", "inf", "1e300", "-1e10", "10_000_000_000", "0xfffffffffff"] {
            let text = format!("a = 1\n[b]\nc = [1, {{ d = {bad} }}]\n");
            let error = Source::parse("s.toml", &text).err().unwrap();
            assert_eq!(at(&error), (3, 15), "{bad}");
            assert!(error.to_string().contains(bad), "{error}");
        }
        assert!(Source::parse("s.toml", "a = 1_000.5e3\nb = -0.0\nc = 0x10").is_ok());
    }

    #[test]
    fn a_column_counts_characters_not_bytes() {
        assert_eq!(at(&Source::parse("s.toml", "é = 1\n'ü' = nan").err().unwrap()), (1, 1));
        assert_eq!(at(&Source::parse("s.toml", "a = 1\n'ü' = nan").err().unwrap()), (2, 7));
    }
}
