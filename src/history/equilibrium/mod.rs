//! The search for the equilibrium of one increment: a linear scene without iteration (`linear`), any other by Newton's method
//! (`newton`).

mod equations;
mod estimate;
mod forms;
mod late;
mod laws;
mod linear;
mod newton;
mod press;
pub(super) mod strategy;
mod view;
mod viscosity;

pub use equations::{Equations, Means};

use serde::{Deserialize, Serialize};

use super::converged::Converged;
use super::loading::StepLoad;
use super::state::ModelState;
use crate::problem::BoundStep;
use crate::solver::{ForceScale, LinearMeasure, NodalSolution, NotPositiveDefinite, Ramp, Unconverged};

/// Failure of the search for the equilibrium of an increment.
#[derive(Debug)]
pub(in crate::history) enum Failure {
    /// A smaller increment may have one.
    Unconverged(Unconverged),
    /// Nothing will help: rounding or overflow leaves this backward error.
    Unusable(f64),
}

/// Part of the most that was carried against which a residual counts where nothing is.
const AT_REST: f64 = 1e-3;

/// Points that reach their surface within this fraction of a part do so at once.
const ON: f64 = 1e-6;

/// State of the search for equilibria, from which the next one starts.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(in crate::history) struct Search {
    /// Unknowns of the form at the accepted increment before the last, and at the last.
    before: Vec<f64>,
    unknowns: Vec<f64>,
    /// Forces of the interfaces at the last.
    forces: Vec<Vec<f64>>,
    /// Viscous tractions there at the law points of every active interface; none where nothing is viscous.
    viscous: Vec<Vec<f64>>,
    /// Friction lags wherever it is steep in viscous steps, since steps without failed.
    lags: bool,
    /// True if measures without displacements are accurate enough.
    trusted: bool,
    /// No increment of the step has been tried yet.
    first: bool,
    /// Load factor of the last accepted state in its step.
    load_factor: f64,
    /// The largest norm that the forces have had [force].
    most: f64,
}

impl Search {
    /// The last accepted unknowns, and a multiple of their last change beyond.
    fn onwards(&self, ahead: f64) -> Vec<f64> {
        if ahead == 0.0 {
            return self.unknowns.clone();
        }
        let along = |(now, before): (&f64, &f64)| now + ahead * (now - before);
        self.unknowns.iter().zip(&self.before).map(along).collect()
    }

    /// Residuals count against what was carried at the last accepted increment at least, and a small part of the most that ever
    /// was: where the load is taken off there is nothing else.
    fn force_scale(&self) -> ForceScale {
        ForceScale { least: norm(&self.forces).max(AT_REST * self.most), most: self.most }
    }

    /// Takes unknowns, forces and viscous tractions of what is accepted; those before come back in their places.
    fn accept(&mut self, (unknowns, forces, viscous): &mut (Vec<f64>, Vec<Vec<f64>>, Vec<Vec<f64>>)) {
        std::mem::swap(&mut self.forces, forces);
        self.most = self.most.max(norm(&self.forces));
        std::mem::swap(&mut self.viscous, viscous);
        std::mem::swap(&mut self.before, &mut self.unknowns);
        std::mem::swap(&mut self.unknowns, unknowns);
    }
}

/// The norm of the forces of all interfaces.
fn norm(forces: &[Vec<f64>]) -> f64 {
    forces.iter().flatten().map(|force| force * force).sum::<f64>().sqrt()
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
pub(in crate::history) struct PathSearch<'a> {
    /// The step, and its loads.
    pub(in crate::history) step: &'a BoundStep,
    pub(in crate::history) ramp: &'a Ramp,
    /// Energy to dissipate; none: as far as the predicted change of the jumps.
    pub(in crate::history) amount: Option<f64>,
    /// The last change of unknowns and load factor is repeated this many times; zero: off the tangent.
    pub(in crate::history) ahead: f64,
    /// The last change of the load factor; off the tangent the first one.
    pub(in crate::history) last: f64,
}

/// Finds equilibria under one set of supports after the other.
pub(in crate::history) trait Engine {
    /// Makes ready for a set of supports. True if something was factored.
    fn support(&mut self, constrained: &[bool]) -> Result<bool, NotPositiveDefinite>;

    /// Prepares a step whose loads are affine in the load factor, so that increments can do without displacements.
    fn prepare(&mut self, ramp: Option<&Ramp>, measures: &[LinearMeasure]);

    /// True if the jumps of all interfaces are found without displacements, those of elastic ones too.
    fn finds_all_jumps(&self) -> bool {
        false
    }

    /// Equilibrium at a load factor, sought from the last accepted one and beyond it. Displacements are recovered if they are
    /// asked for (`complete`) or needed.
    fn solve(
        &mut self,
        state: &ModelState,
        load: &StepLoad,
        ahead: Ahead,
        complete: bool,
    ) -> Result<Converged, Failure>;

    /// A backward Euler step of interfaces with a viscosity, under a load, from the last accepted state.
    fn creep(
        &mut self,
        state: &ModelState,
        load: &StepLoad,
        viscous: Viscous,
        complete: bool,
    ) -> Result<Converged, Failure>;

    /// Error of what was found last, from the laws in the middle of the way there; none if nothing cracks, slides, opens or
    /// closes, so that the way is straight.
    fn estimate(&mut self, state: &ModelState, found: &Converged, way: Way) -> Option<Estimate>;

    /// True if small parts lead to what was found last too: points that crack in it after others have reached their strength
    /// (one linear system).
    fn is_reached(&mut self, state: &ModelState, found: &Converged, end: &StepLoad) -> bool;

    /// Fraction of the way to a load, from that of the last accepted state, at which the first intact point of a softening law
    /// reaches its strength; none if none does.
    fn onset(&mut self, state: &ModelState, load: &StepLoad, now: &StepLoad, ahead: f64) -> Option<f64>;

    /// Relative out-of-balance force of the last accepted state under a load, without any viscosity.
    fn imbalance(&self, state: &ModelState, load: &StepLoad) -> f64;

    /// Equilibrium further along a path from the last accepted one at `load_factor`, wherever its load factor is.
    fn follow(
        &mut self,
        state: &ModelState,
        load_factor: f64,
        path: &PathSearch,
    ) -> Result<(Converged, f64), Failure>;

    /// Displacements and reactions of the last accepted increment, if the engine goes without.
    fn recover(&self, load: &StepLoad) -> Option<NodalSolution>;

    /// State of the search, to be returned to.
    fn search(&self) -> Search;

    /// Returns to where the search stood.
    fn restore(&mut self, search: Search);

    /// State of the search before viscous steps, in which friction does not lag at first.
    fn begin_viscous(&mut self) -> Search;

    /// Accepts the last equilibrium found: the next search starts from it.
    fn accept(&mut self);
}

/// The error of a part of an increment.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::history) struct Estimate {
    /// Change of the tractions at its end, √(Σ w |Δt|²) [stress × √length].
    pub(in crate::history) traction: f64,
    /// Change of the energy dissipated in it [force × length].
    pub(in crate::history) dissipation: f64,
    /// Error of the trapezoidal rule for the work of the interfaces [force × length].
    pub(in crate::history) work: f64,
    /// The work of the interfaces in the part, added up by magnitude [force × length].
    pub(in crate::history) passed: f64,
    /// The same, added up by magnitude, over the work of the interfaces in the part.
    pub(in crate::history) bend: f64,
    /// Intact points of softening laws have cracked, and some of them after others.
    pub(in crate::history) cracked: bool,
    pub(in crate::history) late: bool,
}

/// The way of a part: load in its middle, and those of the step where its load factor was found along a path.
#[derive(Debug, Clone, Copy)]
pub(in crate::history) struct Way<'a> {
    pub(in crate::history) middle: &'a StepLoad<'a>,
    /// Load at its end.
    pub(in crate::history) end: &'a StepLoad<'a>,
    pub(in crate::history) ends: Option<&'a [StepLoad<'a>; 2]>,
}

/// Factors for a set of supports; true if something was factored anew.
type Make<'a, F> = Box<dyn FnMut(&[bool]) -> Result<(F, bool), NotPositiveDefinite> + 'a>;
