//! Where the way on ends, the joints let go: an over-damped leap to a stable equilibrium at the same load.
//!
//! ```text
//! A(x) + q(r; r₀) + G c (r − r₀) = b      then r₀ ← r, and the laws' states with it, until the drag is nothing
//! released = Σ h w (½ c (Δr₀ + Δr) · Δr − (∫ t · dr − ½ (t₀ + t) · Δr)) ≥ 0
//! ```
//!
//! Every step is a backward Euler step of joints that a drag c holds back while all else is in equilibrium. A drag above the
//! slope of the softening leaves one solution, near r₀, so that a step is found wherever the leap goes. A step that does not
//! release energy has passed over a barrier, to an equilibrium that no slow motion would reach; it is not taken. The drag grows
//! where a step is not taken and falls where one is found with ease. The end carries its whole load without drag: nothing of it
//! is left but the way that the laws took.

use super::energy::beyond_trapezium;
use super::engine::Failure;
use super::laws::{Dragged, Laws};
use super::loading::Load;
use super::newton::NewtonEngine;
use super::state::Answer;
use crate::law;
use crate::problem::Problem;
use crate::solver::{Form, Iterate, Settings, Unconverged};

/// Newton's method without drag is tried from where the drag carries less than this part of the load.
const NEAR: f64 = 1e-6;
/// Most iterations of a step; one found in at most `EASY` is followed by one with less drag.
const ITERATIONS: usize = 15;
const EASY: usize = 6;
/// How the drag changes.
const FACTOR: f64 = 4.0;
/// The drag, as a part of the joints' stiffness: what still moves below is not held by anything, what is not found above has
/// no answer.
const LEAST: f64 = 1e-14;
const MOST: f64 = 1e2;
/// Most steps of a leap.
const STEPS: usize = 400;
/// Jumps that change in an increment by more than this part of the joint's length, and by more than so many times the largest
/// displacement that is prescribed, run away: nothing holds what slides or opens, and the residual drowns in their rounding.
const FAR: f64 = 0.1;
const PRESCRIBED: f64 = 10.0;
/// A step may seem to take up this part of what it dissipates: the laws integrate that to their own tolerance.
const TAKEN: f64 = 1e-3;

/// Where the joints are on their way.
pub(super) struct Rest {
    /// Unknowns of the form.
    pub(super) x: Vec<f64>,
    /// States of all laws.
    pub(super) states: Vec<Vec<law::State>>,
    /// What the laws of every active joint have dissipated on the way per area.
    pub(super) spent: Vec<Vec<f64>>,
    /// Linear systems solved.
    pub(super) iterations: usize,
    /// c Δr of the last step at the law points of every active joint; none before the first.
    pulls: Vec<Vec<f64>>,
}

impl<F: Form> NewtonEngine<'_, F> {
    /// Lets the joints go from states that are no equilibrium under a load, until they need no drag.
    pub(super) fn let_go(&mut self, from: &[Vec<law::State>], load: &Load) -> Result<Rest, Failure> {
        let target = self.target(load)?;
        let problem = self.problem;
        let stiffness = problem.laws.iter().flat_map(|(law, _)| law.elastic_stiffness()).fold(0.0, f64::max);
        let settings = Settings { iterations: ITERATIONS, initial_tangent: false, ..self.settings };
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let spent = form.active().iter().map(|&k| vec![0.0; from[k].len()]).collect();
        let (x, states) = (self.unknowns.clone(), from.to_vec());
        let mut at = Rest { x, states, spent, iterations: 0, pulls: Vec::new() };
        let mut why = "the joints do not come to rest".to_string();
        let (mut drag, mut worst) = (stiffness, Vec::new());
        for _ in 0..STEPS {
            if !(LEAST * stiffness..=MOST * stiffness).contains(&drag) {
                break;
            }
            let laws = Dragged { laws: Laws { problem, old: &at.states }, drag };
            let step = match newton.solve(form, &laws, &[&at.x], &target, settings) {
                Ok(step) => step,
                Err(failed) => {
                    at.iterations += failed.iterations;
                    (why, worst) = (failed.reason, failed.worst);
                    drag *= FACTOR;
                    continue;
                }
            };
            at.iterations += step.iterations;
            if let Some(point) = runs_away(problem, from, form.active(), &step.jumps, load) {
                (why, worst) = ("nothing holds what slides or opens".into(), vec![point]);
                break;
            }
            let pulls = at.pulls(problem, form.active(), &step, drag);
            if at.released(problem, form.active(), &step, &pulls) < 0.0 {
                drag *= FACTOR;
                continue;
            }
            let own = |((&k, tractions), pulls): ((&usize, &Vec<f64>), &Vec<f64>)| {
                let own: Vec<f64> = tractions.iter().zip(pulls).map(|(t, pull)| t - pull).collect();
                problem.model.joints[k].gather(&own)
            };
            let forces: Vec<Vec<f64>> =
                form.active().iter().zip(&step.tractions).zip(&pulls).map(own).collect();
            let residual = form.residual(&step.x, &forces, &target);
            let left = form.error(&residual, &step.x, &forces, &target);
            if step.iterations <= EASY {
                drag /= FACTOR;
            }
            at.take(form.active(), step, pulls);
            if left <= NEAR {
                let laws = Laws { problem, old: &at.states };
                match newton.solve(form, &laws, &[&at.x], &target, self.settings) {
                    Ok(last) if runs_away(problem, from, form.active(), &last.jumps, load).is_none() => {
                        at.iterations += last.iterations;
                        return Ok(Rest { x: last.x, ..at });
                    }
                    Ok(last) => at.iterations += last.iterations,
                    Err(failed) => at.iterations += failed.iterations,
                }
            }
        }
        Err(Failure::Unconverged(Unconverged { reason: why, worst, iterations: at.iterations }))
    }
}

/// The law point (joint, number) whose jump has moved farthest, if that is too far for anything to hold it.
pub(super) fn runs_away(
    problem: &Problem,
    from: &[Vec<law::State>],
    active: &[usize],
    jumps: &[Vec<f64>],
    load: &Load,
) -> Option<(usize, usize)> {
    let asked = PRESCRIBED * load.prescribed.iter().fold(0.0, |most: f64, u| u.abs().max(most));
    let mut farthest = (1.0, None);
    for (&k, jumps) in active.iter().zip(jumps) {
        let coupling = &problem.model.joints[k].coupling;
        let most = asked.max(FAR * coupling.midplane.length);
        for (p, (old, r)) in from[k].iter().zip(jumps.chunks_exact(coupling.components)).enumerate() {
            let moved = old.jump.iter().zip(r).map(|(old, r)| (r - old) * (r - old)).sum::<f64>().sqrt();
            if moved.is_nan() || moved / most > farthest.0 {
                farthest = (moved / most, Some((k, p)));
            }
        }
    }
    farthest.1
}

impl Rest {
    /// c (r − r₀) of a step.
    fn pulls(&self, problem: &Problem, active: &[usize], step: &Iterate<Answer>, drag: f64) -> Vec<Vec<f64>> {
        let of = |(&k, jumps): (&usize, &Vec<f64>)| -> Vec<f64> {
            let components = problem.model.joints[k].coupling.components;
            let mut pulls = vec![0.0; jumps.len()];
            let points = pulls.chunks_exact_mut(components).zip(jumps.chunks_exact(components));
            for ((pull, r), old) in points.zip(&self.states[k]) {
                (0..components).for_each(|i| pull[i] = drag * (r[i] - old.jump[i]));
            }
            pulls
        };
        active.iter().zip(&step.jumps).map(of).collect()
    }

    /// Energy that a step releases, less what it may seem to take up by rounding [force × length].
    fn released(
        &self,
        problem: &Problem,
        active: &[usize],
        step: &Iterate<Answer>,
        pulls: &[Vec<f64>],
    ) -> f64 {
        let mut released = 0.0;
        for (a, &k) in active.iter().enumerate() {
            let ((law, _), coupling) = (&problem.laws[k], &problem.model.joints[k].coupling);
            for (p, (old, new)) in self.states[k].iter().zip(&step.memory[a]).enumerate() {
                let moved = new.state.jump - old.jump;
                let at = coupling.components * p;
                let pull = |i: usize| {
                    pulls[a][at + i] + self.pulls.get(a).map_or(pulls[a][at + i], |before| before[at + i])
                };
                let gained: f64 = (0..coupling.components).map(|i| 0.5 * pull(i) * moved[i]).sum();
                let spent = gained - beyond_trapezium(law, old, new) + TAKEN * new.dissipation;
                released += coupling.points[p].weight * spent;
            }
        }
        problem.model.thickness * released
    }

    fn take(&mut self, active: &[usize], step: Iterate<Answer>, pulls: Vec<Vec<f64>>) {
        for ((&k, memory), spent) in active.iter().zip(step.memory).zip(&mut self.spent) {
            for ((state, answer), spent) in self.states[k].iter_mut().zip(memory).zip(spent) {
                *state = answer.state;
                *spent += answer.dissipation;
            }
        }
        (self.x, self.pulls) = (step.x, pulls);
    }
}
