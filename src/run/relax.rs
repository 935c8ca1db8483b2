//! Where the way on ends at a load level, the joints let go: an over-damped leap to the next stable equilibrium.
//!
//! ```text
//! A(x) + q(r; r₀) + c (r − r₀) = b        r₀ ← r, the laws' states with it, until c (r − r₀) is nothing
//! ```
//!
//! Every step is a backward Euler step of joints that a drag c holds back while everything else is in equilibrium. A drag
//! above the slope of the softening leaves one solution, near r₀, so a step is found however far the leap goes; it releases
//! energy, so the steps end, in a state that carries the whole load without the drag. The drag grows where a step is not
//! found and falls where it is. Nothing of it is left in the result but the way that the laws took.

use super::engine::Failure;
use super::laws::{Dragged, Laws};
use super::loading::Load;
use super::newton::NewtonEngine;
use crate::law;
use crate::solver::{Form, Settings, Unconverged};

/// Newton's method without the drag is tried from where the drag carries less than this part of the load.
const NEAR: f64 = 1e-6;
/// Most iterations of a step.
const ITERATIONS: usize = 15;
/// Found in at most this many, it is followed by one with less drag.
const EASY: usize = 6;
/// A step changes what the joints carry by at most this part, as a mean square: a longer one may pass over an equilibrium.
const CHANGED: f64 = 0.1;
/// How the drag changes.
const FACTOR: f64 = 4.0;
/// Most steps of a leap.
const STEPS: usize = 400;
/// The drag, as a part of the joints' stiffness: what still moves below is not held by anything, what is not found above has
/// no answer.
const LEAST: f64 = 1e-14;
const MOST: f64 = 1e2;

/// Where a leap ends: unknowns, states of the laws, what they have dissipated per area on the way, iterations.
type Rest = (Vec<f64>, Vec<Vec<law::State>>, Vec<Vec<f64>>, usize);

impl<F: Form> NewtonEngine<'_, F> {
    /// Lets the joints go from states that are no equilibrium under a load, until what is left is Newton's.
    pub(super) fn let_go(&mut self, from: &[Vec<law::State>], load: &Load) -> Result<Rest, Failure> {
        let target = self.target(load)?;
        let stiffness = self.problem.laws.iter().flat_map(|(law, _)| law.elastic_stiffness());
        let most = stiffness.fold(0.0, f64::max);
        let settings = Settings { iterations: ITERATIONS, initial_tangent: false, ..self.settings };
        let problem = self.problem;
        let mut x = self.unknowns.clone();
        let Some((_, form, newton)) = &mut self.form else { return Err(Failure::Unusable(f64::INFINITY)) };
        let mut states = from.to_vec();
        let mut spent: Vec<Vec<f64>> =
            form.active().iter().map(|&k| vec![0.0; problem.model.joints[k].coupling.points.len()]).collect();
        let (mut drag, mut iterations) = (most, 0);
        let mut why = Unconverged { reason: "the joints do not come to rest".into(), worst: Vec::new(), iterations };
        for _ in 0..STEPS {
            let laws = Dragged { laws: Laws { problem, old: &states }, drag };
            let step = match newton.solve(form, &laws, &[&x], &target, settings) {
                Ok(step) => step,
                Err(failed) => {
                    iterations += failed.iterations;
                    if std::env::var("DBG").is_ok() { eprintln!("fail drag {drag:e} {failed:?}"); }
                    (drag, why) = (drag * FACTOR, failed);
                    if drag > MOST * most {
                        break;
                    }
                    continue;
                }
            };
            iterations += step.iterations;
            let (change, carried) = self_change(problem, form.active(), &states, &step.memory);
            if change > CHANGED * carried {
                drag *= FACTOR;
                if std::env::var("DBG").is_ok() { eprintln!("far {:e}", change / carried); }
                if drag > MOST * most {
                    break;
                }
                continue;
            }
            let mut pulled: Vec<Vec<f64>> = Vec::new();
            for ((&k, jumps), tractions) in form.active().iter().zip(&step.jumps).zip(&step.tractions) {
                let old = states[k].iter().flat_map(|state| state.jump.iter().copied().collect::<Vec<f64>>());
                let drags = jumps.iter().zip(old.chain(std::iter::repeat(f64::NAN)));
                let own = tractions.iter().zip(drags).map(|(t, (r, r0))| t - if r0.is_nan() { 0.0 } else { drag * (r - r0) });
                pulled.push(problem.model.joints[k].gather(&own.collect::<Vec<f64>>()));
            }
            let residual = form.residual(&step.x, &pulled, &target);
            let left = form.error(&residual, &step.x, &pulled, &target);
            for ((&k, memory), spent) in form.active().iter().zip(&step.memory).zip(&mut spent) {
                for ((state, answer), spent) in states[k].iter_mut().zip(memory).zip(spent) {
                    *state = answer.state;
                    *spent += answer.dissipation;
                }
            }
            if std::env::var("DBG").is_ok() {
                eprintln!("drag {drag:e} left {left:e} iterations {}", step.iterations);
            }
            x = step.x;
            if left <= NEAR {
                let laws = Laws { problem, old: &states };
                match newton.solve(form, &laws, &[&x], &target, self.settings) {
                    Ok(last) => return Ok((last.x, states, spent, iterations + last.iterations)),
                    Err(failed) => iterations += failed.iterations,
                }
            }
            if step.iterations <= EASY {
                drag /= FACTOR;
            }
            if drag < LEAST * most {
                break;
            }
        }
        Err(Failure::Unconverged(Unconverged { iterations, ..why }))
    }
}

fn self_change(problem: &crate::problem::Problem, active: &[usize], states: &[Vec<law::State>], memory: &[Vec<super::state::Answer>]) -> (f64, f64) {
    let mut c = (0.0, 0.0);
    for (&k, memory) in active.iter().zip(memory) {
        for ((p, old), new) in problem.model.joints[k].coupling.points.iter().zip(&states[k]).zip(memory) {
            c.0 += p.weight * (new.state.traction - old.traction).norm_squared();
            c.1 += p.weight * old.traction.norm_squared();
        }
    }
    c
}
