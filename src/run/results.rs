//! The results of a run as they come: fields, a row of the history, the summary.

use super::folder::Folder;
use super::summary::{self, Balance};
use crate::error::{Error, Result};
use crate::history::{Clock, Increment, ModelState, Totals};
use crate::output::{HistoryRow, RowData, Writer};
use crate::problem::Problem;
use crate::scene::{Fields, Scene};

/// The results of one run.
pub(super) struct Results<'a> {
    scene: &'a Scene,
    name: &'a str,
    pub(super) problem: &'a Problem,
    folder: Folder,
    writer: Option<Writer>,
    /// Loads and reactions at the last increment whose displacements are known.
    balance: Option<Balance>,
    /// The counts up to the last increment.
    pub(super) totals: Totals,
    /// Number of the last increment whose fields are stored; none before the first.
    stored: Option<usize>,
    /// Rows of the history, that of the unloaded state among them, and states whose fields are stored.
    rows: [usize; 2],
}

impl<'a> Results<'a> {
    /// Results of a run that has not begun: nothing is written yet.
    pub(super) fn new(scene: &'a Scene, name: &'a str, problem: &'a Problem, folder: Folder) -> Results<'a> {
        let (writer, balance, totals, stored) = (None, None, Totals::default(), None);
        Results { scene, name, problem, folder, writer, balance, totals, stored, rows: [0, 0] }
    }

    /// Writes an increment, or the unloaded state. Returns its row, unless that is there already.
    pub(super) fn write(
        &mut self,
        increment: &Increment,
        state: &ModelState,
        totals: &Totals,
    ) -> Result<Option<HistoryRow>> {
        let unloaded = increment.number == 0 && !increment.ended;
        if unloaded {
            self.open()?;
        }
        let Some(writer) = &mut self.writer else { return Ok(None) };
        let (problem, number) = (self.problem, increment.increment);
        let wanted = match self.scene.output.fields {
            Fields::Every => true,
            Fields::Step => unloaded || increment.ended || increment.last,
            Fields::Last => {
                increment.ended || increment.last && increment.step_number + 1 == problem.steps.len()
            }
            Fields::None => false,
        };
        if wanted && self.stored.is_none_or(|stored| stored < number) {
            let row = RowData {
                row: number,
                step: if number == 0 { 0 } else { increment.step_number + 1 },
                load_factor: increment.load_factor,
                energies: [state.stored, state.dissipated, state.released, state.work],
            };
            writer.fields(problem, &state.snapshot, &row)?;
            self.stored = Some(number);
            self.rows[1] += 1;
        }
        if !state.force.is_empty() {
            self.balance = Some(summary::balance(&problem.model, &state.loads(problem), &state.reactions));
        }
        self.totals = totals.clone();
        if increment.ended {
            return Ok(None); // its row is written
        }
        let row = HistoryRow {
            step: increment.step.name.clone(),
            increment: number,
            load_factor: increment.load_factor,
            iterations: increment.iterations,
            residual: state.residual,
            energy_balance: state.energy_balance(),
            values: state.probes(problem),
        };
        writer.row(&row)?;
        self.rows[0] += 1;
        Ok(Some(row).filter(|_| !unloaded))
    }

    /// The first factor stands: a run that is refused before leaves the last results in place.
    fn open(&mut self) -> Result<()> {
        self.folder.keep();
        let writer = Writer::create(self.folder.path(), self.name, &self.problem.columns())?;
        writer.midplanes(&self.problem.model)?;
        self.writer = Some(writer);
        Ok(())
    }

    /// Writes the summary if there is a row.
    pub(super) fn summary(&self, clock: &Clock, end: Option<&Error>) -> Result<()> {
        let (Some(writer), Some(balance)) = (&self.writer, &self.balance) else { return Ok(()) };
        let end = end.map(Error::to_string);
        let Results { scene, name, problem, totals, rows, .. } = self;
        writer.summary(&summary::summary(scene, name, problem, (totals, *rows), balance.clone(), clock, end))
    }
}
