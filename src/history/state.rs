//! The model after an increment: what converged, and its energies.
//!
//! ```text
//! stored      ½ uᵀ K u + Σ h w ½ tᵀ D⁻¹ t          dissipated   Σ h w ∫ t · dr^p, as the laws integrate it
//! work        Σ ½ (f₀ + f₁) · Δu                   released     viscous work of snaps, and what falls off at once
//! ```
//!
//! f: loads and reactions; the sums go over the accepted parts of all increments. Each energy is measured where it happens, so
//! that work − stored − dissipated − released is an error: of second order in the parts, and none of round-off size if a
//! dissipation or an energy is wrong.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::converged::{Converged, InterfaceResponse};
use super::energy::{across, carried, work_to};
use super::held::{HeldForces, presence_at_first};
use super::loading::{Ledger, LoadForces, StepLoad};
use super::prestress::{holding, stresses, warmed};
use super::water::{water_at, water_work};
use crate::assembly::InterfaceOperator;
use crate::continuum::Stresses;
use crate::law::{self, Local, local};
use crate::output::Snapshot;
use crate::problem::{BoundInterface, BoundProbe, ProbeInput, Problem, WaterFields};
use crate::solver::NodalSolution;

/// Rounding of an energy, of that of a body strained by its own displacement.
const ROUNDING: f64 = 1e-12;

/// The model after an increment.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ModelState {
    /// Jumps, tractions and states of the interfaces; displacements and stresses of the bodies where fields are stored, else
    /// none.
    pub snapshot: Snapshot,
    /// External forces by dof [force]; none where fields are not stored.
    pub force: Vec<f64>,
    /// Reactions by dof [force]; none where fields are not stored.
    pub reactions: Vec<f64>,
    /// Componentwise backward error of the solution; relative out-of-balance force where interfaces are not elastic.
    pub residual: f64,
    /// The residual before every iteration and at the end; of an increment that was divided, those of its last part.
    pub residuals: Vec<f64>,
    /// Elastic energy of bodies and interfaces [force × length].
    pub stored: f64,
    /// Energy dissipated by the interfaces so far [force × length].
    pub dissipated: f64,
    /// Work of loads and prescribed displacements so far [force × length].
    pub work: f64,
    /// Energy released by snaps so far [force × length].
    pub released: f64,
    /// Work of the pressures in interfaces so far, part of `work` [force × length].
    pub water_work: f64,
    /// Largest energy so far [force × length].
    largest: f64,
    /// Measures of a step without displacements; none outside such a step.
    ledger: Option<Ledger>,
    /// Interfaces whose jumps were found as unknowns, not taken from displacements.
    found: Vec<bool>,
    /// Step and load factor.
    pub(super) at: (usize, f64),
    /// Forces of parts that have gone.
    pub(super) held: Vec<HeldForces>,
    /// The most that interfaces have carried, √(Σ w |t|²) [stress × √length].
    pub(super) most_carried: f64,
}

impl ModelState {
    /// Before the first increment.
    pub(super) fn unloaded(problem: &Problem) -> ModelState {
        let u = vec![0.0; problem.model.dofs()];
        let none = |interface: &InterfaceOperator| vec![Local::zeros(); interface.coupling.points.len()];
        let snapshot = Snapshot {
            u: u.clone(),
            jumps: problem.model.interfaces.iter().map(none).collect(),
            states: problem.interfaces.iter().map(|interface| interface.states.clone()).collect(),
            presence: presence_at_first(problem),
            ..Snapshot::default()
        };
        let (force, reactions) = (u.clone(), u);
        let (stored, dissipated, work, released, largest) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (residual, residuals) = (0.0, vec![0.0]);
        let mut state = ModelState {
            snapshot,
            force,
            reactions,
            residual,
            residuals,
            stored,
            dissipated,
            work,
            released,
            water_work: 0.0,
            largest,
            ledger: None,
            found: vec![false; problem.interfaces.len()],
            at: (0, 0.0),
            held: Vec::new(),
            most_carried: 0.0,
        };
        if let Some([force, reactions]) = holding(problem) {
            (state.force, state.reactions) = (force, reactions);
        }
        state.recover(problem);
        state
    }

    /// Opens a step whose increments may do without displacements.
    pub(super) fn open(&mut self, ledger: Option<Ledger>) {
        self.ledger = ledger;
    }

    /// True if displacements were recovered.
    pub(super) fn is_complete(&self) -> bool {
        !self.snapshot.u.is_empty()
    }

    /// Takes what converged under a load.
    pub(super) fn accept(&mut self, problem: &Problem, found: Converged, load: StepLoad) {
        let Converged { solution, mut ledger, interfaces, released, residuals, .. } = found;
        let at = (load.step(), load.load_factor);
        self.most_carried = self.most_carried.max(carried(problem, &self.snapshot).sqrt());
        self.released += released;
        if let Some(solution) = &solution {
            self.work += warmed(problem, [self.at, at], [&self.snapshot.u, &solution.u]);
        }
        self.at = at;
        self.work += match (&ledger, &self.ledger, &solution) {
            (Some(now), Some(before), _) => now.work_since(before),
            (_, _, Some(solution)) if self.is_complete() => {
                work_to(&self.snapshot, [&self.force, &self.reactions], solution, &load)
            }
            _ => f64::NAN, // an engine that keeps no ledger recovers every increment
        };
        if let Some(ledger) = &mut ledger {
            let measured = problem.probes.iter().map(|(_, probe)| probe).filter(|probe| probe.is_measured());
            let probed = measured.map(|probe| match probe {
                BoundProbe::Reaction(dofs) => Some(dofs),
                _ => None,
            });
            let all = probed.chain(problem.reactions.iter().map(|reaction| Some(&reaction.dofs)));
            for (column, dofs) in ledger.columns.iter_mut().zip(all) {
                *column += dofs.map_or(0.0, |dofs| load.left_of(dofs));
            }
        }
        self.ledger = ledger;
        let before = (std::mem::take(&mut self.snapshot.water), self.snapshot.jumps.clone());
        (self.snapshot.u, self.force, self.reactions) = (Vec::new(), Vec::new(), Vec::new());
        if let Some(NodalSolution { u, mut reactions, .. }) = solution {
            let LoadForces { force, released, .. } = load.into_forces();
            reactions.iter_mut().zip(&released).for_each(|(reaction, released)| *reaction += released);
            (self.snapshot.u, self.force, self.reactions) = (u, force, reactions);
        }
        for InterfaceResponse { interface, jumps, memory } in interfaces {
            let old = &mut self.snapshot.states[interface];
            let points = &problem.model.interfaces[interface].coupling.points;
            for ((point, old), answer) in points.iter().zip(old).zip(memory) {
                let area = problem.model.thickness * point.weight;
                self.dissipated += area * answer.dissipation;
                self.released += area * answer.released;
                *old = answer.state;
            }
            let presence = &self.snapshot.presence;
            let counted = |(p, jump): (usize, Local)| match presence.is_absent(interface) {
                true => Local::zeros(),
                false => presence.counted(interface, p, jump),
            };
            self.snapshot.jumps[interface] = jumps.into_iter().enumerate().map(counted).collect();
            self.found[interface] = true;
        }
        self.take_water(problem, &before);
        self.residual = residuals[residuals.len() - 1];
        self.residuals = residuals;
    }

    /// Pressures after a part, and their work in it.
    fn take_water(&mut self, problem: &Problem, (water, jumps): &(WaterFields, Vec<Vec<Local>>)) {
        if problem.steps.iter().all(|step| step.water.is_none()) {
            return;
        }
        for (k, interface) in problem.model.interfaces.iter().enumerate() {
            if !self.found[k] && self.is_complete() {
                let jumps = interface.jumps(&self.snapshot.u);
                self.snapshot.jumps[k] = jumps.chunks_exact(problem.model.components).map(local).collect();
            }
        }
        self.snapshot.water = water_at(problem, &self.snapshot, self.at);
        let now = (&self.snapshot.water, &self.snapshot.jumps[..]);
        let [all, coupled] = water_work(problem, (water, jumps), now);
        self.water_work += all;
        self.work += coupled;
    }

    /// Counts as an equilibrium of the laws alone, which leave this residual.
    pub(super) fn stands(&mut self, residual: f64) {
        self.residual = residual;
        self.residuals = vec![residual];
    }

    /// Takes what an increment without stored fields has left out.
    pub(super) fn complete(&mut self, problem: &Problem, solution: NodalSolution, load: StepLoad) {
        let NodalSolution { u, mut reactions, .. } = solution;
        let LoadForces { force, released, .. } = load.into_forces();
        reactions.iter_mut().zip(&released).for_each(|(reaction, released)| *reaction += released);
        (self.snapshot.u, self.force, self.reactions) = (u, force, reactions);
        self.recover(problem);
    }

    /// Stresses, tractions and stored energy of the displacements and states.
    pub(super) fn recover(&mut self, problem: &Problem) {
        let Problem { model, interfaces, .. } = problem;
        let u = &self.snapshot.u;
        self.snapshot.stresses = self.stresses(problem);
        self.stored = match &self.ledger {
            Some(ledger) if !self.is_complete() => ledger.stored(across(model, &self.snapshot)),
            _ => self.snapshot.stresses.iter().map(|stresses| stresses.energy).sum(),
        };
        if let Some(step) = problem.steps.get(self.at.0) {
            self.stored += step.own_strain_energy(self.at.1);
        }
        self.snapshot.tractions = Vec::new();
        for (k, (interface, bound)) in model.interfaces.iter().zip(interfaces).enumerate() {
            let BoundInterface { laws, initial, states: starts, .. } = bound;
            let area = |p: usize| model.thickness * interface.coupling.points[p].weight;
            if bound.is_linear() {
                let d = |p: usize| Local::from(laws.at(p).elastic_stiffness());
                if !self.found[k] {
                    self.snapshot.jumps[k] =
                        interface.jumps(u).chunks_exact(model.components).map(local).collect();
                }
                let jumps = &self.snapshot.jumps[k];
                let traction = |(p, r): (usize, &Local)| d(p).component_mul(r) + initial.at(p);
                self.snapshot.tractions.push(jumps.iter().enumerate().map(traction).collect());
                if !self.is_complete() {
                    continue; // the ledger has the energy of elastic interfaces
                }
                for (p, r) in jumps.iter().enumerate() {
                    let energy = ((0.5 * d(p)).component_mul(r) + initial.at(p)).dot(r);
                    self.stored += area(p) * energy;
                }
            } else if self.snapshot.presence.is_absent(k) {
                self.snapshot.tractions.push(vec![Local::zeros(); interface.coupling.points.len()]);
            } else {
                let states = &self.snapshot.states[k];
                // of a part that has come again nothing was stored before
                let starts = if self.snapshot.presence.origins.get(k).is_some_and(|own| !own.is_empty()) {
                    bound.anew.as_ref().unwrap_or(starts)
                } else {
                    starts
                };
                for (p, (state, start)) in states.iter().zip(starts).enumerate() {
                    let law = laws.at(p);
                    self.stored += area(p) * (law.stored(state) - law.stored(start));
                }
                self.snapshot.tractions.push(states.iter().map(|state| state.traction).collect());
            }
        }
        let energies = [self.work, self.stored, self.dissipated, self.released].map(f64::abs);
        self.largest = energies.into_iter().fold(self.largest.max(self.rounding(problem)), f64::max);
    }

    /// Energy that displacements have by rounding: below it a balance says nothing.
    fn rounding(&self, problem: &Problem) -> f64 {
        let young = problem.model.subdomains.iter().map(|subdomain| subdomain.elasticity.young);
        let moved = self.snapshot.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        ROUNDING * young.fold(0.0, f64::max) * moved * moved * problem.model.thickness
    }

    /// Stresses of all bodies; none where displacements are not known.
    pub(super) fn stresses(&self, problem: &Problem) -> Vec<Stresses> {
        let bodies = if self.is_complete() { problem.model.subdomains.len() } else { 0 };
        (0..bodies).into_par_iter().map(|b| stresses(problem, self.at, b, &self.snapshot.u)).collect()
    }

    /// The largest energy so far [force × length].
    pub(super) fn largest_energy(&self) -> f64 {
        self.largest.max(self.work.abs()).max(self.dissipated)
    }

    /// Work of the viscosity of laws so far, part of what is dissipated [force × length].
    pub(super) fn viscous_work(&self, problem: &Problem) -> f64 {
        let interfaces = problem.model.interfaces.iter().zip(&problem.interfaces).zip(&self.snapshot.states);
        let of = |((interface, bound), states): ((&InterfaceOperator, &BoundInterface), &Vec<law::State>)| {
            if !bound.laws.kind().is_viscous() {
                return 0.0;
            }
            let points = interface.coupling.points.iter().zip(states).enumerate();
            points.map(|(p, (point, state))| point.weight * bound.laws.at(p).viscous_work(state)).sum::<f64>()
        };
        problem.model.thickness * interfaces.map(of).sum::<f64>()
    }

    /// work − stored − dissipated − released over the largest of them so far.
    pub fn energy_balance(&self) -> f64 {
        let left = self.work - self.stored - self.dissipated - self.released;
        if left == 0.0 { 0.0 } else { left / self.largest }
    }

    /// Values of the scene's probes, then of its reactions.
    pub fn probes(&self, problem: &Problem) -> Vec<f64> {
        let input = ProbeInput {
            u: &self.snapshot.u,
            reactions: &self.reactions,
            jumps: &self.snapshot.jumps,
            tractions: &self.snapshot.tractions,
            interfaces: &problem.interfaces,
            states: &self.snapshot.states,
            stored: self.stored,
            dissipated: self.dissipated,
            released: self.released,
            viscous: self.viscous_work(problem),
            water: &self.snapshot.water,
            water_work: self.water_work,
            load_factor: self.at.1,
            work: self.work,
        };
        let mut columns =
            self.ledger.iter().filter(|_| !self.is_complete()).flat_map(|ledger| &ledger.columns).copied();
        let mut values = Vec::with_capacity(problem.probes.len() + problem.reactions.len());
        for (_, probe) in &problem.probes {
            let prepared = if probe.is_measured() { columns.next() } else { None };
            let value = prepared.unwrap_or_else(|| probe.value(&problem.model, &input, &values));
            values.push(value);
        }
        for reaction in &problem.reactions {
            let sum = || reaction.dofs.iter().map(|&dof| self.reactions[dof]).sum();
            values.push(columns.next().unwrap_or_else(sum));
        }
        values
    }
}
