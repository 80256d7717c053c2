//! The anti-aliasing methods, one file or folder each. A new one is its file, its shaders and a line in [`METHODS`].

mod adaptive;
mod cmaa2;
mod fxaa;
mod mlaa;
mod morphology;
mod msaa;
mod none;
mod smaa;
mod spec;
mod ssaa;
mod taa;

pub use spec::{Spec, Stage};

use crate::pass::Method;

/// Every method there is, in the order they are listed.
pub const METHODS: &[Method] = &[
    none::METHOD,
    ssaa::METHOD,
    adaptive::METHOD,
    msaa::METHOD,
    fxaa::METHOD,
    mlaa::METHOD,
    smaa::METHOD,
    cmaa2::METHOD,
    taa::METHOD,
];
