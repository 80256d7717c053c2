//! The reports' pages as people use them: in a headless Chromium, with its keys and its pointer. Where there is no Chromium the list
//! that `make test` prints says so, and `.ci/run` fails.

mod chromium;
mod list;
mod looks;
mod names;
mod sample;
mod speed;
mod views;
