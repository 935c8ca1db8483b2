//! The equilibrium that Newton's method seeks: under a load, or along the path of a load.

use std::borrow::Cow;

use super::evaluation::Evaluation;
use super::{Affine, Constraint, Form, Respond};

/// The equilibrium that is sought.
pub(super) enum Aim<'a> {
    /// Under a load.
    Load(&'a [f64]),
    /// Along the path of a load, as far as a constraint says.
    Path(&'a Affine, &'a Constraint),
}

impl Aim<'_> {
    /// b at a load factor.
    pub(super) fn target(&self, load_factor: f64) -> Cow<'_, [f64]> {
        match self {
            Aim::Load(target) => Cow::Borrowed(target),
            Aim::Path(load, _) => Cow::Owned(load.at(load_factor)),
        }
    }

    /// The laws at a load factor; under a load they have their own.
    pub(super) fn laws<L: Respond>(&self, laws: &L, load_factor: f64) -> L {
        match self {
            Aim::Load(_) => *laws,
            Aim::Path(..) => laws.at(load_factor),
        }
    }

    /// True along a path.
    pub(super) fn follows(&self) -> bool {
        matches!(self, Aim::Path(..))
    }

    /// g.
    pub(super) fn missing<L: Respond>(&self, form: &impl Form, laws: &L, now: &Evaluation<L::Memory>) -> f64 {
        match self {
            Aim::Load(_) => 0.0,
            Aim::Path(_, constraint) => constraint.missing(form, laws, now),
        }
    }

    /// Size of what is left of both equations.
    pub(super) fn merit(&self, error: f64, missing: f64, tolerance: f64) -> f64 {
        match self {
            Aim::Load(_) => error,
            Aim::Path(..) => error.max(tolerance).hypot(missing),
        }
    }

    /// Most halvings of a step.
    pub(super) fn halvings(&self) -> usize {
        match self {
            Aim::Load(_) => 10,
            Aim::Path(..) => 8,
        }
    }

    pub(super) fn singular(&self) -> &'static str {
        match self {
            Aim::Load(_) => "the tangent is singular: nothing holds what slides or opens",
            Aim::Path(..) => "the path is singular",
        }
    }

    pub(super) fn unanswered(&self) -> &'static str {
        match self {
            Aim::Load(_) => "the laws have no answer along the correction",
            Aim::Path(..) => "the laws have no answer along the path",
        }
    }
}
