//! dejag

#[cfg(feature = "workbench")]
pub mod bench;
#[cfg(feature = "workbench")]
pub mod capture;
#[cfg(feature = "workbench")]
pub mod cli;
pub mod error;
#[cfg(feature = "workbench")]
pub mod forward;
#[cfg(feature = "workbench")]
pub mod gpu;
#[cfg(feature = "passes")]
pub mod methods;
#[cfg(feature = "score")]
pub mod metrics;
#[cfg(feature = "passes")]
pub mod pass;
#[cfg(feature = "score")]
pub mod picture;
#[cfg(feature = "score")]
pub mod report;
#[cfg(feature = "passes")]
pub mod sampling;
#[cfg(feature = "workbench")]
pub mod scene;
#[cfg(feature = "passes")]
pub mod shader;
#[cfg(feature = "score")]
pub mod suite;

pub use error::{Error, Result};
