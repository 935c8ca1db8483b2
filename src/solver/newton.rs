//! Newton's method with a line search, for any form of the equilibrium K u + Gᵀ q(G u) = f: under a load, or along the path of
//! equilibria, where the load factor λ is one more unknown and how far an increment goes is one more equation.
//!
//! ```text
//! R(x) = A(x, λ) − b₀ − λ b₁ = 0       ⎡ J   ∂R/∂λ ⎤ ⎡δx⎤   ⎡−R⎤
//! g(x) = 0                             ⎣ cᵀ    0 ⎦ ⎣δλ⎦ = ⎣−g⎦      c = ∂g/∂x
//! ```
//!
//! A form (`condensed`, `floating`, `primal`) turns the equation into a residual R(x) of its own unknowns x and solves with its
//! own Jacobian; laws answer jump by jump. On a path two solves take one factor: δλ = (c·y − g) / (c·z), δx = δλ z − y with
//! y = J⁻¹ R and z = −J⁻¹ ∂R/∂λ. The line search halves a step until the residual decreases: where points open, stick and slide by
//! turns, full steps run in circles.

use rayon::prelude::*;

use super::aim::Aim;
use super::apart::{FREE, LOOSE, intact, moved_apart, opens_freely};
use super::evaluation::{Evaluation, evaluate, evaluate_at, unconverged};
use super::press::{beyond, residual_rate};
use super::{Affine, Constraint, Form, Iterate, NewtonSettings, PathPoint, Respond, Unconverged};
use crate::assembly::InterfaceTangent;

/// Part of the linear prediction by which a step must reduce the residual.
const SUFFICIENT: f64 = 1e-4;
/// An iteration that leaves more than this part of the residual has reached the rounding, if it is near.
const STALLED: f64 = 0.5;
/// Largest residual that counts as rounding.
const UNUSABLE: f64 = 1e-6;
/// A change in the last digit, and how many times the change of the residual that it brings counts as rounding.
const DIGIT: f64 = 2.0 * f64::EPSILON;
const SHOWN: f64 = 4.0;
/// Largest residual that such a change may show: jumps that run away, where nothing holds the interface, would show anything.
const SHOWN_MOST: f64 = 1e-10;
/// The constraint of a path is met to this: it says how far to go, not where the path is.
const MET: f64 = 1e-2;

/// Newton's method on one form; the tangents' patterns are built once.
#[derive(Debug)]
pub struct Newton {
    pub(super) tangents: Vec<InterfaceTangent>,
}

impl Newton {
    /// For the active interfaces of a form.
    pub fn new(form: &impl Form) -> Newton {
        Newton {
            tangents: form.active().iter().map(|&k| InterfaceTangent::new(&form.interfaces()[k])).collect(),
        }
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
        let (mut best, mut unanswered) = (None::<(&Vec<f64>, Evaluation<L::Memory>)>, None);
        for start in starts {
            match evaluate(form, laws, start, target) {
                Ok(there) if best.as_ref().is_none_or(|(_, kept)| there.error < kept.error) => {
                    best = Some((start, there));
                }
                Ok(_) => {}
                Err(why) => unanswered = Some(why),
            }
        }
        let Some((start, now)) = best else {
            let none =
                || Unconverged { reason: "there is no start".into(), worst: Vec::new(), iterations: 0 };
            return Err(unanswered.unwrap_or_else(none));
        };
        let start = PathPoint { x: start.clone(), load_factor: 0.0 };
        self.search(form, laws, (start, now), &Aim::Load(target), settings).map(|(iterate, _)| iterate)
    }

    /// The equilibrium as far from the last accepted one as a constraint says, sought from a point.
    pub fn follow<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        start: PathPoint,
        load: &Affine,
        constraint: &Constraint,
        settings: NewtonSettings,
    ) -> Result<(Iterate<L::Memory>, f64), Unconverged> {
        let now =
            evaluate_at(form, &laws.at(start.load_factor), &start.x, &load.at(start.load_factor), true)?;
        let settings = NewtonSettings { patience: usize::MAX, ..settings };
        self.search(form, laws, (start, now), &Aim::Path(load, constraint), settings)
    }

    /// The equilibrium of an aim and its load factor.
    fn search<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        (start, mut now): (PathPoint, Evaluation<L::Memory>),
        aim: &Aim,
        settings: NewtonSettings,
    ) -> Result<(Iterate<L::Memory>, f64), Unconverged> {
        let PathPoint { mut x, mut load_factor } = start;
        let mut residuals = vec![now.error];
        let (mut mark, mut since) = (now.error, 0);
        for iterations in 0..=settings.iterations {
            let missing = aim.missing(form, laws, &now);
            // a start that is extrapolated well is corrected once all the same: what is left is Newton's, not its own
            let stalled = iterations > 0 && residuals[iterations] > STALLED * residuals[iterations - 1];
            let rounded =
                || self.rounding(form, &aim.laws(laws, load_factor), &x, &now, &aim.target(load_factor));
            let balanced = now.error <= settings.tolerance || stalled && now.error <= rounded();
            if iterations > 0 && balanced && missing.abs() <= MET {
                let Evaluation { jumps, tractions, forces, memory, .. } = now;
                return Ok((
                    Iterate { x, jumps, tractions, forces, memory, iterations, residuals },
                    load_factor,
                ));
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
            let apart = match aim {
                Aim::Load(target) if iterations == 0 => {
                    moved_apart(form, laws, &now).map(|forces| form.residual(&x, &forces, target))
                }
                _ => None,
            };
            let residual = apart.unwrap_or_else(|| now.residual.clone());
            let (correction, change) = self.correction(form, laws, residual, &now, (aim, missing));
            if !(change.is_finite() && correction.iter().all(|value| value.is_finite())) {
                return Err(unconverged(form, aim.singular(), &now, iterations));
            }
            let tolerance = settings.tolerance;
            let Some((next, next_load_factor, there)) = search_line(
                form,
                laws,
                ((&x, load_factor), &now),
                (&correction, change),
                (aim, missing),
                tolerance,
            ) else {
                return Err(unconverged(form, aim.unanswered(), &now, iterations));
            };
            (x, load_factor, now) = (next, next_load_factor, there);
            residuals.push(now.error);
        }
        let (iterations, error) = (residuals.len() - 1, now.error);
        let reason = match aim {
            Aim::Load(_) => format!("out of balance by {error:.1e} after {iterations} iterations"),
            Aim::Path(..) => format!("out of balance by {error:.1e} on the path"),
        };
        Err(unconverged(form, &reason, &now, iterations))
    }

    /// δx and δλ by the tangents at hand; not numbers where these are singular.
    fn correction<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        residual: Vec<f64>,
        now: &Evaluation<L::Memory>,
        (aim, missing): (&Aim, f64),
    ) -> (Vec<f64>, f64) {
        let mut y = residual;
        let factored = form.factor(&self.tangents);
        if factored {
            form.solve(&mut y);
        }
        let Aim::Path(load, constraint) = aim else {
            y.iter_mut().for_each(|value| *value = -*value);
            return (y, 0.0);
        };
        let mut z: Vec<f64> =
            residual_rate(form, &load.change, now.pressures.as_ref()).into_iter().map(|rate| -rate).collect();
        if factored {
            form.solve(&mut z);
        }
        let c = form.weights(&constraint.slope(form, laws, now));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let change = (dot(&c, &y) - missing) / dot(&c, &z);
        (y.iter().zip(&z).map(|(y, z)| change * z - y).collect(), change)
    }

    /// Residual that rounding may leave: in the form's own terms, or as the laws show when the unknowns change in their
    /// last digit. A point that has lost its strength to the last digits turns those into much larger tractions.
    fn rounding<L: Respond>(
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

    /// The tangents of an evaluation.
    pub(super) fn fill<L: Respond>(
        &mut self,
        form: &mut impl Form,
        laws: &L,
        now: &Evaluation<L::Memory>,
        settings: NewtonSettings,
    ) {
        let beyond = if settings.initial_tangent { None } else { beyond(form, now.pressures.as_ref()) };
        form.couple(beyond);
        let form = &*form;
        let fill = |((tangent, &k), stiffness): ((&mut InterfaceTangent, &usize), &Vec<f64>)| {
            let interface = &form.interfaces()[k];
            let intact = intact(form, laws, k);
            if settings.initial_tangent {
                tangent.fill(interface, &intact);
                return;
            }
            let mut stiffness = stiffness.clone();
            let c = interface.coupling.components;
            let normal = if opens_freely(&stiffness, &intact, c) { LOOSE } else { FREE };
            for (d, intact) in stiffness.chunks_exact_mut(c * c).zip(intact.chunks_exact(c * c)) {
                for i in (0..c * c).step_by(c + 1) {
                    let least = if i == 0 { normal } else { FREE } * intact[i];
                    if d[i].abs() < least {
                        d[i] = least;
                    }
                }
            }
            tangent.fill(interface, &stiffness);
        };
        self.tangents.par_iter_mut().zip(form.active()).zip(&now.stiffness).for_each(fill);
    }
}

/// The best of the steps tried, from a full one down: the first that reduces what is left enough.
fn search_line<L: Respond>(
    form: &impl Form,
    laws: &L,
    ((x, load_factor), now): ((&[f64], f64), &Evaluation<L::Memory>),
    (correction, change): (&[f64], f64),
    (aim, missing): (&Aim, f64),
    tolerance: f64,
) -> Option<(Vec<f64>, f64, Evaluation<L::Memory>)> {
    let before = aim.merit(now.error.max(tolerance), missing, tolerance); // below that rounding decides
    let (mut step, mut best) = (1.0, None::<(f64, (Vec<f64>, f64, Evaluation<L::Memory>))>);
    for _ in 0..=aim.halvings() {
        let next: Vec<f64> = x.iter().zip(correction).map(|(x, d)| x + step * d).collect();
        let next_load_factor = load_factor + step * change;
        let there = evaluate_at(
            form,
            &aim.laws(laws, next_load_factor),
            &next,
            &aim.target(next_load_factor),
            aim.follows(),
        );
        if let Ok(there) = there {
            let value = aim.merit(there.error, aim.missing(form, laws, &there), tolerance);
            if value.is_finite() {
                if best.as_ref().is_none_or(|(kept, _)| value < *kept) {
                    best = Some((value, (next, next_load_factor, there)));
                }
                if value <= (1.0 - SUFFICIENT * step) * before {
                    break;
                }
            }
        }
        step *= 0.5;
    }
    best.map(|(_, best)| best)
}
