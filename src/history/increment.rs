//! An increment and its place in the history.

use crate::problem::BoundStep;

/// An increment of the history.
#[derive(Debug, Clone, Copy)]
pub struct Increment<'a> {
    /// Number of the step, from 0.
    pub step_number: usize,
    /// The step.
    pub step: &'a BoundStep,
    /// Number of the increment within its step, from 1; 0 is the unloaded state before the first.
    pub number: usize,
    /// Number of the increment over all steps.
    pub increment: usize,
    /// Load factor in the step, 0 to 1.
    pub load_factor: f64,
    /// Newton iterations since the increment before.
    pub iterations: usize,
    /// The last increment of its step.
    pub last: bool,
    /// The state of the last increment again, complete: no equilibrium was found beyond.
    pub ended: bool,
}

impl<'a> Increment<'a> {
    /// The start of a step, after so many increments over all steps.
    pub(super) fn of(step_number: usize, step: &'a BoundStep, increment: usize) -> Increment<'a> {
        let (number, load_factor, iterations) = (0, 0.0, 0);
        Increment { step_number, step, number, increment, load_factor, iterations, last: false, ended: false }
    }
}
