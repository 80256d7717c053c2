//! Everything that needs the whole workbench: pictures, properties, and the command itself. One binary, so that it links once.

mod architecture;
mod command;
mod common;
mod exact;
mod pictures;
mod rounds;
