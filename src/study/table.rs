//! study.csv and study.json: every point with its axes, measures, errors, sizes, times.

use std::fmt::Write as _;
use std::path::Path;

use indexmap::IndexMap;
use serde::Serialize;
use serde_json::Value;

use super::outcome::PointOutcome;
use super::plan::StudyPlan;
use super::point::StudyMeans;
use super::reference::Limit;
use crate::error::{Error, Result};
use crate::files::write_whole;
use crate::output::{csv_field, write_json};

/// Reference of every measure.
pub type Limits = IndexMap<String, Limit>;

#[derive(Serialize)]
struct File<'a> {
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
    points: Vec<TableRow<'a>>,
    reference_runs: &'a [PointOutcome],
}

#[derive(Serialize)]
struct TableRow<'a> {
    axes: IndexMap<&'a str, &'a Value>,
    /// Relative errors of the measures; null where there is no reference or no value.
    errors: IndexMap<&'a str, Option<f64>>,
    seconds_min: f64,
    seconds_median: f64,
    seconds_spread: f64,
    #[serde(flatten)]
    outcome: &'a PointOutcome,
}

/// References of the measures: the numbers of the file, else the limits of the reference runs.
pub(super) fn limits(plan: &StudyPlan, references: &[PointOutcome]) -> Limits {
    let ratio = plan.study.reference.as_ref().map_or(2.0, |reference| reference.ratio);
    let of = |(name, measure): (&String, &super::Measure)| {
        let values: Vec<f64> = references.iter().map(|run| run.value(name)).collect();
        let limit = measure.reference().map(Limit::exact).or_else(|| Limit::of(&values, ratio));
        limit.map(|limit| (name.clone(), limit))
    };
    plan.study.measures.iter().filter_map(of).collect()
}

/// The relative error of a measure: a norm is its own.
fn error(plan: &StudyPlan, limits: &Limits, outcome: &PointOutcome, measure: &str) -> Option<f64> {
    let value = outcome.value(measure);
    let error = match (plan.study.measures.get(measure), limits.get(measure)) {
        (Some(super::Measure::Error { .. }), _) => value,
        (_, Some(limit)) => limit.error(value),
        _ => return None,
    };
    // a point that failed is infinitely wrong
    Some(if outcome.done() && error.is_finite() { error } else { f64::INFINITY })
}

/// Refuses a folder in which other files stand where the tables go: a study of that name among them.
pub(super) fn check_own(folder: &Path) -> Result<()> {
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).ok();
    let is_table = |text: String| {
        serde_json::from_str::<Value>(&text).is_ok_and(|value| value["program"] == env!("CARGO_PKG_NAME"))
    };
    let foreign = [
        ("study.json", text("study.json").is_some_and(|text| !is_table(text))),
        ("study.csv", text("study.csv").is_some_and(|text| !text.starts_with("point,"))),
    ];
    match foreign.into_iter().find(|(_, foreign)| *foreign) {
        Some((name, _)) => {
            let what = format!("{name} is in the way: it is no table of results");
            Err(Error::folder(folder, what, "choose another folder with -o"))
        }
        None => Ok(()),
    }
}

/// Writes both files.
pub(super) fn write(
    plan: &StudyPlan,
    means: &StudyMeans,
    limits: &Limits,
    outcomes: &[PointOutcome],
) -> Result<()> {
    let (points, references) = outcomes.split_at(plan.designed.min(outcomes.len()));
    let rows = points.iter().map(|outcome| {
        let [seconds_min, seconds_median, seconds_spread] = outcome.times();
        let axes = plan.study.axes.keys().map(String::as_str).zip(&plan.points[outcome.point].values);
        let errors = plan.study.measures.keys().map(|name| {
            (name.as_str(), error(plan, limits, outcome, name).filter(|error| error.is_finite()))
        });
        TableRow {
            axes: axes.collect(),
            errors: errors.collect(),
            seconds_min,
            seconds_median,
            seconds_spread,
            outcome,
        }
    });
    let load = std::fs::read_to_string("/proc/loadavg").ok();
    let load_average = load.map(|text| text.split(' ').take(3).collect::<Vec<_>>().join(" "));
    let file = File {
        program: env!("CARGO_PKG_NAME"),
        version: env!("CARGO_PKG_VERSION"),
        study: &plan.name,
        title: &plan.study.title,
        scene: plan.scene.display().to_string(),
        axes: plan.study.axes.keys().collect(),
        load_average,
        jobs: means.jobs,
        threads: means.threads,
        references: limits,
        points: rows.collect(),
        reference_runs: references,
    };
    write_json(&means.out.join("study.json"), &file)?;
    write_whole(&means.out.join("study.csv"), csv(plan, limits, points).as_bytes())
}

fn csv(plan: &StudyPlan, limits: &Limits, points: &[PointOutcome]) -> String {
    let union = |names: &dyn Fn(&PointOutcome) -> Vec<String>| {
        let mut all: Vec<String> = Vec::new();
        for name in points.iter().flat_map(names) {
            if !all.contains(&name) {
                all.push(name);
            }
        }
        all
    };
    let stages = union(&|o| o.stages.iter().flat_map(|stages| stages.keys().cloned()).collect());
    let counts = union(&|o| o.counts.keys().cloned().collect());
    let measures: Vec<&String> = plan.study.measures.keys().collect();
    let mut head = vec!["point".to_string()];
    head.extend(plan.study.axes.keys().cloned());
    head.push("status".into());
    for name in &measures {
        head.extend([name.to_string(), format!("{name}.error")]);
    }
    head.extend(counts.iter().cloned());
    head.push("strategy".into());
    head.extend(
        ["runs", "seconds_min", "seconds_median", "seconds_spread", "processor_seconds"].map(String::from),
    );
    head.extend(stages.iter().map(|stage| format!("seconds.{stage}")));
    head.extend(["peak_memory_bytes", "reused", "message"].map(String::from));
    let mut text = head.iter().map(|cell| csv_field(cell)).collect::<Vec<_>>().join(",");
    text.push('\n');
    for outcome in points {
        let mut row = vec![outcome.point.to_string()];
        row.extend(plan.points[outcome.point].values.iter().map(shown));
        row.push(outcome.status.clone());
        for name in &measures {
            let value = outcome.values.get(name.as_str()).copied().flatten();
            let error = error(plan, limits, outcome, name);
            row.extend([value, error].map(|number| number.map_or_else(String::new, |n| format!("{n:e}"))));
        }
        row.extend(counts.iter().map(|c| outcome.counts.get(c).map_or_else(String::new, f64::to_string)));
        row.push(outcome.strategy.clone());
        let [min, median, spread] = outcome.times();
        row.push(outcome.seconds.len().to_string());
        row.extend([min, median, spread, outcome.processor_time()].map(|number| format!("{number:.6}")));
        row.extend(stages.iter().map(|stage| format!("{:.6}", outcome.stage(stage))));
        row.push(outcome.peak_memory.map_or_else(String::new, |bytes| bytes.to_string()));
        row.push(outcome.reused.join("; "));
        row.push(outcome.message.clone());
        let _ = writeln!(text, "{}", row.iter().map(|cell| csv_field(cell)).collect::<Vec<_>>().join(","));
    }
    text
}

/// A value of an axis as people read it.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
