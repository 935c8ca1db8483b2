//! Viscous stretches up to a limit load: where nothing holds at the end of an increment, shorter ones follow from the last equilibrium
//! on, so that the run ends at the limit and not where the last stretch began.
//!
//! ```text
//! from ──────────────────────────── goal     nothing holds there
//!      ─►──►────►────────┤                    twice as far each time, as long as something does
//!                        ─►──►┤               and again, until the first is too far
//! ```
//!
//! Beyond the limit a stretch takes long, before it short. What is left between is halved with the laws as they are: below the limit
//! that takes a few iterations.

use super::analysis::{Analysis, complete};
use super::converged::Converged;
use super::equilibrium::{Ahead, Failure};
use super::failure::{stopped, unusable};
use super::judge::{Judged, judge};
use super::nowhere::{farthest, is_nowhere};
use super::outcome::Outcome;
use super::progress::{LoadIncrement, StepProgress};
use super::viscous::viscous;
use crate::error::Result;
use crate::output::Snapshot;
use crate::problem::Problem;
use crate::solver::Unconverged;

/// Between the last equilibrium and where nothing holds any more lies at most this share of an increment.
const NEAR: f64 = 0.05;
/// The same after the last halving.
const NEAREST: f64 = 1e-3;

/// Load factor at which nothing has held.
pub(super) struct LimitAt {
    load_factor: f64,
    why: Unconverged,
    /// The next stretch, in load factors.
    next: f64,
}

/// A viscous stretch to the increment's end, or a short one if nothing holds there. `limit`: the least load factor at which nothing
/// has held in this increment.
pub(super) fn stretch(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    width: f64,
    limit: &mut Option<LimitAt>,
) -> Result<Outcome<usize>> {
    let (from, shortest) = (at.load_factor, NEAR * leg.part);
    let mut iterations = 0;
    loop {
        let goal = match limit {
            None => leg.goal,
            Some(LimitAt { load_factor, why, .. }) if *load_factor - from < shortest => {
                return Ok(Outcome::Retry(Unconverged { iterations, ..why.clone() }));
            }
            Some(LimitAt { load_factor, next, .. }) => from + next.min(0.5 * (*load_factor - from)),
        };
        let short = LoadIncrement { goal, ..*leg };
        let went = match limit {
            None => viscous(analysis, &short, at, width)?,
            Some(_) => to_what_holds(analysis, &short, at, width.min(goal - from))?,
        };
        match went {
            Outcome::Converged(more) => {
                limit.iter_mut().for_each(|limit| limit.next *= 2.0);
                return Ok(Outcome::Converged(iterations + more));
            }
            Outcome::Retry(why) if stopped(&analysis.stop).is_some() => return Ok(Outcome::Retry(why)),
            Outcome::Retry(why) => {
                iterations += why.iterations;
                let load_factor = if goal - from <= shortest { from } else { goal }; // near enough
                *limit = Some(LimitAt { load_factor, why, next: shortest });
            }
        }
    }
}

/// Goes on from the last equilibrium towards the limit, by halves of what lies between. Returns the iterations.
pub(super) fn close_in(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    limit: Option<LimitAt>,
) -> Result<usize> {
    let Some(LimitAt { mut load_factor, .. }) = limit else { return Ok(0) };
    let mut iterations = 0;
    // where the search for a limit ended at the last equilibrium, the next increment of it is beyond
    load_factor = load_factor.max((at.load_factor + NEAR * leg.part).min(leg.goal));
    while load_factor - at.load_factor > NEAREST * leg.part && stopped(&analysis.stop).is_none() {
        let (from, to) = (at.load_factor, 0.5 * (at.load_factor + load_factor));
        let load = leg.start.at(to)?;
        let ahead = Ahead { changes: (to - from) / at.last, near: false };
        let found = match analysis.engine.solve(&analysis.state, &load, ahead, leg.complete) {
            Ok(found) if !is_nowhere(&found, [&leg.start.at(from)?, &load], analysis) => found,
            Ok(Converged { iterations: tried, .. })
            | Err(Failure::Unconverged(Unconverged { iterations: tried, .. })) => {
                (load_factor, iterations) = (to, iterations + tried);
                continue;
            }
            Err(Failure::Unusable(error)) => {
                return Err(unusable(leg.step, leg.number, analysis.totals.increments, error));
            }
        };
        iterations += found.iterations;
        let Judged { error, solved, passed, work, .. } =
            judge(analysis, leg.start, [at.most, at.energy, at.summed], [from, to], &found, false)?;
        iterations += solved;
        if error > 1.0 {
            load_factor = to;
            continue;
        }
        (at.last, at.load_factor) = (to - from, to);
        (at.energy, at.summed) = (at.energy.max(passed), at.summed + work);
        analysis.totals.parts += 1;
        analysis.engine.accept();
        analysis.state.accept(analysis.problem, found, load);
    }
    Ok(iterations)
}

/// A stretch that ends where it began if its points move by more than an edge: what slides so far under a load that something holds is
/// held by rounding.
fn to_what_holds(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    width: f64,
) -> Result<Outcome<usize>> {
    let mut kept = analysis.state.clone();
    complete(analysis.problem, &*analysis.engine, &mut kept, leg.start.at(at.load_factor)?);
    let (search, totals, progress) = (analysis.engine.search(), analysis.totals.clone(), at.clone());
    match viscous(analysis, leg, at, width)? {
        Outcome::Converged(iterations)
            if moved_far(analysis.problem, &kept.snapshot, &analysis.state.snapshot) =>
        {
            analysis.engine.restore(search);
            (analysis.state, analysis.totals, *at) = (kept, totals, progress);
            let reason = "nothing holds what slides or opens".into();
            Ok(Outcome::Retry(Unconverged { reason, worst: Vec::new(), iterations }))
        }
        went => Ok(went),
    }
}

/// True if a point of an interface has moved by more than an edge of its finer side.
fn moved_far(problem: &Problem, before: &Snapshot, now: &Snapshot) -> bool {
    now.jumps.iter().enumerate().any(|(k, jumps)| {
        let coupling = &problem.model.interfaces[k].coupling;
        let edge = coupling.midplane.length / coupling.facets(0).max(coupling.facets(1)) as f64;
        farthest(&before.jumps[k], jumps) > edge
    })
}
