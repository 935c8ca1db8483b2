//! A study as it goes: a bar with the time left on a terminal, a line a point elsewhere.

use std::io::IsTerminal;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Duration;

use indicatif::ProgressStyle;

use super::printer::Printer;
use crate::error::Result;
use crate::study::{self, PointOutcome, Progress, StudyDone, StudyMeans, StudyPlan};

/// Runs a study, or a point of it, and shows it.
pub(super) fn study(
    plan: &StudyPlan,
    means: &StudyMeans,
    point: Option<usize>,
    once: Option<&Path>,
    (quiet, printer): (bool, &Printer),
) -> Result<()> {
    let line = |text: &str| {
        if !quiet {
            printer.out(text);
        }
    };
    match (point, once) {
        (Some(point), Some(file)) => {
            super::set_threads(NonZeroUsize::new(means.threads))?;
            study::run_once(plan, means, point, file).map(|_| ())
        }
        (Some(point), None) => {
            let outcome = study::run_one(plan, means, point)?;
            line(&described(plan, &outcome));
            Ok(())
        }
        (None, _) => {
            let bar = !quiet && std::io::stderr().is_terminal();
            if bar {
                let total = plan.len() as u64;
                let style = ProgressStyle::with_template("{bar:30} {pos}/{len} points, {eta} left {msg}");
                printer.bar(move |bar| {
                    bar.set_length(total);
                    style.into_iter().for_each(|style| bar.set_style(style));
                    bar.enable_steady_tick(Duration::from_millis(200));
                });
            }
            let mut show = |progress: Progress| match (bar, progress.outcome) {
                (true, outcome) => {
                    let (done, begins) = (progress.done as u64, outcome.is_none());
                    printer.bar(move |bar| {
                        bar.set_position(done);
                        if begins {
                            bar.reset_eta();
                        }
                    });
                    if let Some(outcome) = outcome.filter(|outcome| !outcome.done()) {
                        line(&described(plan, outcome));
                    }
                }
                (false, None) if progress.done > 0 => {
                    line(&format!("{} of {} points are there", progress.done, progress.total));
                }
                (false, Some(outcome)) => {
                    line(&format!("{:>5}/{}  {}", progress.done, progress.total, described(plan, outcome)));
                }
                (false, None) => {}
            };
            let done = study::run(plan, means, &mut show)?;
            if bar {
                printer.bar(|bar| bar.finish_and_clear());
            }
            ended(means, &done).iter().for_each(|text| line(text));
            Ok(())
        }
    }
}

/// A point in a line.
fn described(plan: &StudyPlan, outcome: &PointOutcome) -> String {
    let [_, seconds, _] = outcome.times();
    let measures = plan.study.measures.keys();
    let values: Vec<String> = measures.map(|name| format!("{name} {:.6e}", outcome.value(name))).collect();
    let end =
        if outcome.done() { values.join("  ") } else { format!("{}: {}", outcome.status, outcome.message) };
    format!("point {:<4} {seconds:>8.3} s  {end}", outcome.point)
}

fn ended(means: &StudyMeans, done: &StudyDone) -> Vec<String> {
    let mut lines: Vec<String> = done
        .limits
        .iter()
        .map(|(name, limit)| {
            let order = limit.order.map_or_else(String::new, |order| format!(", order {order:.2}"));
            format!("reference {name} {:.9e} ± {:.1e}{order}", limit.value, limit.uncertainty)
        })
        .collect();
    let failed = done.outcomes[..done.designed].iter().filter(|outcome| !outcome.done()).count();
    lines.push(format!("{} points, {failed} of them failed", done.designed));
    lines.push(format!("wrote    {}", means.out.join("study.csv").display()));
    lines
}
