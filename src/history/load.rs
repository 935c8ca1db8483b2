//! A step in equal increments of the load factor.

use serde::{Deserialize, Serialize};

use super::analysis::Analysis;
use super::equilibrium::strategy::active;
use super::loading::Start;
use super::outcome::Outcome;
use super::parts::advance;
use super::progress::{LoadIncrement, Reached, StepProgress};
use crate::error::Result;
use crate::problem::BoundStep;
use crate::scene::Fields;
use crate::solver::{LinearMeasure, Ramp};

/// Progress of a step in equal increments.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LoadStep {
    /// Number of the last increment.
    number: usize,
    /// Increments whose fields are not stored do without displacements.
    thrifty: bool,
    at: StepProgress,
}

impl LoadStep {
    /// Before the first increment; `thrifty` as `prepare` says.
    pub(super) fn new(step: &BoundStep, thrifty: bool) -> LoadStep {
        LoadStep { number: 0, thrifty, at: StepProgress::new(1.0 / step.increments as f64) }
    }
}

/// Prepares the loads of a step. True if its increments can do without displacements, which pays where no interface needs them:
/// a measure costs about as much as recovering one increment. A step that `follows` the path needs them.
pub(super) fn prepare(
    analysis: &mut Analysis,
    step: &BoundStep,
    start: &Start,
    ramp: Option<&Ramp>,
    follows: bool,
) -> bool {
    let problem = analysis.problem;
    let known = active(problem).len() == problem.model.interfaces.len() || analysis.engine.finds_all_jumps();
    let unstored = problem.fields != Fields::Every
        && known
        && !follows
        && !step.warms()
        && step.stage.is_none()
        && problem.interfaces.iter().all(|interface| !interface.coupled_pressure);
    let measures: Vec<LinearMeasure> =
        ramp.filter(|_| unstored).map(|ramp| start.measures(ramp)).unwrap_or_default();
    let thrifty = !measures.is_empty() && measures.len() < step.increments;
    let measures = if thrifty { measures } else { Vec::new() };
    analysis.clock.begin("prepare");
    analysis.engine.prepare(ramp, &measures);
    thrifty
}

/// The next increment.
pub(super) fn next(
    analysis: &mut Analysis,
    step: &BoundStep,
    start: &Start,
    LoadStep { number, thrifty, at }: &mut LoadStep,
) -> Result<Reached> {
    *number += 1;
    let number = *number;
    let goal = number as f64 / step.increments as f64;
    analysis.clock.begin("solve");
    let before = at.load_factor;
    let complete = !*thrifty || number == step.increments;
    let part = 1.0 / step.increments as f64;
    let leg = LoadIncrement { start, step, number, goal, part, complete };
    let (iterations, lost) = match advance(analysis, &leg, at)? {
        Outcome::Converged(iterations) => (iterations, None),
        Outcome::Retry(why) => (why.iterations, Some(why)),
    };
    let last = number == step.increments && lost.is_none();
    let moved = lost.is_none() || at.load_factor > before;
    Ok(Reached { number, load_factor: at.load_factor, iterations, last, moved, lost })
}
