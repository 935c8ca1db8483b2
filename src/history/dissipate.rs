//! Steps along the path by dissipated energy, and by load factor while nothing dissipates.

use super::analysis::Analysis;
use super::equilibrium::{Failure, PathSearch};
use super::judge::judge;
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::PathProgress;
use super::trial::{Followed, SMALLER, SMALLEST, TRACTIONS, WIDE, by_load, far, follow, take};
use crate::error::Result;
use crate::solver::{Ramp, Unconverged};

/// The first step on the path dissipates this part of the elastic energy.
const FIRST: f64 = 1e-2;
/// The first increment that dissipates is divided down to this part, to begin where it does.
const LEAST: f64 = 1e-3;
/// A row by the load factor dissipates at most so many times what the last one makes expect, so that rows follow the path closely.
const ROWS: f64 = 4.0;
/// Sizes of a part by the load factor that are tried where the path rises, unless its error is so many times the tolerance.
const RISING: usize = 2;
const PATIENCE: usize = 16;
const FAR_OFF: f64 = 100.0;

/// An increment of the load factor if nothing dissipates in it; else a first step on the path.
pub(super) fn intact(
    analysis: &mut Analysis,
    start: &Start,
    ramp: &Ramp,
    at: &mut PathProgress,
    part: f64,
) -> Result<Outcome<usize>> {
    let reached = if at.load_factor + 1.001 * part >= 1.0 { 1.0 } else { at.load_factor + part };
    if let Outcome::Converged((iterations, _)) = by_load(analysis, start, at, reached, 0.0)? {
        return Ok(Outcome::Converged(iterations));
    }
    // up to where something begins to dissipate: what follows is compared with the state there
    let (begin, mut width, mut all) = (at.load_factor, part, 0);
    while width > LEAST * part {
        width *= 0.5;
        if let Outcome::Converged((iterations, _)) =
            by_load(analysis, start, at, at.load_factor + width, 0.0)?
        {
            all += iterations;
        }
    }
    if at.load_factor - begin > 2.0 * LEAST * part {
        return Ok(Outcome::Converged(all));
    }
    let mut amount = FIRST * analysis.state.stored;
    let mut why = Unconverged { reason: "nothing to go on".into(), worst: Vec::new(), iterations: 0 };
    for _ in 0..SMALLEST {
        let path = PathSearch { step: start.step(), ramp, amount: Some(amount), ahead: 0.0, last: 0.0 };
        match analysis.engine.follow(&analysis.state, at.load_factor, &path) {
            Ok((found, load_factor)) if far(analysis, at, &found) <= WIDE * TRACTIONS * part => {
                let judged = judge(
                    analysis,
                    start,
                    [at.most.sqrt(), 0.0, 0.0],
                    [at.load_factor, load_factor],
                    &found,
                    true,
                )?;
                at.tried += judged.solved;
                if judged.error > 1.0 {
                    at.tried += found.iterations;
                    analysis.totals.rejected += 1;
                    amount *= SMALLER;
                    continue;
                }
                return take(analysis, start, found, at, load_factor, amount).map(Outcome::Converged);
            }
            Ok(_) => {}
            Err(Failure::Unconverged(failed)) => {
                at.tried += failed.iterations;
                why = failed;
            }
            Err(Failure::Unusable(_)) => {}
        }
        amount *= SMALLER;
    }
    Ok(Outcome::Retry(why))
}

/// The next step on the path, ending at the end of the load exactly.
pub(super) fn along(
    analysis: &mut Analysis,
    start: &Start,
    ramp: &Ramp,
    at: &mut PathProgress,
    part: f64,
) -> Result<Outcome<usize>> {
    at.wait = at.wait.max(1) - 1;
    if at.change > 0.0 && at.wait == 0 {
        // the path rises: the load factor may lead, as long as it leads along the path
        at.patience = (2 * at.patience).min(PATIENCE);
        at.wait = at.patience;
        for _ in 0..RISING {
            let width = at.width.min(part);
            let reached = if at.load_factor + 1.001 * width >= 1.0 { 1.0 } else { at.load_factor + width };
            let expected = at.spent * (reached - at.load_factor) / at.change;
            match by_load(analysis, start, at, reached, ROWS * expected)? {
                Outcome::Converged((iterations, error)) => {
                    at.width = (width * (0.8 / error.sqrt()).clamp(1.0, 4.0)).min(part);
                    (at.patience, at.wait) = (1, 0);
                    return Ok(Outcome::Converged(iterations));
                }
                Outcome::Retry(error) if error < FAR_OFF => at.width = width * (0.8 / error.sqrt()).min(0.5),
                Outcome::Retry(_) => break,
            }
        }
    }
    let mut amount = at.amount;
    let mut why = Unconverged { reason: "the path ends".into(), worst: Vec::new(), iterations: 0 };
    for _ in 0..SMALLEST {
        let path = PathSearch {
            step: start.step(),
            ramp,
            amount: Some(amount),
            ahead: amount / at.spent,
            last: at.change,
        };
        match follow(analysis, start, &path, at, part)? {
            Followed::Taken { iterations, growth } => {
                at.amount = amount * growth;
                return Ok(Outcome::Converged(iterations));
            }
            Followed::Refused { iterations, far, error } => {
                at.tried += iterations;
                analysis.totals.rejected += 1;
                if far <= WIDE && error < FAR_OFF {
                    amount *= (0.8 / error.sqrt()).min(0.5) / SMALLER;
                }
            }
            Followed::Beyond => {
                if let Outcome::Converged((iterations, _)) = by_load(analysis, start, at, 1.0, f64::INFINITY)?
                {
                    return Ok(Outcome::Converged(iterations));
                }
            }
            Followed::Lost(failed) => {
                at.tried += failed.iterations;
                why = failed;
                analysis.totals.rejected += 1;
            }
            Followed::Unusable => {}
        }
        amount *= SMALLER;
    }
    Ok(Outcome::Retry(why))
}
