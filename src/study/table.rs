//! Table of a study: which points have an outcome, the names of its columns, the references of its measures.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use indexmap::{IndexMap, IndexSet};
use serde::Deserialize;

use super::file::Measure;
use super::outcome::PointOutcome;
use super::plan::StudyPlan;
use super::point::{self, StudyMeans};
use super::reference::Limit;
use crate::error::{Error, Result};
use crate::run::Shared;

/// Reference of every measure.
pub type Limits = IndexMap<String, Limit>;

/// Outcome of a study.
#[derive(Debug)]
pub struct StudyDone {
    /// Number of points in the table: those of the design that have an outcome.
    pub points: usize,
    /// Number of those that failed.
    pub failed: usize,
    /// Number of points without an outcome, those of the reference included.
    pub missing: usize,
    /// The first of them.
    pub first_missing: Option<usize>,
    /// Reference of every measure.
    pub limits: Limits,
}

/// Table of a study. It knows which points have an outcome; the outcomes stay on disk until their rows are written.
pub(super) struct StudyTable<'a> {
    pub(super) plan: &'a StudyPlan,
    pub(super) means: &'a StudyMeans,
    shared: &'a Shared,
    pub(super) limits: Limits,
    /// Points of the design that have an outcome.
    pub(super) there: Vec<usize>,
    failed: usize,
    pub(super) missing: usize,
    first_missing: Option<usize>,
    pub(super) references: Vec<PointOutcome>,
    /// Names of the stages and of the counts of all points.
    pub(super) stages: IndexSet<String>,
    pub(super) counts: IndexSet<String>,
}

impl<'a> StudyTable<'a> {
    /// Looks at all points, one after the other.
    pub(super) fn survey(
        plan: &'a StudyPlan,
        means: &'a StudyMeans,
        shared: &'a Shared,
    ) -> Result<StudyTable<'a>> {
        let mut table = StudyTable {
            plan,
            means,
            shared,
            limits: Limits::new(),
            there: Vec::new(),
            failed: 0,
            missing: 0,
            first_missing: None,
            references: Vec::new(),
            stages: IndexSet::new(),
            counts: IndexSet::new(),
        };
        for k in 0..plan.len() {
            match point::kept(plan, means, shared, k)? {
                None => {
                    table.missing += 1;
                    table.first_missing.get_or_insert(k);
                }
                Some(outcome) if k >= plan.designed() => table.references.push(outcome),
                Some(outcome) => {
                    table.there.push(k);
                    table.failed += usize::from(!outcome.done());
                    table.stages.extend(outcome.stages.iter().flat_map(|stages| stages.keys().cloned()));
                    table.counts.extend(outcome.counts.keys().cloned());
                }
            }
        }
        table.limits = limits(plan, &table.references);
        Ok(table)
    }

    /// True if no point has an outcome.
    pub(super) fn is_empty(&self) -> bool {
        self.there.is_empty() && self.references.is_empty()
    }

    /// The numbers that are told.
    pub(super) fn done(self) -> StudyDone {
        StudyDone {
            points: self.there.len(),
            failed: self.failed,
            missing: self.missing,
            first_missing: self.first_missing,
            limits: self.limits,
        }
    }

    /// Outcomes of the points that have one, each read when it is its turn.
    pub(super) fn outcomes(&self) -> impl Iterator<Item = Result<PointOutcome>> {
        self.there.iter().map(|&k| {
            let outcome = point::kept(self.plan, self.means, self.shared, k)?;
            outcome.ok_or_else(|| point::broken(&format!("point {k} has changed while it was collected")))
        })
    }

    /// The relative error of a measure: a norm is its own.
    pub(super) fn error(&self, outcome: &PointOutcome, measure: &str) -> Option<f64> {
        let value = outcome.value(measure);
        let error = match (self.plan.study.measures.get(measure), self.limits.get(measure)) {
            (Some(Measure::Error { .. }), _) => value,
            (_, Some(limit)) => limit.error(value),
            _ => return None,
        };
        // a point that failed is infinitely wrong
        Some(if outcome.done() && error.is_finite() { error } else { f64::INFINITY })
    }
}

/// References of the measures: the numbers of the file, else the limits of the reference runs, if all of them are there.
fn limits(plan: &StudyPlan, references: &[PointOutcome]) -> Limits {
    let (runs, ratio) =
        plan.study.reference.as_ref().map_or((0, 2.0), |reference| (reference.runs.len(), reference.ratio));
    let of = |(name, measure): (&String, &Measure)| {
        let values: Vec<f64> = references.iter().map(|run| run.value(name)).collect();
        let limit = || Limit::of(&values, ratio).filter(|_| values.len() == runs);
        measure.reference().map(Limit::exact).or_else(limit).map(|limit| (name.clone(), limit))
    };
    plan.study.measures.iter().filter_map(of).collect()
}

/// Beginning of a file that was written as study.json.
#[derive(Deserialize)]
struct TableOrigin {
    program: String,
}

/// Refuses a folder in which other files stand where the tables go: a study of that name among them.
pub(super) fn check_own(folder: &Path) -> Result<()> {
    let open = |name: &str| File::open(folder.join(name)).ok();
    let is_json = |file: File| {
        let origin: serde_json::Result<TableOrigin> = serde_json::from_reader(BufReader::new(file));
        origin.is_ok_and(|origin| origin.program == env!("CARGO_PKG_NAME"))
    };
    let is_csv = |mut file: File| {
        let mut begin = [0; 6];
        file.read_exact(&mut begin).is_ok() && begin == *b"point,"
    };
    let foreign = [
        ("study.json", open("study.json").is_some_and(|file| !is_json(file))),
        ("study.csv", open("study.csv").is_some_and(|file| !is_csv(file))),
    ];
    match foreign.into_iter().find(|(_, foreign)| *foreign) {
        Some((name, _)) => {
            let what = format!("{name} is in the way: it is no table of results");
            Err(Error::folder(folder, what, "choose another folder with -o"))
        }
        None => Ok(()),
    }
}
