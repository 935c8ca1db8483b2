//! Newton's method with a line search, for any form of the equilibrium K u + Gᵀ q(G u) = f.
//!
//! A form (`dual`, `plain`) turns the equation into a residual R(x) of its own unknowns x and solves with its own
//! Jacobian; laws answer jump by jump. The line search halves a step until the residual decreases: where points open, stick
//! and slide by turns, full steps run in circles.

use serde::{Deserialize, Serialize};

use super::apart::{FREE, LOOSE, moved_apart, opens_freely};
use super::evaluation::{Answers, Evaluation, ask, evaluate, unconverged};
use super::{Form, Respond};
use crate::assembly::InterfaceTangent;

/// Most halvings of a step.
const HALVINGS: usize = 10;
/// Part of the linear prediction by which a step must reduce the residual.
const SUFFICIENT: f64 = 1e-4;
/// An iteration that leaves more than this part of the residual has reached the rounding, if it is near.
pub(super) const STALLED: f64 = 0.5;
/// What rounding leaves is not taken for a solution above this.
pub(super) const UNUSABLE: f64 = 1e-6;
/// A change in the last digit, and how many times the change of the residual that it brings counts as rounding.
const DIGIT: f64 = 2.0 * f64::EPSILON;
const SHOWN: f64 = 4.0;
/// What is shown counts up to this: jumps that run away, where nothing holds the joint, would show anything.
const SHOWN_MOST: f64 = 1e-10;

/// When Newton ends, and with which tangent it goes.
#[derive(Debug, Clone, Copy)]
pub struct NewtonSettings {
    /// Largest relative residual of a solution.
    pub tolerance: f64,
    /// Most iterations.
    pub iterations: usize,
    /// Give up if the residual has not halved in so many iterations.
    pub patience: usize,
    /// Stay with the tangent of the sound joints: linear convergence only.
    pub initial_tangent: bool,
}

/// A solution, or where Newton stands.
#[derive(Debug)]
pub struct Iterate<M> {
    /// The unknowns of the form.
    pub x: Vec<f64>,
    /// Jumps (n, t, …) at the law points of every active joint.
    pub jumps: Vec<Vec<f64>>,
    /// Tractions alike.
    pub tractions: Vec<Vec<f64>>,
    /// Forces q on the jump coefficients of every active joint.
    pub forces: Vec<Vec<f64>>,
    /// What the law points remember.
    pub memory: Vec<Vec<M>>,
    /// Linear systems solved.
    pub iterations: usize,
    /// Relative residual before every iteration and at the end.
    pub residuals: Vec<f64>,
}

/// Why Newton ended without equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unconverged {
    /// In words.
    pub reason: String,
    /// Joint and law point that are farthest from equilibrium.
    pub worst: Vec<(usize, usize)>,
    /// Linear systems solved.
    pub iterations: usize,
}

/// Newton's method on one form; the tangents' patterns are built once.
#[derive(Debug)]
pub struct Newton {
    pub(super) tangents: Vec<InterfaceTangent>,
}

impl Newton {
    /// For the active joints of a form.
    pub fn new(form: &impl Form) -> Newton {
        Newton { tangents: form.active().iter().map(|&k| InterfaceTangent::new(&form.joints()[k])).collect() }
    }

    /// Solves R(x) = 0 from the best of some starting points.
    pub fn solve<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        starts: &[&Vec<f64>],
        target: &[f64],
        settings: NewtonSettings,
    ) -> Result<Iterate<L::Memory>, Unconverged> {
        let mut best: Option<(Vec<f64>, Evaluation<L::Memory>)> = None;
        for start in starts {
            match evaluate(form, laws, start, target) {
                Ok(there) if best.as_ref().is_none_or(|(_, kept)| there.error < kept.error) => {
                    best = Some((start.to_vec(), there));
                }
                Err(why) if best.is_none() => return Err(why),
                _ => {}
            }
        }
        let Some((mut x, mut now)) = best else {
            return Err(Unconverged { reason: "there is no start".into(), worst: Vec::new(), iterations: 0 });
        };
        let mut residuals = vec![now.error];
        let (mut mark, mut since) = (now.error, 0);
        for iterations in 0..=settings.iterations {
            // a start that is extrapolated well is corrected once all the same: what is left is Newton's, not its own
            let stalled = iterations > 0 && residuals[iterations] > STALLED * residuals[iterations - 1];
            let rounded = || self.rounding(form, laws, &x, &now, target);
            if iterations > 0 && (now.error <= settings.tolerance || stalled && now.error <= rounded()) {
                let Evaluation { jumps, tractions, forces, memory, .. } = now;
                return Ok(Iterate { x, jumps, tractions, forces, memory, iterations, residuals });
            }
            if now.error < 0.5 * mark {
                (mark, since) = (now.error, 0);
            } else if iterations > 0 {
                since += 1;
            }
            if iterations == settings.iterations || since >= settings.patience {
                break;
            }
            self.fill(form, laws, &now, settings);
            // at first what is free of stress is moved apart
            let apart = if iterations == 0 { moved_apart(form, laws, &now) } else { None };
            let residual = apart.map(|forces| form.residual(&x, &forces, target));
            let mut correction =
                self.correction(form, residual.unwrap_or_else(|| now.residual.clone()), &now, iterations)?;
            correction.iter_mut().for_each(|value| *value = -*value);
            let error = now.error.max(settings.tolerance); // below that rounding decides
            let Some((next, there)) = search(form, laws, &x, &correction, target, error) else {
                return Err(unconverged(
                    form,
                    "the laws have no answer along the correction",
                    &now,
                    iterations,
                ));
            };
            (x, now) = (next, there);
            residuals.push(now.error);
        }
        let reason = format!("out of balance by {:.1e} after {} iterations", now.error, residuals.len() - 1);
        Err(unconverged(form, &reason, &now, residuals.len() - 1))
    }

    /// The unknowns that the tangent leads to by a change of the target.
    pub fn along<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        x: &[f64],
        target: &[f64],
        mut change: Vec<f64>,
        settings: NewtonSettings,
    ) -> Result<Vec<f64>, Unconverged> {
        let now = evaluate(form, laws, x, target)?;
        self.fill(form, laws, &now, settings);
        if form.factor(&self.tangents) {
            form.solve(&mut change);
        }
        Ok(x.iter().zip(&change).map(|(x, d)| x + d).collect())
    }

    /// The answers of the laws at some unknowns.
    pub fn look<L: Respond>(
        &self,
        form: &impl Form,
        laws: &L,
        x: &[f64],
    ) -> Result<Answers<L::Memory>, Unconverged> {
        ask(form, laws, x)
    }

    /// Evaluations at some unknowns and at those corrected by the factor at hand; with a change of the target also by as much of
    /// it as keeps the correction across a way.
    pub fn corrected<L: Respond>(
        &self,
        form: &impl Form,
        laws: &L,
        x: &[f64],
        target: &[f64],
        across: Option<(Vec<f64>, Vec<f64>)>,
    ) -> Result<[Iterate<L::Memory>; 2], Unconverged> {
        let here = evaluate(form, laws, x, target)?;
        let mut correction = here.residual.clone();
        form.solve(&mut correction);
        let mut target = target.to_vec();
        if let Some((change, way)) = across {
            let mut along = change.clone();
            form.solve(&mut along);
            let dot = |a: &[f64]| a.iter().zip(&way).map(|(a, b)| a * b).sum::<f64>();
            let more = dot(&correction) / dot(&along);
            if more.is_finite() {
                correction.iter_mut().zip(&along).for_each(|(d, z)| *d -= more * z);
                target.iter_mut().zip(&change).for_each(|(b, change)| *b += more * change);
            }
        }
        let target = &target;
        let next: Vec<f64> = x.iter().zip(&correction).map(|(x, d)| x - d).collect();
        let there = evaluate(form, laws, &next, target)?;
        Ok([here.into_iterate(x.to_vec()), there.into_iterate(next)])
    }

    /// What rounding may leave of the residual: in the form's own terms, or as the laws show when the unknowns change in their
    /// last digit. A point that has lost its strength to the last digits turns those into much larger tractions.
    pub(super) fn rounding<L: Respond>(
        &self,
        form: &impl Form,
        laws: &L,
        x: &[f64],
        now: &Evaluation<L::Memory>,
        target: &[f64],
    ) -> f64 {
        let own = form.rounding(x, &now.forces, target, &self.tangents);
        let last = |(i, x): (usize, &f64)| x * (1.0 + if i % 2 == 0 { DIGIT } else { -DIGIT });
        let beside: Vec<f64> = x.iter().enumerate().map(last).collect();
        let shown = evaluate(form, laws, &beside, target).map_or(0.0, |there| {
            let change: Vec<f64> = there.residual.iter().zip(&now.residual).map(|(b, a)| b - a).collect();
            form.error(&change, x, &now.forces, target)
        });
        own.max((SHOWN * shown).min(SHOWN_MOST)).min(UNUSABLE)
    }

    /// J⁻¹ R by the tangents at hand.
    fn correction<M>(
        &mut self,
        form: &mut impl Form,
        mut residual: Vec<f64>,
        now: &Evaluation<M>,
        iterations: usize,
    ) -> Result<Vec<f64>, Unconverged> {
        if form.factor(&self.tangents) {
            form.solve(&mut residual);
        }
        if residual.iter().all(|value| value.is_finite()) {
            return Ok(residual);
        }
        Err(unconverged(form, "the tangent is singular: nothing holds what slides or opens", now, iterations))
    }

    /// The tangents of an evaluation.
    pub(super) fn fill<L: Respond>(
        &mut self,
        form: &impl Form,
        laws: &L,
        now: &Evaluation<L::Memory>,
        settings: NewtonSettings,
    ) {
        for ((tangent, &k), stiffness) in self.tangents.iter_mut().zip(form.active()).zip(&now.stiffness) {
            let joint = &form.joints()[k];
            if settings.initial_tangent {
                let mut stiffness = stiffness.clone();
                let c = joint.coupling.components;
                stiffness.chunks_exact_mut(c * c).for_each(|d| laws.initial_stiffness(k, d));
                tangent.fill(joint, &stiffness);
            } else {
                let mut stiffness = stiffness.clone();
                let c = joint.coupling.components;
                let mut intact = vec![0.0; c * c];
                laws.initial_stiffness(k, &mut intact);
                let normal = if opens_freely(&stiffness, &intact) { LOOSE } else { FREE };
                for d in stiffness.chunks_exact_mut(c * c) {
                    for i in (0..c * c).step_by(c + 1) {
                        let least = if i == 0 { normal } else { FREE } * intact[i];
                        if d[i].abs() < least {
                            d[i] = least;
                        }
                    }
                }
                tangent.fill(joint, &stiffness);
            }
        }
    }
}

/// The best of the steps tried, from a full one to a thousandth: the first that reduces the residual enough.
fn search<L: Respond>(
    form: &impl Form,
    laws: &L,
    x: &[f64],
    correction: &[f64],
    target: &[f64],
    error: f64,
) -> Option<(Vec<f64>, Evaluation<L::Memory>)> {
    let (mut step, mut best) = (1.0, None);
    for _ in 0..=HALVINGS {
        let next: Vec<f64> = x.iter().zip(correction).map(|(x, d)| x + step * d).collect();
        if let Ok(there) = evaluate(form, laws, &next, target)
            && there.error.is_finite()
        {
            let enough = there.error <= (1.0 - SUFFICIENT * step) * error;
            if best
                .as_ref()
                .is_none_or(|(_, kept): &(Vec<f64>, Evaluation<L::Memory>)| there.error < kept.error)
            {
                best = Some((next, there));
            }
            if enough {
                break;
            }
        }
        step *= 0.5;
    }
    best
}
