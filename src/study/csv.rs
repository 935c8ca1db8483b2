//! study.csv: a row per point.

use serde_json::Value;

use super::outcome::PointOutcome;
use super::table::StudyTable;
use crate::error::{Error, Result};
use crate::files::write_whole_by;
use crate::output::csv_field;

/// Writes the file.
pub(super) fn write(table: &StudyTable) -> Result<()> {
    let path = table.means.out.join("study.csv");
    write_whole_by(&path, |file| {
        let mut write = |line: String| file.write_all(line.as_bytes()).map_err(Error::io("write", &path));
        write(head(table))?;
        table.outcomes().try_for_each(|outcome| write(row(table, &outcome?)))
    })
}

/// Names of the columns.
fn head(table: &StudyTable) -> String {
    let study = &table.plan.study;
    let mut head = vec!["point".to_string()];
    head.extend(study.axes.keys().cloned());
    head.push("status".into());
    for name in study.measures.keys() {
        head.extend([name.to_string(), format!("{name}.error")]);
    }
    head.extend(table.counts.iter().cloned());
    head.push("strategy".into());
    head.extend(
        ["runs", "seconds_min", "seconds_median", "seconds_spread", "processor_seconds"].map(String::from),
    );
    head.extend(table.stages.iter().map(|stage| format!("seconds.{stage}")));
    head.extend(["peak_memory_bytes", "reused", "message"].map(String::from));
    line(&head)
}

/// A point.
fn row(table: &StudyTable, outcome: &PointOutcome) -> String {
    let mut row = vec![outcome.point.to_string()];
    row.extend(table.plan.point(outcome.point).values.iter().map(shown));
    row.push(outcome.status.clone());
    for name in table.plan.study.measures.keys() {
        let value = outcome.values.get(name.as_str()).copied().flatten();
        let error = table.error(outcome, name);
        row.extend([value, error].map(|number| number.map_or_else(String::new, |n| format!("{n:e}"))));
    }
    row.extend(table.counts.iter().map(|c| outcome.counts.get(c).map_or_else(String::new, f64::to_string)));
    row.push(outcome.strategy.clone());
    let [min, median, spread] = outcome.times();
    row.push(outcome.seconds.len().to_string());
    row.extend([min, median, spread, outcome.processor_time()].map(|number| format!("{number:.6}")));
    row.extend(table.stages.iter().map(|stage| format!("{:.6}", outcome.stage(stage))));
    row.push(outcome.peak_memory.map_or_else(String::new, |bytes| bytes.to_string()));
    row.push(outcome.reused.join("; "));
    row.push(outcome.message.clone());
    line(&row)
}

fn line(cells: &[String]) -> String {
    cells.iter().map(|cell| csv_field(cell)).collect::<Vec<_>>().join(",") + "\n"
}

/// A value of an axis as people read it.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
