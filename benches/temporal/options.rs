//! The command line.

/// What was asked for.
pub(crate) struct Options {
    /// Scenes to run instead of all.
    pub(crate) only: Vec<String>,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// Frames of a scene in motion. Still ones take twice as many, and 64 at least.
    pub(crate) frames: i64,
    /// Samples a pixel of the reference.
    pub(crate) spp: u32,
    /// Whether passes are timed, not sequences measured.
    pub(crate) cost: bool,
}

impl Options {
    /// None where there is nothing to do: a test harness asks for a list of tests.
    ///
    /// `cargo bench` says `--bench`. Whoever does not only wants to know whether it runs.
    pub(crate) fn read(mut words: impl Iterator<Item = String>) -> Option<Self> {
        let mut options = Self { only: Vec::new(), size: [320, 180], frames: 32, spp: 256, cost: false };
        let mut smoke = true;
        while let Some(word) = words.next() {
            let mut value = || words.next().unwrap_or_else(|| panic!("{word} takes a value"));
            match word.as_str() {
                "--list" => return None,
                "--bench" => smoke = false,
                "--only" => options.only.push(value()),
                "--size" => options.size = size(&value()),
                "--cost" => (options.size, options.cost) = (size(&value()), true),
                "--frames" => options.frames = value().parse().expect("--frames takes a number"),
                // Whatever else a harness says to its own.
                _ => {}
            }
        }
        if smoke {
            (options.size, options.frames, options.spp) = ([32, 18], 2, 4);
        }
        Some(options)
    }
}

fn size(text: &str) -> [u32; 2] {
    let (width, height) = text.split_once('x').expect("--size takes WIDTHxHEIGHT");
    [width, height].map(|side| side.parse().expect("a number of pixels"))
}
