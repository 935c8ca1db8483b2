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
    /// Number of the last increment whose fields are stored.
    stored: usize,
}

impl<'a> Results<'a> {
    /// Results of a run that has not begun: nothing is written yet.
    pub(super) fn new(scene: &'a Scene, name: &'a str, problem: &'a Problem, folder: Folder) -> Results<'a> {
        let (writer, balance, totals, stored) = (None, None, Totals::default(), 0);
        Results { scene, name, problem, folder, writer, balance, totals, stored }
    }

    /// Writes an increment. Returns its row, unless that is there already.
    pub(super) fn write(
        &mut self,
        increment: &Increment,
        state: &ModelState,
        totals: &Totals,
    ) -> Result<Option<HistoryRow>> {
        let (problem, fields) = (self.problem, self.scene.output.fields);
        if increment.number == 0 {
            return self.open(state).map(|()| None);
        }
        let Some(writer) = &mut self.writer else { return Ok(None) };
        let wanted = match fields {
            Fields::Every => true,
            Fields::Step => increment.ended || increment.last,
            Fields::Last => {
                increment.ended || increment.last && increment.step_number + 1 == problem.steps.len()
            }
            Fields::None => false,
        };
        if wanted && self.stored < increment.increment {
            let row = RowData {
                row: increment.increment,
                step: increment.step_number + 1,
                load_factor: increment.load_factor,
                energies: [state.stored, state.dissipated, state.released, state.work],
            };
            writer.fields(problem, &state.snapshot, &row)?;
            self.stored = increment.increment;
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
            increment: increment.increment,
            load_factor: increment.load_factor,
            iterations: increment.iterations,
            residual: state.residual,
            energy_balance: state.energy_balance(),
            values: state.probes(problem),
        };
        writer.row(&row)?;
        Ok(Some(row))
    }

    /// The first factor stands: a run that is refused before leaves the last results in place.
    fn open(&mut self, state: &ModelState) -> Result<()> {
        self.folder.keep();
        let mut writer = Writer::create(self.folder.path(), self.name, &self.problem.columns())?;
        writer.midplanes(&self.problem.model)?;
        if matches!(self.scene.output.fields, Fields::Every | Fields::Step) {
            writer.fields(self.problem, &state.snapshot, &RowData::default())?;
        }
        self.writer = Some(writer);
        Ok(())
    }

    /// Writes the summary if there is an increment.
    pub(super) fn summary(&self, clock: &Clock, end: Option<&Error>) -> Result<()> {
        let (Some(writer), Some(balance)) = (&self.writer, &self.balance) else { return Ok(()) };
        let end = end.map(Error::to_string);
        let Results { scene, name, problem, totals, .. } = self;
        writer.summary(&summary::summary(scene, name, problem, totals, balance.clone(), clock, end))
    }
}
