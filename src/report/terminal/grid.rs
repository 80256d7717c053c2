//! Names and figures in columns.

use super::TABLE_WIDTH;
use comfy_table::{Cell, CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

/// A table laid out: no line is longer than [`TABLE_WIDTH`] characters as long as the figures leave room.
pub(super) struct Grid {
    /// The headings and the rule below them.
    pub(super) heading: Vec<String>,
    /// One a row. A name that is longer than `room` is left out.
    pub(super) lines: Vec<String>,
    /// Characters that the figures leave to a name.
    pub(super) room: usize,
}

impl Grid {
    /// Of a heading a column, and rows of a name and one figure fewer than there are columns.
    pub(super) fn new(headings: &[&str], rows: &[(String, Vec<String>)]) -> Self {
        let room = room_for_names(headings, rows);
        let mut table = Table::new();
        table.load_style(TableStyle::new().header_separator(LineStyle::none().fill('─')));
        table.set_content_arrangement(ContentArrangement::Disabled);
        table.set_header(headings.iter().map(Cell::new));
        for (name, figures) in rows {
            let name = if name.chars().count() <= room { name.as_str() } else { "" };
            table.add_row(std::iter::once(name).chain(figures.iter().map(String::as_str)).map(Cell::new));
        }
        set_columns(&mut table);
        let mut lines: Vec<String> = table.lines().map(|line| line.trim_end().to_string()).collect();
        let rows = lines.split_off(lines.len().min(2));
        Self { heading: lines, lines: rows, room }
    }
}

/// What the figures' columns, each with a gap of one before it, leave of the width.
fn room_for_names(headings: &[&str], rows: &[(String, Vec<String>)]) -> usize {
    let width = |text: &str| text.chars().count();
    let column = |i: usize| {
        let figures = rows.iter().map(|(_, figures)| width(&figures[i]));
        1 + figures.fold(width(headings[i + 1]), usize::max)
    };
    TABLE_WIDTH.saturating_sub((0..headings.len() - 1).map(column).sum())
}

fn set_columns(table: &mut Table) {
    for (i, column) in table.column_iter_mut().enumerate() {
        if i == 0 {
            column.set_padding((0, 0));
        } else {
            column.set_padding((1, 0)).set_cell_alignment(CellAlignment::Right);
        }
    }
}
