//! The command itself, as a user runs it.
