//! Values of a manifest that are words: read while the file is, so that an error names their place.

use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;
use std::str::FromStr;

use serde::de::{self, Deserializer, Visitor};

use crate::compare::{Allowance, Rectangle, parse_difference, parse_limit};

/// Text, or a number that is read as if it were.
struct Words<T, F> {
    parse: F,
    expecting: &'static str,
    made: PhantomData<T>,
}

impl<T, F: Fn(&str) -> Result<T, String>> Visitor<'_> for Words<T, F> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.expecting)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
        (self.parse)(text).map_err(E::custom)
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<T, E> {
        self.visit_str(&number.to_string())
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<T, E> {
        self.visit_str(&number.to_string())
    }

    fn visit_f64<E: de::Error>(self, number: f64) -> Result<T, E> {
        self.visit_str(&number.to_string())
    }
}

fn words<'de, D, T>(deserializer: D, expecting: &'static str, parse: impl Fn(&str) -> Result<T, String>) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
{
    deserializer.deserialize_any(Words { parse, expecting, made: PhantomData })
}

pub(super) fn allowance<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Allowance>, D::Error> {
    words(deserializer, "a number of pixels or a share such as '0.1%'", Allowance::from_str).map(Some)
}

pub(super) fn difference<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    words(deserializer, "a difference such as '2/255' or 0.01", parse_difference).map(Some)
}

pub(super) fn limit<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    words(deserializer, "a number of at least 0", parse_limit).map(Some)
}

/// A rectangle as a manifest writes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Area(pub(super) Rectangle);

impl<'de> de::Deserialize<'de> for Area {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        words(deserializer, "a rectangle such as '0,0,200,40'", Rectangle::from_str).map(Area)
    }
}

/// Width and height of what is drawn, in pixels.
pub(super) fn size<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[u32; 2], D::Error> {
    let parse = |text: &str| {
        let side = |text: &str| text.trim().parse::<u32>().ok().filter(|side| *side > 0);
        let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([side(width)?, side(height)?]));
        sides.ok_or_else(|| format!("'{text}' is no size; write 'WIDTHxHEIGHT' in pixels, such as '1280x720', both at least 1"))
    };
    words(deserializer, "a size such as '640x360'", parse)
}

/// Frames of a sequence, the last left out.
pub(super) fn frames<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Range<i64>, D::Error> {
    let parse = |text: &str| {
        let number = |text: &str| text.trim().parse::<i64>().ok().filter(|frame| (-MOST_DISTANT..=MOST_DISTANT).contains(frame));
        let range = text.split_once("..").and_then(|(start, end)| Some(number(start)?..number(end)?));
        range.filter(|range| !range.is_empty() && range.end.saturating_sub(range.start) <= MAX_FRAMES).ok_or_else(|| {
            format!("'{text}' are no frames; write 'A..B', such as '0..8', B left out, at most {MAX_FRAMES} of them")
        })
    };
    words(deserializer, "frames such as '0..8'", parse)
}

/// Of a sequence in a manifest: each is a picture with a golden of its own.
const MAX_FRAMES: i64 = 100_000;

/// No scene moves for so long.
const MOST_DISTANT: i64 = 1_000_000_000;

/// One or several.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Several(pub(super) Vec<String>);

impl<'de> de::Deserialize<'de> for Several {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct List;
        impl<'de> Visitor<'de> for List {
            type Value = Several;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text or a list of texts")
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Several, E> {
                Ok(Several(vec![text.to_owned()]))
            }

            fn visit_seq<A: de::SeqAccess<'de>>(self, mut list: A) -> Result<Several, A::Error> {
                let mut all = Vec::new();
                while let Some(text) = list.next_element()? {
                    all.push(text);
                }
                if all.is_empty() { Err(de::Error::invalid_length(0, &"at least one text")) } else { Ok(Several(all)) }
            }
        }
        deserializer.deserialize_any(List)
    }
}
