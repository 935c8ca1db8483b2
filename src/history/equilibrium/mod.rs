//! What finds the equilibrium of one increment: a linear scene without iteration (`linear`), any other by Newton's method
//! (`newton`).

pub(super) mod estimate;
mod laws;
pub(super) mod linear;
pub(super) mod newton;
pub(super) mod strategy;

use std::sync::Arc;

use super::loading::Load;
use super::state::{Found, State};
use crate::problem::Problem;
use crate::solver::{
    Base, Condensation, Continuum, Measure, NotPositiveDefinite, Ramp, Solution, Unconverged,
};
use estimate::{Estimate, Way};

/// Why an increment has no equilibrium.
#[derive(Debug)]
pub(in crate::history) enum Failure {
    /// A smaller increment may have one.
    Unconverged(Unconverged),
    /// Nothing will help: rounding or overflow leaves this backward error.
    Unusable(f64),
}

/// Starting points of the search for an equilibrium.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::history) struct Ahead {
    /// The last change of the unknowns is repeated this many times.
    pub(in crate::history) changes: f64,
    /// Only as far as shows which points go on cracking: others may be about to.
    pub(in crate::history) near: bool,
}

/// A viscous step.
#[derive(Debug, Clone, Copy)]
pub(in crate::history) struct Viscous {
    /// c [stress / length].
    pub(in crate::history) viscosity: f64,
    /// The last change of the unknowns is repeated this many times, as a second start.
    pub(in crate::history) ahead: f64,
    /// To the tolerance of an increment.
    pub(in crate::history) strict: bool,
}

/// A step on the path of equilibria.
#[derive(Debug)]
pub(in crate::history) struct Path<'a> {
    /// The step's loads.
    pub(in crate::history) ramp: &'a Ramp,
    /// Energy to dissipate; none: as far as the predicted change of the jumps.
    pub(in crate::history) amount: Option<f64>,
    /// The last change of unknowns and load level is repeated this many times; zero: off the tangent.
    pub(in crate::history) ahead: f64,
    /// The last change of the load level; off the tangent the first one.
    pub(in crate::history) last: f64,
}

/// Finds equilibria under one set of supports after the other.
pub(in crate::history) trait Engine {
    /// Makes ready for a set of supports. True if something was factored.
    fn support(&mut self, held: &[bool]) -> Result<bool, NotPositiveDefinite>;

    /// Prepares a step whose loads are affine in the load level, so that increments can do without displacements.
    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[Measure]);

    /// True if the jumps of all joints are found without displacements, those of elastic ones too.
    fn finds_all_jumps(&self) -> bool {
        false
    }

    /// Equilibrium at a load level, sought from the last accepted one and beyond it. Displacements are recovered if they are
    /// asked for (`complete`) or needed.
    fn solve(&mut self, state: &State, load: &Load, ahead: Ahead, complete: bool) -> Result<Found, Failure>;

    /// A backward Euler step of joints with a viscosity, under a load, from the last accepted state.
    fn creep(
        &mut self,
        state: &State,
        load: &Load,
        viscous: Viscous,
        complete: bool,
    ) -> Result<Found, Failure>;

    /// Error of what was found last, from the laws in the middle of the way there; none if nothing cracks, slides, opens or
    /// closes, so that the way is straight.
    fn estimate(&mut self, state: &State, found: &Found, way: Way) -> Option<Estimate>;

    /// True if small parts lead to what was found last too: points that crack in it after others have reached their strength
    /// (one linear system).
    fn is_reached(&mut self, state: &State, found: &Found, end: &Load) -> bool;

    /// Fraction of the way to a load, from that of the last accepted state, at which the first intact point of a softening law
    /// reaches its strength; none if none does.
    fn onset(&mut self, state: &State, load: &Load, now: &Load, ahead: f64) -> Option<f64>;

    /// Relative out-of-balance force of the last accepted state under a load, without any viscosity.
    fn imbalance(&self, state: &State, load: &Load) -> f64;

    /// Equilibrium further along a path from the last accepted one at `level`, wherever its load level is.
    fn follow(&mut self, state: &State, level: f64, path: &Path) -> Result<(Found, f64), Failure>;

    /// Displacements and reactions of the last accepted increment, if the engine goes without.
    fn recover(&self, load: &Load) -> Option<Solution>;

    /// Keeps where the search stands, for `go_back`.
    fn keep(&mut self);

    /// Returns to what was kept last.
    fn go_back(&mut self);

    /// What was found last is accepted: the next search starts from it.
    fn accept(&mut self);
}

/// Factors for a set of supports; true if something was factored anew.
pub(in crate::history) type Make<'a, F> =
    Box<dyn FnMut(&[bool]) -> Result<(F, bool), NotPositiveDefinite> + 'a>;

/// Makes the base system of a set of supports; one condensation serves all sets that differ on joints only.
pub(in crate::history) fn bases<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    stiffness: &'a [Vec<f64>],
) -> Make<'a, Base<'a>> {
    let mut condense = condensations(continuum);
    Box::new(move |held: &[bool]| {
        let (condensation, anew) = condense(held)?;
        Ok((Base::new(continuum, condensation, &problem.model.joints, stiffness, held)?, anew))
    })
}

/// Makes the condensation of a set of supports, which serves all sets that differ on joints only.
pub(in crate::history) fn condensations<'a>(continuum: &'a Continuum) -> Make<'a, Arc<Condensation>> {
    let mut condensed: Option<Arc<Condensation>> = None;
    Box::new(move |held: &[bool]| {
        let reused = condensed.take().filter(|condensation| continuum.serves(condensation, held));
        let anew = reused.is_none();
        let condensation = match reused {
            Some(condensation) => condensation,
            None => Arc::new(continuum.condense(held)?),
        };
        condensed = Some(condensation.clone());
        Ok((condensation, anew))
    })
}
