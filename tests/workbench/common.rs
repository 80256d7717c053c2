//! The one place that decides which adapter tests use.
//!
//! `DEJAG_TEST_ADAPTER=software` (the default) takes a software rasteriser and nothing else; `auto` takes what a user would get.
//! A machine where none answers fails the tests: it never skips them.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::sync::OnceLock;

use dejag::gpu::{AdapterChoice, Gpu};

/// What `--adapter` should say in tests of the command.
pub(crate) fn adapter() -> &'static str {
    static NAME: OnceLock<String> = OnceLock::new();
    NAME.get_or_init(|| match std::env::var("DEJAG_TEST_ADAPTER").as_deref() {
        Err(_) | Ok("software") => "software".into(),
        Ok("auto") => "auto".into(),
        Ok(other) => panic!("DEJAG_TEST_ADAPTER={other} is neither software nor auto"),
    })
}

/// A device for a test.
pub(crate) fn gpu() -> Gpu {
    let choice: AdapterChoice = adapter().parse().expect("infallible");
    Gpu::open(&choice).unwrap_or_else(|error| panic!("the tests need an adapter: {error}"))
}

/// Whether a test of lavapipe's very bits applies. Where it doesn't, its name is added to the list that `make test` prints.
pub(crate) fn lavapipe_bits(gpu: &Gpu, test: &str) -> bool {
    let software = gpu.card.name.contains("llvmpipe");
    if !software {
        not_applicable(gpu, test);
    }
    software
}

/// Adds a line to the list that `make test` prints.
pub(crate) fn not_applicable(gpu: &Gpu, test: &str) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-applicable.txt");
    let mut list = OpenOptions::new().create(true).append(true).open(path).expect("the list can be written");
    writeln!(list, "not applicable on {}: {test}", gpu.card.name).expect("the list can be written");
}
