//! One step, bound: what is held and loaded at any load factor λ.
//!
//! ```text
//! u(λ) = u₀ + λ (u₁ − u₀),     f(λ) = f₀ + λ (f₁ − f₀)     and, where load_factor occurs in a formula, its value at λ
//! ```

use std::sync::Arc;

use super::load::BoundLoad;
use super::quantity::Quantity;
use super::{Prestress, StepWater, prestress};
use crate::assembly::Model;
use crate::error::Result;
use crate::scene::{Control, FormulaPlace, StepStage};

/// One step, bound.
#[derive(Debug, Clone)]
pub struct BoundStep {
    /// Number of the step.
    pub number: usize,
    /// Name of the step.
    pub name: String,
    /// Parts that come and go in it; none if all are there, always.
    pub stage: Option<StepStage>,
    /// Number of increments.
    pub increments: usize,
    /// Control from increment to increment.
    pub control: Control,
    /// Held dofs.
    pub constrained: Vec<bool>,
    /// Dofs that were held and are free now: their reaction goes to zero over the step.
    pub released: Vec<usize>,
    /// Displacement of every held dof at the end of the step [length].
    pub(super) prescribed: Vec<f64>,
    /// Dofs that stay where they are at the start of the step, whatever their target.
    pub(super) frozen: Vec<bool>,
    /// Dofs whose displacement follows a formula in load_factor.
    pub(super) moving: Vec<Moving>,
    /// External forces that ramp, at the start of the step [force].
    pub(super) force_start: Vec<f64>,
    /// The same at its end.
    pub(super) force_end: Vec<f64>,
    /// Initial stresses and eigenstrains, subdomain by subdomain; empty without any.
    pub prestress: Vec<Option<Arc<Prestress>>>,
    /// Pressures in the interfaces; none without water.
    pub water: Option<Arc<StepWater>>,
    /// Loads that follow a formula in load_factor.
    pub(super) changing: Vec<Arc<BoundLoad>>,
}

/// A held dof whose displacement follows a formula in load_factor.
#[derive(Debug, Clone)]
pub(super) struct Moving {
    pub(super) dof: usize,
    pub(super) place: FormulaPlace,
    pub(super) value: Arc<Quantity>,
}

impl Moving {
    /// Its displacement at a load factor.
    pub(super) fn at(&self, load_factor: f64) -> Result<f64> {
        self.value.at(&FormulaPlace { load_factor, ..self.place })
    }
}

impl BoundStep {
    /// External forces at a load factor [force].
    pub fn force(&self, model: &Model, load_factor: f64) -> Result<Vec<f64>> {
        let mut force = self.ramped(load_factor);
        for load in &self.changing {
            load.add(model, load_factor, &mut force)?;
        }
        Ok(force)
    }

    /// The same without those that follow a formula.
    pub fn ramped(&self, load_factor: f64) -> Vec<f64> {
        ramp(&self.force_start, &self.force_end, load_factor)
    }

    /// Displacements of the held dofs at a load factor, for those at the start of the step [length].
    pub fn prescribed(&self, start: &[f64], load_factor: f64) -> Result<Vec<f64>> {
        let mut u = self.moved(start, load_factor);
        for moving in &self.moving {
            u[moving.dof] = moving.at(load_factor)?;
        }
        Ok(u)
    }

    /// The same without those that follow a formula.
    pub fn moved(&self, start: &[f64], load_factor: f64) -> Vec<f64> {
        let mut u = ramp(start, &self.prescribed, load_factor);
        for (dof, _) in self.frozen.iter().enumerate().filter(|(_, frozen)| **frozen) {
            u[dof] = start[dof];
        }
        u
    }

    /// Nodal forces of initial stresses and eigenstrains; none without any [force].
    pub fn prestress_forces(&self, model: &Model, load_factor: f64) -> Option<Vec<f64>> {
        prestress::forces(model, &self.prestress, load_factor)
    }

    /// Energy of the eigenstrains in rigid confinement, ½ ∫ ε*ᵀ C ε* [force × length].
    pub fn own_strain_energy(&self, load_factor: f64) -> f64 {
        self.prestress.iter().flatten().map(|own| own.energy(load_factor)).sum()
    }

    /// True if temperature or strains change in it.
    pub fn warms(&self) -> bool {
        self.prestress.iter().flatten().any(|own| own.changes())
    }

    /// True if a formula in load_factor makes loads or displacements anything but a ramp.
    pub fn follows_load_factor(&self) -> bool {
        !(self.changing.is_empty() && self.moving.is_empty()) || self.water_follows_load_factor()
    }

    /// True if the load factor stands in a pressure of an interface.
    pub(super) fn water_follows_load_factor(&self) -> bool {
        self.water.as_ref().is_some_and(|water| water.follows_load_factor())
    }

    /// True if loads and displacements are affine in the load factor, so that the path of equilibria can be followed.
    pub fn is_affine(&self) -> bool {
        self.changing.iter().all(|load| load.is_affine())
            && self.moving.iter().all(|moving| moving.value.is_affine())
            && !self.water_follows_load_factor()
    }

    /// Asks every formula in load_factor at every increment, so that none fails half-way.
    pub(super) fn check(&self, model: &Model) -> Result<()> {
        self.water.iter().try_for_each(|water| water.check(model, self.increments))?;
        if !self.follows_load_factor() {
            return Ok(());
        }
        let mut unused = vec![0.0; model.dofs()];
        for number in 1..=self.increments {
            let load_factor = number as f64 / self.increments as f64;
            self.moving.iter().try_for_each(|moving| moving.at(load_factor).map(|_| ()))?;
            self.changing.iter().try_for_each(|load| load.add(model, load_factor, &mut unused))?;
        }
        Ok(())
    }
}

fn ramp(start: &[f64], end: &[f64], load_factor: f64) -> Vec<f64> {
    let between = |(a, b): (&f64, &f64)| if load_factor == 1.0 { *b } else { a + load_factor * (b - a) };
    start.iter().zip(end).map(between).collect()
}
