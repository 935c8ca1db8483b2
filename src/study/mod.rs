//! Parametric studies: the same scene at many points of its keys, measured against what is known.
//!
//! ```text
//!   study.json ▸ points ▸ run each: in threads of this process, in processes, or on a cluster (--shard K/N, --point K)
//!                           └► points/K.json ▸ reference ▸ study.csv, study.json
//! ```
//!
//! Points are made when they are needed and outcomes read when they are written into the tables: a study of many points holds
//! a number or two of each.
//!
//! A point whose outcome is on disk and whose scene has not changed is not run again, so that an interrupted study goes on
//! where it was.

mod csv;
mod design;
mod file;
mod gauge;
mod json;
mod outcome;
mod plan;
mod point;
mod reference;
mod selection;
mod summit;
mod table;

pub use file::{Axis, Design, Field, Measure, Process, Reference, Settings, Study, study_schema};
pub use outcome::PointOutcome;
pub use plan::StudyPlan;
pub use point::StudyMeans;
pub use reference::{FLOOR, Limit};
pub use selection::{Selection, Shard};
pub use table::{Limits, StudyDone};

use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Mutex, PoisonError, mpsc};

use crate::error::{At, Error, Result};
use crate::history::{memory, processor};
use crate::output::write_json;
use crate::run::{Folder, Shared};
use table::StudyTable;

/// Progress of a study.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Selected points that have an outcome.
    pub done: usize,
    /// Selected points.
    pub total: usize,
    /// The last of them; absent when the study starts or goes on.
    pub outcome: Option<&'a PointOutcome>,
}

/// Outcome of a shard.
#[derive(Debug, Default)]
pub struct ShardDone {
    /// Number of its points.
    pub points: usize,
    /// Number of those that failed.
    pub failed: usize,
}

/// Runs every point that has no outcome yet, then writes study.csv and study.json.
pub fn run(plan: &StudyPlan, means: &StudyMeans, listen: &mut dyn FnMut(Progress)) -> Result<StudyDone> {
    let mut folder = Folder::open(&means.out)?;
    table::check_own(&means.out)?;
    folder.keep();
    let shared = Shared::new(&means.options, &means.meshes());
    run_selected(plan, means, &shared, listen)?;
    write(StudyTable::survey(plan, means, &shared)?)
}

/// Runs every point of the plan's shard that has no outcome yet. Other processes may run other shards into the same folder.
pub fn run_shard(
    plan: &StudyPlan,
    means: &StudyMeans,
    listen: &mut dyn FnMut(Progress),
) -> Result<ShardDone> {
    table::check_own(&means.out)?;
    run_selected(plan, means, &Shared::new(&means.options, &means.meshes()), listen)
}

/// Writes study.csv and study.json of the points that have an outcome, and runs none.
pub fn collect(plan: &StudyPlan, means: &StudyMeans) -> Result<StudyDone> {
    let mut folder = Folder::open(&means.out)?;
    table::check_own(&means.out)?;
    let shared = Shared::new(&means.options, &means.meshes());
    let table = StudyTable::survey(plan, means, &shared)?;
    if table.is_empty() {
        return Err(Error::Text {
            at: Box::new(At { key: "--collect".into(), ..Default::default() }),
            what: format!("no point of the study as it is now is in {}", means.out.display()),
            help: "run its shards first, into this folder".into(),
        });
    }
    folder.keep();
    write(table)
}

/// Writes both files.
fn write(table: StudyTable) -> Result<StudyDone> {
    json::write(&table)?;
    csv::write(&table)?;
    Ok(table.done())
}

/// Runs the selected points that have no outcome yet.
fn run_selected(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    listen: &mut dyn FnMut(Progress),
) -> Result<ShardDone> {
    let (mut done, mut failed, mut missing) = (0, 0, VecDeque::new());
    for k in plan.selected() {
        match point::earlier(plan, means, shared, k)? {
            Some(outcome) => {
                done += 1;
                failed += usize::from(!outcome.done());
            }
            None => missing.push_back(k),
        }
    }
    let total = done + missing.len();
    listen(Progress { done, total, outcome: None });
    let queue = &Mutex::new(missing);
    let (send, received) = mpsc::channel();
    let first_error = std::thread::scope(|scope| {
        for _ in 0..means.jobs {
            let send = send.clone();
            scope.spawn(move || work(plan, means, shared, queue, &send));
        }
        drop(send);
        let mut first_error = None;
        for result in received {
            match result {
                Ok(outcome) => {
                    done += 1;
                    failed += usize::from(!outcome.done());
                    listen(Progress { done, total, outcome: Some(&outcome) });
                }
                Err(error) => {
                    // what is wrong with the machine concerns all points
                    queue.lock().unwrap_or_else(PoisonError::into_inner).clear();
                    first_error.get_or_insert(error);
                }
            }
        }
        first_error
    });
    match first_error {
        Some(Error::Stopped { signal, .. }) => {
            let kept =
                format!("kept {done} of {total} points in {}, the same command goes on", means.out.display());
            Err(Error::Stopped { signal, kept })
        }
        Some(error) => Err(error),
        None => Ok(ShardDone { points: total, failed }),
    }
}

/// Takes points from the queue until it is empty.
fn work(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    queue: &Mutex<VecDeque<usize>>,
    send: &mpsc::Sender<Result<PointOutcome>>,
) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(means.threads).build();
    let pool =
        pool.map_err(|error| point::broken(&format!("cannot start {} threads: {error}", means.threads)));
    match pool {
        Ok(pool) => loop {
            let next = queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
            let Some(k) = next else { break };
            let outcome = pool.install(|| point::run_point(plan, means, shared, k));
            if send.send(outcome).is_err() {
                break; // nobody listens any more
            }
        },
        // if nobody listens there is nobody to tell
        Err(error) => drop(send.send(Err(error))),
    }
}

/// Runs exactly one point, whatever there is of it.
pub fn run_one(plan: &StudyPlan, means: &StudyMeans, point: usize) -> Result<PointOutcome> {
    known(plan, point)?;
    let shared = Shared::new(&means.options, &means.meshes());
    point::run_point(plan, means, &shared, point)
}

/// One run of a point in this process, its outcome written to `file`: what a process of its own does.
pub fn run_once(plan: &StudyPlan, means: &StudyMeans, point: usize, file: &Path) -> Result<PointOutcome> {
    known(plan, point)?;
    let shared = Shared::new(&means.options, &means.meshes());
    let mut outcome = point::run_once(plan, means, &shared, point)?;
    outcome.peak_memory = memory::peak();
    outcome.processor = processor().into_iter().collect();
    write_json(file, &outcome)?;
    Ok(outcome)
}

fn known(plan: &StudyPlan, point: usize) -> Result<()> {
    match plan.len() {
        total if point < total => Ok(()),
        total => Err(Error::Text {
            at: Box::new(At { key: format!("--point {point}"), ..Default::default() }),
            what: format!("the study has {total} points"),
            help: format!("they count from 0 to {}", total.max(1) - 1),
        }),
    }
}
