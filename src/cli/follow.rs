//! A study as it goes: a bar with the time left on a terminal, a line a point elsewhere.

use std::io::IsTerminal;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Duration;

use indicatif::ProgressStyle;

use super::printer::Printer;
use crate::error::Result;
use crate::study::{self, PointOutcome, Progress, Selection, Shard, StudyDone, StudyMeans, StudyPlan};

/// A study whose progress is shown.
pub(super) struct Follow<'a> {
    plan: &'a StudyPlan,
    means: &'a StudyMeans,
    quiet: bool,
    /// A bar in place of lines.
    bar: bool,
    printer: &'a Printer,
}

impl<'a> Follow<'a> {
    pub(super) fn new(
        plan: &'a StudyPlan,
        means: &'a StudyMeans,
        quiet: bool,
        printer: &'a Printer,
    ) -> Follow<'a> {
        Follow { plan, means, quiet, bar: !quiet && std::io::stderr().is_terminal(), printer }
    }

    /// Runs what is selected; one point may be run `once`, its outcome written to a file of its own.
    pub(super) fn run(&self, once: Option<&Path>) -> Result<()> {
        match (self.plan.selection, once) {
            (Selection::Point(point), Some(file)) => {
                super::set_threads(NonZeroUsize::new(self.means.threads))?;
                study::run_once(self.plan, self.means, point, file).map(|_| ())
            }
            (Selection::Point(point), None) => {
                let outcome = study::run_one(self.plan, self.means, point)?;
                self.line(&described(self.plan, &outcome));
                Ok(())
            }
            (Selection::Shard(Shard { index, count }), _) => {
                let done = study::run_shard(self.plan, self.means, &mut |progress| self.show(&progress))?;
                self.finish();
                self.line(&format!(
                    "shard {index} of {count}: {} points, {} of them failed",
                    done.points, done.failed
                ));
                Ok(())
            }
            (Selection::All, _) => {
                let done = study::run(self.plan, self.means, &mut |progress| self.show(&progress))?;
                self.finish();
                self.ended(&done);
                Ok(())
            }
        }
    }

    /// Writes the table of the points that are there.
    pub(super) fn collect(&self) -> Result<()> {
        let done = study::collect(self.plan, self.means)?;
        self.ended(&done);
        Ok(())
    }

    fn show(&self, progress: &Progress) {
        let &Progress { done, total, outcome } = progress;
        match (self.bar, outcome) {
            (true, None) => self.begin(done as u64, total as u64),
            (true, Some(outcome)) => {
                self.printer.bar(move |bar| bar.set_position(done as u64));
                if !outcome.done() {
                    self.line(&described(self.plan, outcome));
                }
            }
            (false, None) if done > 0 => self.line(&format!("{done} of {total} points are there")),
            (false, Some(outcome)) => {
                self.line(&format!("{done:>5}/{total}  {}", described(self.plan, outcome)));
            }
            (false, None) => {}
        }
    }

    fn begin(&self, done: u64, total: u64) {
        let style = ProgressStyle::with_template("{bar:30} {pos}/{len} points, {eta} left {msg}");
        self.printer.bar(move |bar| {
            bar.set_length(total);
            style.into_iter().for_each(|style| bar.set_style(style));
            bar.enable_steady_tick(Duration::from_millis(200));
            bar.set_position(done);
            bar.reset_eta();
        });
    }

    fn finish(&self) {
        if self.bar {
            self.printer.bar(|bar| bar.finish_and_clear());
        }
    }

    fn line(&self, text: &str) {
        if !self.quiet {
            self.printer.out(text);
        }
    }

    fn ended(&self, done: &StudyDone) {
        for (name, limit) in &done.limits {
            let order = limit.order.map_or_else(String::new, |order| format!(", order {order:.2}"));
            self.line(&format!("reference {name} {:.9e} ± {:.1e}{order}", limit.value, limit.uncertainty));
        }
        self.line(&format!("{} points, {} of them failed", done.points, done.failed));
        if let Some(first) = done.first_missing {
            // an incomplete table is told even to who wants errors only
            self.printer.error(&format!(
                "note: {} of {} points are missing, the first is {first}",
                done.missing,
                self.plan.len()
            ));
        }
        self.line(&format!("wrote    {}", self.means.out.join("study.csv").display()));
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
