//! A step along the path of equilibria as long as the one before it, measured by the change of the jumps. It needs nothing
//! that dissipates.

use super::analysis::Analysis;
use super::energy::dissipation;
use super::equilibrium::{Failure, PathSearch};
use super::judge::{Judged, judge};
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::PathProgress;
use super::trial::{SMALLER, SMALLEST, TRACTIONS, USUAL, WIDE, by_load, far, take};
use crate::error::Result;
use crate::solver::{Ramp, Unconverged};

/// The next step, ending at the end of the load exactly. The first one goes an increment along the tangent.
pub(super) fn arc(
    analysis: &mut Analysis,
    start: &Start,
    ramp: &Ramp,
    at: &mut PathProgress,
    part: f64,
) -> Result<Outcome<usize>> {
    let first = at.change == 0.0;
    let mut ratio = at.ratio;
    let mut why = Unconverged { reason: "the path ends".into(), worst: Vec::new(), iterations: 0 };
    for _ in 0..SMALLEST {
        let (ahead, last) = if first { (0.0, ratio * part) } else { (ratio, at.change) };
        match analysis.engine.follow(
            &analysis.state,
            at.load_factor,
            &PathSearch { ramp, amount: None, ahead, last },
        ) {
            Ok((found, load_factor)) if load_factor < 1.0 => {
                let spent = dissipation(analysis.problem, &found);
                // how far this goes, in increments of the scene; what is intact may go from nothing to anything
                let load = (load_factor - at.load_factor).abs() / part;
                let tractions =
                    if spent > 0.0 { far(analysis, at, &found) / (TRACTIONS * part) } else { 0.0 };
                let far = load.max(tractions);
                let Judged { error, .. } = judge(
                    analysis,
                    start,
                    [at.most.sqrt(), 0.0, 0.0],
                    [at.load_factor, load_factor],
                    &found,
                    true,
                )?;
                if far <= WIDE && error <= 1.0 {
                    let iterations = found.iterations;
                    let easier = (USUAL / iterations as f64).sqrt().clamp(0.5, 2.0);
                    take(analysis, start, found, at, load_factor, spent)?;
                    at.ratio = easier.min(1.0 / far).min((1.0 / error).sqrt());
                    return Ok(Outcome::Converged(iterations));
                }
            }
            Ok(_) => {
                if let Outcome::Converged((iterations, _)) = by_load(analysis, start, at, 1.0, f64::INFINITY)?
                {
                    return Ok(Outcome::Converged(iterations));
                }
            }
            Err(Failure::Unconverged(failed)) => {
                at.tried += failed.iterations;
                why = failed;
                analysis.totals.rejected += 1;
            }
            Err(Failure::Unusable(_)) => {}
        }
        ratio *= SMALLER;
    }
    Ok(Outcome::Retry(why))
}
