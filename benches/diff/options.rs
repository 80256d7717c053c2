//! The command line.

use std::path::PathBuf;

const HELP: &str = "\
--peers DIR    where peers are installed, else DEJAG_PEERS names it:
                 npm install --prefix DIR odiff-bin pixelmatch pngjs
                 cargo install --root DIR dify
               ImageMagick's compare is looked for in PATH
--pairs N      pairs in the folders [200]
--single N     of these, how many are compared a process a pair [60]
--flips N      of these, how many are compared by FLIP [12]
--size WxH     [1920x1080]
--folder DIR   write the pictures there, into a new folder, and leave them
--large        also --max-flip of two pictures of 16384x16384, which takes minutes";

/// What was asked for.
pub(crate) struct Options {
    /// Where other programs are installed.
    pub(crate) peers: Option<PathBuf>,
    /// Pairs in the folders.
    pub(crate) pairs: usize,
    /// Of these, how many are compared a process a pair.
    pub(crate) single: usize,
    /// Of these, how many are compared by FLIP.
    pub(crate) flips: usize,
    /// Width and height in pixels.
    pub(crate) size: [u32; 2],
    /// Where the pictures go, if they are to stay.
    pub(crate) folder: Option<PathBuf>,
    /// Whether a very large pair is measured, too.
    pub(crate) large: bool,
}

impl Options {
    /// None where there is nothing to do: a test harness asks for a list of tests, or a person for help.
    ///
    /// `cargo bench` says `--bench`. Whoever does not only wants to know whether it runs.
    pub(crate) fn read(mut words: impl Iterator<Item = String>) -> Option<Self> {
        let peers = std::env::var_os("DEJAG_PEERS").map(PathBuf::from);
        let mut options = Self { peers, pairs: 200, single: 60, flips: 12, size: [1920, 1080], folder: None, large: false };
        let mut smoke = true;
        while let Some(word) = words.next() {
            let mut value = || words.next().unwrap_or_else(|| panic!("{word} takes a value"));
            match word.as_str() {
                "--list" => return None,
                "--help" => {
                    println!("{HELP}");
                    return None;
                }
                "--bench" => smoke = false,
                "--peers" => options.peers = Some(value().into()),
                "--pairs" => options.pairs = number(&value()),
                "--single" => options.single = number(&value()),
                "--flips" => options.flips = number(&value()),
                "--size" => options.size = size(&value()),
                "--folder" => options.folder = Some(value().into()),
                "--large" => options.large = true,
                // Whatever else a harness says to its own.
                _ => {}
            }
        }
        if smoke {
            (options.pairs, options.flips, options.size, options.large) = (3, 1, [160, 90], false);
        }
        Some(options)
    }
}

fn number(text: &str) -> usize {
    text.parse().ok().filter(|n| *n > 0).expect("a number of pairs")
}

fn size(text: &str) -> [u32; 2] {
    let (width, height) = text.split_once('x').expect("--size takes WIDTHxHEIGHT");
    [width, height].map(|side| side.parse().expect("a number of pixels"))
}
