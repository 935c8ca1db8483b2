//! Loads that are affine in the load factor, and constraints that say how far an increment on their path goes.
//!
//! ```text
//! g = Σ h w ΔD(r) / Δτ − 1             the energy that the interfaces dissipate: it never decreases
//! g = Σ h w p·Δr / Σ h w p·p − 1       the change of the jumps along a predicted one p: a plane across the path
//! ```
//!
//! The sum of the laws' own dissipation is taken: formulas from energies hold for interfaces that unload to their origin, ours
//! unload elastically.

use super::evaluation::Evaluation;
use super::{Form, Respond};

/// A load that is affine in the load factor: b₀ and b₁.
#[derive(Debug, Clone)]
pub struct Affine {
    /// Target at load factor 0.
    pub start: Vec<f64>,
    /// Its change up to load factor 1.
    pub change: Vec<f64>,
}

impl Affine {
    /// From the targets at levels 0 and 1.
    pub fn new(start: Vec<f64>, end: &[f64]) -> Affine {
        let change = end.iter().zip(&start).map(|(end, start)| end - start).collect();
        Affine { start, change }
    }

    /// The target at a load factor.
    pub fn at(&self, load_factor: f64) -> Vec<f64> {
        self.start.iter().zip(&self.change).map(|(start, change)| start + load_factor * change).collect()
    }
}

/// Constraint on the size of an increment.
#[derive(Debug, Clone)]
pub enum Constraint {
    /// As far as it dissipates this energy.
    Dissipate(f64),
    /// From the jumps of every active interface by a change of them, or what is across it.
    Move {
        /// The jumps.
        from: Vec<Vec<f64>>,
        /// Their change.
        by: Vec<Vec<f64>>,
    },
}

impl Constraint {
    /// By the change of the jumps between two sets of unknowns.
    pub fn between(form: &impl Form, from: &[f64], to: &[f64]) -> Constraint {
        let jumps = |x: &[f64]| -> Vec<Vec<f64>> {
            let of = |(&k, a): (&usize, Vec<f64>)| form.interfaces()[k].jumps_of(&a);
            form.active().iter().zip(form.coefficients(x)).map(of).collect()
        };
        let (from, mut by) = (jumps(from), jumps(to));
        by.iter_mut().flatten().zip(from.iter().flatten()).for_each(|(by, from)| *by -= from);
        Constraint::Move { from, by }
    }

    /// g.
    pub(super) fn missing<L: Respond>(&self, form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> f64 {
        match self {
            Constraint::Dissipate(amount) => dissipated(form, laws, now) / amount - 1.0,
            Constraint::Move { from, by } => {
                let moved = (now.jumps.iter().zip(from))
                    .map(|(now, from)| now.iter().zip(from).map(|(now, from)| now - from).collect())
                    .collect::<Vec<Vec<f64>>>();
                product(form, by, &moved) / product(form, by, by) - 1.0
            }
        }
    }

    /// Its derivative by the jump coefficients of every active interface.
    pub(super) fn slope<L: Respond>(
        &self,
        form: &impl Form,
        laws: &L,
        now: &Evaluation<L::Memory>,
    ) -> Vec<Vec<f64>> {
        let (mut slope, amount) = match self {
            Constraint::Dissipate(amount) => (rates(form, laws, now), *amount),
            Constraint::Move { by, .. } => {
                let of = |(&k, by): (&usize, &Vec<f64>)| form.interfaces()[k].gather(by);
                (form.active().iter().zip(by).map(of).collect(), product(form, by, by))
            }
        };
        slope.iter_mut().flatten().for_each(|value| *value /= amount);
        slope
    }
}

/// Σ h w a·b of two sets of values at the law points.
fn product(form: &impl Form, a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let of = |((&k, a), b): ((&usize, &Vec<f64>), &Vec<f64>)| {
        let interface = &form.interfaces()[k];
        let components = interface.coupling.components;
        let at =
            |(p, (a, b)): (usize, (&f64, &f64))| interface.coupling.points[p / components].weight * a * b;
        interface.thickness() * a.iter().zip(b).enumerate().map(at).sum::<f64>()
    };
    form.active().iter().zip(a).zip(b).map(of).sum()
}

/// Energy dissipated since the last accepted increment.
pub(super) fn dissipated<L: Respond>(form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> f64 {
    let interfaces = form.active().iter().zip(&now.memory);
    let of = |(&k, memory): (&usize, &Vec<L::Memory>)| {
        let interface = &form.interfaces()[k];
        let points = interface.coupling.points.iter().zip(memory);
        points.map(|(p, memory)| interface.thickness() * p.weight * laws.dissipation(memory).0).sum::<f64>()
    };
    interfaces.map(of).sum()
}

/// Its derivative by the jump coefficients of every active interface.
fn rates<L: Respond>(form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> Vec<Vec<f64>> {
    let interfaces = form.active().iter().zip(&now.memory);
    let of = |(&k, memory): (&usize, &Vec<L::Memory>)| {
        let rates: Vec<f64> = memory.iter().flat_map(|memory| laws.dissipation(memory).1).copied().collect();
        form.interfaces()[k].gather(&rates)
    };
    interfaces.map(of).collect()
}
