//! The results of a run as they come: fields, a row of the history, the summary.
//!
//! Results of an earlier run in the folder stay until the first row of this one is complete.

use serde::{Deserialize, Serialize};

use super::folder::Folder;
use super::places::{LATEST, of_step};
use super::summary::{self, Balance};
use crate::error::{Error, Result};
use crate::history::{Clock, Increment, ModelState, Totals};
use crate::output::{HistoryRow, Listing, RowData, TextLengths, Writer, check_free, files_once};
use crate::problem::Problem;
use crate::scene::{Fields, Scene};

/// The results of one run.
pub(super) struct Results<'a> {
    scene: &'a Scene,
    name: &'a str,
    pub(super) problem: &'a Problem,
    folder: Folder,
    /// None before the unloaded state; of a run that goes on, before there is something to write.
    writer: Option<Writer>,
    /// True if the folder has results of an earlier run, whose place is still to be taken.
    earlier: bool,
    /// Name of their scene, if it is another.
    pub(super) other: Option<String>,
    state: ResultsState,
    /// Loads and reactions at the last increment whose displacements are known.
    balance: Option<Balance>,
    /// The counts up to the last increment.
    pub(super) totals: Totals,
    /// The checkpoint that the run goes on from.
    from: Option<(TextLengths, String)>,
}

/// What there is so far: part of a checkpoint.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct ResultsState {
    lengths: Option<TextLengths>,
    /// Number of the last increment whose fields are stored; none before the first.
    stored: Option<usize>,
    /// Rows of the history, that of the unloaded state among them, and states whose fields are stored.
    rows: [usize; 2],
    /// The same before the fields of the last increment of all, which are not stored if it is not the last of all.
    before_last: Option<(TextLengths, Option<usize>, usize)>,
    /// The balance of loads and reactions, as JSON.
    balance: Option<String>,
    /// Increments after which the run was gone on with.
    resumed: Vec<usize>,
}

impl<'a> Results<'a> {
    /// Results of a run that has not begun: nothing is written yet. Refused where others would be in the way.
    pub(super) fn new(
        scene: &'a Scene,
        name: &'a str,
        problem: &'a Problem,
        folder: Folder,
    ) -> Result<Results<'a>> {
        let earlier = Listing::read(folder.path())?;
        let names = problem.model.subdomains.iter().map(|part| part.name.clone());
        let names: Vec<String> =
            names.chain(problem.model.interfaces.iter().map(|i| i.name.clone())).collect();
        let checkpoints = (1..=problem.steps.len()).map(of_step).chain([LATEST.into()]);
        let wanted: Vec<String> = files_once(name, &problem.model).into_iter().chain(checkpoints).collect();
        check_free(folder.path(), earlier.as_ref(), &wanted, &names)?;
        let other = earlier.as_ref().map(|earlier| earlier.scene.clone()).filter(|scene| scene != name);
        let (earlier, state, totals) = (earlier.is_some(), ResultsState::default(), Totals::default());
        let (writer, balance, from) = (None, None, None);
        Ok(Results { scene, name, problem, folder, writer, earlier, other, state, balance, totals, from })
    }

    /// True if the files of the folder begin with the rows of a checkpoint.
    pub(super) fn has_rows_of(&self, state: &ResultsState) -> Result<bool> {
        state.lengths.map_or(Ok(false), |lengths| Writer::is_continued(self.path(), self.name, &lengths))
    }

    /// Goes on from a checkpoint of this name, after so many increments.
    pub(super) fn go_on(
        &mut self,
        mut state: ResultsState,
        totals: &Totals,
        checkpoint: &str,
        complete: bool,
    ) {
        if let (Some((lengths, stored, fields)), false) = (state.before_last.take(), complete) {
            state.lengths = state.lengths.map(|now| now.without_fields_since(&lengths));
            state.stored = stored;
            state.rows[1] = fields;
        }
        if !complete {
            state.resumed.push(totals.increments);
        }
        self.from = state.lengths.map(|lengths| (lengths, checkpoint.into()));
        self.totals = totals.clone();
        self.balance = state.balance.take().and_then(|text| serde_json::from_str(&text).ok());
        self.state = state;
        self.earlier = false;
        self.folder.keep();
    }

    /// Path of the folder.
    pub(super) fn path(&self) -> &std::path::Path {
        self.folder.path()
    }

    /// True if there are rows in their place.
    pub(super) fn has_rows(&self) -> bool {
        self.state.rows[0] > 0 && !self.earlier
    }

    /// True while the results of an earlier run are in place.
    pub(super) fn leaves_earlier(&self) -> bool {
        self.earlier
    }

    /// The state to be kept.
    pub(super) fn state(&self) -> ResultsState {
        let lengths = self.writer.as_ref().map(Writer::lengths);
        let balance = self.balance.as_ref().and_then(|balance| serde_json::to_string(balance).ok());
        ResultsState { lengths, balance, ..self.state.clone() }
    }

    /// Lists a file that is about to be written.
    pub(super) fn list(&mut self, name: &str) -> Result<()> {
        self.writer.as_mut().map_or(Ok(()), |writer| writer.list([name]))
    }

    /// Removes a file of this run that is of no use any more.
    pub(super) fn remove(&self, name: &str) {
        let _ = std::fs::remove_file(self.path().join(name)); // it may not be there
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
            self.begin()?;
        }
        let (problem, number) = (self.problem, increment.increment);
        let last = increment.last && increment.step_number + 1 == problem.steps.len();
        let wanted = match self.scene.output.fields {
            Fields::Every => true,
            Fields::Step => unloaded || increment.ended || increment.last,
            Fields::Last => increment.ended || last,
            Fields::None => false,
        };
        self.reopen()?;
        if wanted && self.state.stored.is_none_or(|stored| stored < number) {
            let step = if number == 0 { 0 } else { increment.step_number + 1 };
            self.fields(state, number, step, increment.load_factor)?;
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
        let Some(writer) = &mut self.writer else { return Ok(None) };
        writer.row(&row)?;
        self.state.rows[0] += 1;
        if !unloaded && self.earlier {
            writer.move_to(self.folder.path(), || self.folder.promote())?;
            self.earlier = false;
            self.folder.keep();
        }
        Ok(Some(row).filter(|_| !unloaded))
    }

    /// Of a run whose last step was not the last when it was done: its fields come now.
    pub(super) fn finish(&mut self, state: &ModelState) -> Result<()> {
        let number = self.totals.increments;
        if self.scene.output.fields != Fields::Last || self.state.stored == Some(number) {
            return Ok(());
        }
        self.reopen()?;
        self.fields(state, number, self.problem.steps.len(), 1.0)
    }

    /// Writes the fields of a state.
    fn fields(&mut self, state: &ModelState, row: usize, step: usize, load_factor: f64) -> Result<()> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        if self.scene.output.fields == Fields::Last {
            self.state.before_last = Some((writer.lengths(), self.state.stored, self.state.rows[1]));
        }
        let energies = [state.stored, state.dissipated, state.released, state.work];
        writer.fields(self.problem, &state.snapshot, &RowData { row, step, load_factor, energies })?;
        self.state.stored = Some(row);
        self.state.rows[1] += 1;
        Ok(())
    }

    /// The first factor stands: results can be written, beside those of an earlier run as long as these are in place.
    fn begin(&mut self) -> Result<()> {
        let place = if self.earlier { self.folder.staged() } else { self.folder.path().to_path_buf() };
        if !self.earlier {
            self.folder.keep();
        }
        let mut writer = Writer::create(&place, self.name, &self.problem.columns())?;
        writer.list([LATEST])?;
        writer.midplanes(&self.problem.model)?;
        self.writer = Some(writer);
        Ok(())
    }

    /// Of a run that goes on: what was written after its checkpoint goes.
    fn reopen(&mut self) -> Result<()> {
        let Some((lengths, checkpoint)) = self.from.take() else { return Ok(()) };
        if checkpoint != LATEST {
            self.remove(LATEST);
        }
        let columns = self.problem.columns();
        self.writer = Some(Writer::reopen(self.folder.path(), self.name, &columns, &lengths)?);
        Ok(())
    }

    /// Writes the summary if there is a row and it is in place.
    pub(super) fn summary(&mut self, clock: &Clock, end: Option<&Error>) -> Result<()> {
        if end.is_none() {
            self.reopen()?;
        }
        let Results { scene, name, problem, totals, state, .. } = self;
        let (Some(writer), Some(balance), false) = (&self.writer, &self.balance, self.earlier) else {
            return Ok(());
        };
        let (end, counts) = (end.map(Error::to_string), (&*totals, state.rows, &state.resumed[..]));
        writer.summary(&summary::summary(scene, name, problem, counts, balance.clone(), clock, end))
    }
}
