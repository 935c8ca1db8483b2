//! A viscous stretch and its steps.

use super::analysis::Analysis;
use super::converged::Converged;
use super::energy::{carried, change, moved};
use super::equilibrium::{Ahead, Failure, Viscous};
use super::loading::StepLoad;
use super::nowhere::is_nowhere;
use super::outcome::Outcome;
use super::progress::{LoadIncrement, StepProgress};
use crate::error::Result;
use crate::solver::Unconverged;

/// A step that changes more than this of what is carried is divided, unless it may change much.
const CHANGE: f64 = 0.3;
/// Least part of the most that was carried, for changes relative to it.
const LEAST_CARRIED: f64 = 0.2;
/// Law points that are named.
const NAMED: usize = 3;

/// A viscous stretch under way.
pub(super) struct ViscousStretch {
    pub(super) from: f64,
    /// Load factor and energy released after every step.
    pub(super) work: Vec<(f64, f64)>,
    /// Viscous work per area at the law points of every interface.
    pub(super) at: Vec<Vec<f64>>,
    /// The part of it that open points do as they close.
    pub(super) closing: f64,
    pub(super) iterations: usize,
}

/// The motion of a viscous step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    pub(super) iterations: usize,
    /// √(Σ w |Δr|²), and that of open points that close.
    pub(super) moved: f64,
    pub(super) closing: f64,
    /// c times the first, and that of what is carried.
    pub(super) pull: f64,
    pub(super) pulled: f64,
    /// It is no larger than what is prescribed makes it.
    pub(super) driven: bool,
    /// Change of what is carried, and the bend of the tractions of interfaces that dilate, of it.
    pub(super) change: f64,
    pub(super) bend: f64,
}

impl ViscousStretch {
    /// The law points that do most of the viscous work.
    pub(super) fn worst(&self) -> Vec<(usize, usize)> {
        let mut all: Vec<(f64, usize, usize)> = Vec::new();
        for (k, of) in self.at.iter().enumerate() {
            all.extend(of.iter().enumerate().map(|(p, work)| (*work, k, p)));
        }
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all.iter().take(NAMED).map(|&(_, k, p)| (k, p)).collect()
    }
}

/// A viscous step to a load factor, kept if it changes little or may change much.
pub(super) fn creep(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    to: f64,
    viscous: Viscous,
    limited: bool,
    stretch: &mut ViscousStretch,
) -> Result<Outcome<Motion>> {
    let load = leg.start.at(to)?;
    let now = carried(analysis.problem, &analysis.state.snapshot).sqrt();
    at.most = at.most.max(now);
    let scale = now.max(LEAST_CARRIED * at.most);
    let too_far = |reason: &str| Unconverged { reason: reason.into(), worst: Vec::new(), iterations: 0 };
    let found = match analysis.engine.creep(&analysis.state, &load, viscous, true) {
        Ok(found) => found,
        Err(Failure::Unconverged(why)) => {
            stretch.iterations += why.iterations;
            analysis.totals.rejected += 1;
            return Ok(Outcome::Retry(why));
        }
        Err(Failure::Unusable(_)) => return Ok(Outcome::Retry(too_far("numbers overflowed"))),
    };
    let iterations = found.iterations;
    stretch.iterations += iterations + found.wasted;
    let change = change(analysis.problem, &analysis.state.snapshot, &found).sqrt();
    if limited && change > CHANGE * scale {
        analysis.totals.rejected += 1;
        return Ok(Outcome::Retry(too_far("the tractions change too much")));
    }
    let [moved, closing] = moved(analysis.problem, &analysis.state.snapshot, &found);
    let driven = moved <= driven(analysis, leg, &load);
    let bend = found.bend / scale.max(f64::MIN_POSITIVE);
    take_viscous(analysis, found, load, stretch);
    let (pull, change) = (viscous.viscosity * moved, change / scale.max(f64::MIN_POSITIVE));
    let pulled = pull / scale.max(f64::MIN_POSITIVE);
    Ok(Outcome::Converged(Motion { iterations, moved, closing, pull, pulled, driven, change, bend }))
}

/// √(Σ w |Δr|²) of interfaces that move twice as far as what is prescribed.
fn driven(analysis: &Analysis, leg: &LoadIncrement, load: &StepLoad) -> f64 {
    let ways = load.forces().prescribed.iter().zip(&analysis.state.snapshot.u).zip(&leg.step.constrained);
    let most =
        ways.filter(|(_, constrained)| **constrained).map(|((a, b), _)| (a - b).abs()).fold(0.0, f64::max);
    let interfaces =
        analysis.problem.model.interfaces.iter().flat_map(|interface| &interface.coupling.points);
    2.0 * most * interfaces.map(|point| point.weight).sum::<f64>().sqrt()
}

fn take_viscous(analysis: &mut Analysis, found: Converged, load: StepLoad, stretch: &mut ViscousStretch) {
    let load_factor = load.load_factor;
    for of in &found.interfaces {
        let states = &analysis.state.snapshot.states[of.interface];
        let points = &analysis.problem.model.interfaces[of.interface].coupling.points;
        for (p, (old, new)) in states.iter().zip(&of.memory).enumerate() {
            let moved = new.state.jump - old.jump;
            let work = new.viscous[0] * moved.x + new.viscous[1] * moved.y + new.released;
            stretch.at[of.interface][p] += work;
            if old.traction.x == 0.0 && old.traction.y == 0.0 && moved.x < 0.0 {
                stretch.closing += analysis.problem.model.thickness * points[p].weight * work;
            }
        }
    }
    analysis.engine.accept();
    analysis.state.accept(analysis.problem, found, load);
    analysis.totals.parts += 1;
    stretch.work.push((load_factor, analysis.state.released));
}

/// The equilibrium of the laws alone at the load reached, if there is one near.
pub(super) fn by_laws_alone(
    analysis: &mut Analysis,
    leg: &LoadIncrement,
    at: &mut StepProgress,
    stretch: &mut ViscousStretch,
) -> Result<bool> {
    let load = leg.start.at(at.load_factor)?;
    match analysis.engine.solve(&analysis.state, &load, Ahead::default(), leg.complete) {
        Ok(found) if is_nowhere(&found, [&load, &load], analysis) => {
            stretch.iterations += found.iterations;
            Ok(false)
        }
        Ok(found) => {
            stretch.iterations += found.iterations;
            take_viscous(analysis, found, load, stretch);
            (at.last, at.fresh) = (f64::INFINITY, true);
            Ok(true)
        }
        Err(Failure::Unconverged(why)) => {
            stretch.iterations += why.iterations;
            Ok(false)
        }
        Err(Failure::Unusable(_)) => Ok(false),
    }
}
