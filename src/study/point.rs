//! One point: run in this process beside others, or in a process of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use indexmap::IndexMap;

use super::file::Process;
use super::gauge::Gauge;
use super::outcome::{LIMIT, PointOutcome};
use super::plan::StudyPlan;
use crate::error::{Error, Result};
use crate::output::write_json;
use crate::run::{self, Event, Every, Options, Shared};

/// Means by which points are run.
#[derive(Debug, Clone)]
pub struct StudyMeans {
    /// Folder of the study.
    pub out: PathBuf,
    /// The study's file, for processes of their own.
    pub file: PathBuf,
    /// The mesher and its time limit.
    pub options: Options,
    /// Points side by side.
    pub jobs: usize,
    /// Threads of every point.
    pub threads: usize,
}

impl StudyMeans {
    /// The folder of a point's results.
    pub(super) fn folder(&self, point: usize) -> PathBuf {
        self.out.join("points").join(format!("{point:04}"))
    }

    /// The file of a point's outcome.
    pub(super) fn file(&self, point: usize) -> PathBuf {
        self.out.join("points").join(format!("{point:04}.json"))
    }

    /// Folder of the meshes of all points.
    pub(super) fn meshes(&self) -> PathBuf {
        self.out.join("mesh")
    }
}

/// The outcome of a point that was run before, if nothing that files decide of it has changed.
pub(super) fn kept(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    point: usize,
) -> Result<Option<PointOutcome>> {
    let Some(outcome) = read(&means.file(point)) else { return Ok(None) };
    let key = plan.key(shared, point)?.unwrap_or_default();
    let same = outcome.point == point && outcome.key == key && outcome.settings == plan.point(point).settings;
    Ok(same.then_some(outcome))
}

/// The same, if nothing at all that decides it has changed: it need not be run again.
pub(super) fn earlier(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    point: usize,
) -> Result<Option<PointOutcome>> {
    Ok(kept(plan, means, shared, point)?.filter(|outcome| !outcome.key.is_empty()))
}

/// Runs a point as often as the study says and keeps its outcome.
pub(super) fn run_point(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    point: usize,
) -> Result<PointOutcome> {
    let mut outcome: Option<PointOutcome> = None;
    for repeat in 0..plan.study.repeat {
        let once = match plan.study.process {
            Process::Shared => run_once(plan, means, shared, point)?,
            Process::Own => run_apart(means, point, repeat)?,
        };
        match &mut outcome {
            None => outcome = Some(once),
            Some(first) => {
                first.seconds.extend(once.seconds);
                first.processor.extend(once.processor);
                first.stages.extend(once.stages);
                first.peak_memory = first.peak_memory.max(once.peak_memory);
            }
        }
        if outcome.as_ref().is_some_and(|outcome| !outcome.done()) {
            break;
        }
    }
    let outcome = outcome.ok_or_else(|| broken("a point was not run at all"))?;
    write_json(&means.file(point), &outcome)?;
    Ok(outcome)
}

/// One run in this process. What is wrong with the point is its outcome; what is wrong with the machine is an error.
pub(super) fn run_once(
    plan: &StudyPlan,
    means: &StudyMeans,
    shared: &Shared,
    point: usize,
) -> Result<PointOutcome> {
    let settings = plan.point(point).settings;
    let key = plan.key(shared, point)?.unwrap_or_default();
    let options = Options {
        scene: plan.scene.clone(),
        out: Some(means.folder(point)),
        settings: settings.clone(),
        checkpoints: Every::Never, // a study goes on point by point
        ..means.options.clone()
    };
    let start = Instant::now();
    let (mut gauge, mut reused) = (Gauge::new(&plan.study.measures), Vec::new());
    let mut listen = |event: Event| match event {
        Event::Meshed { name, reused: true, .. } => reused.push(format!("mesh of {name}")),
        Event::Reused(what) => reused.push(what.into()),
        Event::Increment { row, totals, problem, state, .. } => gauge.look(row, totals, problem, state),
        _ => {}
    };
    let done = run::run_sharing(&options, Some(shared), &mut listen);
    let seconds = start.elapsed().as_secs_f64();
    let (status, message, stages) = match done {
        Ok(done) => {
            let stages = done.clock.stages().iter().map(|&(name, seconds)| (name.to_string(), seconds));
            ("done", String::new(), stages.collect())
        }
        Err(error) if error.exit_code() == 4 || matches!(error, Error::Stopped { .. }) => return Err(error),
        Err(error @ Error::NoEquilibrium { .. }) => {
            let status = if gauge.seeks_limit() { LIMIT } else { "stopped" };
            (status, error.to_string(), IndexMap::new())
        }
        Err(error) => ("refused", error.to_string(), IndexMap::new()),
    };
    let known = |value: f64| value.is_finite().then_some(value);
    let values = gauge.values().into_iter().map(|(name, value)| (name, known(value))).collect();
    Ok(PointOutcome {
        point,
        key,
        settings,
        status: status.into(),
        message,
        values,
        counts: gauge.counts.iter().map(|(name, value)| (name.to_string(), *value)).collect(),
        strategy: gauge.method.into(),
        seconds: vec![seconds],
        processor: Vec::new(),
        stages: vec![stages],
        peak_memory: None,
        reused,
    })
}

/// One run in a process of its own, timed from outside.
fn run_apart(means: &StudyMeans, point: usize, repeat: usize) -> Result<PointOutcome> {
    let program = std::env::current_exe().map_err(Error::io("find", "the program"))?;
    let once = means.out.join("points").join(format!(".{point:04}-{repeat}.json"));
    let mut command = Command::new(program);
    command.arg("study").arg(&means.file).arg("--out").arg(&means.out);
    command.arg("--gmsh").arg(&means.options.gmsh);
    command.arg("--gmsh-limit").arg(means.options.gmsh_limit.as_secs().to_string());
    if let Some(memory) = means.options.gmsh_memory {
        command.arg("--gmsh-memory").arg(format!("{}", memory as f64 / f64::from(1 << 30)));
    }
    command.args(means.options.geo_paths.iter().flat_map(|path| ["--geo-path".as_ref(), path.as_os_str()]));
    if means.options.trust_geo {
        command.arg("--trust-geo");
    }
    command.args(["--point", &point.to_string(), "--threads", &means.threads.to_string(), "--once"]);
    command.arg(&once).stdin(Stdio::null()).stdout(Stdio::null());
    let start = Instant::now();
    let output = command.output().map_err(Error::io("start", "a process of a point"))?;
    let seconds = start.elapsed().as_secs_f64();
    if let Some(signal) = means.options.stop.requested() {
        return Err(Error::stopped(signal));
    }
    let read = read(&once);
    // it may not be there, and is of no use any more if it is
    let _ = std::fs::remove_file(&once);
    let mut outcome = read.ok_or_else(|| {
        let said = String::from_utf8_lossy(&output.stderr);
        broken(&format!("point {point} ended with {}: {}", output.status, said.trim()))
    })?;
    outcome.seconds = vec![seconds];
    Ok(outcome)
}

fn read(file: &Path) -> Option<PointOutcome> {
    serde_json::from_str(&std::fs::read_to_string(file).ok()?).ok()
}

pub(super) fn broken(what: &str) -> Error {
    Error::Program { program: "midplane".into(), what: what.into(), help: "run it again".into() }
}
