//! The stages from scene to results: the table of contents of the program.
//!
//! read scene ▸ mesh ▸ read meshes ▸ bind ▸ assemble ▸ factor ▸ solve ▸ recover ▸ write

mod checkpoint;
mod folder;
mod identity;
mod keeper;
mod lock;
mod places;
pub mod point;
mod prepare;
mod presets;
mod results;
mod resume;
mod shared;
mod summary;

pub use folder::Folder;
pub use keeper::Every;
pub use prepare::{Prepared, mesh, prepare};
pub use presets::{parse_scene, read_scene};
pub use shared::Shared;

use identity::Identity;
use keeper::Keeper;
use results::Results;

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::{Error, Result, Stop, Warning};
use crate::history::{Clock, Equations, History, Means, ModelState, StageNow, Totals, memory};
use crate::mesh::Gmsh;
use crate::output::{self, HistoryRow};
use crate::problem::Problem;
use crate::scene::Fields;

/// Options of a run.
#[derive(Debug, Clone)]
pub struct Options {
    /// The scene file or its folder.
    pub scene: PathBuf,
    /// Folder of the results; `results/<scene>` if absent.
    pub out: Option<PathBuf>,
    /// `KEY=VALUE` settings on top of the scene.
    pub settings: Vec<String>,
    /// The mesher.
    pub gmsh: PathBuf,
    /// Time limit for one run of the mesher.
    pub gmsh_limit: Duration,
    /// Memory for one run of the mesher [bytes]; a share of all if absent.
    pub gmsh_memory: Option<u64>,
    /// Folders that geometries may read, beside that of the scene.
    pub geo_paths: Vec<PathBuf>,
    /// Geometries may do what the user may.
    pub trust_geo: bool,
    /// A request to stop: the run ends with what has converged.
    pub stop: Stop,
    /// Goes on from the last checkpoint in the folder, if there is one.
    pub resume: bool,
    /// How often a checkpoint is written.
    pub checkpoints: Every,
}

impl Options {
    /// A scene with gmsh as it is found and nothing else set.
    pub fn of(scene: &Path) -> Options {
        let (gmsh, gmsh_limit) = ("gmsh".into(), Duration::from_secs(600));
        let (out, settings, stop) = (None, Vec::new(), Stop::default());
        let (resume, checkpoints) = (false, Every::Seconds(60.0));
        let (gmsh_memory, geo_paths, trust_geo) = (None, Vec::new(), false);
        Options {
            scene: scene.into(),
            out,
            settings,
            gmsh,
            gmsh_limit,
            gmsh_memory,
            geo_paths,
            trust_geo,
            stop,
            resume,
            checkpoints,
        }
    }

    /// The mesher, which may read the folder of the scene and those that are listed.
    fn mesher(&self) -> Gmsh {
        let scene = std::path::absolute(&self.scene).unwrap_or_else(|_| self.scene.clone());
        let folder = if scene.is_dir() { Some(scene.as_path()) } else { scene.parent() };
        let readable = folder.map(Path::to_path_buf).into_iter().chain(self.geo_paths.iter().cloned());
        let readable: Vec<PathBuf> = readable.collect();
        let gmsh = Gmsh::new(&self.gmsh, self.gmsh_limit).until(&self.stop);
        let gmsh = gmsh.allowing(&readable, self.trust_geo);
        self.gmsh_memory.into_iter().fold(gmsh, Gmsh::within)
    }
}

/// Events of a run, to be shown.
#[derive(Debug)]
pub enum Event<'a> {
    /// The run has begun; the stage under way can be read from now on.
    Began(&'a StageNow),
    /// A mesh is there.
    Meshed {
        /// The subdomain, or the geometry that several share.
        name: &'a str,
        /// Its file.
        path: &'a Path,
        /// True if it was there already.
        reused: bool,
    },
    /// An interface is built.
    Interface(&'a crate::assembly::InterfaceOperator),
    /// Something the user should know before believing the result.
    Warning(&'a Warning),
    /// An increment is done.
    Increment {
        /// Its row of the history.
        row: &'a HistoryRow,
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
        state: &'a ModelState,
    },
    /// Something another run had left was used, such as "factor of lower".
    Reused(&'a str),
    /// The run goes on from a checkpoint, or begins although it was to go on.
    Resumed(&'a Resumed),
    /// A geometry was meshed that the kernel does not confine.
    Unconfined,
    /// The results of another scene in the folder go when the first row of this one is complete.
    Replaces(&'a str),
    /// What a run that failed has kept of its own, and how to go on.
    Kept(&'a str),
    /// A run that failed has left the results of an earlier one in their folder.
    Left(&'a Path),
}

/// Start of a run that was to go on.
#[derive(Debug, Clone, PartialEq)]
pub enum Resumed {
    /// There is no checkpoint.
    Anew,
    /// After so many increments.
    After {
        /// The increments.
        increments: usize,
        /// Why it is not a later checkpoint, if there is one.
        passed: Option<String>,
    },
}

/// Receiver of events.
pub type Listener<'a> = &'a mut dyn FnMut(Event);

/// Outcome of a run.
#[derive(Debug)]
pub struct RunDone {
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
pub fn run(options: &Options, listen: Listener) -> Result<RunDone> {
    run_sharing(options, None, listen)
}

/// `run` with what other runs of this process have left, and leaving them what they can use.
pub fn run_sharing(options: &Options, shared: Option<&Shared>, listen: Listener) -> Result<RunDone> {
    let mut placed = false;
    let done = attempt(options, shared, &mut placed, listen);
    if let (Err(error), false) = (&done, placed)
        && !matches!(error, Error::Folder { .. })
        && let Some(folder) = prepare::earlier_results(options)
    {
        listen(Event::Left(&folder));
    }
    done
}

/// A run; `placed` becomes true when its results are in their place.
fn attempt(
    options: &Options,
    shared: Option<&Shared>,
    placed: &mut bool,
    listen: Listener,
) -> Result<RunDone> {
    let Prepared { scene, name, problem, folder, mut clock } =
        prepare::prepare_sharing(options, shared, listen)?;
    let path = folder.path().to_path_buf();
    let mut results = Results::new(&scene, &name, &problem, folder)?;
    if let Some(other) = &results.other {
        listen(Event::Replaces(other));
    }
    let keeps = options.checkpoints != Every::Never;
    let identity = (keeps || options.resume).then(|| Identity::new(&scene, &problem));
    let resumed = match identity.as_ref().filter(|_| options.resume) {
        Some(identity) => resume::find(&mut results, identity, listen)?,
        None => None,
    };
    let method = resumed.as_ref().map(|checkpoint| checkpoint.method());
    let cache = shared.map(|shared| shared.cache.clone());
    let means = Means { cache, stop: options.stop.clone(), method, ..Means::default() };
    let equations = Equations::new(&problem, means, &mut clock)?;
    let mut history = match resumed {
        Some(checkpoint) => resume::history(&problem, &equations, clock, checkpoint, results.path())?,
        None => History::new(&problem, &equations, clock),
    };
    let increments = history.totals().increments;
    let mut keeper = Keeper::new(options.checkpoints, identity.as_ref(), &problem, increments)?;
    let followed = follow(&mut history, &mut results, &mut keeper, &options.stop, listen);
    *placed = !results.leaves_earlier();
    if followed.is_err() {
        // what ended the run is told, not that its state cannot be kept for the same reason
        let _ = keeper.end(&mut results);
    }
    let end = match followed {
        Ok(()) => None,
        Err(end @ Error::NoEquilibrium { .. }) => Some(presets::suspected(end, scene.accuracy)),
        Err(Error::Stopped { signal, .. }) if *placed => {
            Some(Error::Stopped { signal, kept: kept(history.totals().increments, &path, keeps) })
        }
        Err(end @ Error::Stopped { .. }) => Some(end),
        Err(other) => {
            if results.has_rows() {
                listen(Event::Kept(&kept(history.totals().increments, &path, keeps)));
            }
            return Err(other);
        }
    };
    if end.is_none() {
        results.finish(history.state())?;
    }
    equations.reused().iter().for_each(|what| listen(Event::Reused(what)));
    if end.is_none() {
        results.totals = history.totals().clone();
    }
    for warning in &results.totals.warnings(problem.solution.path_tolerance) {
        listen(Event::Warning(warning));
    }
    results.summary(history.clock(), end.as_ref())?;
    if let Some(end) = end {
        return Err(end);
    }
    let collection = match scene.output.fields {
        Fields::None => path.clone(),
        _ => path.join(output::collection(&name)),
    };
    let (clock, totals) = (history.clock().clone(), results.totals);
    Ok(RunDone { folder: path, collection, clock, totals, peak_memory: memory::peak() })
}

/// What a run that was stopped has left, and how to go on.
fn kept(increments: usize, folder: &Path, goes_on: bool) -> String {
    let place = folder.display();
    let how = if goes_on { ", --resume goes on from there" } else { "" };
    match increments {
        0 => format!("kept the unloaded state in {place}"),
        1 => format!("kept 1 increment in {place}{how}"),
        many => format!("kept {many} increments in {place}{how}"),
    }
}

/// Goes through the history, writes every increment, tells of it and keeps the state.
fn follow(
    history: &mut History,
    results: &mut Results,
    keeper: &mut Keeper,
    stop: &Stop,
    listen: Listener,
) -> Result<()> {
    let problem = results.problem;
    let total: usize = problem.steps.iter().map(|step| step.increments).sum();
    while let Some(increment) = history.next()? {
        history.clock().begin("write");
        let (state, totals) = (history.state(), history.totals());
        let row = results.write(&increment, state, totals)?;
        keeper.after(&increment, history, results, stop.requested().is_some())?;
        if let Some(row) = row {
            let (number, of) = (increment.number, increment.step.increments);
            let (state, totals) = (history.state(), history.totals());
            listen(Event::Increment { row: &row, number, of, total, totals, problem, state });
        }
    }
    Ok(())
}
