//! The march through the load history of a linear scene: one factorisation per set of supports, one solve per
//! increment, no iteration.

use super::{Clock, memory};
use crate::assembly::Model;
use crate::continuum::{Stresses, recover};
use crate::error::{Error, Result};
use crate::output::Snapshot;
use crate::problem::{ProbeInput, Problem, Stage};
use crate::solver::{Linear, Plan, Solution, System, TooLarge};

/// A solution with a larger backward error is not kept.
const UNUSABLE: f64 = 1e-6;

/// Counts over a whole march.
#[derive(Debug, Clone, Default)]
pub struct Totals {
    /// Increments done.
    pub increments: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// How the matrix is factored.
    pub strategy: &'static str,
    /// Entries of one factor.
    pub factor_entries: usize,
    /// Largest componentwise backward error max |r| / (|A| |u| + |f|).
    pub backward_error: f64,
}

/// Where in the history a state stands.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// Number of the step, from 0.
    pub step: usize,
    /// The step.
    pub stage: &'a Stage,
    /// Number of the increment within its step, from 1; 0 is the unloaded state before the first.
    pub number: usize,
    /// Number of the increment over all steps.
    pub increment: usize,
    /// Load level in the step, 0 to 1.
    pub load_factor: f64,
}

/// The model after an increment.
#[derive(Debug, Clone)]
pub struct State {
    /// Displacements, stresses, jumps, tractions.
    pub snapshot: Snapshot,
    /// External forces by dof [force].
    pub force: Vec<f64>,
    /// Reactions by dof [force].
    pub reactions: Vec<f64>,
    /// Componentwise backward error of the solution.
    pub backward_error: f64,
    /// Elastic energy of bodies and joints [force × length].
    pub stored: f64,
    /// Work of loads and prescribed displacements so far [force × length].
    pub work: f64,
}

/// Called after the unloaded state (`number` 0) and after every increment, with the running counts.
pub type Visit<'a> = &'a mut dyn FnMut(Place, &State, &Totals, &mut Clock) -> Result<()>;

/// Marches through all steps. `stage` hears of every stage of work.
pub fn march(
    problem: &Problem,
    clock: &mut Clock,
    stage: &mut dyn FnMut(&'static str),
    visit: Visit,
) -> Result<Totals> {
    march_within(memory::available(), problem, clock, stage, visit)
}

/// `march` if it can do with the memory that is available [bytes]; else it is refused before the first factor.
pub fn march_within(
    available: Option<u64>,
    problem: &Problem,
    clock: &mut Clock,
    stage: &mut dyn FnMut(&'static str),
    visit: Visit,
) -> Result<Totals> {
    let mut begin = |clock: &mut Clock, name: &'static str| {
        stage(name);
        clock.begin(name);
    };
    begin(clock, "assemble");
    let model = &problem.model;
    let stiffness: Vec<Vec<f64>> = problem
        .laws
        .iter()
        .zip(&model.joints)
        .map(|((law, _), joint)| {
            let [kn, kt] = law.elastic_stiffness();
            [kn, 0.0, 0.0, kt].repeat(joint.coupling.points.len())
        })
        .collect();
    let pattern = model.pattern();
    let continuum = model.continuum(&pattern);
    let system =
        System { joints: &model.joints, stiffness: &stiffness, pattern: &pattern, continuum: &continuum };
    let initial = initial_force(problem);
    begin(clock, "order");
    let plan =
        Plan::analyse(&pattern, &model.coordinates()).map_err(|TooLarge| memory::too_large(model.dofs()))?;
    memory::refuse(model.dofs(), plan.entries(), memory::needed(&plan, &pattern), available)?;

    let mut totals =
        Totals { strategy: plan.strategy(), factor_entries: plan.entries(), ..Totals::default() };
    let mut state = State::unloaded(problem);
    let mut factored: Option<(&[bool], Linear)> = None;
    for (step, stage) in problem.stages.iter().enumerate() {
        let (_, linear) = match factored.take().filter(|(held, _)| *held == stage.held) {
            Some(same) => factored.insert(same),
            None => {
                begin(clock, "factor");
                totals.factorisations += 1;
                let linear = Linear::new(&system, &plan, &stage.held);
                factored.insert((&stage.held, linear.map_err(|_| singular(stage, totals.increments))?))
            }
        };
        if step == 0 {
            visit(Place { step, stage, number: 0, increment: 0, load_factor: 0.0 }, &state, &totals, clock)?;
        }
        let start = state.snapshot.u.clone();
        for number in 1..=stage.increments {
            begin(clock, "solve");
            let load_factor = number as f64 / stage.increments as f64;
            let force = stage.force(model, load_factor)?;
            let loaded: Vec<f64> = force.iter().zip(&initial).map(|(f, f0)| f - f0).collect();
            let prescribed = stage.prescribed(&start, load_factor)?;
            let solution = linear.solve(&loaded, &prescribed);
            if solution.backward_error > UNUSABLE {
                return Err(unusable(stage, number, totals.increments, solution.backward_error));
            }
            begin(clock, "recover");
            state.advance(problem, solution, force);
            if !(state.stored.is_finite() && state.work.is_finite()) {
                return Err(unusable(stage, number, totals.increments, f64::INFINITY)); // every stress counts in these
            }
            totals.increments += 1;
            totals.backward_error = totals.backward_error.max(state.backward_error);
            let place = Place { step, stage, number, increment: totals.increments, load_factor };
            visit(place, &state, &totals, clock)?;
        }
    }
    clock.begin("end");
    Ok(totals)
}

/// Gᵀ Σ w Nᵀ Rᵀ t₀ of the initial tractions (paper eq. 12).
fn initial_force(problem: &Problem) -> Vec<f64> {
    let mut force = vec![0.0; problem.model.dofs()];
    for (joint, (_, initial)) in problem.model.joints.iter().zip(&problem.laws) {
        let tractions: Vec<f64> = (0..joint.coupling.points.len()).flat_map(|p| initial.at(p)).collect();
        joint.add_force(&tractions, &mut force);
    }
    force
}

/// A solution that is none: rounding or overflow has eaten it.
fn unusable(stage: &Stage, increment: usize, kept: usize, error: f64) -> Error {
    let reason = if error.is_finite() {
        format!("rounding leaves a backward error of {error:.1e}")
    } else {
        "numbers overflowed: loads or stiffnesses are out of range".into()
    };
    Error::NoEquilibrium { step: stage.name.clone(), increment, reason, kept }
}

fn singular(stage: &Stage, kept: usize) -> Error {
    let reason = "the stiffness is not positive definite in floating point".into();
    Error::NoEquilibrium { step: stage.name.clone(), increment: 1, reason, kept }
}

impl State {
    fn unloaded(problem: &Problem) -> State {
        let u = vec![0.0; problem.model.dofs()];
        let mut state = State {
            force: u.clone(),
            reactions: u.clone(),
            snapshot: Snapshot { u, ..Snapshot::default() },
            backward_error: 0.0,
            stored: 0.0,
            work: 0.0,
        };
        state.recover(problem);
        state
    }

    /// Takes a solution; external work by the trapezoidal rule, which is exact between two linear states.
    fn advance(&mut self, problem: &Problem, solution: Solution, force: Vec<f64>) {
        let Solution { u, reactions, backward_error } = solution;
        self.work += (0..u.len())
            .map(|i| {
                let mean = 0.5 * (force[i] + reactions[i] + self.force[i] + self.reactions[i]);
                mean * (u[i] - self.snapshot.u[i])
            })
            .sum::<f64>();
        (self.snapshot.u, self.force, self.reactions, self.backward_error) =
            (u, force, reactions, backward_error);
        self.recover(problem);
    }

    /// Stresses, jumps, tractions and energy of the displacements.
    fn recover(&mut self, problem: &Problem) {
        let Problem { model, laws, .. } = problem;
        let u = &self.snapshot.u;
        self.snapshot.stresses = (0..model.bodies.len()).map(|b| stresses(model, b, u)).collect();
        self.stored = self.snapshot.stresses.iter().map(|stresses| stresses.energy).sum();
        (self.snapshot.jumps, self.snapshot.tractions) = (Vec::new(), Vec::new());
        for (joint, (law, initial)) in model.joints.iter().zip(laws) {
            let d = law.elastic_stiffness();
            let jumps: Vec<[f64; 2]> = joint.jumps(u).chunks_exact(2).map(|r| [r[0], r[1]]).collect();
            let traction = |(p, r): (usize, &[f64; 2])| [0, 1].map(|i| d[i] * r[i] + initial.at(p)[i]);
            let tractions: Vec<[f64; 2]> = jumps.iter().enumerate().map(traction).collect();
            for (p, (point, r)) in joint.coupling.points.iter().zip(&jumps).enumerate() {
                let initial = initial.at(p);
                let energy: f64 = (0..2).map(|i| (0.5 * d[i] * r[i] + initial[i]) * r[i]).sum();
                self.stored += model.thickness * point.weight * energy;
            }
            self.snapshot.jumps.push(jumps);
            self.snapshot.tractions.push(tractions);
        }
    }

    /// Values of the scene's probes, then of its reactions.
    pub fn probes(&self, problem: &Problem) -> Vec<f64> {
        let input = ProbeInput {
            u: &self.snapshot.u,
            jumps: &self.snapshot.jumps,
            tractions: &self.snapshot.tractions,
            stored: self.stored,
            dissipated: 0.0,
            work: self.work,
        };
        let probes = problem.probes.iter().map(|(_, probe)| probe.value(&problem.model, &input));
        let reactions = problem
            .reactions
            .iter()
            .map(|reaction| reaction.dofs.iter().map(|&dof| self.reactions[dof]).sum());
        probes.chain(reactions).collect()
    }
}

fn stresses(model: &Model, body: usize, u: &[f64]) -> Stresses {
    let of = &model.bodies[body];
    recover(&of.mesh, &u[model.dofs_of(body)], &of.elasticity, model.thickness)
}
