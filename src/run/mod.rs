//! The stages from scene to results: the table of contents of the program.
//!
//! read scene ▸ mesh ▸ read meshes ▸ bind ▸ assemble ▸ factor ▸ solve ▸ recover ▸ write

mod folder;
pub mod point;
mod prepare;
mod shared;
mod summary;

pub use prepare::{Prepared, mesh, prepare};
pub use shared::Shared;

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::{Error, Result, Warning};
use crate::history::{Clock, Means, Place, State, Totals, march_within, memory};
use crate::output::{Row, Writer};
use crate::problem::Problem;
use crate::scene::Fields;

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

impl Options {
    /// A scene with gmsh as it is found and nothing else set.
    pub fn of(scene: &Path) -> Options {
        let (gmsh, gmsh_limit) = ("gmsh".into(), Duration::from_secs(600));
        Options { scene: scene.into(), out: None, settings: Vec::new(), gmsh, gmsh_limit }
    }
}

/// What happens, for whoever shows it.
#[derive(Debug)]
pub enum Event<'a> {
    /// A stage begins.
    Stage(&'static str),
    /// A mesh is there.
    Meshed {
        /// The subdomain, or the geometry that several share.
        name: &'a str,
        /// Its file.
        path: &'a Path,
        /// True if it was there already.
        reused: bool,
    },
    /// A joint is built.
    Joint(&'a crate::assembly::Joint),
    /// Something the user should know before believing the result.
    Warning(&'a Warning),
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
        /// The counts so far.
        totals: &'a Totals,
        /// The scene bound to its meshes.
        problem: &'a Problem,
        /// The model after the increment.
        state: &'a State,
    },
    /// Something another run had left was used, such as "factor of lower".
    Reused(&'a str),
}

/// Whoever listens to the run.
pub type Listener<'a> = &'a mut dyn FnMut(Event);

/// What a run leaves behind.
#[derive(Debug)]
pub struct Done {
    /// The results folder.
    pub folder: PathBuf,
    /// The collection to open, or the folder if no fields are written.
    pub collection: PathBuf,
    /// Seconds by stage.
    pub clock: Clock,
    /// The counts.
    pub totals: Totals,
    /// Most memory that the process has taken [bytes]; absent where the system does not tell.
    pub peak_memory: Option<u64>,
}

/// Runs a scene: prepares, solves, writes.
pub fn run(options: &Options, listen: Listener) -> Result<Done> {
    run_sharing(options, None, listen)
}

/// `run` with what other runs of this process have left, and leaving them what they can use.
pub fn run_sharing(options: &Options, shared: Option<&Shared>, listen: Listener) -> Result<Done> {
    let Prepared { scene, name, problem, mut folder, mut clock } =
        prepare::prepare_sharing(options, shared, listen)?;
    let path = folder.path().to_path_buf();
    let total: usize = problem.stages.iter().map(|stage| stage.increments).sum();
    let listen = std::cell::RefCell::new(listen);
    let mut writer: Option<Writer> = None;
    let (mut balance, mut kept, mut stored) = (None, Totals::default(), 0);
    let mut visit = |place: Place, state: &State, totals: &Totals, clock: &mut Clock| -> Result<()> {
        (listen.borrow_mut())(Event::Stage("write"));
        clock.begin("write");
        let fields = scene.output.fields;
        if place.number == 0 {
            // the first factor stands: a run that is refused before leaves the last results in place
            folder.keep();
            let mut opened = Writer::create(&path, &name, &prepare::columns(&problem))?;
            opened.midplanes(&problem.model)?;
            if matches!(fields, Fields::Every | Fields::Step) {
                opened.fields(&problem.model, &state.snapshot, 0, 0.0)?;
            }
            writer = Some(opened);
            return Ok(());
        }
        let Some(writer) = &mut writer else { return Ok(()) };
        let wanted = match fields {
            Fields::Every => true,
            Fields::Step => place.ended || place.last,
            Fields::Last => place.ended || place.last && place.step + 1 == problem.stages.len(),
            Fields::None => false,
        };
        if wanted && stored < place.increment {
            let time = place.step as f64 + place.load_factor;
            writer.fields(&problem.model, &state.snapshot, place.increment, time)?;
            stored = place.increment;
        }
        if !state.force.is_empty() {
            balance = Some(summary::balance(&problem.model, &state.force, &state.reactions));
        }
        kept = totals.clone();
        if place.ended {
            return Ok(()); // its row is written
        }
        let row = Row {
            step: place.stage.name.clone(),
            increment: place.increment,
            load_factor: place.load_factor,
            iterations: place.iterations,
            residual: state.residual,
            energy_balance: state.energy_balance(),
            values: state.probes(&problem),
        };
        writer.row(&row)?;
        let of = place.stage.increments;
        let (number, problem) = (place.number, &problem);
        (listen.borrow_mut())(Event::Increment { row: &row, number, of, total, totals, problem, state });
        Ok(())
    };
    let means = Means { memory: memory::available(), shelf: shared.map(|shared| shared.shelf.clone()) };
    let mut stage = |name| (listen.borrow_mut())(Event::Stage(name));
    let marched = march_within(means, &problem, &mut clock, &mut stage, &mut visit);
    let (totals, end) = match marched {
        Ok(totals) => (totals, None),
        Err(end @ Error::NoEquilibrium { .. }) => (kept, Some(end)),
        Err(other) => return Err(other),
    };
    totals.reused.iter().for_each(|what| (listen.borrow_mut())(Event::Reused(what)));
    for warning in &totals.warnings(problem.solution.path_tolerance) {
        (listen.borrow_mut())(Event::Warning(warning));
    }
    if let (Some(writer), Some(balance)) = (&writer, balance) {
        let end = end.as_ref().map(Error::to_string);
        writer.summary(&summary::summary(&scene, &name, &problem, &totals, balance, &clock, end))?;
    }
    if let Some(end) = end {
        return Err(end);
    }
    let collection = match scene.output.fields {
        Fields::None => path.clone(),
        _ => path.join(format!("{name}.pvd")),
    };
    Ok(Done { folder: path, collection, clock, totals, peak_memory: memory::peak() })
}
