//! An increment of the load factor in as many parts as its accuracy asks for.
//!
//! ```text
//! exact      Newton's method with the laws as they are; the error of the part is estimated (`estimate`)
//!              │ above path_tolerance: a smaller part
//!              ▼ not found in a few tries, or no smaller part is better
//! viscous    the load goes on while a viscosity holds the jumps (`viscous`), until the laws alone hold them again
//! ```
//!
//! A part that is kept is an equilibrium of the laws, and so is the end of every increment.

use super::course::Course;
use super::equilibrium::estimate::{Estimate, Way};
use super::equilibrium::{Ahead, Failure};
use super::failure::unusable;
use super::loading::Start;
use super::march::Snap;
use super::snap::{NOTHING, TOLD};
use super::state::{Found, State};
use crate::error::Result;
use crate::problem::Stage;
use crate::solver::Unconverged;

/// A part that is not found is tried again with this share of it, at most so many times.
const NARROWER: f64 = 0.25;
const TRIES: usize = 2;
/// The smallest part that is tried for its accuracy, of an increment.
const SMALLEST: f64 = 5e-4;
/// A new part aims at this share of the tolerance, and changes its size by these factors at most.
const SAFETY: f64 = 0.8;
const SHRINK: f64 = 0.05;
const GROW: f64 = 4.0;
/// A part found in at most so many iterations may be followed by a larger one.
const EASY: usize = 8;
/// Share of the tolerance above which the bend of a part with late cracks asks for the check of late points, and the error over
/// the tolerance of a part that fails it.
const SUSPECT: f64 = 1.0;
const UNREACHED: f64 = 10.0;
/// Weight of the trapezoidal rule's error of a part: these add up over an increment.
const SUMS: f64 = 3.0;
/// Their sum over a step stays below so many times the tolerance: a part may have this share of what is left of that.
const BUDGET: f64 = 4.5;
const SHARE: f64 = 0.25;
/// Smallest scale of the tractions [stress × √length].
const FLOOR: f64 = 1e-12;

/// One increment of a step.
pub(super) struct Leg<'a, 'b> {
    pub(super) start: &'b Start<'a>,
    pub(super) stage: &'b Stage,
    /// Number within its step.
    pub(super) number: usize,
    /// Load factor at its end.
    pub(super) goal: f64,
    /// Share of an increment in its step.
    pub(super) part: f64,
    /// Displacements are recovered at its end.
    pub(super) complete: bool,
}

/// Where a step stands.
#[derive(Debug, Clone)]
pub(super) struct Progress {
    /// Load factor.
    pub(super) level: f64,
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

impl Progress {
    /// At the start of a step whose increments are `part` of it.
    pub(super) fn new(part: f64) -> Progress {
        Progress {
            level: 0.0,
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

/// Iterations, or why there is no equilibrium.
pub(super) type Went = std::result::Result<usize, Unconverged>;

impl Course<'_, '_> {
    /// Goes on to the end of an increment.
    pub(super) fn advance(&mut self, leg: &Leg, at: &mut Progress) -> Result<Went> {
        let (mut iterations, mut failed, mut cut) = (0, 0, false);
        while at.level < leg.goal {
            let from = at.level;
            let to = if from + 1.001 * at.width >= leg.goal { leg.goal } else { from + at.width };
            let load = leg.start.at(to)?;
            at.most = at.most.max(self.state.carried(self.problem).sqrt());
            let ahead = Ahead { changes: (to - from) / at.last, near: at.onset };
            let narrower = match self.engine.solve(&self.state, &load, ahead, leg.complete) {
                Ok(found) => {
                    iterations += found.iterations;
                    let Judged { error, cracked, solved, passed, work } =
                        self.judge(leg.start, [at.most, at.energy, at.summed], [from, to], &found, false)?;
                    iterations += solved;
                    at.energy = at.energy.max(passed);
                    if error <= 1.0 {
                        at.width = match found.iterations <= EASY {
                            true => (to - from) * (SAFETY / error.sqrt()).clamp(1.0, GROW),
                            false => to - from,
                        };
                        at.width = if error == 0.0 { leg.part } else { at.width.min(leg.part) };
                        (at.last, at.level, at.fresh, at.patience) = (to - from, to, false, 4);
                        (at.onset, cut, failed) = (cut, false, 0);
                        self.totals.parts += 1;
                        at.summed += work;
                        self.tell_drop(leg, at.energy, [from, to], &found);
                        self.engine.accept();
                        self.state.accept(self.problem, found, load);
                        continue;
                    }
                    let narrower = (to - from) * (SAFETY / error.sqrt()).clamp(SHRINK, 0.5);
                    let onset = if cracked { self.onset(leg.start, [from, to], at.last)? } else { None };
                    cut = onset.is_some();
                    onset.unwrap_or(narrower)
                }
                Err(Failure::Unconverged(why)) => {
                    iterations += why.iterations;
                    failed += 1;
                    NARROWER * (to - from)
                }
                Err(Failure::Unusable(error)) => {
                    return Err(unusable(leg.stage, leg.number, self.totals.increments, error));
                }
            };
            self.totals.rejected += 1;
            if failed <= TRIES && narrower >= SMALLEST * leg.part && !at.fresh {
                at.width = narrower;
                continue;
            }
            failed = 0;
            match self.viscous(leg, at, to - from)? {
                Ok(more) => iterations += more,
                Err(why) => return Ok(Err(Unconverged { iterations: iterations + why.iterations, ..why })),
            }
        }
        Ok(Ok(iterations))
    }

    /// Tells energy that is lost at once in a part, where a traction drops, as a snap.
    fn tell_drop(&mut self, leg: &Leg, energy: f64, [from, to]: [f64; 2], found: &Found) {
        let (mut released, mut most) = (0.0, (0.0, (0, 0)));
        for of in &found.joints {
            let points = &self.problem.model.joints[of.joint].coupling.points;
            for (p, (point, answer)) in points.iter().zip(&of.memory).enumerate() {
                released += self.problem.model.thickness * point.weight * answer.released;
                if answer.released > most.0 {
                    most = (answer.released, (of.joint, p));
                }
            }
        }
        if released <= (TOLD * self.state.dissipated).max(NOTHING * energy.max(self.state.largest_energy())) {
            return;
        }
        let (interface, at) = self.place_of(&[most.1]);
        let (increment, step) = (self.totals.increments + 1, leg.stage.name.clone());
        let between = [from, to];
        self.totals.snaps.push(Snap { increment, step, load_factor: to, between, interface, at, released });
    }

    /// Share of a part up to the first point that cracks in it.
    fn onset(&mut self, start: &Start, [from, to]: [f64; 2], last: f64) -> Result<Option<f64>> {
        let (now, load) = (start.at(from)?, start.at(to)?);
        let fraction = self.engine.onset(&self.state, &load, &now, (to - from) / last);
        Ok(fraction.map(|fraction| fraction * (to - from)).filter(|width| *width < 0.99 * (to - from)))
    }

    /// Error of what was found between two load factors, over the tolerance; 0 if the way there is straight, or any will do. `follows`: the
    /// load factor was found along a path. The most that was carried, the largest energy of what was sought and the errors of work so far count too.
    pub(super) fn judge(
        &mut self,
        start: &Start,
        [most, energy, summed]: [f64; 3],
        [from, to]: [f64; 2],
        found: &Found,
        follows: bool,
    ) -> Result<Judged> {
        if self.problem.solution.path_tolerance >= 1.0 {
            return Ok(Judged { error: 0.0, cracked: false, solved: 0, passed: 0.0, work: 0.0 });
        }
        let [middle, end] = [start.at(0.5 * (from + to))?, start.at(to)?];
        let step = if follows { Some([start.at(0.0)?, start.at(1.0)?]) } else { None };
        let way = Way { middle: &middle, step: step.as_ref() };
        let Some(estimate) = self.engine.estimate(&self.state, found, way) else {
            return Ok(Judged { error: 0.0, cracked: false, solved: 0, passed: 0.0, work: 0.0 });
        };
        let Estimate { traction, dissipation, work, passed, bend, cracked, late } = estimate;
        let tolerance = self.problem.solution.path_tolerance;
        let spent = State::dissipation(self.problem, found);
        let carried = most.max(self.state.carried_after(self.problem, found).sqrt()).max(FLOOR);
        let so_far = self.state.largest_energy().max(self.state.dissipated + spent);
        let energy = energy.max(passed).max(so_far).max(f64::MIN_POSITIVE);
        let energies = dissipation.abs().max(SUMS * work.abs()) / energy;
        let left = (BUDGET * tolerance * energy - summed).max(f64::MIN_POSITIVE);
        let mut error = ((traction / carried).max(energies) / tolerance).max(work.abs() / (SHARE * left));
        let mut solved = 0;
        if late && error <= 1.0 && bend > SUSPECT * tolerance {
            solved = 1;
            if !self.engine.is_reached(&self.state, found, &end) {
                error = error.max(UNREACHED);
            }
        }
        Ok(Judged { error, cracked, solved, passed, work: work.abs() })
    }
}

/// What a part is worth.
pub(super) struct Judged {
    /// Its error over the tolerance.
    pub(super) error: f64,
    /// Intact points of softening laws have cracked in it.
    pub(super) cracked: bool,
    /// Linear systems solved to know.
    pub(super) solved: usize,
    /// Work of the interfaces in it, added up by magnitude [force × length].
    passed: f64,
    /// Error of their work by the trapezoidal rule [force × length].
    work: f64,
}
