//! study.json: every point with its axes, measures, errors, sizes, times.

use indexmap::IndexMap;
use serde::ser::{Error as _, SerializeSeq};
use serde::{Serialize, Serializer};
use serde_json::Value;

use super::outcome::PointOutcome;
use super::table::{Limits, StudyTable};
use crate::error::Result;
use crate::output::write_json;

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
struct TableRows<'a>(&'a StudyTable<'a>);

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

/// Writes the file.
pub(super) fn write(table: &StudyTable) -> Result<()> {
    let load = std::fs::read_to_string("/proc/loadavg").ok();
    let load_average = load.map(|text| text.split(' ').take(3).collect::<Vec<_>>().join(" "));
    let (plan, means) = (table.plan, table.means);
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
        references: &table.limits,
        missing: table.missing,
        points: TableRows(table),
        reference_runs: &table.references,
    };
    write_json(&means.out.join("study.json"), &file)
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
