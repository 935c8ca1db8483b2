//! A form of the equilibrium as the estimates of a part see it.

use super::Failure;
use crate::history::loading::{LoadForces, StepLoad};
use crate::problem::Problem;
use crate::solver::{Form, Newton};

/// Form and unknowns of a search.
pub(super) struct View<'a, F> {
    pub(super) problem: &'a Problem,
    /// The step's loads are prepared.
    pub(super) prepared: bool,
    pub(super) form: &'a F,
    /// Unknowns at the last accepted increment, and of what was found last.
    pub(super) unknowns: &'a [f64],
    pub(super) found: &'a [f64],
}

/// The same, to be factored anew.
pub(super) struct ViewMut<'a, F> {
    pub(super) problem: &'a Problem,
    pub(super) prepared: bool,
    pub(super) form: &'a mut F,
    pub(super) newton: &'a mut Newton,
    pub(super) unknowns: &'a [f64],
    pub(super) found: &'a [f64],
}

/// b of a load on a form whose loads are prepared, or not.
pub(super) fn target(form: &impl Form, prepared: bool, load: &StepLoad) -> Result<Vec<f64>, Failure> {
    let target = match prepared {
        true => form.prepared(load.load_factor),
        false => {
            let LoadForces { loaded, prescribed, .. } = load.forces();
            form.target(loaded, prescribed)
        }
    };
    match target.iter().all(|value| value.is_finite()) {
        true => Ok(target),
        false => Err(Failure::Unusable(f64::INFINITY)),
    }
}
