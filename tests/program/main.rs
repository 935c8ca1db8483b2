//! The program as its users meet it: `cargo test --release --test program study::` runs the tests of one file.
//!
//! ## Scenes
//!
//! - `bad_input`: bad input gives one clear error with its place, and nothing is written
//! - `absurd`: counts, names and texts are checked before they are believed
//! - `expressions`: numbers of a scene may be formulas, exact where they act, refused where they fail
//! - `patterns`: a pattern is the names that fit it
//! - `presets`: the error of every preset stays within its limit
//! - `units`: no number in the program has a unit
//!
//! ## Runs and their files
//!
//! - `check`: `midplane check` says of every interface what it is, and warns of what spoils it
//! - `folders`: a results folder belongs to one run at a time
//! - `results`: the results folder holds the files of the last run and those of others
//! - `rows`: history.csv, the .pvd and summary.json tell the same rows
//! - `going_on`: an interrupted run goes on with `--resume`, byte by byte
//! - `pipes`: whoever reads the output has no say in the run
//!
//! ## Studies
//!
//! - `study`: a study runs every point of its axes with the answers of single runs
//! - `study_shards`: shards collected have the answers of one process
//!
//! ## Safety and form
//!
//! - `hostile`: a geometry from a stranger is contained
//! - `faults`: faults that users met stay mended
//! - `warnings`: every code of a warning has its section in docs/WARNINGS.md
//! - `rooms`: rooms import one way, and every file says what it is
#![allow(missing_docs, clippy::unwrap_used)]

#[allow(dead_code)] // each program of tests uses a part of it
#[path = "../common/mod.rs"]
mod common;

mod absurd;
mod bad_input;
mod check;
mod expressions;
mod faults;
mod folders;
mod going_on;
mod hostile;
mod patterns;
mod pipes;
mod presets;
mod results;
mod rooms;
mod rows;
mod study;
mod study_shards;
mod units;
mod warnings;
