//! A step along the path of equilibria: by load level while nothing dissipates, by dissipated energy while something does;
//! or by the change of the jumps throughout (`arclength`).
//!
//! No number is set by hand. The first step beyond the sound state dissipates a small part of the elastic energy that is
//! stored then; later ones as much more or less as iterations allow, with no more change of the load level than the step's
//! increments have, until the load level reaches its end for good.

use super::course::Course;
use super::equilibrium::{Ahead, Failure, Path};
use super::loading::Start;
use super::march::Place;
use super::parts::{Judged, Leg, Progress};
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
/// The first increment that dissipates is divided down to this part, to begin where it does.
const LEAST: f64 = 1e-3;
/// Joints that carry less than this part of the most that they have carried are exhausted.
const EXHAUSTED: f64 = 1e-4;
/// A row by the load factor dissipates at most so many times what the last one makes expect, so that rows follow the path closely.
const ROWS: f64 = 4.0;
/// Sizes of a part by the load factor that are tried where the path rises, unless its error is so many times the tolerance.
const RISING: usize = 2;
const PATIENCE: usize = 16;
const FAR_OFF: f64 = 100.0;
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
    pub(super) most: f64,
    /// Size of the next part by the load factor.
    width: f64,
    /// Steps along the path before the load factor is tried again, now and after the next failure.
    wait: usize,
    patience: usize,
    /// Iterations of searches that were not kept.
    pub(super) tried: usize,
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
            width: part,
            wait: 0,
            patience: 1,
            tried: 0,
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
            let tried = std::mem::take(&mut at.tried);
            let iterations = tried
                + match found? {
                    Ok(iterations) => iterations,
                    Err(_) => match self.go_on(start, &mut at, stage, part)? {
                        Ok(iterations) => iterations,
                        Err(why) => {
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
        if let Ok((iterations, _)) = self.by_load(start, at, reached, 0.0)? {
            return Ok(Ok(iterations));
        }
        // up to where something begins to dissipate: what follows is compared with the state there
        let (begin, mut width, mut all) = (at.level, part, 0);
        while width > LEAST * part {
            width *= 0.5;
            all += self.by_load(start, at, at.level + width, 0.0)?.map_or(0, |(iterations, _)| iterations);
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
                    let judged =
                        self.judge(start, [at.most.sqrt(), 0.0, 0.0], [at.level, level], &found, true)?;
                    at.tried += judged.solved;
                    if judged.error > 1.0 {
                        at.tried += found.iterations;
                        self.totals.rejected += 1;
                        amount *= SMALLER;
                        continue;
                    }
                    return self.take(start, found, at, level, amount).map(Ok);
                }
                Ok(_) => {}
                Err(Failure::Unconverged(failed)) => {
                    at.tried += failed.iterations;
                    why = failed;
                }
                Err(Failure::Unusable(_)) => {}
            }
            amount *= SMALLER;
        }
        Ok(Err(why))
    }

    /// The next step on the path, ending at the end of the load exactly.
    fn along(&mut self, start: &Start, ramp: &Ramp, at: &mut Standing, part: f64) -> Result<Step> {
        at.wait = at.wait.max(1) - 1;
        if at.change > 0.0 && at.wait == 0 {
            // the path rises: the load factor may lead, as long as it leads along the path
            at.patience = (2 * at.patience).min(PATIENCE);
            at.wait = at.patience;
            for _ in 0..RISING {
                let width = at.width.min(part);
                let reached = if at.level + 1.001 * width >= 1.0 { 1.0 } else { at.level + width };
                let expected = at.spent * (reached - at.level) / at.change;
                match self.by_load(start, at, reached, ROWS * expected)? {
                    Ok((iterations, error)) => {
                        at.width = (width * (0.8 / error.sqrt()).clamp(1.0, 4.0)).min(part);
                        (at.patience, at.wait) = (1, 0);
                        return Ok(Ok(iterations));
                    }
                    Err(error) if error < FAR_OFF => at.width = width * (0.8 / error.sqrt()).min(0.5),
                    Err(_) => break,
                }
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
                    let Judged { error, .. } =
                        self.judge(start, [at.most.sqrt(), 0.0, 0.0], [at.level, level], &found, true)?;
                    if far <= WIDE && error <= 1.0 {
                        let iterations = found.iterations;
                        let easier = (USUAL / iterations as f64).sqrt().clamp(0.5, 2.0);
                        self.take(start, found, at, level, amount)?;
                        at.amount = amount * easier.min(1.0 / far).min((1.0 / error).sqrt());
                        return Ok(Ok(iterations));
                    }
                    at.tried += found.iterations;
                    self.totals.rejected += 1;
                    if far <= WIDE && error < FAR_OFF {
                        amount *= (0.8 / error.sqrt()).min(0.5) / SMALLER;
                    }
                }
                Ok((_, level)) if level >= 1.0 => {
                    if let Ok((iterations, _)) = self.by_load(start, at, 1.0, f64::INFINITY)? {
                        return Ok(Ok(iterations));
                    }
                }
                Err(Failure::Unconverged(failed)) => {
                    at.tried += failed.iterations;
                    why = failed;
                    self.totals.rejected += 1;
                }
                Ok(_) | Err(Failure::Unusable(_)) => {}
            }
            amount *= SMALLER;
        }
        Ok(Err(why))
    }

    /// From where no step along the path is found to an equilibrium an increment of the load factor further at most: the load
    /// goes on while a viscosity holds the jumps.
    fn go_on(&mut self, start: &Start, at: &mut Standing, stage: &Stage, part: f64) -> Result<Step> {
        let goal = (at.level + part).min(1.0);
        let leg = Leg { start, stage, number: 0, goal, part, complete: true };
        let mut progress = Progress { level: at.level, most: at.most.sqrt(), ..Progress::new(part) };
        let went = self.viscous(&leg, &mut progress, part)?;
        if went.is_ok() {
            (at.level, at.change, at.spent) = (progress.level, 0.0, 0.0);
        }
        Ok(went)
    }

    /// Change of what the joints carry, relative to what they carry now; of exhausted joints, to a small part of the most.
    pub(super) fn far(&self, at: &Standing, found: &Found) -> f64 {
        let carried = self.state.carried(self.problem).max(EXHAUSTED * EXHAUSTED * at.most);
        let change = self.state.change(self.problem, found);
        if change == 0.0 { 0.0 } else { (change / carried).sqrt() }
    }

    /// An increment to a load factor if it has an equilibrium that dissipates no more than an amount: iterations and error over
    /// the tolerance, or the error of what was not kept.
    pub(super) fn by_load(
        &mut self,
        start: &Start,
        at: &mut Standing,
        level: f64,
        amount: f64,
    ) -> Result<std::result::Result<(usize, f64), f64>> {
        let load = start.at(level)?;
        let ahead = if at.change > 0.0 { (level - at.level) / at.change } else { 0.0 };
        let ahead = Ahead { changes: ahead, near: false };
        let found = match self.engine.solve(&self.state, &load, ahead, true) {
            Ok(found) => found,
            Err(failure) => {
                if let Failure::Unconverged(why) = failure {
                    at.tried += why.iterations;
                }
                self.totals.rejected += 1;
                return Ok(Err(f64::INFINITY));
            }
        };
        let spent = State::dissipation(self.problem, &found);
        let judged = self.judge(start, [at.most.sqrt(), 0.0, 0.0], [at.level, level], &found, false)?;
        at.tried += judged.solved;
        if spent > amount || judged.error > 1.0 {
            at.tried += found.iterations;
            self.totals.rejected += 1;
            return Ok(Err(if spent > amount { f64::INFINITY } else { judged.error }));
        }
        let iterations = self.take(start, found, at, level, spent)?;
        Ok(Ok((iterations, judged.error)))
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
        self.totals.parts += 1;
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
