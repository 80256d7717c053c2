//! `dejag diff` as a user runs it: exit codes, what is said where, what is written, and what bad files come to. Needs no GPU stack.

mod desk;
mod files;
mod folders;
mod formats;
mod limits;
mod outcomes;
mod pictures;
mod scope;
