//! The command itself, as a user runs it: exit codes, what is said where, and what is left behind.

mod caching;
mod checking;
mod desk;
mod filtering;
mod models;
mod names;
mod outputs;
mod patterns;
mod repeating;
mod scenes;
mod sequences;
mod shards;
mod sizes;
mod stopping;
mod streams;
mod texts;
