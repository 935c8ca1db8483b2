//! An increment of a step by load factor, and where such a step stands.

use serde::{Deserialize, Serialize};

use super::loading::Start;
use crate::problem::BoundStep;
use crate::solver::Unconverged;

/// One increment of a step.
pub(super) struct LoadIncrement<'a, 'b> {
    pub(super) start: &'b Start<'a>,
    pub(super) step: &'b BoundStep,
    /// Number within its step.
    pub(super) number: usize,
    /// Load factor at its end.
    pub(super) goal: f64,
    /// Share of an increment in its step.
    pub(super) part: f64,
    /// Displacements are recovered at its end.
    pub(super) complete: bool,
}

/// Progress of a step by load factor.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct StepProgress {
    /// Load factor.
    pub(super) load_factor: f64,
    /// Size of the next part, and of the last.
    pub(super) width: f64,
    pub(super) last: f64,
    /// The most that the interfaces have carried, √(Σ w |t|²).
    pub(super) most: f64,
    /// The largest work of the interfaces in a part that was sought [force × length].
    pub(super) energy: f64,
    /// Errors of the work of the interfaces so far [force × length].
    pub(super) summed: f64,
    /// Viscous steps before the laws alone are tried again.
    pub(super) patience: usize,
    /// The last part was the end of a viscous stretch.
    pub(super) fresh: bool,
    /// The last part ended where a point reaches its strength.
    pub(super) onset: bool,
}

impl StepProgress {
    /// At the start of a step whose increments are `part` of it.
    pub(super) fn new(part: f64) -> StepProgress {
        StepProgress {
            load_factor: 0.0,
            width: part,
            last: f64::INFINITY,
            most: 0.0,
            energy: 0.0,
            summed: 0.0,
            patience: 4,
            fresh: false,
            onset: false,
        }
    }
}

/// The last equilibrium that a step has reached.
pub(super) struct Reached {
    /// Number of the increment within its step.
    pub(super) number: usize,
    /// Load factor of the last equilibrium.
    pub(super) load_factor: f64,
    /// Newton iterations.
    pub(super) iterations: usize,
    /// The step is done.
    pub(super) last: bool,
    /// There is an equilibrium beyond the one before.
    pub(super) moved: bool,
    /// Reason for none at the increment's end.
    pub(super) lost: Option<Unconverged>,
}

/// Progress of a step along the path.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct PathProgress {
    pub(super) load_factor: f64,
    /// The last change of the load factor, and the energy that it dissipated.
    pub(super) change: f64,
    pub(super) spent: f64,
    /// Energy of the next step.
    pub(super) amount: f64,
    /// Length of the next step, of the last one.
    pub(super) ratio: f64,
    /// The most that the interfaces have carried, as `State::carried`.
    pub(super) most: f64,
    /// Size of the next part by the load factor.
    pub(super) width: f64,
    /// Steps along the path before the load factor is tried again, now and after the next failure.
    pub(super) wait: usize,
    pub(super) patience: usize,
    /// Iterations of searches that were not kept.
    pub(super) tried: usize,
}
