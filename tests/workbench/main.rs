//! Everything that needs the whole workbench: pictures, properties, and the command itself. One binary, so that it links once.

#![expect(clippy::print_stdout, reason = "tests say what they measured")]

mod adaptive;
mod architecture;
mod command;
mod common;
mod edges;
mod embedding;
mod exact;
mod filters;
mod goldens;
mod pictures;
mod rounds;
mod sequence;
mod smaa_modes;
mod taa;
mod whitted;
