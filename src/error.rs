//! The library's errors. Every message says what was wrong and what to do next.

use std::path::{Path, PathBuf};

/// A `Result` with this crate's [`enum@Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// Who can mend an error; the command line turns it into an exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Blame {
    /// The request itself makes no sense: an unknown name, a value out of range, a scene that contradicts itself. Exit code 2.
    Request,
    /// The request is fine, the world is not: no adapter, an unreadable file, a failed write. Exit code 3.
    World,
    /// The user asked to stop. Exit code 130.
    Interrupt,
}

/// Everything that can go wrong in this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A method, pattern, filter, scene or option that does not exist, or a value out of its range.
    /// The message lists what exists and suggests the nearest.
    #[error("{0}")]
    Request(String),

    /// A scene file or manifest that was read but makes no sense, with the place in the file.
    #[error("{path}:{line}:{column}: {message}")]
    Document {
        /// The file, as the user named it.
        path: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong there and what was expected.
        message: String,
    },

    /// A model that was read but makes no sense or asks for what is not supported.
    #[error("{path}: {message}")]
    Model {
        /// The glTF file, as the user named it.
        path: String,
        /// What is wrong and what was expected.
        message: String,
    },

    /// A file or folder that could not be read or written.
    #[error("could not {action} {}: {source}{}", path.display(), advice(source))]
    Io {
        /// What was tried: "read", "write", "create the folder".
        action: &'static str,
        /// The path it was tried on.
        path: PathBuf,
        /// What the system answered.
        source: std::io::Error,
    },

    /// A file whose bytes are not what its format says.
    #[error("{} is not a readable {expected}: {message}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The format that was expected.
        expected: &'static str,
        /// What the decoder met.
        message: String,
    },

    /// Two pictures that should have the same size.
    #[error("pictures differ in size: {}x{} and {}x{}; compare pictures of one size", .0[0], .0[1], .1[0], .1[1])]
    SizeMismatch([u32; 2], [u32; 2]),

    /// No adapter answered, or none matches what was asked for.
    #[error("{0}")]
    NoAdapter(String),

    /// The adapter lacks what a method or a size needs.
    #[error("{0}")]
    Unsupported(String),

    /// The device failed: validation, out of memory, or lost. No picture was made.
    #[error("the GPU could not do it ({kind}): {message}")]
    Gpu {
        /// `validation`, `out of memory`, `device lost` or `internal`.
        kind: &'static str,
        /// What the driver or wgpu said.
        message: String,
    },

    /// The user pressed Ctrl-C.
    #[error("interrupted; nothing was left half-written")]
    Interrupted,
}

impl Error {
    /// Builds an [`Error::Io`]; meant for `map_err`.
    pub fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_path_buf();
        move |source| Self::Io { action, path, source }
    }

    /// An [`Error::Document`] at a byte of a text, `path` being its file as the user named it.
    #[must_use]
    pub fn at(path: &str, text: &str, offset: usize, message: String) -> Self {
        let before = &text[..text.floor_char_boundary(offset)];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        Self::Document { path: path.to_owned(), line, column, message }
    }

    /// Who can mend this.
    #[must_use]
    pub fn blame(&self) -> Blame {
        match self {
            Self::Request(_) | Self::Document { .. } | Self::Model { .. } | Self::Unsupported(_) | Self::SizeMismatch(..) => {
                Blame::Request
            }
            Self::Io { .. } | Self::Format { .. } | Self::NoAdapter(_) | Self::Gpu { .. } => Blame::World,
            Self::Interrupted => Blame::Interrupt,
        }
    }
}

/// What to do about the commonest system errors.
fn advice(source: &std::io::Error) -> &'static str {
    match source.kind() {
        std::io::ErrorKind::NotFound => "; check the path",
        std::io::ErrorKind::PermissionDenied => "; check the permissions or choose another place",
        std::io::ErrorKind::NotADirectory => "; a folder in the path is a file: check the path",
        std::io::ErrorKind::ReadOnlyFilesystem => "; choose a place that can be written",
        std::io::ErrorKind::StorageFull | std::io::ErrorKind::QuotaExceeded | std::io::ErrorKind::FileTooLarge => {
            "; free some space or choose another place"
        }
        _ => "",
    }
}

/// "`what` 'given' does not exist", with all that do and the nearest one: the one shape of such messages.
#[must_use]
pub fn unknown(what: &str, given: &str, known: &[&str]) -> Error {
    let nearest = known
        .iter()
        .map(|name| (edit_distance(&given.to_lowercase(), name), name))
        .min()
        .filter(|(distance, name)| *distance <= 1 + name.len() / 3);
    let hint = nearest.map_or(String::new(), |(_, name)| format!("; did you mean '{name}'?"));
    Error::Request(format!("unknown {what} '{given}'{hint} (known: {})", known.join(", ")))
}

/// Levenshtein distance in characters.
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_name_lists_the_known_ones_and_suggests_the_nearest() {
        let text = unknown("method", "sssa", &["none", "ssaa", "msaa"]).to_string();
        assert!(text.contains("did you mean 'ssaa'"), "{text}");
        assert!(text.contains("none, ssaa, msaa"), "{text}");
        assert!(!unknown("method", "quite-else", &["none"]).to_string().contains("mean"));
    }

    #[test]
    fn distance_counts_edits() {
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }
}
