//! An analysis under way: the model, what finds its equilibria, its state and the counts.

use super::Clock;
use super::equilibrium::Engine;
use super::loading::StepLoad;
use super::state::ModelState;
use super::totals::Totals;
use crate::error::Stop;
use crate::problem::Problem;

/// The data that every step of a history works on.
pub(super) struct Analysis<'a> {
    pub(super) problem: &'a Problem,
    pub(super) engine: Box<dyn Engine + 'a>,
    pub(super) state: ModelState,
    pub(super) totals: Totals,
    pub(super) clock: Clock,
    /// A request to stop.
    pub(super) stop: Stop,
}

/// Recovers what an increment without stored fields has left out of a state.
pub(super) fn complete(problem: &Problem, engine: &dyn Engine, state: &mut ModelState, load: StepLoad) {
    if state.is_complete() {
        return;
    }
    if let Some(solution) = engine.recover(&load) {
        state.complete(problem, solution, load);
    }
}
