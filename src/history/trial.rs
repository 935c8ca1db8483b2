//! Trials on the path: an increment by load factor, one that follows the path, how far one goes, and its acceptance.

use super::analysis::Analysis;
use super::converged::Converged;
use super::energy::{carried, change, dissipation};
use super::equilibrium::{Ahead, Failure, PathSearch};
use super::judge::{Judged, judge};
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::PathProgress;
use crate::error::Result;
use crate::solver::Unconverged;

/// Iterations of a step that is neither too small nor too large.
const USUAL: f64 = 5.0;
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

/// An increment that was followed along the path.
pub(super) enum Followed {
    /// Taken; the next one may be `growth` times as large.
    Taken { iterations: usize, growth: f64 },
    /// Found and not kept: it goes too far, or its error over the tolerance is above 1.
    Refused { iterations: usize, far: f64, error: f64 },
    /// It ends beyond the end of the load.
    Beyond,
    /// Not found.
    Lost(Unconverged),
    /// Found, but of no use.
    Unusable,
}

/// An increment along the path, kept if it goes no further than increments of the scene (`part`) and is accurate enough.
pub(super) fn follow(
    analysis: &mut Analysis,
    start: &Start,
    path: &PathSearch,
    at: &mut PathProgress,
    part: f64,
) -> Result<Followed> {
    let (found, load_factor) = match analysis.engine.follow(&analysis.state, at.load_factor, path) {
        Ok((found, load_factor)) if load_factor < 1.0 => (found, load_factor),
        Ok(_) => return Ok(Followed::Beyond),
        Err(Failure::Unconverged(why)) => return Ok(Followed::Lost(why)),
        Err(Failure::Unusable(_)) => return Ok(Followed::Unusable),
    };
    let spent = path.amount.unwrap_or_else(|| dissipation(analysis.problem, &found));
    // how far this goes, in increments of the scene; what is intact may go from nothing to anything
    let load = (load_factor - at.load_factor).abs() / part;
    let tractions = if spent > 0.0 { far(analysis, at, &found) / (TRACTIONS * part) } else { 0.0 };
    let far = load.max(tractions);
    let Judged { error, .. } =
        judge(analysis, start, [at.most.sqrt(), 0.0, 0.0], [at.load_factor, load_factor], &found, true)?;
    let iterations = found.iterations;
    if far > WIDE || error > 1.0 {
        return Ok(Followed::Refused { iterations, far, error });
    }
    let easier = (USUAL / iterations as f64).sqrt().clamp(0.5, 2.0);
    take(analysis, start, found, at, load_factor, spent)?;
    Ok(Followed::Taken { iterations, growth: easier.min(1.0 / far).min((1.0 / error).sqrt()) })
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
