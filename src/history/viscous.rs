//! Viscous stretches, for paths that no equilibrium continues: the load goes on while a viscosity holds the jumps back.
//!
//! ```text
//! A(x) + q(r) + G c (r − r₀) = b(λ)        c = η / Δλ, then r₀ ← r, and the states of the laws with it
//! rest: λ is held, and c falls until the laws hold the jumps alone
//! ```
//!
//! Every step is a backward Euler step in the load factor as time, with the viscosity η. Where the path goes on, the jumps
//! follow it and the viscous tractions are small; where it has ended, steps get short by themselves and lead to the next stable
//! equilibrium. Friction lags by a step where its slope has no bound (`law::lagged`), so that a step has one answer as
//! soon as c is above the softening. A stretch ends with an equilibrium of the laws alone.

use super::analysis::{Analysis, complete};
use super::clock::PartNow;
use super::equilibrium::Viscous;
use super::failure::stopped;
use super::outcome::Outcome;
use super::progress::{LoadIncrement, StepProgress};
use super::rest::{EASY, FACTOR, NEAR, rest};
use super::snap::tell;
use super::stretch::{Motion, ViscousStretch, by_laws_alone, creep};
use crate::error::Result;
use crate::solver::Unconverged;

/// η of a whole step, of the steepest softening; where nothing softens, of the stiffness.
const VISCOSITY: f64 = 3e-6;
const WITHOUT_SOFTENING: f64 = 1e-7;
/// First viscous step, of the part that was not found.
const FIRST: f64 = 0.1;
/// Longest viscous step, of a step.
const LONGEST: f64 = 1.0 / 200.0;
/// The longest steps leave the viscosity at most this part of what is carried: it falls where jumps are large.
const SLIGHT: f64 = 1e-3;
/// A c above this part of the stiffness makes steps that may change much.
const STIFF: f64 = 0.1;
/// The tractions of interfaces that dilate may bend by so many times the tolerance of the path in a step, of what is carried.
const BEND: f64 = 2.0;
/// Largest c, of the stiffness.
const MOST: f64 = 1e4;

/// Goes on from where a part of some width is not found, to an equilibrium of the laws at most at the increment's end.
pub(super) fn viscous(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    width: f64,
) -> Result<Outcome<usize>> {
    let mut kept = analysis.state.clone();
    complete(analysis.problem, &*analysis.engine, &mut kept, leg.start.at(at.load_factor)?);
    let search = analysis.engine.begin_viscous();
    let load_factor = at.load_factor;
    let released = analysis.state.released;
    let at_points = analysis.state.snapshot.states.iter().map(|states| vec![0.0; states.len()]).collect();
    let mut stretch =
        ViscousStretch { from: load_factor, work: Vec::new(), at: at_points, closing: 0.0, iterations: 0 };
    let went = creep_on(analysis, leg, at, width, &mut stretch)?;
    match went {
        Outcome::Converged(()) => {
            tell(analysis, leg, at.energy, &stretch, released);
            Ok(Outcome::Converged(stretch.iterations))
        }
        Outcome::Retry(why) => {
            analysis.engine.restore(search);
            (analysis.state, at.load_factor) = (kept, load_factor);
            Ok(Outcome::Retry(Unconverged { iterations: stretch.iterations, ..why }))
        }
    }
}

fn creep_on(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    width: f64,
    stretch: &mut ViscousStretch,
) -> Result<Outcome<()>> {
    let [mut eta, stiffness, softening] = scales(analysis);
    at.patience = if at.fresh { (2 * at.patience).min(64) } else { 4 };
    let (mut wait, mut hold, mut pulls) = (at.patience, 0, f64::INFINITY);
    let most_bent = BEND * analysis.problem.solution.path_tolerance;
    let (mut step, mut last) = ((FIRST * width).min(LONGEST), 0.0);
    loop {
        if let Some(why) = stopped(&analysis.stop) {
            return Ok(Outcome::Retry(why));
        }
        tell_stretch(analysis, at, stretch);
        let at_goal = at.load_factor >= leg.goal;
        if at_goal || wait == 0 {
            let load = leg.start.at(at.load_factor)?;
            let left = analysis.engine.imbalance(&analysis.state, &load);
            let near = if at_goal { left < 1e-2 } else { left < NEAR || pulls < SLIGHT };
            if near && by_laws_alone(analysis, leg, at, stretch)? {
                at.width = (4.0 * step).max(1e-4).min(leg.part);
                return Ok(Outcome::Converged(()));
            }
            if at_goal {
                at.width = (4.0 * step).max(1e-4).min(leg.part);
                return rest(analysis, leg, at, stretch, [stiffness, softening]);
            }
            wait = at.patience;
        }
        step = step.min(leg.goal - at.load_factor).min(LONGEST);
        let to = if at.load_factor + step > leg.goal - 1e-13 { leg.goal } else { at.load_factor + step };
        let c = eta / step;
        let ahead = if last > 0.0 { step / last } else { 0.0 };
        match creep(
            analysis,
            leg,
            at,
            to,
            Viscous { viscosity: c, ahead, strict: false },
            c < STIFF * stiffness,
            stretch,
        )? {
            Outcome::Converged(Motion { iterations, bend, pulled, driven, .. }) => {
                if step >= 0.99 * LONGEST && driven && pulled > SLIGHT {
                    eta *= SLIGHT / pulled;
                }
                (last, pulls) = (step, pulled);
                at.load_factor = to;
                (hold, wait) = (hold.max(1) - 1, wait.max(1) - 1);
                let grow = if hold == 0 && iterations <= EASY { FACTOR } else { 1.0 };
                // an interface that dilates presses or opens off a straight way; in a snap, where steps are tiny, that is no matter
                let tiny = c > STIFF * stiffness;
                step *= if tiny { grow } else { grow.min((most_bent / bend).sqrt().max(1.0 / FACTOR)) };
            }
            Outcome::Retry(why) => {
                (step, last, hold) = (step / FACTOR, 0.0, 2);
                if eta / step > MOST * stiffness {
                    return Ok(Outcome::Retry(why));
                }
            }
        }
    }
}

/// Tells how far a stretch has come.
pub(super) fn tell_stretch(analysis: &Analysis, at: &StepProgress, stretch: &ViscousStretch) {
    let (parts, iterations) = (stretch.work.len(), stretch.iterations);
    analysis.clock.tell(PartNow { load_factor: at.load_factor, parts, iterations });
}

/// η, the largest stiffness and the steepest softening of all laws [stress / length].
fn scales(analysis: &Analysis) -> [f64; 3] {
    let laws = || analysis.problem.laws();
    let stiffness = laws().flat_map(|law| law.elastic_stiffness()).fold(0.0, f64::max);
    let softening = laws().map(|law| law.steepest_softening()).fold(0.0, f64::max).min(stiffness);
    match softening > 0.0 {
        true => [VISCOSITY * softening, stiffness, softening],
        false => [WITHOUT_SOFTENING * stiffness, stiffness, 1e-2 * stiffness],
    }
}
