//! Values that a scene file may write in more than one way: colours, scales, materials by name or in place.

use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error, Expected, MapAccess, SeqAccess, Visitor, value::MapAccessDeserializer};

use super::document::MaterialDoc;

/// Exactly `N` numbers. (serde's own arrays let a longer one pass.)
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Numbers<const N: usize>(pub(super) [f64; N]);

impl<const N: usize> Default for Numbers<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl From<Numbers<3>> for glam::DVec3 {
    fn from(numbers: Numbers<3>) -> Self {
        numbers.0.into()
    }
}

impl<'de, const N: usize> Deserialize<'de> for Numbers<N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NumbersVisitor<const N: usize>;
        impl<'de, const N: usize> Visitor<'de> for NumbersVisitor<N> {
            type Value = Numbers<N>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "an array of {N} numbers")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Numbers<N>, A::Error> {
                exactly(items, &self).map(Numbers)
            }
        }
        deserializer.deserialize_seq(NumbersVisitor)
    }
}

fn exactly<'de, const N: usize, A: SeqAccess<'de>>(mut items: A, expected: &impl Expected) -> Result<[f64; N], A::Error> {
    let mut values = [0.0; N];
    for (index, value) in values.iter_mut().enumerate() {
        *value = items.next_element()?.ok_or_else(|| A::Error::invalid_length(index, expected))?;
    }
    match items.next_element::<f64>()? {
        None => Ok(values),
        Some(_) => Err(A::Error::invalid_length(N + 1, expected)),
    }
}

/// A linear colour: three numbers, or sRGB as `"#rrggbb"`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Color(pub(super) [f64; 3]);

impl Color {
    pub(super) fn white() -> Self {
        Self([1.0; 3])
    }

    /// From sRGB, two hexadecimal digits a channel after a `#`.
    fn from_hex(text: &str) -> Option<Self> {
        let digits =
            text.strip_prefix('#').filter(|digits| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
        let code = u32::from_str_radix(digits, 16).ok()?;
        Some(Self([16, 8, 0].map(|shift| linear_from_srgb(f64::from(code >> shift & 255) / 255.0))))
    }
}

/// The sRGB transfer function of IEC 61966-2-1.
fn linear_from_srgb(coded: f64) -> f64 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

impl<'de> Deserialize<'de> for Color {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ColorVisitor;
        impl<'de> Visitor<'de> for ColorVisitor {
            type Value = Color;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a colour: three linear numbers or \"#rrggbb\"")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Color, E> {
                Color::from_hex(text).ok_or_else(|| E::custom(format!("\"{text}\" is not a colour; expected \"#rrggbb\"")))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Color, A::Error> {
                exactly(items, &self).map(Color)
            }
        }
        deserializer.deserialize_any(ColorVisitor)
    }
}

/// Three factors, or one for all of them. Negative ones mirror.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale(pub(super) [f64; 3]);

impl Default for Scale {
    fn default() -> Self {
        Self([1.0; 3])
    }
}

impl<'de> Deserialize<'de> for Scale {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ScaleVisitor;
        impl<'de> Visitor<'de> for ScaleVisitor {
            type Value = Scale;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a scale: one number or three")
            }

            fn visit_f64<E: Error>(self, factor: f64) -> Result<Scale, E> {
                Ok(Scale([factor; 3]))
            }

            fn visit_i64<E: Error>(self, factor: i64) -> Result<Scale, E> {
                Ok(Scale([factor as f64; 3]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, items: A) -> Result<Scale, A::Error> {
                exactly(items, &self).map(Scale)
            }
        }
        deserializer.deserialize_any(ScaleVisitor)
    }
}

/// A material by name, or its description in place.
#[derive(Debug)]
pub(super) enum MaterialUse {
    Named(String),
    Inline(Box<MaterialDoc>),
}

impl<'de> Deserialize<'de> for MaterialUse {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct UseVisitor;
        impl<'de> Visitor<'de> for UseVisitor {
            type Value = MaterialUse;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a material: the name of one under [materials], or a table")
            }

            fn visit_str<E: Error>(self, name: &str) -> Result<MaterialUse, E> {
                Ok(MaterialUse::Named(name.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialUse, A::Error> {
                MaterialDoc::deserialize(MapAccessDeserializer::new(map)).map(|doc| MaterialUse::Inline(Box::new(doc)))
            }
        }
        deserializer.deserialize_any(UseVisitor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hexadecimal_colours_are_srgb() {
        assert_eq!(Color::from_hex("#000000"), Some(Color([0.0; 3])));
        assert_eq!(Color::from_hex("#ffffff"), Some(Color([1.0; 3])));
        let Color([r, g, b]) = Color::from_hex("#bc0080").unwrap();
        assert!((r - 0.502_886).abs() < 1e-6 && g == 0.0 && (b - 0.215_861).abs() < 1e-6, "{r} {g} {b}");
        for bad in ["", "#", "#12345", "#1234567", "123456", "#12345g", "#+12345", "#ééé"] {
            assert_eq!(Color::from_hex(bad), None, "{bad}");
        }
    }
}
