//! The loads of one step as the engine sees them, and what the history asks of the displacements.

use std::cell::OnceCell;

use serde::{Deserialize, Serialize};

use super::held::HeldForces;
use crate::error::Result;
use crate::problem::{BoundProbe, BoundStep, Problem};
use crate::shape::Ends;
use crate::solver::{LinearMeasure, Ramp};

/// A load factor of a step. Its forces are made when they are asked for: an increment without displacements needs none.
#[derive(Debug, Clone)]
pub(super) struct StepLoad<'s> {
    /// Load factor in the step, 0 to 1.
    pub(super) load_factor: f64,
    start: &'s Start<'s>,
    forces: OnceCell<LoadForces>,
}

/// Loads and prescribed displacements at one load factor.
#[derive(Debug, Clone)]
pub(super) struct LoadForces {
    /// External forces [force].
    pub(super) force: Vec<f64>,
    /// Remainder of released reactions [force].
    pub(super) released: Vec<f64>,
    /// External forces and released reactions less those of initial tractions and of stresses beyond the strains' [force].
    pub(super) loaded: Vec<f64>,
    /// Displacements of held dofs [length].
    pub(super) prescribed: Vec<f64>,
}

impl StepLoad<'_> {
    /// The step, and the load factor in it.
    pub(super) fn at(&self) -> (&BoundStep, f64) {
        (self.start.step, self.load_factor)
    }

    /// Number of the step.
    pub(super) fn step(&self) -> usize {
        self.start.step.number
    }

    /// Loads and prescribed displacements.
    pub(super) fn forces(&self) -> &LoadForces {
        self.forces.get_or_init(|| self.start.ramped(self.load_factor))
    }

    /// The same.
    pub(super) fn into_forces(self) -> LoadForces {
        self.forces.into_inner().unwrap_or_else(|| self.start.ramped(self.load_factor))
    }

    /// Sum of the released reactions that remain at some dofs [force].
    pub(super) fn left_of(&self, dofs: &[usize]) -> f64 {
        match self.start.step.released.is_empty() {
            true => 0.0,
            false => dofs.iter().map(|&dof| self.forces().released[dof]).sum(),
        }
    }
}

/// Start of a step.
#[derive(Debug)]
pub(super) struct Start<'a> {
    problem: &'a Problem,
    step: &'a BoundStep,
    initial: Vec<f64>,
    u: Vec<f64>,
    reactions: Vec<f64>,
    held: Vec<HeldForces>,
}

impl<'a> Start<'a> {
    /// The step.
    pub(super) fn step(&self) -> &'a BoundStep {
        self.step
    }

    /// Displacements and reactions at the end of the step before.
    pub(super) fn before(&self) -> [&[f64]; 2] {
        [&self.u, &self.reactions]
    }

    /// Start from displacements and reactions at the end of the step before. `initial`: forces of the initial tractions of elastic
    /// interfaces.
    pub(super) fn new(
        problem: &'a Problem,
        step: &'a BoundStep,
        initial: Vec<f64>,
        u: Vec<f64>,
        reactions: Vec<f64>,
        held: Vec<HeldForces>,
    ) -> Start<'a> {
        let mut initial = initial;
        if !step.warms()
            && let Some(prestress) = step.prestress_forces(&problem.model, 1.0)
        {
            initial.iter_mut().zip(prestress).for_each(|(initial, p)| *initial += p);
        }
        Start { problem, step, initial, u, reactions, held }
    }

    /// Loads at a load factor.
    pub(super) fn at(&self, load_factor: f64) -> Result<StepLoad<'_>> {
        let load = StepLoad { load_factor, start: self, forces: OnceCell::new() };
        if !self.step.follows_load_factor() {
            return Ok(load);
        }
        // only formulas can fail
        let (force, prescribed) =
            (self.step.force(&self.problem.model, load_factor)?, self.step.prescribed(&self.u, load_factor)?);
        Ok(StepLoad { forces: OnceCell::from(self.forces(load_factor, force, prescribed)), ..load })
    }

    /// Forces of a step without formulas in the load factor.
    fn ramped(&self, load_factor: f64) -> LoadForces {
        self.forces(load_factor, self.step.ramped(load_factor), self.step.moved(&self.u, load_factor))
    }

    fn forces(&self, load_factor: f64, mut force: Vec<f64>, prescribed: Vec<f64>) -> LoadForces {
        HeldForces::add(&self.held, self.step, load_factor, &mut force);
        let mut released = vec![0.0; self.u.len()];
        let left = |dof: usize| (1.0 - load_factor) * self.reactions[dof];
        self.step.released.iter().for_each(|&dof| released[dof] = left(dof));
        let mut loaded: Vec<f64> =
            force.iter().zip(&released).zip(&self.initial).map(|((f, r), f0)| f + r - f0).collect();
        if self.step.warms()
            && let Some(prestress) = self.step.prestress_forces(&self.problem.model, load_factor)
        {
            loaded.iter_mut().zip(prestress).for_each(|(loaded, p)| *loaded -= p);
        }
        LoadForces { force, released, loaded, prescribed }
    }

    /// Loads at both ends if they are affine between them.
    pub(super) fn ramp(&self) -> Result<Option<Ramp>> {
        if !self.step.is_affine() {
            return Ok(None);
        }
        let [start, end] = [self.at(0.0)?.into_forces(), self.at(1.0)?.into_forces()];
        Ok(Some(Ramp { force: [start.loaded, end.loaded], prescribed: [start.prescribed, end.prescribed] }))
    }

    /// The ledger of the state that the step starts from.
    pub(super) fn ledger(&self, ramp: &Ramp) -> Ledger {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let reactions: Vec<f64> = self
            .reactions
            .iter()
            .zip(&self.step.constrained)
            .map(|(r, &constrained)| if constrained { *r } else { 0.0 })
            .collect();
        let [f0, f1] = [0, 1].map(|end| dot(&ramp.force[end], &self.u));
        let [r0, r1] = [0, 1].map(|end| dot(&ramp.prescribed[end], &reactions));
        let (loads, supports) = ([f0, f1 - f0], [r0, r1 - r0]);
        Ledger {
            load_factor: 0.0,
            loads,
            supports,
            initial: dot(&self.initial, &self.u),
            columns: Vec::new(),
        }
    }

    /// Measures that work, energy and history need when these are not recovered: see `Ledger`.
    pub(super) fn measures(&self, ramp: &Ramp) -> Vec<LinearMeasure> {
        let terms = |at: &dyn Fn(usize) -> f64| -> Vec<(usize, f64)> {
            (0..self.u.len()).map(|i| (i, at(i))).filter(|(_, value)| *value != 0.0).collect()
        };
        let constrained = |i: usize| self.step.constrained[i];
        let ([f0, f1], [u0, u1]) = (&ramp.force, &ramp.prescribed);
        let mut measures = vec![
            LinearMeasure::Displacement(terms(&|i| f0[i])),
            LinearMeasure::Displacement(terms(&|i| f1[i] - f0[i])),
            LinearMeasure::Reaction(terms(&|i| if constrained(i) { u0[i] } else { 0.0 })),
            LinearMeasure::Reaction(terms(&|i| if constrained(i) { u1[i] - u0[i] } else { 0.0 })),
            LinearMeasure::Displacement(terms(&|i| self.initial[i])),
        ];
        for (_, probe) in &self.problem.probes {
            match probe {
                BoundProbe::Displacement(weights) => {
                    measures.push(LinearMeasure::Displacement(weights.clone()));
                }
                BoundProbe::Reaction(dofs) => {
                    let terms = dofs.iter().map(|&dof| (dof, 1.0));
                    measures.push(LinearMeasure::Reaction(terms.collect()));
                }
                _ => {}
            }
        }
        for reaction in &self.problem.reactions {
            measures.push(LinearMeasure::Reaction(reaction.dofs.iter().map(|&dof| (dof, 1.0)).collect()));
        }
        measures
    }
}

/// The measures of one increment, in the order of `Start::measures`.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Ledger {
    /// Load factor.
    pub(super) load_factor: f64,
    /// f · u with the loads at the step's start, and with their change.
    pub(super) loads: Ends,
    /// Reactions · ū with the displacements at the step's start, and with their change.
    pub(super) supports: Ends,
    /// Forces of the initial tractions · u.
    pub(super) initial: f64,
    /// Probes of displacements and reactions, then reactions.
    pub(super) columns: Vec<f64>,
}

impl Ledger {
    /// From what an engine has measured.
    pub(super) fn new(load_factor: f64, measured: &[f64]) -> Option<Ledger> {
        let [f0, f1, r0, r1, initial, columns @ ..] = measured else { return None };
        let (loads, supports) = ([*f0, *f1], [*r0, *r1]);
        Some(Ledger { load_factor, loads, supports, initial: *initial, columns: columns.to_vec() })
    }

    /// ½ (f₀ + f₁) · Δu of loads and reactions from an earlier ledger to this one; initial tractions are no loads.
    pub(super) fn work_since(&self, before: &Ledger) -> f64 {
        let mean = 0.5 * (self.load_factor + before.load_factor);
        let loads = self.loads[0] - before.loads[0] + mean * (self.loads[1] - before.loads[1]);
        let supports =
            0.5 * (self.supports[1] + before.supports[1]) * (self.load_factor - before.load_factor);
        loads + supports + self.initial - before.initial
    }

    /// Elastic energy of the bodies and of the interfaces that are elastic, `across`: Σ q · a of all others.
    pub(super) fn stored(&self, across: f64) -> f64 {
        let loads = self.loads[0] + self.load_factor * self.loads[1];
        let supports = self.supports[0] + self.load_factor * self.supports[1];
        0.5 * (loads + supports - across) + self.initial
    }
}
