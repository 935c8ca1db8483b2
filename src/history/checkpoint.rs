//! Checkpoints: the state of a history after an increment, from which it can go on.

use serde::{Deserialize, Serialize};

use super::analysis::Analysis;
use super::equilibrium::Search;
use super::failure::singular;
use super::load;
use super::loading::Start;
use super::settle::initial_force;
use super::{Clock, Equations, History, ModelState, Phase, Position, Totals};
use crate::error::Result;
use crate::problem::Problem;
use crate::solver::Method;

/// A checkpoint that was read.
#[derive(Debug, Clone, Deserialize)]
pub struct Checkpoint {
    position: Position,
    state: ModelState,
    totals: Totals,
    search: Search,
    /// Displacements and reactions at the start of the step under way.
    before: Option<[Vec<f64>; 2]>,
}

/// The state of a history, to be written: a `Checkpoint` is read from it.
#[derive(Debug, Serialize)]
pub struct HistoryState<'a> {
    position: &'a Position,
    state: &'a ModelState,
    totals: &'a Totals,
    search: Search,
    before: Option<[&'a [f64]; 2]>,
}

impl Checkpoint {
    /// Way in which its equations are solved.
    pub fn method(&self) -> Method {
        self.totals.method
    }

    /// True if these equations are solved in that way.
    pub fn fits(&self, equations: &Equations) -> bool {
        self.totals.method == equations.method
    }

    /// The counts up to it.
    pub fn totals(&self) -> &Totals {
        &self.totals
    }
}

impl<'a> History<'a> {
    /// From a checkpoint of a history of the same problem, whose equations are solved in the same way.
    pub fn resume(
        problem: &'a Problem,
        equations: &'a Equations,
        clock: Clock,
        checkpoint: Checkpoint,
    ) -> Result<History<'a>> {
        let Checkpoint { position, mut state, mut totals, search, before } = checkpoint;
        totals.operations = equations.operations; // steps to come may be others
        state.snapshot.stresses = state.stresses(problem);
        let (engine, stop) = (equations.engine(), equations.stop.clone());
        let mut analysis = Analysis { problem, engine, state, totals, clock, stop };
        let mut loads = None;
        let between = matches!(position.phase, Phase::Supports);
        if let (Some(step), false) = (problem.steps.get(position.step_number), between) {
            analysis.clock.begin("factor");
            let kept = analysis.totals.increments;
            analysis.engine.support(&step.constrained).map_err(|_| singular(step, kept))?;
            if let Some([u, reactions]) = before {
                let held = analysis.state.held.clone();
                let start = Start::new(problem, step, initial_force(problem), u, reactions, held);
                let ramp = start.ramp()?;
                let follows = matches!(position.phase, Phase::Path(_));
                load::prepare(&mut analysis, step, &start, ramp.as_ref(), follows);
                loads = Some((start, ramp));
            }
        }
        analysis.engine.restore(search);
        Ok(History { analysis, position, loads })
    }

    /// The state after the last increment, from which the history can go on.
    pub fn checkpoint(&self) -> HistoryState<'_> {
        let Analysis { state, totals, engine, .. } = &self.analysis;
        let within = !matches!(self.position.phase, Phase::Supports);
        let before = self.loads.as_ref().filter(|_| within).map(|(start, _)| start.before());
        HistoryState { position: &self.position, state, totals, search: engine.search(), before }
    }

    /// Number of the step under way, and true if none of it has been done; none if the history does not go on from here.
    pub fn place(&self) -> Option<(usize, bool)> {
        let Position { step_number, phase } = &self.position;
        let lost = matches!(phase, Phase::Lost { .. });
        (!lost).then_some((*step_number, matches!(phase, Phase::Supports)))
    }
}
