//! Trials on the path: an increment by load factor, how far one goes, and its acceptance.

use super::analysis::Analysis;
use super::converged::Converged;
use super::energy::{carried, change, dissipation};
use super::equilibrium::{Ahead, Failure};
use super::judge::judge;
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::PathProgress;
use crate::error::Result;

/// Iterations of a step that is neither too small nor too large.
pub(super) const USUAL: f64 = 5.0;
/// A step that fails is tried again with this part of its energy, at most so many times.
pub(super) const SMALLER: f64 = 0.25;
pub(super) const SMALLEST: usize = 20;
/// A step on the path goes at most this many increments far: in the load factor, and in what the interfaces carry, of which
/// `TRACTIONS` times an increment's part may change.
pub(super) const WIDE: f64 = 2.0;
pub(super) const TRACTIONS: f64 = 4.0;
/// Interfaces that carry less than this part of the most that they have carried are exhausted.
const EXHAUSTED: f64 = 1e-4;

/// Change of what the interfaces carry, relative to what they carry now; of exhausted interfaces, to a small part of the most.
pub(super) fn far(analysis: &Analysis, at: &PathProgress, found: &Converged) -> f64 {
    let carried = carried(analysis.problem, &analysis.state.snapshot).max(EXHAUSTED * EXHAUSTED * at.most);
    let change = change(analysis.problem, &analysis.state.snapshot, found);
    if change == 0.0 { 0.0 } else { (change / carried).sqrt() }
}

/// An increment to a load factor if it has an equilibrium that dissipates no more than an amount: iterations and error over
/// the tolerance, or the error of what was not kept.
pub(super) fn by_load(
    analysis: &mut Analysis,
    start: &Start,
    at: &mut PathProgress,
    load_factor: f64,
    amount: f64,
) -> Result<Outcome<(usize, f64), f64>> {
    let load = start.at(load_factor)?;
    let ahead = if at.change > 0.0 { (load_factor - at.load_factor) / at.change } else { 0.0 };
    let ahead = Ahead { changes: ahead, near: false };
    let found = match analysis.engine.solve(&analysis.state, &load, ahead, true) {
        Ok(found) => found,
        Err(failure) => {
            if let Failure::Unconverged(why) = failure {
                at.tried += why.iterations;
            }
            analysis.totals.rejected += 1;
            return Ok(Outcome::Retry(f64::INFINITY));
        }
    };
    let spent = dissipation(analysis.problem, &found);
    let judged =
        judge(analysis, start, [at.most.sqrt(), 0.0, 0.0], [at.load_factor, load_factor], &found, false)?;
    at.tried += judged.solved;
    if spent > amount || judged.error > 1.0 {
        at.tried += found.iterations;
        analysis.totals.rejected += 1;
        return Ok(Outcome::Retry(if spent > amount { f64::INFINITY } else { judged.error }));
    }
    let iterations = take(analysis, start, found, at, load_factor, spent)?;
    Ok(Outcome::Converged((iterations, judged.error)))
}

/// Accepts what was found at a load factor. Returns its iterations.
pub(super) fn take(
    analysis: &mut Analysis,
    start: &Start,
    found: Converged,
    at: &mut PathProgress,
    load_factor: f64,
    spent: f64,
) -> Result<usize> {
    let iterations = found.iterations;
    analysis.engine.accept();
    analysis.state.accept(analysis.problem, found, start.at(load_factor)?);
    analysis.totals.parts += 1;
    (at.change, at.load_factor, at.spent) = (load_factor - at.load_factor, load_factor, spent);
    if spent > 0.0 {
        at.amount = spent;
    }
    Ok(iterations)
}
