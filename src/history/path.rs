//! A step along the path of equilibria: by load factor while nothing dissipates, by dissipated energy while something does;
//! or by the change of the jumps throughout (`arclength`).
//!
//! No number is set by hand. The first step beyond the intact state dissipates a small part of the elastic energy that is
//! stored then; later ones as much more or less as iterations allow, with no more change of the load factor than the step's
//! increments have, until the load factor reaches its end for good.

use serde::{Deserialize, Serialize};

use super::analysis::Analysis;
use super::arclength::arc;
use super::dissipate::{along, intact};
use super::energy::carried;
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::{LoadIncrement, PathProgress, Reached, StepProgress};
use super::viscous::viscous;
use crate::error::Result;
use crate::problem::BoundStep;
use crate::scene::Control;
use crate::solver::{Ramp, Unconverged};

/// Most increments per increment of the scene.
const MOST: usize = 1000;

/// Progress of a step along the path, with its last increments.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct PathStep {
    /// Number of the last increment.
    number: usize,
    at: PathProgress,
    /// Change of the load factor in the last increment.
    rising: f64,
    /// Dissipated energy and load factor of the last three.
    passed: [(f64, f64); 3],
}

impl PathStep {
    /// Before the first increment, with the energy dissipated so far.
    pub(super) fn new(step: &BoundStep, dissipated: f64) -> PathStep {
        let at = PathProgress {
            load_factor: 0.0,
            change: 0.0,
            spent: 0.0,
            amount: 0.0,
            ratio: 1.0,
            most: 0.0,
            width: 1.0 / step.increments as f64,
            wait: 0,
            patience: 1,
            tried: 0,
        };
        PathStep { number: 0, at, rising: 0.0, passed: [(dissipated, 0.0); 3] }
    }
}

/// The next increment.
pub(super) fn next(
    analysis: &mut Analysis,
    step: &BoundStep,
    start: &Start,
    ramp: &Ramp,
    PathStep { number, at, rising, passed }: &mut PathStep,
) -> Result<Reached> {
    let part = 1.0 / step.increments as f64;
    if *number == MOST * step.increments {
        let reason = "the path does not reach its end".into();
        let why = Unconverged { reason, worst: Vec::new(), iterations: 0 };
        return Ok(lost(*number, at, why));
    }
    *number += 1;
    analysis.clock.begin("solve");
    let before = at.load_factor;
    at.most = at.most.max(carried(analysis.problem, &analysis.state.snapshot));
    let found = match step.control {
        Control::Arclength => arc(analysis, start, ramp, at, part),
        _ if at.spent > 0.0 => along(analysis, start, ramp, at, part),
        _ => intact(analysis, start, ramp, at, part),
    };
    let tried = std::mem::take(&mut at.tried);
    let iterations = tried
        + match found? {
            Outcome::Converged(iterations) => iterations,
            Outcome::Retry(_) => match go_on(analysis, start, at, step, part)? {
                Outcome::Converged(iterations) => iterations,
                Outcome::Retry(why) => return Ok(lost(*number, at, why)),
            },
        };
    *passed = [passed[1], passed[2], (analysis.state.dissipated, at.load_factor)];
    if *rising * (at.load_factor - before) < 0.0 {
        analysis.totals.turns.push((analysis.totals.increments, step.name.clone(), vertex(*passed)));
    }
    *rising = at.load_factor - before;
    let last = at.load_factor >= 1.0;
    Ok(Reached { number: *number, load_factor: at.load_factor, iterations, last, moved: true, lost: None })
}

fn lost(number: usize, at: &PathProgress, why: Unconverged) -> Reached {
    let (load_factor, lost) = (at.load_factor, Some(why));
    Reached { number, load_factor, iterations: 0, last: false, moved: false, lost }
}

/// From where no step along the path is found to an equilibrium an increment of the load factor further at most: the load
/// goes on while a viscosity holds the jumps.
fn go_on(
    analysis: &mut Analysis,
    start: &Start,
    at: &mut PathProgress,
    step: &BoundStep,
    part: f64,
) -> Result<Outcome<usize>> {
    let goal = (at.load_factor + part).min(1.0);
    let leg = LoadIncrement { start, step, number: 0, goal, part, complete: true };
    let mut progress =
        StepProgress { load_factor: at.load_factor, most: at.most.sqrt(), ..StepProgress::new(part) };
    let went = viscous(analysis, &leg, &mut progress, part)?;
    if let Outcome::Converged(_) = went {
        (at.load_factor, at.change, at.spent) = (progress.load_factor, 0.0, 0.0);
    }
    Ok(went)
}

/// Extreme load factor of the parabola through three points (dissipated energy, load factor); the middle one's where there is
/// none, or where the path has a corner: a parabola would be far off.
fn vertex([(d0, l0), (d1, l1), (d2, l2)]: [(f64, f64); 3]) -> f64 {
    let (before, after) = ((l1 - l0) / (d1 - d0), (l2 - l1) / (d2 - d1));
    let curvature = (after - before) / (d2 - d0);
    let slope = before + curvature * (d1 - d0);
    let beyond = -slope * slope / (4.0 * curvature);
    let near = beyond.abs() <= 0.25 * (l1 - l0).abs().max((l2 - l1).abs());
    if near { l1 + beyond } else { l1 }
}
