//! An increment of the load factor in as many parts as its accuracy asks for.
//!
//! ```text
//! exact      Newton's method with the laws as they are; the error of the part is estimated (`estimate`)
//!              │ above path_tolerance: a smaller part
//!              ▼ not found in a few tries, or no smaller part is better
//! viscous    the load goes on while a viscosity holds the jumps (`viscous`), until the laws alone hold them again
//! ```
//!
//! A part that is kept is an equilibrium of the laws, and so is the end of every increment.

use super::analysis::Analysis;
use super::clock::PartNow;
use super::energy::carried;
use super::equilibrium::{Ahead, Failure};
use super::failure::{stopped, unusable};
use super::judge::{Judged, judge};
use super::limit::{close_in, stretch};
use super::loading::Start;
use super::nowhere::is_nowhere;
use super::outcome::Outcome;
use super::progress::{LoadIncrement, StepProgress};
use super::snap::tell_drop;

use crate::error::Result;
use crate::solver::Unconverged;

/// A part that is not found is tried again with this share of it, at most so many times.
const NARROWER: f64 = 0.25;
const TRIES: usize = 2;
/// The smallest part that is tried for its accuracy, of an increment.
const SMALLEST: f64 = 5e-4;
/// A new part aims at this share of the tolerance, and changes its size by these factors at most.
const SAFETY: f64 = 0.8;
const SHRINK: f64 = 0.05;
const GROW: f64 = 4.0;
/// A part found in at most so many iterations may be followed by a larger one.
const EASY: usize = 8;

/// Goes on to the end of an increment.
pub(super) fn advance(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
) -> Result<Outcome<usize>> {
    let (mut iterations, mut failed, mut cut) = (0, 0, false);
    let mut limit = None;
    let before = analysis.totals.parts;
    while at.load_factor < leg.goal {
        let parts = analysis.totals.parts - before;
        analysis.clock.tell(PartNow { load_factor: at.load_factor, parts, iterations });
        if let Some(why) = stopped(&analysis.stop) {
            return Ok(Outcome::Retry(Unconverged { iterations, ..why }));
        }
        let from = at.load_factor;
        let to = if from + 1.001 * at.width >= leg.goal { leg.goal } else { from + at.width };
        let load = leg.start.at(to)?;
        at.most = at.most.max(carried(analysis.problem, &analysis.state.snapshot).sqrt());
        let ahead = Ahead { changes: (to - from) / at.last, near: at.onset };
        let narrower = match analysis.engine.solve(&analysis.state, &load, ahead, leg.complete) {
            Ok(found) if is_nowhere(&found, [&leg.start.at(from)?, &load], analysis) => {
                iterations += found.iterations;
                failed += 1;
                NARROWER * (to - from)
            }
            Ok(found) => {
                iterations += found.iterations;
                let Judged { error, cracked, solved, passed, work } =
                    judge(analysis, leg.start, [at.most, at.energy, at.summed], [from, to], &found, false)?;
                iterations += solved;
                at.energy = at.energy.max(passed);
                if error <= 1.0 {
                    at.width = match found.iterations <= EASY {
                        true => (to - from) * (SAFETY / error.sqrt()).clamp(1.0, GROW),
                        false => to - from,
                    };
                    at.width = if error == 0.0 { leg.part } else { at.width.min(leg.part) };
                    (at.last, at.load_factor, at.fresh, at.patience) = (to - from, to, false, 4);
                    (at.onset, cut, failed) = (cut, false, 0);
                    analysis.totals.parts += 1;
                    at.summed += work;
                    tell_drop(analysis, leg, at.energy, [from, to], &found);
                    analysis.engine.accept();
                    analysis.state.accept(analysis.problem, found, load);
                    continue;
                }
                let narrower = (to - from) * (SAFETY / error.sqrt()).clamp(SHRINK, 0.5);
                let onset = if cracked { onset(analysis, leg.start, [from, to], at.last)? } else { None };
                cut = onset.is_some();
                onset.unwrap_or(narrower)
            }
            Err(Failure::Unconverged(why)) => {
                iterations += why.iterations;
                failed += 1;
                NARROWER * (to - from)
            }
            Err(Failure::Unusable(error)) => {
                return Err(unusable(leg.step, leg.number, analysis.totals.increments, error));
            }
        };
        analysis.totals.rejected += 1;
        if failed <= TRIES && narrower >= SMALLEST * leg.part && !at.fresh {
            at.width = narrower;
            continue;
        }
        failed = 0;
        match stretch(analysis, leg, at, to - from, &mut limit)? {
            Outcome::Converged(more) => iterations += more,
            Outcome::Retry(why) => {
                iterations += why.iterations + close_in(analysis, leg, at, limit)?;
                return Ok(Outcome::Retry(Unconverged { iterations, ..why }));
            }
        }
    }
    Ok(Outcome::Converged(iterations))
}

/// Share of a part up to the first point that cracks in it.
fn onset(analysis: &mut Analysis, start: &Start, [from, to]: [f64; 2], last: f64) -> Result<Option<f64>> {
    let (now, load) = (start.at(from)?, start.at(to)?);
    let fraction = analysis.engine.onset(&analysis.state, &load, &now, (to - from) / last);
    Ok(fraction.map(|fraction| fraction * (to - from)).filter(|width| *width < 0.99 * (to - from)))
}
