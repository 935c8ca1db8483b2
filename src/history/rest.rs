//! The rest of a viscous stretch: the load is held, and the viscosity falls until the laws hold the jumps alone.

use super::analysis::Analysis;
use super::equilibrium::Viscous;
use super::failure::stopped;
use super::outcome::Outcome;
use super::progress::{LoadIncrement, StepProgress};
use super::stretch::{Motion, ViscousStretch, by_laws_alone, creep};
use crate::error::Result;
use crate::solver::Unconverged;

/// Factor between steps, and the iterations of one that is found with ease or as usual.
pub(super) const FACTOR: f64 = 3.0;
pub(super) const EASY: usize = 6;
const USUAL: usize = 12;
/// Out-of-balance force below which the laws alone are asked; where it is so small, at once.
pub(super) const NEAR: f64 = 1e-3;
const VERY_NEAR: f64 = 1e-6;
/// A viscosity that pulls at less than this part of the tolerance is none; what is left then is rounding, if it is so small.
const GONE: f64 = 1e-3;
const ROUNDED: f64 = 1e-8;
/// Most steps.
const STEPS: usize = 400;
/// A force and tractions that change by less than this part are the same; where at least this part of the motion closes,
/// something may come to hold it.
const SAME: f64 = 1e-3;
const CLOSES: f64 = 0.1;
/// Steps in a row under the same force, and iterations of them, after which nothing will hold.
const FREE: usize = 3;
const FREE_ITERATIONS: usize = 20;

/// Holds the load until the laws hold the jumps alone.
pub(super) fn rest(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    stretch: &mut ViscousStretch,
    [stiffness, softening]: [f64; 2],
) -> Result<Outcome<()>> {
    let (mut c, mut hold) = (softening, 0);
    let mut why =
        Unconverged { reason: "nothing holds what slides or opens".into(), worst: Vec::new(), iterations: 0 };
    let (mut ahead, mut before, mut left) = (0.0, f64::INFINITY, f64::INFINITY);
    let (mut free, mut spent, mut refused) = (0, 0, false);
    for k in 0..STEPS {
        if let Some(why) = stopped(&analysis.stop) {
            return Ok(Outcome::Retry(why));
        }
        if c > 100.0 * stiffness || free >= FREE && spent >= FREE_ITERATIONS {
            break;
        }
        let strict = left < VERY_NEAR && !refused;
        match creep(
            analysis,
            leg,
            at,
            at.load_factor,
            Viscous { viscosity: c, ahead, strict },
            false,
            stretch,
        )? {
            Outcome::Converged(Motion { iterations, moved, closing, pull, pulled, change, .. }) => {
                // the same force on growing steps of what only slides or opens: nothing holds it
                let same = (pull / before - 1.0).abs() < SAME && change < SAME && closing < CLOSES * moved;
                (free, spent) = if same { (free + 1, spent + iterations) } else { (0, 0) };
                (before, ahead) = (pull, 1.0);
                let load = leg.start.at(at.load_factor)?;
                left = analysis.engine.imbalance(&analysis.state, &load);
                let tolerance = analysis.problem.solution.tolerance;
                // a viscosity that pulls at nothing leaves what rounding does: stiff interfaces that have slid far have few digits
                let rounded = pulled < GONE * tolerance && left.max(change) <= ROUNDED;
                if left.max(change) <= tolerance || rounded {
                    analysis.state.stands(left);
                    at.last = f64::INFINITY;
                    at.fresh = true;
                    return Ok(Outcome::Converged(()));
                }
                let due = k % 3 == 2 || left < VERY_NEAR || c < 0.1 * softening;
                if left <= NEAR && due && by_laws_alone(analysis, leg, at, stretch)? {
                    return Ok(Outcome::Converged(()));
                }
                hold = if hold > 0 { hold - 1 } else { 0 };
                if hold == 0 && iterations <= USUAL {
                    c /= if iterations < EASY { 4.0 } else { 2.0 };
                }
                c = c.max(1e-12 * stiffness);
            }
            Outcome::Retry(_) if strict => refused = true,
            Outcome::Retry(failed) => {
                why = failed;
                (c, hold, ahead) = (FACTOR * c, 3, 0.0);
            }
        }
    }
    if free >= FREE {
        why.reason = "nothing holds what slides or opens".into();
        why.worst = stretch.worst();
    }
    Ok(Outcome::Retry(why))
}
