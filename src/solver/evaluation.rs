//! Evaluation of the laws of all interfaces and of a form at some unknowns.

use rayon::prelude::*;

use super::iterate::{Iterate, Unconverged};
use super::press::subtract;
use super::{Form, Pressures, Respond};
use crate::assembly::InterfaceOperator;

/// A law point is asked by itself; fewer than this many are not worth a thread.
const CHUNK: usize = 32;
/// Law points that are named when no equilibrium is found.
const NAMED: usize = 3;

/// A point of the search and what the laws say there.
pub(super) struct Evaluation<M> {
    pub(super) jumps: Vec<Vec<f64>>,
    pub(super) tractions: Vec<Vec<f64>>,
    pub(super) stiffness: Vec<Vec<f64>>,
    pub(super) forces: Vec<Vec<f64>>,
    pub(super) memory: Vec<Vec<M>>,
    pub(super) pressures: Option<Pressures>,
    pub(super) residual: Vec<f64>,
    pub(super) error: f64,
}

impl<M> Evaluation<M> {
    pub(super) fn into_iterate(self, x: Vec<f64>) -> Iterate<M> {
        let Evaluation { jumps, tractions, forces, memory, error, .. } = self;
        Iterate { x, jumps, tractions, forces, memory, iterations: 0, residuals: vec![error] }
    }
}

/// The answers of the laws at the law points of every active interface, without what the form makes of them.
#[derive(Debug)]
pub struct Answers<M> {
    /// Jumps (n, t, …).
    pub jumps: Vec<Vec<f64>>,
    /// Tractions alike.
    pub tractions: Vec<Vec<f64>>,
    /// Tangents, by rows.
    pub stiffness: Vec<Vec<f64>>,
    /// Forces q on the jump coefficients.
    pub forces: Vec<Vec<f64>>,
    /// Memory of the law points.
    pub memory: Vec<Vec<M>>,
    /// Pressures that depend on the jumps; the tractions are less these.
    pub pressures: Option<Pressures>,
}

/// Asks the laws at the jumps of some unknowns, and the form for what is left.
pub(super) fn evaluate<L: Respond>(
    form: &impl Form,
    laws: &L,
    x: &[f64],
    target: &[f64],
) -> Result<Evaluation<L::Memory>, Unconverged> {
    evaluate_at(form, laws, x, target, false)
}

/// The same, with the derivatives by the load factor if these are asked for.
pub(super) fn evaluate_at<L: Respond>(
    form: &impl Form,
    laws: &L,
    x: &[f64],
    target: &[f64],
    by_load_factor: bool,
) -> Result<Evaluation<L::Memory>, Unconverged> {
    let Answers { jumps, tractions, stiffness, forces, memory, pressures } =
        answers(form, laws, x, by_load_factor)?;
    let residual = form.residual(x, &forces, target);
    let error = form.error(&residual, x, &forces, target);
    Ok(Evaluation { jumps, tractions, stiffness, forces, memory, pressures, residual, error })
}

/// Asks the laws at the jumps of some unknowns.
pub fn ask<L: Respond>(form: &impl Form, laws: &L, x: &[f64]) -> Result<Answers<L::Memory>, Unconverged> {
    answers(form, laws, x, false)
}

fn answers<L: Respond>(
    form: &impl Form,
    laws: &L,
    x: &[f64],
    by_load_factor: bool,
) -> Result<Answers<L::Memory>, Unconverged> {
    let coefficients = form.coefficients(x);
    // many interfaces have few points, others many
    let asked: Vec<_> = (form.active().par_iter().zip(&coefficients))
        .map(|(&k, coefficients)| of_interface(&form.interfaces()[k], laws, k, coefficients))
        .collect();
    let (mut all_jumps, mut tractions, mut stiffness) = (Vec::new(), Vec::new(), Vec::new());
    let mut memory = Vec::new();
    for asked in asked {
        let OfInterface { jumps, tractions: t, stiffness: d, memory: m } = asked?;
        all_jumps.push(jumps);
        tractions.push(t);
        stiffness.push(d);
        memory.push(m);
    }
    let pressures = laws.pressures(form.active(), &all_jumps, &mut memory, by_load_factor);
    let pressures = pressures.map_err(|reason| Unconverged { reason, worst: Vec::new(), iterations: 0 })?;
    if let Some(pressures) = &pressures {
        let components = form.active().first().map_or(0, |&k| form.interfaces()[k].coupling.components);
        subtract(pressures, components, &mut tractions, &mut stiffness);
    }
    let active = form.active().par_iter().zip(&tractions);
    let forces = active.map(|(&k, t)| form.interfaces()[k].gather(t)).collect();
    Ok(Answers { jumps: all_jumps, tractions, stiffness, forces, memory, pressures })
}

/// The answers at the law points of one interface.
struct OfInterface<M> {
    jumps: Vec<f64>,
    tractions: Vec<f64>,
    stiffness: Vec<f64>,
    memory: Vec<M>,
}

fn of_interface<L: Respond>(
    interface: &InterfaceOperator,
    laws: &L,
    k: usize,
    coefficients: &[f64],
) -> Result<OfInterface<L::Memory>, Unconverged> {
    let c = interface.coupling.components;
    let jumps = interface.jumps_of(coefficients);
    let (mut tractions, mut stiffness) = (vec![0.0; jumps.len()], vec![0.0; c * jumps.len()]);
    let answers: Result<Vec<L::Memory>, Unconverged> = (jumps.par_chunks_exact(c))
        .zip(tractions.par_chunks_exact_mut(c))
        .zip(stiffness.par_chunks_exact_mut(c * c))
        .enumerate()
        .with_min_len(CHUNK)
        .map(|(p, ((jump, t), d))| {
            laws.respond(k, p, jump, t, d).map_err(|reason| Unconverged {
                reason,
                worst: vec![(k, p)],
                iterations: 0,
            })
        })
        .collect();
    Ok(OfInterface { jumps, tractions, stiffness, memory: answers? })
}

/// Names the law points with the largest misfit.
pub(super) fn unconverged<M>(
    form: &impl Form,
    reason: &str,
    now: &Evaluation<M>,
    iterations: usize,
) -> Unconverged {
    let mut worst: Vec<(f64, usize, usize)> = Vec::new();
    for (&k, misfit) in form.active().iter().zip(form.coefficients(&now.residual)) {
        let interface = &form.interfaces()[k];
        let size = |jump: &[f64]| jump.iter().map(|r| r * r).sum::<f64>();
        let sizes = interface.jumps_of(&misfit);
        let sizes = sizes.chunks_exact(interface.coupling.components).map(size);
        worst.extend(sizes.enumerate().map(|(p, size)| (size, k, p)));
    }
    worst.sort_by(|a, b| b.0.total_cmp(&a.0));
    let worst = worst.iter().take(NAMED).map(|&(_, k, p)| (k, p)).collect();
    Unconverged { reason: reason.into(), worst, iterations }
}
