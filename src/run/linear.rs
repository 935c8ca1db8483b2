//! A linear scene: one factorisation per set of supports, one solve per increment, no iteration.

use super::prepare::{columns, no_equilibrium, refuse_nonlinear};
use super::summary::{self, Totals};
use super::{Done, Event, Listener, Prepared};
use crate::assembly::Model;
use crate::continuum::recover;
use crate::error::Result;
use crate::output::{Row, Snapshot, Writer};
use crate::problem::{ProbeInput, Problem, Stage};
use crate::scene::Fields;
use crate::solver::{Linear, Solution, Symbolic, System};

/// Solves all steps and writes the results.
pub(super) fn solve(mut prepared: Prepared, listen: Listener) -> Result<Done> {
    refuse_nonlinear(&prepared.scene)?;
    let Prepared { scene, name, problem, folder, clock } = &mut prepared;
    let model = &problem.model;
    let first = &problem.stages[0].name;
    let singular = |step: &str, kept| {
        no_equilibrium(step, 1, kept, "the stiffness is not positive definite in floating point")
    };

    listen(Event::Stage("assemble"));
    clock.begin("assemble");
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
    listen(Event::Stage("order"));
    clock.begin("order");
    let symbolic = Symbolic::analyse(&pattern).map_err(|_| singular(first, 0))?;

    let total: usize = problem.stages.iter().map(|stage| stage.increments).sum();
    let mut totals = Totals { factor_entries: symbolic.entries(), ..Totals::default() };
    let mut writer: Option<Writer> = None;
    let mut state = State::unloaded(problem);
    let mut factored: Option<(&[bool], Linear)> = None;
    for (index, stage) in problem.stages.iter().enumerate() {
        if factored.as_ref().is_none_or(|(held, _)| *held != stage.held) {
            listen(Event::Stage("factor"));
            clock.begin("factor");
            let linear = Linear::new(&system, &symbolic, &stage.held)
                .map_err(|_| singular(&stage.name, totals.increments))?;
            factored = Some((&stage.held, linear));
            totals.factorisations += 1;
        }
        let Some((_, linear)) = &factored else { continue };
        // the results folder is opened once the first factor stands: a run that is refused leaves the last one in place
        let writer = match &mut writer {
            Some(writer) => writer,
            None => {
                clock.begin("write");
                folder.keep();
                let mut opened = Writer::create(folder.path(), name, &columns(problem))?;
                opened.midplanes(model)?;
                if matches!(scene.output.fields, Fields::Every | Fields::Step) {
                    opened.fields(model, &state.snapshot, 0, 0.0)?;
                }
                writer.insert(opened)
            }
        };
        let start = state.snapshot.u.clone();
        for number in 1..=stage.increments {
            listen(Event::Stage("solve"));
            clock.begin("solve");
            let load_factor = number as f64 / stage.increments as f64;
            let force = force(stage, load_factor);
            let loaded: Vec<f64> = force.iter().zip(&initial).map(|(f, f0)| f - f0).collect();
            let ramp = |(u0, u1): (&f64, &f64)| u0 + load_factor * (u1 - u0);
            let prescribed: Vec<f64> = start.iter().zip(&stage.target).map(ramp).collect();
            let solution = linear.solve(&loaded, &prescribed);
            clock.begin("recover");
            state.advance(problem, solution, force);
            totals.add(state.backward_error);
            let row = state.row(problem, stage, totals.increments, load_factor);
            clock.begin("write");
            let last = totals.increments == total;
            let wanted = match scene.output.fields {
                Fields::Every => true,
                Fields::Step => number == stage.increments,
                Fields::Last => last,
                Fields::None => false,
            };
            if wanted {
                writer.fields(model, &state.snapshot, totals.increments, index as f64 + load_factor)?;
            }
            writer.row(&row)?;
            listen(Event::Increment { row: &row, number, of: stage.increments, total });
        }
    }
    clock.begin("end");
    if let Some(writer) = &writer {
        let balance = summary::balance(model, &state.force, &state.reactions);
        writer.summary(&summary::summary(scene, name, problem, &totals, balance, clock))?;
    }
    let collection = folder.path().join(format!("{name}.pvd"));
    Ok(Done { folder: folder.path().into(), collection, clock: clock.clone() })
}

/// External forces within a step.
fn force(stage: &Stage, load_factor: f64) -> Vec<f64> {
    let ramp = |(f0, f1): (&f64, &f64)| f0 + load_factor * (f1 - f0);
    stage.force_start.iter().zip(&stage.force_end).map(ramp).collect()
}

/// Gᵀ Σ w Nᵀ Rᵀ t₀ of the initial tractions (paper eq. 12).
fn initial_force(problem: &Problem) -> Vec<f64> {
    let mut force = vec![0.0; problem.model.dofs()];
    for (joint, (_, initial)) in problem.model.joints.iter().zip(&problem.laws) {
        joint.add_force(&initial.repeat(joint.coupling.points.len()), &mut force);
    }
    force
}

/// Where the run stands.
struct State {
    snapshot: Snapshot,
    force: Vec<f64>,
    reactions: Vec<f64>,
    backward_error: f64,
    stored: f64,
    work: f64,
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

    fn recover(&mut self, problem: &Problem) {
        let Problem { model, laws, .. } = problem;
        let u = &self.snapshot.u;
        self.snapshot.stresses = (0..model.bodies.len()).map(|b| stresses(model, b, u)).collect();
        self.stored = self.snapshot.stresses.iter().map(|stresses| stresses.energy).sum();
        (self.snapshot.jumps, self.snapshot.tractions) = (Vec::new(), Vec::new());
        for (joint, (law, initial)) in model.joints.iter().zip(laws) {
            let d = law.elastic_stiffness();
            let jumps: Vec<[f64; 2]> = joint.jumps(u).chunks_exact(2).map(|r| [r[0], r[1]]).collect();
            let tractions: Vec<[f64; 2]> =
                jumps.iter().map(|r| [0, 1].map(|i| d[i] * r[i] + initial[i])).collect();
            for (point, r) in joint.coupling.points.iter().zip(&jumps) {
                let energy: f64 = (0..2).map(|i| (0.5 * d[i] * r[i] + initial[i]) * r[i]).sum();
                self.stored += model.thickness * point.weight * energy;
            }
            self.snapshot.jumps.push(jumps);
            self.snapshot.tractions.push(tractions);
        }
    }

    fn row(&self, problem: &Problem, stage: &Stage, increment: usize, load_factor: f64) -> Row {
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
        Row {
            step: stage.name.clone(),
            increment,
            load_factor,
            iterations: 0,
            residual: self.backward_error,
            values: probes.chain(reactions).collect(),
        }
    }
}

fn stresses(model: &Model, body: usize, u: &[f64]) -> crate::continuum::Stresses {
    let of = &model.bodies[body];
    recover(&of.mesh, &u[model.dofs_of(body)], &of.elasticity, model.thickness)
}
