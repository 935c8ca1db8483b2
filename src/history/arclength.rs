//! A step along the path of equilibria as long as the one before it, measured by the change of the jumps. It needs nothing
//! that dissipates.

use super::analysis::Analysis;
use super::equilibrium::PathSearch;
use super::loading::Start;
use super::outcome::Outcome;
use super::progress::PathProgress;
use super::trial::{Followed, SMALLER, SMALLEST, by_load, follow};
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
        let path = PathSearch { step: start.step(), ramp, amount: None, ahead, last };
        match follow(analysis, start, &path, at, part)? {
            Followed::Taken { iterations, growth } => {
                at.ratio = growth;
                return Ok(Outcome::Converged(iterations));
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
            Followed::Refused { .. } | Followed::Unusable => {}
        }
        ratio *= SMALLER;
    }
    Ok(Outcome::Retry(why))
}
