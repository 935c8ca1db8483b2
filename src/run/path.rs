//! A step along the path of equilibria: by load level while nothing dissipates, by dissipated energy while something does;
//! or by the change of the jumps throughout (`arclength`).
//!
//! No number is set by hand. The first step beyond the sound state dissipates a small part of the elastic energy that is
//! stored then; later ones as much more or less as iterations allow, with no more change of the load level than the step's
//! increments have, until the load level reaches its end for good.

use super::course::Course;
use super::engine::{Failure, Path};
use super::loading::Start;
use super::march::Place;
use super::state::{Found, State};
use crate::error::Result;
use crate::problem::Stage;
use crate::scene::Control;
use crate::solver::{Ramp, Unconverged};

/// The first step on the path dissipates this part of the elastic energy.
const FIRST: f64 = 1e-2;
/// Iterations of a step that is neither too small nor too large.
pub(super) const USUAL: f64 = 5.0;
/// A step that fails is tried again with this part of its energy, at most so many times.
pub(super) const SMALLER: f64 = 0.25;
pub(super) const SMALLEST: usize = 20;
/// A step on the path goes at most this many increments far: in the load level, and in what the joints carry, of which
/// `TRACTIONS` times an increment's part may change.
pub(super) const WIDE: f64 = 2.0;
pub(super) const TRACTIONS: f64 = 4.0;
/// An increment of the load level that dissipates more than so many times what the last one makes expect has leapt to another
/// branch.
const LEAP: f64 = 4.0;
/// The first increment that dissipates is divided down to this part, to begin where it does.
const LEAST: f64 = 1e-3;
/// Widths of the increment in which the joints are let go that are tried.
const TRIES: usize = 5;
/// Joints that carry less than this part of the most that they have carried are exhausted.
const EXHAUSTED: f64 = 1e-4;
/// Most increments per increment of the scene.
const MOST: usize = 1000;

/// Iterations of a step, or why there is none.
pub(super) type Step = std::result::Result<usize, Unconverged>;

/// Where the path stands.
pub(super) struct Standing {
    pub(super) level: f64,
    /// The last change of the load level, and the energy that it dissipated.
    pub(super) change: f64,
    spent: f64,
    /// Energy of the next step.
    amount: f64,
    /// Length of the next step, of the last one.
    pub(super) ratio: f64,
    /// The most that the joints have carried, as `State::carried`.
    most: f64,
    /// Part of an increment by which the next leap goes on.
    width: f64,
}

impl<'a> Course<'a, '_> {
    /// A step on the path.
    pub(super) fn path_step(&mut self, step: usize, stage: &'a Stage, start: &Start) -> Result<()> {
        let Some(ramp) = start.ramp()? else { return Ok(()) }; // the scene's door has refused it
        self.stage("prepare");
        self.engine.prepare(Some(&ramp), &[]);
        self.state.open(None);
        let part = 1.0 / stage.increments as f64;
        let mut at = Standing {
            level: 0.0,
            change: 0.0,
            spent: 0.0,
            amount: 0.0,
            ratio: 1.0,
            most: 0.0,
            width: LEAST,
        };
        let mut rising = 0.0;
        let mut passed = [(self.state.dissipated, 0.0); 3];
        for number in 1..=MOST * stage.increments {
            self.stage("solve");
            let before = at.level;
            at.most = at.most.max(self.state.carried(self.problem));
            let found = match stage.control {
                Control::Arclength => self.arc(start, &ramp, &mut at, part),
                _ if at.spent > 0.0 => self.along(start, &ramp, &mut at, part),
                _ => self.sound(start, &ramp, &mut at, part),
            };
            let iterations = match found? {
                Ok(iterations) => iterations,
                Err(why) => match self.let_go(start, &mut at, stage, part)? {
                    Some(iterations) => iterations,
                    None => {
                        let place = Place { number, load_factor: at.level, ..self.place(step, stage) };
                        return self.stop(place, start, &why);
                    }
                },
            };
            passed = [passed[1], passed[2], (self.state.dissipated, at.level)];
            if rising * (at.level - before) < 0.0 {
                self.totals.turns.push((self.totals.increments, stage.name.clone(), vertex(passed)));
            }
            rising = at.level - before;
            let last = at.level >= 1.0;
            self.row(Place { number, load_factor: at.level, iterations, last, ..self.place(step, stage) })?;
            if last {
                return Ok(());
            }
        }
        let why = Unconverged {
            reason: "the path does not reach its end".into(),
            worst: Vec::new(),
            iterations: 0,
        };
        let number = MOST * stage.increments;
        let place = Place { number, load_factor: at.level, ..self.place(step, stage) };
        self.stop(place, start, &why)
    }

    /// An increment of the load level if nothing dissipates in it; else a first step on the path.
    fn sound(&mut self, start: &Start, ramp: &Ramp, at: &mut Standing, part: f64) -> Result<Step> {
        let reached = if at.level + 1.001 * part >= 1.0 { 1.0 } else { at.level + part };
        if let Some(iterations) = self.by_load(start, at, reached, 0.0)? {
            return Ok(Ok(iterations));
        }
        // up to where something begins to dissipate: what follows is compared with the state there
        let (begin, mut width, mut all) = (at.level, part, 0);
        while width > LEAST * part {
            width *= 0.5;
            all += self.by_load(start, at, at.level + width, 0.0)?.unwrap_or(0);
        }
        if at.level - begin > 2.0 * LEAST * part {
            return Ok(Ok(all));
        }
        let mut amount = FIRST * self.state.stored;
        let mut why = Unconverged { reason: "nothing to go on".into(), worst: Vec::new(), iterations: 0 };
        for _ in 0..SMALLEST {
            let path = Path { ramp, amount: Some(amount), ahead: 0.0, last: 0.0 };
            match self.engine.follow(&self.state, at.level, &path) {
                Ok((found, level)) if self.far(at, &found) <= WIDE * TRACTIONS * part => {
                    return self.take(start, found, at, level, amount).map(Ok);
                }
                Ok(_) => {}
                Err(Failure::Unconverged(failed)) => why = failed,
                Err(Failure::Unusable(_)) => {}
            }
            amount *= SMALLER;
        }
        Ok(Err(why))
    }

    /// The next step on the path, ending at the end of the load exactly.
    fn along(&mut self, start: &Start, ramp: &Ramp, at: &mut Standing, part: f64) -> Result<Step> {
        if at.change > 0.0 {
            // the path rises: the load level may lead, as long as it jumps to no other branch
            let reached = if at.level + 1.001 * part >= 1.0 { 1.0 } else { at.level + part };
            let expected = at.spent * (reached - at.level) / at.change;
            if let Some(iterations) = self.by_load(start, at, reached, LEAP * expected)? {
                return Ok(Ok(iterations));
            }
        }
        let mut amount = at.amount;
        let mut why = Unconverged { reason: "the path ends".into(), worst: Vec::new(), iterations: 0 };
        for _ in 0..SMALLEST {
            let path = Path { ramp, amount: Some(amount), ahead: amount / at.spent, last: at.change };
            match self.engine.follow(&self.state, at.level, &path) {
                Ok((found, level)) if level < 1.0 => {
                    // how far this goes, in increments of the scene
                    let far = (level - at.level).abs() / part;
                    let far = far.max(self.far(at, &found) / (TRACTIONS * part));
                    if far <= WIDE {
                        let iterations = found.iterations;
                        let easier = (USUAL / iterations as f64).sqrt().clamp(0.5, 2.0);
                        self.take(start, found, at, level, amount)?;
                        at.amount = amount * easier.min(1.0 / far);
                        return Ok(Ok(iterations));
                    }
                }
                Ok((_, level)) if level >= 1.0 => {
                    if let Some(iterations) = self.by_load(start, at, 1.0, amount)? {
                        return Ok(Ok(iterations));
                    }
                }
                Err(Failure::Unconverged(failed)) => {
                    why = failed;
                    self.totals.halved += 1;
                }
                Ok(_) | Err(Failure::Unusable(_)) => {}
            }
            amount *= SMALLER;
        }
        Ok(Err(why))
    }

    /// From where no step along the path is found to a stable equilibrium at a load level a little above, by letting the
    /// joints go. That is a leap if it releases energy.
    fn let_go(
        &mut self,
        start: &Start,
        at: &mut Standing,
        stage: &Stage,
        part: f64,
    ) -> Result<Option<usize>> {
        for _ in 0..TRIES {
            let level = (at.level + at.width * part).min(1.0);
            let Ok(found) = self.engine.relax(&self.state, &start.at(level)?, true) else {
                at.width *= SMALLER;
                continue;
            };
            let leaps = self.leaps(&found);
            let spent = if leaps { 0.0 } else { State::dissipation(self.problem, &found) };
            let iterations = self.take(start, found, at, level, spent)?;
            if leaps {
                self.leapt(stage, level);
                (at.change, at.width) = (0.0, LEAST);
            } else {
                at.width = (2.0 * at.width).min(1.0);
            }
            return Ok(Some(iterations));
        }
        Ok(None)
    }

    /// Change of what the joints carry, relative to what they carry now; of exhausted joints, to a small part of the most.
    pub(super) fn far(&self, at: &Standing, found: &Found) -> f64 {
        let carried = self.state.carried(self.problem).max(EXHAUSTED * EXHAUSTED * at.most);
        let change = self.state.change(self.problem, found);
        if change == 0.0 { 0.0 } else { (change / carried).sqrt() }
    }

    /// An increment to a load level if it has an equilibrium that dissipates no more than an amount.
    pub(super) fn by_load(
        &mut self,
        start: &Start,
        at: &mut Standing,
        level: f64,
        amount: f64,
    ) -> Result<Option<usize>> {
        let load = start.at(level)?;
        let ahead = if at.change > 0.0 { (level - at.level) / at.change } else { 0.0 };
        let Ok(found) = self.engine.solve(&self.state, &load, ahead, true) else { return Ok(None) };
        let spent = State::dissipation(self.problem, &found);
        if spent > amount {
            return Ok(None);
        }
        self.take(start, found, at, level, spent).map(Some)
    }

    /// Accepts what was found at a load level. Returns its iterations.
    pub(super) fn take(
        &mut self,
        start: &Start,
        found: Found,
        at: &mut Standing,
        level: f64,
        spent: f64,
    ) -> Result<usize> {
        let iterations = found.iterations;
        self.engine.accept();
        self.state.accept(self.problem, found, start.at(level)?);
        (at.change, at.level, at.spent) = (level - at.level, level, spent);
        if spent > 0.0 {
            at.amount = spent;
        }
        Ok(iterations)
    }
}

/// Extreme load level of the parabola through three points (dissipated energy, load level); the middle one's where there is
/// none, or where the path has a corner: a parabola would be far off.
fn vertex([(d0, l0), (d1, l1), (d2, l2)]: [(f64, f64); 3]) -> f64 {
    let (before, after) = ((l1 - l0) / (d1 - d0), (l2 - l1) / (d2 - d1));
    let curvature = (after - before) / (d2 - d0);
    let slope = before + curvature * (d1 - d0);
    let beyond = -slope * slope / (4.0 * curvature);
    let near = beyond.abs() <= 0.25 * (l1 - l0).abs().max((l2 - l1).abs());
    if near { l1 + beyond } else { l1 }
}
