//! The load history, increment by increment.
//!
//! ```text
//! while let Some(increment) = history.next()? { write; tell; keep a checkpoint }
//!
//! step      load factor in equal increments (`load`), or the path of equilibria (`path`)
//! increment as many parts as its accuracy asks for (`parts`, `judge`), else a viscous stretch (`viscous`, `rest`)
//! part      an equilibrium (`equilibrium`), accepted into the state (`state`)
//! ```

mod account;
mod analysis;
mod arclength;
mod balance;
mod beyond;
mod checkpoint;
mod clock;
mod converged;
mod dissipate;
mod energy;
mod equilibrium;
mod failure;
mod held;
mod increment;
mod judge;
mod limit;
mod load;
mod loading;
pub mod memory;
mod nowhere;
mod outcome;
mod parts;
mod path;
mod prestress;
mod progress;
mod rest;
mod settle;
mod snap;
mod stages;
mod state;
mod stretch;
mod totals;
mod trial;
mod viscous;
mod water;
mod water_loads;

pub use balance::{Resultant, resultant};
pub use beyond::Beyond;
pub use checkpoint::{Checkpoint, HistoryState};
pub use clock::{Clock, PartNow, StageNow, processor};
pub use equilibrium::strategy::Operations;
pub use equilibrium::{Equations, Means};
pub use increment::Increment;
pub use state::ModelState;
pub use totals::{Snap, Totals};

use serde::{Deserialize, Serialize};

use account::account;
use analysis::{Analysis, complete};
use equilibrium::strategy::active;
use failure::{no_equilibrium, singular, stopped};
use load::LoadStep;
use loading::Start;
use path::PathStep;
use settle::{initial_force, settle};

use crate::error::{Error, Result};
use crate::problem::{BoundStep, Problem};
use crate::scene::Control;
use crate::solver::{Ramp, Unconverged};

/// The history of a problem.
pub struct History<'a> {
    analysis: Analysis<'a>,
    position: Position,
    /// Loads of the step under way.
    loads: Option<(Start<'a>, Option<Ramp>)>,
}

/// Position of a history.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Position {
    /// Number of the step.
    step_number: usize,
    phase: Phase,
}

/// Phase of a step.
#[derive(Debug, Clone, Serialize, Deserialize)]
enum Phase {
    /// Its supports are still to be factored.
    Supports,
    /// Its loads are still to be prepared.
    Loads,
    /// Increments of the load factor.
    Load(LoadStep),
    /// Increments along the path.
    Path(PathStep),
    /// No equilibrium beyond an increment, at a load factor; the last one has been given once more, or not.
    Lost { number: usize, load_factor: f64, why: Unconverged, shown: bool },
}

impl<'a> History<'a> {
    /// Before the first step.
    pub fn new(problem: &'a Problem, equations: &'a Equations, clock: Clock) -> History<'a> {
        let totals = Totals {
            method: equations.method,
            operations: equations.operations,
            distinct: equations.distinct(),
            factor_entries: equations.factor_entries,
            ..Totals::default()
        };
        let (engine, state) = (equations.engine(), ModelState::unloaded(problem));
        let position = Position { step_number: 0, phase: Phase::Supports };
        let stop = equations.stop.clone();
        History { analysis: Analysis { problem, engine, state, totals, clock, stop }, position, loads: None }
    }

    /// The model after the last increment.
    pub fn state(&self) -> &ModelState {
        &self.analysis.state
    }

    /// The counts so far.
    pub fn totals(&self) -> &Totals {
        &self.analysis.totals
    }

    /// The clock, whose stages go on between increments.
    pub fn clock(&mut self) -> &mut Clock {
        &mut self.analysis.clock
    }

    /// The next increment; first the unloaded state with number 0, none at the end. Where no equilibrium is found the last
    /// increment comes once more with all its fields, and then the error; so it does where the run is asked to stop.
    #[expect(clippy::should_implement_trait, reason = "a history ends with an error or without")]
    pub fn next(&mut self) -> Result<Option<Increment<'a>>> {
        let problem = self.analysis.problem;
        while let Some(step) = problem.steps.get(self.position.step_number) {
            self.end_if_stopped();
            let step_number = self.position.step_number;
            if let Some(increment) = self.go_on(step_number, step)? {
                return Ok(Some(increment));
            }
        }
        self.analysis.clock.begin("end");
        Ok(None)
    }

    /// Goes no further if the run is asked to stop.
    fn end_if_stopped(&mut self) {
        let begun = self.position.step_number > 0 || !matches!(self.position.phase, Phase::Supports);
        let ended = matches!(self.position.phase, Phase::Lost { .. });
        if let Some(why) = stopped(&self.analysis.stop).filter(|_| begun && !ended) {
            let load_factor = self.analysis.state.at.1;
            self.position.phase = Phase::Lost { number: 0, load_factor, why, shown: false };
        }
    }

    /// The next phase of a step, and the increment that it gives.
    fn go_on(&mut self, step_number: usize, step: &'a BoundStep) -> Result<Option<Increment<'a>>> {
        let History { analysis, position, loads } = self;
        let at = Increment::of(step_number, step, analysis.totals.increments);
        let reached = match (&mut position.phase, loads) {
            (Phase::Supports, loads) => {
                *loads = None;
                analysis.clock.begin("factor");
                let factored = analysis.engine.support(&step.constrained);
                let factored = factored.map_err(|_| singular(step, analysis.totals.increments))?;
                analysis.totals.factorisations += usize::from(factored);
                position.phase = Phase::Loads;
                return Ok((step_number == 0).then_some(at));
            }
            (Phase::Load(at), Some((start, _))) => load::next(analysis, step, start, at)?,
            (Phase::Path(at), Some((start, Some(ramp)))) => path::next(analysis, step, start, ramp, at)?,
            (Phase::Lost { number, load_factor, why, shown }, loads) => {
                if !*shown {
                    *shown = true;
                    let Analysis { problem, engine, state, .. } = analysis;
                    if let Some((start, _)) = loads.as_ref().filter(|_| !state.is_complete()) {
                        complete(problem, &**engine, state, start.at(*load_factor)?);
                    }
                    let (number, load_factor) = (*number, *load_factor);
                    return Ok(Some(Increment { number, load_factor, ended: true, ..at }));
                }
                let kept = analysis.totals.increments;
                if let Some(signal) = analysis.stop.requested() {
                    return Err(Error::stopped(signal));
                }
                return Err(no_equilibrium(analysis.problem, step, *number, kept, *load_factor, why));
            }
            (Phase::Loads | Phase::Load(_) | Phase::Path(_), _) => {
                self.open(step_number, step)?;
                return Ok(None);
            }
        };
        let progress::Reached { number, load_factor, iterations, last, moved, lost } = reached;
        if let Some(why) = lost {
            position.phase = Phase::Lost { number, load_factor, why, shown: false };
        } else if last {
            *position = Position { step_number: step_number + 1, phase: Phase::Supports };
        }
        if !moved {
            analysis.totals.iterations += iterations;
            return Ok(None);
        }
        let mut increment = Increment { number, load_factor, iterations, last, ..at };
        account(analysis, &mut increment)?;
        Ok(Some(increment))
    }

    /// Prepares the loads of a step.
    fn open(&mut self, step_number: usize, step: &'a BoundStep) -> Result<()> {
        let History { analysis, position, loads } = self;
        let problem = analysis.problem;
        analysis.state.enter(problem, step);
        let start = |state: &ModelState| {
            let (u, reactions) = (state.snapshot.u.clone(), state.reactions.clone());
            Start::new(problem, step, initial_force(problem), u, reactions, state.held.clone())
        };
        if step_number == 0 {
            let unloaded = start(&analysis.state);
            settle(analysis, step, &unloaded)?;
        }
        let start = start(&analysis.state);
        let ramp = start.ramp()?;
        let follows = step.control != Control::Load && !active(problem).is_empty() && ramp.is_some();
        let thrifty = load::prepare(analysis, step, &start, ramp.as_ref(), follows);
        analysis.state.open(ramp.as_ref().filter(|_| thrifty).map(|ramp| start.ledger(ramp)));
        position.phase = match follows {
            true => Phase::Path(PathStep::new(step, analysis.state.dissipated)),
            false => Phase::Load(LoadStep::new(step, thrifty)),
        };
        *loads = Some((start, ramp));
        Ok(())
    }
}
