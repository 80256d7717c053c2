//! Colour on a terminal, or none.

/// ANSI escapes, or none.
pub(super) struct Ink {
    pub(super) color: bool,
}

impl Ink {
    fn paint(&self, code: u8, text: &str) -> String {
        if self.color && !text.is_empty() { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.to_string() }
    }

    pub(super) fn bold(&self, text: &str) -> String {
        self.paint(1, text)
    }

    pub(super) fn dim(&self, text: &str) -> String {
        self.paint(2, text)
    }

    pub(super) fn red(&self, text: &str) -> String {
        self.paint(31, text)
    }

    pub(super) fn green(&self, text: &str) -> String {
        self.paint(32, text)
    }

    pub(super) fn yellow(&self, text: &str) -> String {
        self.paint(33, text)
    }
}
