//! `dejag diff`, `check`, `bless` and `merge` as a user runs them: exit codes, what is said where, what is written, and what bad files
//! come to. Needs no GPU stack.

mod check;
mod checks;
mod ci;
mod desk;
mod files;
mod folders;
mod formats;
mod github;
mod junit;
mod limits;
mod outcomes;
mod pictures;
mod schema;
mod scope;
