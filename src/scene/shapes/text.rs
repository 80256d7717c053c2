//! Text in a bitmap font of our own: five pixels wide, seven above the line, up to two below it.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};
use serde::Deserialize;

use super::builder::Builder;
use crate::error::Result;
use crate::scene::Mesh;
use crate::scene::place::Place;

/// One line a character of ASCII 32 to 126: the character, a space, and seven to nine rows from the top.
const FONT: &str = include_str!("font.txt");
const WIDTH: usize = 5;
/// Rows above the line.
const ASCENT: usize = 7;
const ROWS: usize = 9;
/// From one character to the next, and from one line to the next, in pixels of the font.
const ADVANCE: f64 = 6.0;
const LEADING: f64 = 11.0;

/// The rows of each character's lit pixels as (first, end) runs.
type Glyph = [Vec<(usize, usize)>; ROWS];

static GLYPHS: LazyLock<Vec<Glyph>> = LazyLock::new(|| FONT.lines().map(glyph).collect());

fn glyph(line: &str) -> Glyph {
    let mut rows = line.get(2..).unwrap_or_default().split(' ').map(runs);
    std::array::from_fn(|_| rows.next().unwrap_or_default())
}

fn runs(row: &str) -> Vec<(usize, usize)> {
    let lit = |x: usize| row.as_bytes().get(x) == Some(&b'#');
    let starts = (0..WIDTH).filter(|&x| lit(x) && (x == 0 || !lit(x - 1)));
    starts.map(|start| (start, (start..=WIDTH).find(|&x| !lit(x)).unwrap_or(WIDTH))).collect()
}

/// Where a text's lines stand along x.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::scene) enum Align {
    /// They begin at x = 0.
    #[default]
    Left,
    /// Their middle is at x = 0, rounded to a whole pixel of the font.
    Center,
}

/// Text in the plane z = 0 facing +z. The first line stands on y = 0; each horizontal run of lit pixels is a quad.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(in crate::scene) struct Text {
    /// ASCII; `\n` begins a new line.
    string: String,
    /// Side of a pixel of the font. A capital is 7 of them high.
    pixel: f64,
    #[serde(default)]
    align: Align,
}

impl Text {
    pub(super) fn mesh(&self, at: &Place<'_>) -> Result<Mesh> {
        let pixel = at.key("pixel").positive(self.pixel)?;
        let string_place = at.key("string");
        if self.string.trim().is_empty() || self.string.len() > 10_000 {
            return Err(string_place.error("expected a text of 1 to 10000 characters"));
        }
        let mut builder = Builder::default();
        for (line_index, line) in self.string.lines().enumerate() {
            let start = match self.align {
                Align::Left => 0.0,
                Align::Center => -((ADVANCE * line.chars().count() as f64 - 1.0) * 0.5).floor(),
            };
            for (index, character) in line.chars().enumerate() {
                let glyph = glyph_of(character).ok_or_else(|| {
                    string_place.error(format!("the font has no {character:?}; expected printable ASCII characters"))
                })?;
                let origin = DVec2::new(start + ADVANCE * index as f64, -LEADING * line_index as f64);
                draw(&mut builder, glyph, origin, pixel);
            }
        }
        Ok(builder.finish())
    }
}

fn glyph_of(character: char) -> Option<&'static Glyph> {
    GLYPHS.get((character as usize).checked_sub(32)?)
}

fn draw(builder: &mut Builder, glyph: &Glyph, origin: DVec2, pixel: f64) {
    for (row, runs) in glyph.iter().enumerate() {
        let y = origin.y + ASCENT as f64 - 1.0 - row as f64;
        for &(start, end) in runs {
            let corners = [(start, 0.0), (end, 0.0), (end, 1.0), (start, 1.0)].map(|(x, up)| {
                let position = pixel * DVec2::new(origin.x + x as f64, y + up);
                builder.vertex(position.extend(0.0), DVec3::Z, DVec3::X, position)
            });
            builder.quad(corners);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_every_printable_character_in_its_place() {
        assert_eq!(FONT.lines().count(), 95);
        for (index, line) in FONT.lines().enumerate() {
            assert_eq!(line.chars().next().map(|c| c as usize), Some(32 + index));
            let rows: Vec<&str> = line[2..].split(' ').collect();
            assert!((ASCENT..=ROWS).contains(&rows.len()) && rows.iter().all(|row| row.len() == WIDTH), "{line}");
            assert!(line[1..].chars().all(|c| " .#".contains(c)), "{line}");
        }
        assert!(glyph_of('~').is_some() && glyph_of('\u{7f}').is_none() && glyph_of('\t').is_none());
    }

    #[test]
    fn no_two_characters_look_the_same() {
        for (index, glyph) in GLYPHS.iter().enumerate() {
            assert!(!GLYPHS[index + 1..].contains(glyph), "{}", FONT.lines().nth(index).unwrap());
        }
    }

    #[test]
    fn a_row_is_split_into_runs() {
        assert_eq!(runs("##.#."), [(0, 2), (3, 4)]);
        assert_eq!(runs("#####"), [(0, 5)]);
        assert!(runs(".....").is_empty());
    }
}
