//! All steps with one engine: increments of the load factor in as many parts as they need (`parts`), or the path of
//! equilibria (`path`).

use super::equilibrium::strategy::active;
use super::equilibrium::{Ahead, Engine, Failure};
use super::failure::{no_equilibrium, singular, unusable};
use super::loading::{Forces, Start};
use super::march::{NO_BALANCE, Place, Totals, Visit};
use super::parts::{Leg, Progress};
use super::state::State;
use super::{Clock, Resultant, beyond, resultant};
use crate::error::{Error, Result};
use crate::problem::{Problem, Stage, is_held};
use crate::scene::{Control, Fields};
use crate::solver::Unconverged;

/// Initial tractions whose forces are out of balance by less than this part are so by rounding.
const ROUNDED: f64 = 1e-10;
/// Rounding of forces, of those that the displacements would make.
const ROUNDING: f64 = 1e-11;

/// A march under way.
pub(super) struct Course<'a, 'b> {
    pub(super) problem: &'a Problem,
    pub(super) engine: &'b mut dyn Engine,
    pub(super) totals: Totals,
    pub(super) state: State,
    initial: Vec<f64>,
    /// Largest sum of the magnitudes of loads and reactions so far [force].
    forces: f64,
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
        Course { problem, engine, totals, state, initial, forces: 0.0, clock, begin, visit }
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
            if step == 0 {
                self.settle(stage, &initial)?;
            }
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

    /// Lets initial tractions, and those of overlaps, that supports and loads do not hold relax, before the first increment.
    fn settle(&mut self, stage: &'a Stage, initial: &[f64]) -> Result<()> {
        let problem = self.problem;
        let mut tractions = vec![0.0; problem.model.dofs()];
        let mut sum = 0.0;
        let mut given = false;
        for (k, (joint, (_, initial))) in problem.model.joints.iter().zip(&problem.laws).enumerate() {
            let states = &problem.states[k];
            // faces that overlap press on each other without a traction of the scene
            let at = |p: usize| states.get(p).map_or(initial.at(p), |state| state.traction.into());
            let points = 0..joint.coupling.points.len();
            given |= points.clone().any(|p| initial.at(p) != [0.0; 2]);
            let at: Vec<f64> = points.flat_map(at).collect();
            if at.iter().any(|t| *t != 0.0) {
                joint.add_force(&at, &mut tractions);
            }
        }
        sum += tractions.iter().map(|f| f.abs()).sum::<f64>();
        if sum == 0.0 {
            return Ok(());
        }
        let start = Start::new(problem, stage, initial, &self.state.snapshot.u, &self.state.reactions);
        let load = start.at(0.0)?;
        let Forces { force, released, .. } = load.forces();
        // forces of what is not in equilibrium at the start, on free dofs
        let left: Vec<f64> = (0..tractions.len())
            .map(|i| if stage.held[i] { 0.0 } else { force[i] + released[i] - tractions[i] })
            .collect();
        let rest = left.iter().map(|f| f.abs()).sum::<f64>() / sum;
        if rest <= ROUNDED {
            return Ok(());
        }
        self.stage("solve");
        self.engine.prepare(None, &[]);
        self.state.open(None);
        let released = self.engine.solve(&self.state, &load, Ahead::default(), true);
        let found = released.map_err(|failure| match failure {
            Failure::Unconverged(why) => no_equilibrium(problem, stage, 1, 0, 0.0, &why),
            Failure::Unusable(error) => unusable(stage, 1, 0, error),
        })?;
        self.totals.iterations += found.iterations;
        let work = |u: &[f64]| 0.5 * left.iter().zip(u).map(|(f, u)| f * u).sum::<f64>();
        let released = found.solution.as_ref().map_or(0.0, |solution| work(&solution.u));
        self.engine.accept();
        self.state.accept(problem, found, load);
        self.state.released += released;
        self.state.recover(problem);
        self.totals.initial = if given { [rest, released] } else { [0.0; 2] };
        Ok(())
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
        let mut at = Progress::new(part);
        for number in 1..=stage.increments {
            let goal = number as f64 / stage.increments as f64;
            self.stage("solve");
            let before = at.level;
            let complete = !thrifty || number == stage.increments;
            let went = self.advance(&Leg { start, stage, number, goal, part, complete }, &mut at)?;
            let (iterations, lost) = match went {
                Ok(iterations) => (iterations, None),
                Err(why) => (why.iterations, Some(why)),
            };
            let place = Place { number, load_factor: at.level, iterations, ..self.place(step, stage) };
            if lost.is_none() || at.level > before {
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
        let imbalance = self.imbalance();
        if imbalance > NO_BALANCE {
            let reason = format!("loads and reactions are out of balance by {imbalance:.1e} of their sum");
            let (step, kept) = (place.stage.name.clone(), self.totals.increments);
            return Err(Error::NoEquilibrium { step, increment: place.number, reason, kept });
        }
        self.totals.increments += 1;
        if imbalance > self.totals.imbalance {
            (self.totals.imbalance, self.totals.imbalance_at) = (imbalance, self.totals.increments);
        }
        self.note_unheld(place.stage);
        beyond::note(self.problem, &self.state, self.totals.increments, &mut self.totals.beyond);
        if self.state.energy_balance().abs() > self.totals.energy_balance {
            self.totals.balance_at = self.totals.increments;
        }
        self.totals.released = self.state.released;
        self.totals.residual = self.totals.residual.max(self.state.residual);
        self.totals.energy_balance = self.totals.energy_balance.max(self.state.energy_balance().abs());
        self.visit(Place { increment: self.totals.increments, ..place })
    }

    /// Out-of-balance of loads and reactions over the largest sum of their magnitudes so far; 0 where nothing but rounding acts,
    /// and where displacements were not recovered.
    fn imbalance(&mut self) -> f64 {
        if self.state.force.is_empty() {
            return 0.0;
        }
        let model = &self.problem.model;
        let Resultant { rest, scale } = resultant(model, &self.state.force, &self.state.reactions);
        let young = model.bodies.iter().map(|body| body.elasticity.young).fold(0.0, f64::max);
        let moved = self.state.snapshot.u.iter().map(|u| u.abs()).fold(0.0, f64::max);
        self.forces = self.forces.max(scale);
        let rounding = ROUNDING * young * moved * model.thickness;
        if rest > rounding { rest / self.forces } else { 0.0 }
    }

    /// Notes the subdomains whose interfaces are all open and that the supports leave free.
    fn note_unheld(&mut self, stage: &Stage) {
        let model = &self.problem.model;
        let states = &self.state.snapshot.states;
        let open = |k: usize| {
            !states[k].is_empty()
                && states[k].iter().all(|state| state.traction.x == 0.0 && state.traction.y == 0.0)
        };
        for (b, body) in model.bodies.iter().enumerate() {
            let mut of = (0..model.joints.len()).filter(|&k| model.joints[k].bodies.contains(&b)).peekable();
            if of.peek().is_some()
                && of.all(open)
                && !self.totals.unheld.iter().any(|(name, _)| *name == body.name)
                && !is_held(model, b, &stage.held)
            {
                self.totals.unheld.push((body.name.clone(), self.totals.increments));
            }
        }
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
