//! Output of a run: a bar on a terminal, plain lines elsewhere.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressState, ProgressStyle};

use super::printer::Printer;
use super::ticker::Ticker;
use crate::assembly::InterfaceOperator;
use crate::error::Warning;
use crate::history::{Operations, PartNow, StageNow, Totals, memory::gigabytes};
use crate::output::HistoryRow;
use crate::problem::Problem;
use crate::run::{Event, Resumed, RunDone};
use crate::scene::Control;
use crate::solver::Method;

/// Prints events.
pub(super) struct Show {
    quiet: bool,
    printer: Printer,
    /// There is a bar.
    bar: bool,
    stage: Option<StageNow>,
    /// Counts up to the last increment shown.
    totals: Option<Totals>,
    /// Without a bar, what is under way is told now and then.
    ticker: Option<Ticker>,
    /// Widths of the table's first two columns.
    widths: [usize; 2],
}

impl Show {
    pub(super) fn new(quiet: bool, printer: &Printer) -> Show {
        let bar = !quiet && std::io::stderr().is_terminal();
        if bar {
            printer.bar(|bar| bar.enable_steady_tick(Duration::from_millis(100)));
        }
        let printer = printer.clone();
        Show { quiet, printer, bar, stage: None, totals: None, ticker: None, widths: [0, 0] }
    }

    /// Shows the bar by a template, in which `{stage}` is the stage of work under way.
    fn style(&self, template: &str) {
        if let (true, Some(stage), Ok(style)) =
            (self.bar, self.stage.clone(), ProgressStyle::with_template(template))
        {
            let name = move |_: &ProgressState, text: &mut dyn std::fmt::Write| {
                // a bar that cannot be drawn is no loss
                let _ = text.write_str(stage.name());
                let PartNow { load_factor, parts, iterations } = stage.part();
                if parts > 0 {
                    let _ = write!(text, " at {load_factor:.4}, {parts} parts, {iterations} iterations");
                }
            };
            let style = style.with_key("stage", name);
            self.printer.bar(|bar| bar.set_style(style));
        }
    }

    /// One line, above the bar if there is one.
    pub(super) fn line(&self, text: &str) {
        if self.quiet {
            return;
        }
        self.printer.out(text);
        self.ticker.iter().for_each(Ticker::told);
    }

    /// A warning is worth its lines also when everything else is quiet.
    pub(super) fn warning(&self, Warning { code, what, help }: &Warning) {
        self.printer.error(&format!("warning: {code} {what}\n         help: {help}"));
    }

    pub(super) fn event(&mut self, event: Event) {
        match event {
            Event::Began(stage) => {
                self.stage = Some(stage.clone());
                self.style("{spinner} {stage} {elapsed}");
                let told = !self.bar && !self.quiet;
                self.ticker = told.then(|| Ticker::start(stage.clone(), self.printer.clone()));
            }
            Event::Meshed { name, path, reused } => {
                let how = if reused { "reused" } else { "meshed" };
                self.line(&format!("{how:<8} {name:<12} {}", path.display()));
            }
            Event::Interface(interface) => self.line(&describe(interface)),
            Event::Warning(warning) => self.warning(warning),
            Event::Resumed(Resumed::Anew) => self.line("resume   there is no checkpoint, the run begins"),
            Event::Resumed(Resumed::After { increments, passed }) => {
                self.line(&format!("resume   goes on after increment {increments}"));
                if let Some(why) = passed {
                    self.line(&format!("{:<8} {:<12} {why}", "", "not later:"));
                }
            }
            Event::Unconfined => self.printer.error(
                "note: this system cannot confine gmsh (no Landlock): a .geo from a stranger may do what you may",
            ),
            Event::Replaces(scene) => {
                self.printer
                    .error(&format!("note: takes the place of the results of another scene, {scene}"));
            }
            Event::Kept(kept) => self.printer.error(&format!("note: {kept}")),
            Event::Left(folder) => {
                self.printer
                    .error(&format!("note: the results of an earlier run in {} stay", folder.display()));
            }
            Event::Reused(what) => self.line(&format!("reused   {what}")),
            Event::Increment { row, number, of, total, totals, problem, .. } => {
                if self.totals.is_none() {
                    self.begin(total, totals, problem);
                }
                if self.bar {
                    let position = row.increment as u64;
                    self.printer.bar(move |bar| bar.set_position(position));
                }
                let marks = marks(totals, self.totals.as_ref());
                self.line(increment(self.widths, row, number, of, &marks).trim_end());
                self.totals = Some(totals.clone());
            }
        }
    }

    /// The method of solution, and the head of the table of increments.
    fn begin(&mut self, total: usize, totals: &Totals, problem: &Problem) {
        let how = match totals.method {
            Method::Joined => "linear, one factor",
            Method::InParts => "linear, factors of two parts side by side",
            Method::Condensed => "Newton's method on the jumps of the interfaces",
            Method::Blocks => {
                "Newton's method on the nodes of interfaces, bodies condensed, sparse by bodies"
            }
            Method::Plain => "Newton's method on all displacements",
        };
        self.line(&format!("{:<8} {:<12} {how}", "solving", totals.method.name()));
        if let Some(Operations { condensed, blocks, plain }) = totals.operations {
            let text = format!("condensed {condensed:.1e}, blocks {blocks:.1e}, plain {plain:.1e} or more");
            self.line(&format!("{:<8} {:<12} {text}", "", "operations"));
        }
        let bodies = problem.model.subdomains.len();
        if let Some(distinct) = totals.distinct.filter(|distinct| *distinct < bodies) {
            let text = format!("{bodies} of {distinct} kinds, one of each is condensed");
            self.line(&format!("{:<8} {:<12} {text}", "", "bodies"));
        }
        self.widths = widths(problem);
        let [name, count] = self.widths;
        self.line(&format!(
            "{:<name$} {:>count$} {:>10} {:>6} {:>10} {:>10}",
            "step", "incr", "load", "iter", "residual", "energy"
        ));
        if self.bar {
            self.printer.bar(move |bar| bar.set_length(total as u64));
            self.style("{bar:30} {pos}/{len} {stage} {eta}");
        }
    }

    pub(super) fn finish(&self) {
        if self.bar {
            self.printer.bar(|bar| bar.finish_and_clear());
        }
    }

    pub(super) fn done(&self, done: &RunDone) {
        self.finish();
        let stages: Vec<String> = done
            .clock
            .stages()
            .iter()
            .filter(|(_, seconds)| *seconds >= 0.005)
            .map(|(stage, seconds)| format!("{stage} {seconds:.2}"))
            .collect();
        if let Some(totals) = self.totals.as_ref().filter(|totals| totals.iterations > 0) {
            let Totals { increments, parts, iterations, energy_balance, viscous, .. } = totals;
            let viscous = match *viscous > 0.0 {
                true => format!("; viscosity took {viscous:.3e} of the work"),
                false => String::new(),
            };
            self.line(&format!(
                "solved   {increments} increments in {parts} parts, {iterations} iterations; energies balance to {energy_balance:.1e}{viscous}"
            ));
        }
        self.line(&format!("time     {:.2} s: {}", done.clock.total(), stages.join(", ")));
        if let Some(peak) = done.peak_memory {
            self.line(&format!("memory   {}", gigabytes(peak)));
        }
        self.line(&format!("wrote    {}", done.collection.display()));
    }
}

/// Marks of an increment in the table: several parts, turning points of the path, snaps.
fn marks(now: &Totals, before: Option<&Totals>) -> String {
    let count = |of: &dyn Fn(&Totals) -> usize| of(now) - before.map_or(0, of);
    let mut marks = Vec::new();
    match count(&|totals| totals.parts) {
        0 | 1 => {}
        n => marks.push(format!("{n} parts")),
    }
    let new = count(&|totals| totals.turns.len());
    marks.extend(now.turns.iter().rev().take(new).map(|(_, _, level)| format!("turns at {level:.6}")));
    let new = count(&|totals| totals.snaps.len());
    marks.extend(now.snaps.iter().rev().take(new).map(|snap| format!("snaps at {:.6}", snap.load_factor)));
    marks.join(", ")
}

/// Widths of the names of steps, and of the numbers of increments: a path that turns has more than its step states.
fn widths(problem: &Problem) -> [usize; 2] {
    let names = problem.steps.iter().map(|step| step.name.chars().count()).max().unwrap_or(0);
    let counts = problem.steps.iter().map(|step| match step.control {
        Control::Load => 2 * step.increments.to_string().len() + 1,
        _ => 2 * step.increments.to_string().len() + 4,
    });
    [names.clamp(4, 40), counts.max().unwrap_or(0).max(7)]
}

/// A row of the table.
fn increment([name, count]: [usize; 2], row: &HistoryRow, number: usize, of: usize, marks: &str) -> String {
    format!(
        "{:<name$} {:>count$} {:>10.6} {:>6} {:>10.1e} {:>10.1e}  {marks}",
        row.step,
        format!("{number}/{of}"),
        row.load_factor,
        row.iterations,
        row.residual,
        row.energy_balance
    )
}

fn describe(interface: &InterfaceOperator) -> String {
    let coupling = &interface.coupling;
    let [a, b] = [0, 1].map(|side| coupling.facets(side));
    format!(
        "joined   {:<12} {a}:{b} edges, {} segments, {} law points, length {:.6}",
        interface.name,
        coupling.midplane.segments.len(),
        coupling.points.len(),
        coupling.midplane.length
    )
}
