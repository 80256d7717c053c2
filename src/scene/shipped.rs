//! The scenes that come with the program, one for each class of artefacts.

use super::place::Source;

/// A scene embedded in the program.
#[derive(Debug, Clone, Copy)]
pub struct Shipped {
    /// What it is called, and its file's name.
    pub name: &'static str,
    /// The scene file. It opens with what the scene tests and what right looks like.
    pub text: &'static str,
}

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(Shipped { name: $name, text: include_str!(concat!("../../scenes/", $name, ".toml")) }),*]
    };
}

/// Every scene that comes with the program.
pub const SHIPPED: &[Shipped] = shipped![
    "edges",
    "wires",
    "fence",
    "checker",
    "zoneplate",
    "foliage",
    "neon",
    "glint",
    "wheel",
    "pan",
    "stars",
    "text",
    "far",
    "courtyard",
];

impl Shipped {
    /// What it tests, in a line, without building it.
    #[must_use]
    pub fn about(&self) -> String {
        #[derive(serde::Deserialize)]
        struct About {
            about: String,
        }
        Source::parse(self.name, self.text)
            .and_then(|source| source.deserialize())
            .map_or_else(|_| String::new(), |doc: About| doc.about)
    }
}
