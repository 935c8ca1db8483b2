//! study.csv and study.json: every point with its axes, measures, errors, sizes, times.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;

use indexmap::{IndexMap, IndexSet};
use serde::ser::{Error as _, SerializeSeq};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;

use super::outcome::PointOutcome;
use super::plan::StudyPlan;
use super::point::{self, StudyMeans};
use super::reference::Limit;
use super::{StudyDone, csv};
use crate::error::{Error, Result};
use crate::files::write_whole_by;
use crate::output::write_json;
use crate::run::Shared;

/// Reference of every measure.
pub type Limits = IndexMap<String, Limit>;

/// Table of a study. It knows which points have an outcome; the outcomes stay on disk until their rows are written.
pub(super) struct Table<'a> {
    pub(super) plan: &'a StudyPlan,
    means: &'a StudyMeans,
    shared: &'a Shared,
    limits: Limits,
    /// Points of the design that have an outcome.
    there: Vec<usize>,
    failed: usize,
    missing: usize,
    first_missing: Option<usize>,
    references: Vec<PointOutcome>,
    /// Names of the stages and of the counts of all points.
    pub(super) stages: IndexSet<String>,
    pub(super) counts: IndexSet<String>,
}

#[derive(Serialize)]
struct TableFile<'a> {
    program: &'static str,
    version: &'static str,
    study: &'a str,
    title: &'a str,
    scene: String,
    axes: Vec<&'a String>,
    /// Load of the machine at the end, over 1, 5 and 15 minutes, where the system tells.
    load_average: Option<String>,
    jobs: usize,
    threads: usize,
    references: &'a Limits,
    /// Number of points without an outcome.
    missing: usize,
    points: TableRows<'a>,
    reference_runs: &'a [PointOutcome],
}

/// Rows that are made while they are written.
struct TableRows<'a>(&'a Table<'a>);

#[derive(Serialize)]
struct TableRow<'a> {
    axes: IndexMap<&'a str, Value>,
    /// Relative errors of the measures; null where there is no reference or no value.
    errors: IndexMap<&'a str, Option<f64>>,
    seconds_min: f64,
    seconds_median: f64,
    seconds_spread: f64,
    #[serde(flatten)]
    outcome: &'a PointOutcome,
}

impl<'a> Table<'a> {
    /// Looks at all points, one after the other.
    pub(super) fn survey(
        plan: &'a StudyPlan,
        means: &'a StudyMeans,
        shared: &'a Shared,
    ) -> Result<Table<'a>> {
        let mut table = Table {
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

    /// Writes both files.
    pub(super) fn write(self) -> Result<StudyDone> {
        let load = std::fs::read_to_string("/proc/loadavg").ok();
        let load_average = load.map(|text| text.split(' ').take(3).collect::<Vec<_>>().join(" "));
        let (plan, means) = (self.plan, self.means);
        let file = TableFile {
            program: env!("CARGO_PKG_NAME"),
            version: env!("CARGO_PKG_VERSION"),
            study: &plan.name,
            title: &plan.study.title,
            scene: plan.scene.display().to_string(),
            axes: plan.study.axes.keys().collect(),
            load_average,
            jobs: means.jobs,
            threads: means.threads,
            references: &self.limits,
            missing: self.missing,
            points: TableRows(&self),
            reference_runs: &self.references,
        };
        write_json(&means.out.join("study.json"), &file)?;
        let path = means.out.join("study.csv");
        write_whole_by(&path, |file| {
            let mut write = |line: String| file.write_all(line.as_bytes()).map_err(Error::io("write", &path));
            write(csv::head(&self))?;
            self.outcomes().try_for_each(|outcome| write(csv::row(&self, &outcome?)))
        })?;
        Ok(StudyDone {
            points: self.there.len(),
            failed: self.failed,
            missing: self.missing,
            first_missing: self.first_missing,
            limits: self.limits,
        })
    }

    /// Outcomes of the points that have one, each read when it is its turn.
    fn outcomes(&self) -> impl Iterator<Item = Result<PointOutcome>> {
        self.there.iter().map(|&k| {
            let outcome = point::kept(self.plan, self.means, self.shared, k)?;
            outcome.ok_or_else(|| point::broken(&format!("point {k} has changed while it was collected")))
        })
    }

    /// The relative error of a measure: a norm is its own.
    pub(super) fn error(&self, outcome: &PointOutcome, measure: &str) -> Option<f64> {
        let value = outcome.value(measure);
        let error = match (self.plan.study.measures.get(measure), self.limits.get(measure)) {
            (Some(super::Measure::Error { .. }), _) => value,
            (_, Some(limit)) => limit.error(value),
            _ => return None,
        };
        // a point that failed is infinitely wrong
        Some(if outcome.done() && error.is_finite() { error } else { f64::INFINITY })
    }
}

impl Serialize for TableRows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let TableRows(table) = self;
        let study = &table.plan.study;
        let mut rows = serializer.serialize_seq(Some(table.there.len()))?;
        for outcome in table.outcomes() {
            let outcome = &outcome.map_err(S::Error::custom)?;
            let [seconds_min, seconds_median, seconds_spread] = outcome.times();
            let axes = study.axes.keys().map(String::as_str);
            let error = |name: &str| table.error(outcome, name).filter(|error| error.is_finite());
            rows.serialize_element(&TableRow {
                axes: axes.zip(table.plan.point(outcome.point).values).collect(),
                errors: study.measures.keys().map(|name| (name.as_str(), error(name))).collect(),
                seconds_min,
                seconds_median,
                seconds_spread,
                outcome,
            })?;
        }
        rows.end()
    }
}

/// References of the measures: the numbers of the file, else the limits of the reference runs, if all of them are there.
fn limits(plan: &StudyPlan, references: &[PointOutcome]) -> Limits {
    let (runs, ratio) =
        plan.study.reference.as_ref().map_or((0, 2.0), |reference| (reference.runs.len(), reference.ratio));
    let of = |(name, measure): (&String, &super::Measure)| {
        let values: Vec<f64> = references.iter().map(|run| run.value(name)).collect();
        let limit = || Limit::of(&values, ratio).filter(|_| values.len() == runs);
        measure.reference().map(Limit::exact).or_else(limit).map(|limit| (name.clone(), limit))
    };
    plan.study.measures.iter().filter_map(of).collect()
}

/// The program that a file written as study.json names.
#[derive(Deserialize)]
struct ProgramName {
    program: String,
}

/// Refuses a folder in which other files stand where the tables go: a study of that name among them.
pub(super) fn check_own(folder: &Path) -> Result<()> {
    let open = |name: &str| File::open(folder.join(name)).ok();
    let is_json = |file: File| {
        let origin: serde_json::Result<ProgramName> = serde_json::from_reader(BufReader::new(file));
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
