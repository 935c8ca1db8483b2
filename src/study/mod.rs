//! Parametric studies: the same scene at many points of its keys, measured against what is known.
//!
//! ```text
//!   study.json ▸ points ▸ run each: in threads of this process, in processes, or on a cluster (--point K)
//!                           └► points/K.json ▸ reference ▸ study.csv, study.json
//! ```
//!
//! A point whose outcome is on disk and whose scene has not changed is not run again, so that an interrupted study goes on
//! where it was.

mod design;
mod file;
mod gauge;
mod outcome;
mod plan;
mod point;
mod reference;
mod summit;
mod table;

pub use file::{Axis, Design, Field, Measure, Process, Reference, Settings, Study, study_schema};
pub use outcome::PointOutcome;
pub use plan::StudyPlan;
pub use point::StudyMeans;
pub use reference::{FLOOR, Limit};
pub use table::Limits;

use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Mutex, PoisonError, mpsc};

use crate::error::{At, Error, Result};
use crate::history::{memory, processor};
use crate::output::write_json;
use crate::run::{Folder, Shared};

/// Progress of a study.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Points that have an outcome.
    pub done: usize,
    /// All points.
    pub total: usize,
    /// The last of them; absent when the study starts or goes on.
    pub outcome: Option<&'a PointOutcome>,
}

/// Outcome of a study.
#[derive(Debug)]
pub struct StudyDone {
    /// Outcomes of the design's points, then of the reference's.
    pub outcomes: Vec<PointOutcome>,
    /// Number of those in the design.
    pub designed: usize,
    /// Reference of every measure.
    pub limits: Limits,
}

/// Runs every point that has no outcome yet, then writes study.csv and study.json.
pub fn run(plan: &StudyPlan, means: &StudyMeans, listen: &mut dyn FnMut(Progress)) -> Result<StudyDone> {
    let total = plan.len();
    let mut folder = Folder::open(&means.out)?;
    table::check_own(&means.out)?;
    folder.keep();
    let shared = &Shared::new(&means.options, &means.meshes());
    let mut outcomes: Vec<Option<PointOutcome>> =
        (0..total).map(|k| point::earlier(plan, means, shared, k)).collect();
    let missing: VecDeque<usize> = (0..total).filter(|&k| outcomes[k].is_none()).collect();
    let mut done = total - missing.len();
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
                    listen(Progress { done, total, outcome: Some(&outcome) });
                    let k = outcome.point;
                    outcomes[k] = Some(outcome);
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
            return Err(Error::Stopped { signal, kept });
        }
        Some(error) => return Err(error),
        None => {}
    }
    let outcomes: Vec<PointOutcome> = outcomes.into_iter().flatten().collect();
    let designed = plan.designed.min(outcomes.len());
    let limits = table::limits(plan, &outcomes[designed..]);
    table::write(plan, means, &limits, &outcomes)?;
    Ok(StudyDone { outcomes, designed, limits })
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
