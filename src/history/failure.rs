//! Errors that end a history before its last increment.

use crate::error::{Error, Stop};
use crate::problem::{BoundStep, Problem};
use crate::solver::Unconverged;

/// A solution that is none: rounding or overflow has eaten it.
pub(super) fn unusable(step: &BoundStep, increment: usize, kept: usize, error: f64) -> Error {
    let reason = if error.is_finite() {
        format!("rounding leaves a backward error of {error:.1e}")
    } else {
        "numbers overflowed: loads or stiffnesses are out of range".into()
    };
    Error::NoEquilibrium { step: step.name.clone(), increment, reason, kept }
}

/// Somebody wants the run to end: an equilibrium beyond the last one is not sought.
pub(super) fn stopped(stop: &Stop) -> Option<Unconverged> {
    let reason = "the run was stopped".into();
    stop.requested().map(|_| Unconverged { reason, worst: Vec::new(), iterations: 0 })
}

/// A matrix that is not positive definite.
pub(super) fn singular(step: &BoundStep, kept: usize) -> Error {
    let reason = "the stiffness is not positive definite in floating point".into();
    Error::NoEquilibrium { step: step.name.clone(), increment: 1, reason, kept }
}

/// The smallest increment has none: where it was lost, and the law points that are farthest from it.
pub(super) fn no_equilibrium(
    problem: &Problem,
    step: &BoundStep,
    increment: usize,
    kept: usize,
    load_factor: f64,
    why: &Unconverged,
) -> Error {
    let worst: Vec<String> = why
        .worst
        .iter()
        .map(|&(interface, point)| {
            let interface = &problem.model.interfaces[interface];
            let point = &interface.coupling.points[point];
            format!("{} at ({:.6}, {:.6})", interface.name, point.position[0], point.position[1])
        })
        .collect();
    let mut reason = format!("{} beyond load factor {load_factor:.6}", why.reason);
    if !worst.is_empty() {
        reason.push_str(&format!("; worst law points: {}", worst.join(", ")));
    }
    Error::NoEquilibrium { step: step.name.clone(), increment, reason, kept }
}
