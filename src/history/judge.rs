//! The error of a part of an increment over the tolerance of the path.

use super::analysis::Analysis;
use super::converged::Converged;
use super::energy::{carried_after, dissipation};
use super::equilibrium::{Estimate, Way};
use super::loading::Start;
use crate::error::Result;

/// Share of the tolerance above which the bend of a part with late cracks asks for the check of late points, and the error over
/// the tolerance of a part that fails it.
const SUSPECT: f64 = 1.0;
const UNREACHED: f64 = 10.0;
/// Weight of the trapezoidal rule's error of a part: these add up over an increment.
const SUMS: f64 = 3.0;
/// Their sum over a step stays below so many times the tolerance: a part may have this share of what is left of that.
const BUDGET: f64 = 4.5;
const SHARE: f64 = 0.25;
/// Part of the most that was carried against which tractions count where nothing is.
const AT_REST: f64 = 1e-3;
/// Smallest scale of the tractions [stress × √length].
const FLOOR: f64 = 1e-12;

/// Error of what was found between two load factors, over the tolerance; 0 if the way there is straight, or any will do. `follows`: the
/// load factor was found along a path. The most that was carried, the largest energy of what was sought and the errors of work so far count too.
pub(super) fn judge(
    analysis: &mut Analysis,
    start: &Start,
    [most, energy, summed]: [f64; 3],
    [from, to]: [f64; 2],
    found: &Converged,
    follows: bool,
) -> Result<Judged> {
    if analysis.problem.solution.path_tolerance >= 1.0 {
        return Ok(Judged { error: 0.0, cracked: false, solved: 0, passed: 0.0, work: 0.0 });
    }
    let [middle, end] = [start.at(0.5 * (from + to))?, start.at(to)?];
    let ends = if follows { Some([start.at(0.0)?, start.at(1.0)?]) } else { None };
    let way = Way { middle: &middle, end: &end, ends: ends.as_ref() };
    let Some(estimate) = analysis.engine.estimate(&analysis.state, found, way) else {
        return Ok(Judged { error: 0.0, cracked: false, solved: 0, passed: 0.0, work: 0.0 });
    };
    let Estimate { traction, work, passed, bend, cracked, late, .. } = estimate;
    let tolerance = analysis.problem.solution.path_tolerance;
    let spent = dissipation(analysis.problem, found);
    let carried = most.max(carried_after(analysis.problem, found).sqrt());
    let carried = carried.max(AT_REST * analysis.state.most_carried).max(FLOOR);
    let so_far = analysis.state.largest_energy().max(analysis.state.dissipated + spent);
    let energy = energy.max(passed).max(so_far).max(f64::MIN_POSITIVE);
    let energies = estimate.dissipation.abs().max(SUMS * work.abs()) / energy;
    let left = (BUDGET * tolerance * energy - summed).max(f64::MIN_POSITIVE);
    let mut error = ((traction / carried).max(energies) / tolerance).max(work.abs() / (SHARE * left));
    let mut solved = 0;
    if late && error <= 1.0 && bend > SUSPECT * tolerance {
        solved = 1;
        if !analysis.engine.is_reached(&analysis.state, found, &end) {
            error = error.max(UNREACHED);
        }
    }
    Ok(Judged { error, cracked, solved, passed, work: work.abs() })
}

/// Error of a part, and the work in it.
pub(super) struct Judged {
    /// Its error over the tolerance.
    pub(super) error: f64,
    /// Intact points of softening laws have cracked in it.
    pub(super) cracked: bool,
    /// Linear systems solved to know.
    pub(super) solved: usize,
    /// Work of the interfaces in it, added up by magnitude [force × length].
    pub(super) passed: f64,
    /// Error of their work by the trapezoidal rule [force × length].
    pub(super) work: f64,
}
