//! All steps with one engine: increments of the load level that are halved where there is no equilibrium and grow back, or
//! the path of equilibria (`path`).

use super::Clock;
use super::engine::{Engine, Failure};
use super::failure::{no_equilibrium, singular, unusable};
use super::loading::Start;
use super::march::{Place, Totals, Visit};
use super::state::State;
use super::strategy::active;
use crate::error::Result;
use crate::problem::{Problem, Stage};
use crate::scene::{Control, Fields};
use crate::solver::Unconverged;

/// An increment is halved at most this many times before the joints are let go, and so many times more if they find no rest.
const HALVINGS: i32 = 10;
const LAST: i32 = 6;
/// How many times wider than half of it an increment may be that follows one in which the joints were let go.
const AFTER: f64 = 8.0;
/// An increment found in at most this many iterations is followed by one of twice the size.
const EASY: usize = 8;

/// A march under way.
pub(super) struct Course<'a, 'b> {
    pub(super) problem: &'a Problem,
    pub(super) engine: &'b mut dyn Engine,
    pub(super) totals: Totals,
    pub(super) state: State,
    initial: Vec<f64>,
    clock: &'b mut Clock,
    begin: &'b mut dyn FnMut(&mut Clock, &'static str),
    visit: Visit<'b>,
}

impl<'a, 'b> Course<'a, 'b> {
    /// Before the first step.
    pub(super) fn new(
        problem: &'a Problem,
        engine: &'b mut dyn Engine,
        totals: Totals,
        clock: &'b mut Clock,
        begin: &'b mut dyn FnMut(&mut Clock, &'static str),
        visit: Visit<'b>,
    ) -> Course<'a, 'b> {
        let (initial, state) = (initial_force(problem), State::unloaded(problem));
        Course { problem, engine, totals, state, initial, clock, begin, visit }
    }

    /// Goes through all steps.
    pub(super) fn march(mut self) -> Result<Totals> {
        let problem = self.problem;
        for (step, stage) in problem.stages.iter().enumerate() {
            self.stage("factor");
            let factored = self.engine.support(&stage.held);
            self.totals.factorisations +=
                usize::from(factored.map_err(|_| singular(stage, self.totals.increments))?);
            if step == 0 {
                self.visit(Place { step, stage, number: 0, ..self.place(step, stage) })?;
            }
            let initial = self.initial.clone();
            let start = Start::new(problem, stage, &initial, &self.state.snapshot.u, &self.state.reactions);
            match stage.control {
                Control::Auto | Control::Arclength if !active(problem).is_empty() => {
                    self.path_step(step, stage, &start)?
                }
                _ => self.load_step(step, stage, &start)?,
            }
        }
        self.clock.begin("end");
        Ok(self.totals)
    }

    /// A step in equal increments of the load level.
    fn load_step(&mut self, step: usize, stage: &'a Stage, start: &Start) -> Result<()> {
        let problem = self.problem;
        let ramp = start.ramp()?;
        // increments whose fields are not stored do without displacements where no joint needs them and it pays: a
        // measure costs about as much as recovering one increment
        let known = active(problem).len() == problem.model.joints.len() || self.engine.finds_all_jumps();
        let unstored = problem.fields != Fields::Every && known;
        let measures =
            ramp.as_ref().filter(|_| unstored).map(|ramp| start.measures(ramp)).unwrap_or_default();
        let thrifty = !measures.is_empty() && measures.len() < stage.increments;
        let measures = if thrifty { measures } else { Vec::new() };
        self.stage("prepare");
        self.engine.prepare(ramp.as_ref(), &measures);
        self.state.open(ramp.filter(|_| thrifty).map(|ramp| start.ledger(&ramp)));
        let part = 1.0 / stage.increments as f64;
        let (mut level, mut width, mut last) = (0.0, part, f64::INFINITY);
        for number in 1..=stage.increments {
            let goal = number as f64 / stage.increments as f64;
            let mut iterations = 0;
            let mut lost = None;
            while level < goal {
                self.stage("solve");
                let reached = if level + 1.001 * width >= goal { goal } else { level + width };
                let load = start.at(reached)?;
                let complete = !thrifty || number == stage.increments;
                let tried = match self.engine.solve(&self.state, &load, (reached - level) / last, complete) {
                    Ok(found) => self.leap(start, [level, reached], last, found)?,
                    Err(Failure::Unconverged(why)) => Err(why),
                    Err(Failure::Unusable(error)) => {
                        return Err(unusable(stage, number, self.totals.increments, error));
                    }
                };
                match tried {
                    Ok((found, leap)) => {
                        iterations += found.iterations;
                        if found.iterations <= EASY {
                            width = (2.0 * width).min(part);
                        }
                        if let Some(level) = leap {
                            self.leapt(stage, level);
                        }
                        self.engine.accept();
                        self.state.accept(problem, found, load);
                        (last, level) = (reached - level, reached);
                    }
                    Err(why) => {
                        iterations += why.iterations;
                        self.totals.halved += 1;
                        width = 0.5 * (reached - level);
                        let smallest = 0.5_f64.powi(HALVINGS) * part;
                        if width >= smallest {
                            continue;
                        }
                        match self.engine.relax(&self.state, &load, complete) {
                            Ok(found) => {
                                iterations += found.iterations;
                                let leaps = self.leaps(&found);
                                if leaps {
                                    self.leapt(stage, reached);
                                }
                                self.engine.accept();
                                self.state.accept(problem, found, load);
                                last = if leaps { f64::INFINITY } else { reached - level };
                                width = (AFTER * width).min(part);
                                level = reached;
                            }
                            Err(_) if width >= 0.5_f64.powi(LAST) * smallest => {}
                            Err(_) => {
                                lost = Some(why);
                                break;
                            }
                        }
                    }
                }
            }
            let between = level > (number - 1) as f64 / stage.increments as f64;
            let place = Place { number, load_factor: level, iterations, ..self.place(step, stage) };
            if lost.is_none() || between {
                self.row(Place { last: number == stage.increments && lost.is_none(), ..place })?;
            } else {
                self.totals.iterations += iterations;
            }
            if let Some(why) = lost {
                return self.stop(place, start, &why);
            }
        }
        Ok(())
    }

    /// Keeps that the next increment leaps at a load level.
    pub(super) fn leapt(&mut self, stage: &Stage, level: f64) {
        self.totals.leaps.push((self.totals.increments + 1, stage.name.clone(), level));
    }

    /// A place in a step, to be filled in.
    pub(super) fn place(&self, step: usize, stage: &'a Stage) -> Place<'a> {
        let increment = self.totals.increments;
        let (number, load_factor, iterations) = (0, 0.0, 0);
        Place { step, stage, number, increment, load_factor, iterations, last: false, ended: false }
    }

    /// A stage of work begins.
    pub(super) fn stage(&mut self, name: &'static str) {
        (self.begin)(self.clock, name);
    }

    fn visit(&mut self, place: Place) -> Result<()> {
        (self.visit)(place, &self.state, &self.totals, self.clock)
    }

    /// An increment has converged: recovers its fields and shows it.
    pub(super) fn row(&mut self, place: Place) -> Result<()> {
        self.stage("recover");
        self.totals.iterations += place.iterations;
        self.state.recover(self.problem);
        if !(self.state.stored.is_finite() && self.state.work.is_finite()) {
            // every stress counts in these
            return Err(unusable(place.stage, place.number, self.totals.increments, f64::INFINITY));
        }
        self.totals.increments += 1;
        self.totals.residual = self.totals.residual.max(self.state.residual);
        self.totals.energy_balance = self.totals.energy_balance.max(self.state.energy_balance().abs());
        self.visit(Place { increment: self.totals.increments, ..place })
    }

    /// No equilibrium beyond the last increment: shows it once more with all its fields.
    pub(super) fn stop(&mut self, place: Place, start: &Start, why: &Unconverged) -> Result<()> {
        let Place { stage, number, load_factor, .. } = place;
        let increment = self.totals.increments;
        if increment > 0 {
            self.state.complete(self.problem, self.engine, start.at(load_factor)?);
            self.visit(Place { increment, iterations: 0, ended: true, ..place })?;
        }
        Err(no_equilibrium(self.problem, stage, number, increment, load_factor, why))
    }
}

/// Gᵀ Σ w Nᵀ Rᵀ t₀ of the initial tractions of elastic joints (paper eq. 12); other laws know theirs.
fn initial_force(problem: &Problem) -> Vec<f64> {
    let mut force = vec![0.0; problem.model.dofs()];
    for ((joint, (_, initial)), states) in problem.model.joints.iter().zip(&problem.laws).zip(&problem.states)
    {
        if states.is_empty() {
            let tractions: Vec<f64> = (0..joint.coupling.points.len()).flat_map(|p| initial.at(p)).collect();
            joint.add_force(&tractions, &mut force);
        }
    }
    force
}
