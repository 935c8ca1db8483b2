//! How a scene is solved: which joints have unknowns of their own, and which form of the equations takes less work.

use super::memory;
use crate::error::Result;
use crate::law::Law;
use crate::problem::Problem;
use crate::scene::Strategy;
use crate::solver::Continuum;

/// Iterations of an increment, for the estimate.
const ITERATIONS: f64 = 4.0;

/// Multiplications and additions that a run takes, estimated before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// On the jumps of the joints.
    pub condensed: f64,
    /// On all displacements, the joints' own share left out.
    pub plain: f64,
}

/// Joints that are not elastic.
pub(super) fn active(problem: &Problem) -> Vec<usize> {
    let laws = problem.laws.iter().enumerate();
    laws.filter(|(_, (law, _))| !matches!(law, Law::Elastic(_))).map(|(k, _)| k).collect()
}

/// Joints whose jumps are unknowns of the condensed form: those that are not elastic or stiff. None if the scene is linear
/// and its displacements will do.
pub(super) fn asked(problem: &Problem) -> Vec<usize> {
    let active = active(problem);
    match problem.solution.strategy {
        Strategy::Plain => return active,
        Strategy::Condensed if active.is_empty() => return (0..problem.laws.len()).collect(),
        _ => {}
    }
    (0..problem.laws.len()).filter(|k| problem.stiff[*k] || active.contains(k)).collect()
}

/// Chooses the condensed form or the plain one (false). Stiff elastic joints need the condensed one.
pub(super) fn condensed(
    problem: &Problem,
    continuum: &Continuum,
    asked: &[usize],
    available: Option<u64>,
) -> Result<(bool, Estimate)> {
    let (model, dofs) = (&problem.model, problem.model.dofs());
    let border = continuum.border() as f64;
    let coefficients = asked.iter().map(|&k| model.joints[k].size()).sum::<usize>() as f64;
    let changes = problem.stages.windows(2).filter(|pair| pair[0].held != pair[1].held).count();
    let increments = problem.stages.iter().map(|stage| stage.increments).sum::<usize>() as f64;
    let iterations = if active(problem).is_empty() { 1.0 } else { ITERATIONS * increments };
    let base = border.powi(3) / 3.0 + border * coefficients * (border + coefficients);
    let estimate = Estimate {
        condensed: continuum.operations()
            + (1 + changes) as f64 * (base + 2.0 * coefficients.powi(3))
            + iterations * 2.0 / 3.0 * coefficients.powi(3),
        plain: iterations * 2.0 * continuum.operations(),
    };
    let dense = continuum.border().pow(2) + 5 * (coefficients as usize).pow(2);
    let needed = memory::needed(continuum.bytes() + size_of::<f64>() * dense, 0, dofs);
    let fits = available.is_none_or(|available| needed <= available);
    let condensed = match problem.solution.strategy {
        Strategy::Auto => {
            let stiff = asked.iter().any(|&k| problem.stiff[k]);
            stiff || asked.is_empty() || fits && estimate.condensed <= estimate.plain
        }
        strategy => strategy == Strategy::Condensed,
    };
    if condensed {
        memory::refuse(dofs, continuum.entries(), needed, available)?;
    }
    Ok((condensed, estimate))
}
