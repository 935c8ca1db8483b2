//! The stages from scene to results: the table of contents of the program.
//!
//! read scene ▸ mesh ▸ read meshes ▸ bind ▸ assemble ▸ factor ▸ solve ▸ recover ▸ write

mod clock;
mod folder;
mod linear;
mod prepare;
mod summary;

pub use clock::Clock;
pub use prepare::{Prepared, mesh, prepare};

use std::path::PathBuf;
use std::time::Duration;

use crate::error::Result;
use crate::output::Row;

/// What the user asked for.
#[derive(Debug, Clone)]
pub struct Options {
    /// The scene file or its folder.
    pub scene: PathBuf,
    /// Where results go; `results/<scene>` if absent.
    pub out: Option<PathBuf>,
    /// `KEY=VALUE` settings on top of the scene.
    pub settings: Vec<String>,
    /// The mesher.
    pub gmsh: PathBuf,
    /// Time limit for one run of the mesher.
    pub gmsh_limit: Duration,
}

/// What happens, for whoever shows it.
#[derive(Debug)]
pub enum Event<'a> {
    /// A stage begins.
    Stage(&'static str),
    /// A subdomain has its mesh.
    Meshed {
        /// The subdomain.
        name: &'a str,
        /// Its file.
        path: &'a std::path::Path,
        /// True if it was there already.
        reused: bool,
    },
    /// A joint is built.
    Joint(&'a crate::assembly::Joint),
    /// Something the user should know before believing the result.
    Warning(&'a str),
    /// An increment is done.
    Increment {
        /// Its row of the history.
        row: &'a Row,
        /// Its number within its step.
        number: usize,
        /// Increments of its step.
        of: usize,
        /// Increments of all steps.
        total: usize,
    },
}

/// Whoever listens to the run.
pub type Listener<'a> = &'a mut dyn FnMut(Event);

/// What a run leaves behind.
#[derive(Debug)]
pub struct Done {
    /// The results folder.
    pub folder: PathBuf,
    /// The collection to open.
    pub collection: PathBuf,
    /// Seconds by stage.
    pub clock: Clock,
}

/// Runs a scene.
pub fn run(options: &Options, listen: Listener) -> Result<Done> {
    let prepared = prepare(options, listen)?;
    linear::solve(prepared, listen)
}
