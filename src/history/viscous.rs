//! Where no equilibrium continues the path: the load goes on while a viscosity holds the jumps back.
//!
//! ```text
//! A(x) + q(r) + G c (r − r₀) = b(λ)        c = η / Δλ, then r₀ ← r, and the states of the laws with it
//! rest: λ is held, and c falls until the laws hold the jumps alone
//! ```
//!
//! Every step is a backward Euler step in the load factor as time, with the viscosity η. Where the path goes on, the jumps
//! follow it and the viscous tractions are small; where it has ended, steps get short by themselves and lead to the next stable
//! equilibrium. Friction lags by a step where its slope has no bound (`law::lagged`), so that a step has one answer as
//! soon as c is above the softening. A stretch ends with an equilibrium of the laws alone.

use super::course::Course;
use super::equilibrium::{Ahead, Failure, Viscous};
use super::loading::Load;
use super::parts::{Leg, Progress, Went};
use super::state::Found;
use crate::error::Result;
use crate::solver::Unconverged;

/// η of a whole step, of the steepest softening; where nothing softens, of the stiffness.
const VISCOSITY: f64 = 3e-6;
const WITHOUT_SOFTENING: f64 = 1e-7;
/// First viscous step, of the part that was not found.
const FIRST: f64 = 0.1;
/// Longest viscous step, of a step.
const LONGEST: f64 = 1.0 / 200.0;
/// The longest steps leave the viscosity at most this part of what is carried: it falls where jumps are large.
const SLIGHT: f64 = 1e-3;
/// A step that changes more than this of what is carried is divided, unless c is above this part of the stiffness.
const CHANGE: f64 = 0.3;
const STIFF: f64 = 0.1;
/// The tractions of joints that dilate may bend by so many times the tolerance of the path in a step, of what is carried.
const BEND: f64 = 2.0;
/// Factor between steps, and the iterations of one that is found with ease.
const FACTOR: f64 = 3.0;
const EASY: usize = 6;
const USUAL: usize = 12;
/// Largest c, of the stiffness.
const MOST: f64 = 1e4;
/// What is carried counts at least by this part of the most.
const LEAST_CARRIED: f64 = 0.2;
/// Out-of-balance force below which the laws alone are asked; where it is so small, at once.
const NEAR: f64 = 1e-3;
const VERY_NEAR: f64 = 1e-6;
/// A viscosity that pulls at less than this part of the tolerance is none; what is left then is rounding, if it is so small.
const GONE: f64 = 1e-3;
const ROUNDED: f64 = 1e-8;
/// Most steps of a rest.
const STEPS: usize = 400;
/// A force and tractions that change by less than this part are the same; where at least this part of the motion closes,
/// something may come to hold it.
const SAME: f64 = 1e-3;
const CLOSES: f64 = 0.1;
/// Steps in a row under the same force, and iterations of them, after which nothing will hold.
const FREE: usize = 3;
const FREE_ITERATIONS: usize = 20;
/// Law points that are named.
const NAMED: usize = 3;

/// A viscous stretch under way.
pub(super) struct Stretch {
    pub(super) from: f64,
    /// Load factor and energy released after every step.
    pub(super) work: Vec<(f64, f64)>,
    /// Viscous work per area at the law points of every interface.
    at: Vec<Vec<f64>>,
    /// The part of it that open points do as they close.
    pub(super) closing: f64,
    iterations: usize,
}

/// The motion of a viscous step.
#[derive(Debug, Clone, Copy)]
struct Motion {
    iterations: usize,
    /// √(Σ w |Δr|²), and that of open points that close.
    moved: f64,
    closing: f64,
    /// c times the first, and that of what is carried.
    pull: f64,
    pulled: f64,
    /// It is no larger than what is prescribed makes it.
    driven: bool,
    /// Change of what is carried, and the bend of the tractions of joints that dilate, of it.
    change: f64,
    bend: f64,
}

impl Course<'_, '_> {
    /// Goes on from where a part of some width is not found, to an equilibrium of the laws at most at the increment's end.
    pub(super) fn viscous(&mut self, leg: &Leg, at: &mut Progress, width: f64) -> Result<Went> {
        let mut kept = self.state.clone();
        kept.complete(self.problem, self.engine, leg.start.at(at.level)?);
        self.engine.keep();
        let level = at.level;
        let released = self.state.released;
        let at_points = self.state.snapshot.states.iter().map(|states| vec![0.0; states.len()]).collect();
        let mut stretch =
            Stretch { from: level, work: Vec::new(), at: at_points, closing: 0.0, iterations: 0 };
        let went = self.creep_on(leg, at, width, &mut stretch)?;
        match went {
            Ok(()) => {
                self.tell(leg, at.energy, &stretch, released);
                Ok(Ok(stretch.iterations))
            }
            Err(why) => {
                self.engine.go_back();
                (self.state, at.level) = (kept, level);
                Ok(Err(Unconverged { iterations: stretch.iterations, ..why }))
            }
        }
    }

    fn creep_on(
        &mut self,
        leg: &Leg,
        at: &mut Progress,
        width: f64,
        stretch: &mut Stretch,
    ) -> Result<std::result::Result<(), Unconverged>> {
        let [mut eta, stiffness, softening] = self.scales();
        at.patience = if at.fresh { (2 * at.patience).min(64) } else { 4 };
        let (mut wait, mut hold) = (at.patience, 0);
        let most_bent = BEND * self.problem.solution.path_tolerance;
        let (mut step, mut last) = ((FIRST * width).min(LONGEST), 0.0);
        loop {
            let at_goal = at.level >= leg.goal;
            if at_goal || wait == 0 {
                let load = leg.start.at(at.level)?;
                let left = self.engine.imbalance(&self.state, &load);
                if left < if at_goal { 1e-2 } else { NEAR } && self.by_laws_alone(leg, at, stretch)? {
                    at.width = (4.0 * step).max(1e-4).min(leg.part);
                    return Ok(Ok(()));
                }
                if at_goal {
                    at.width = (4.0 * step).max(1e-4).min(leg.part);
                    return self.rest(leg, at, stretch, [stiffness, softening]);
                }
                wait = at.patience;
            }
            step = step.min(leg.goal - at.level).min(LONGEST);
            let to = if at.level + step > leg.goal - 1e-13 { leg.goal } else { at.level + step };
            let c = eta / step;
            let ahead = if last > 0.0 { step / last } else { 0.0 };
            match self.creep(
                leg,
                at,
                to,
                Viscous { viscosity: c, ahead, strict: false },
                c < STIFF * stiffness,
                stretch,
            )? {
                Ok(Motion { iterations, bend, pulled, driven, .. }) => {
                    if step >= 0.99 * LONGEST && driven && pulled > SLIGHT {
                        eta *= SLIGHT / pulled;
                    }
                    last = step;
                    at.level = to;
                    (hold, wait) = (hold.max(1) - 1, wait.max(1) - 1);
                    let grow = if hold == 0 && iterations <= EASY { FACTOR } else { 1.0 };
                    // a joint that dilates presses or opens off a straight way; in a snap, where steps are tiny, that is no matter
                    let tiny = c > STIFF * stiffness;
                    step *= if tiny { grow } else { grow.min((most_bent / bend).sqrt().max(1.0 / FACTOR)) };
                }
                Err(why) => {
                    (step, last, hold) = (step / FACTOR, 0.0, 2);
                    if eta / step > MOST * stiffness {
                        return Ok(Err(why));
                    }
                }
            }
        }
    }

    /// η, the largest stiffness and the steepest softening of all laws [stress / length].
    fn scales(&self) -> [f64; 3] {
        let laws = || self.problem.laws.iter().map(|(law, _)| law);
        let stiffness = laws().flat_map(|law| law.elastic_stiffness()).fold(0.0, f64::max);
        let softening = laws().map(|law| law.steepest_softening()).fold(0.0, f64::max).min(stiffness);
        match softening > 0.0 {
            true => [VISCOSITY * softening, stiffness, softening],
            false => [WITHOUT_SOFTENING * stiffness, stiffness, 1e-2 * stiffness],
        }
    }

    /// A viscous step to a load factor, kept if it changes little or may change much.
    fn creep(
        &mut self,
        leg: &Leg,
        at: &mut Progress,
        to: f64,
        viscous: Viscous,
        limited: bool,
        stretch: &mut Stretch,
    ) -> Result<std::result::Result<Motion, Unconverged>> {
        let load = leg.start.at(to)?;
        let now = self.state.carried(self.problem).sqrt();
        at.most = at.most.max(now);
        let scale = now.max(LEAST_CARRIED * at.most);
        let too_far = |reason: &str| Unconverged { reason: reason.into(), worst: Vec::new(), iterations: 0 };
        let found = match self.engine.creep(&self.state, &load, viscous, true) {
            Ok(found) => found,
            Err(Failure::Unconverged(why)) => {
                stretch.iterations += why.iterations;
                self.totals.rejected += 1;
                return Ok(Err(why));
            }
            Err(Failure::Unusable(_)) => return Ok(Err(too_far("numbers overflowed"))),
        };
        let iterations = found.iterations;
        stretch.iterations += iterations + found.wasted;
        let change = self.state.change(self.problem, &found).sqrt();
        if limited && change > CHANGE * scale {
            self.totals.rejected += 1;
            return Ok(Err(too_far("the tractions change too much")));
        }
        let [moved, closing] = self.state.moved(self.problem, &found);
        let driven = moved <= self.driven(leg, &load);
        let bend = found.bend / scale.max(f64::MIN_POSITIVE);
        self.take_viscous(found, load, stretch);
        let (pull, change) = (viscous.viscosity * moved, change / scale.max(f64::MIN_POSITIVE));
        let pulled = pull / scale.max(f64::MIN_POSITIVE);
        Ok(Ok(Motion { iterations, moved, closing, pull, pulled, driven, change, bend }))
    }

    /// √(Σ w |Δr|²) of interfaces that move twice as far as what is prescribed.
    fn driven(&self, leg: &Leg, load: &Load) -> f64 {
        let ways = load.forces().prescribed.iter().zip(&self.state.snapshot.u).zip(&leg.stage.held);
        let most = ways.filter(|(_, held)| **held).map(|((a, b), _)| (a - b).abs()).fold(0.0, f64::max);
        let joints = self.problem.model.joints.iter().flat_map(|joint| &joint.coupling.points);
        2.0 * most * joints.map(|point| point.weight).sum::<f64>().sqrt()
    }

    fn take_viscous(&mut self, found: Found, load: Load, stretch: &mut Stretch) {
        let level = load.level;
        for of in &found.joints {
            let states = &self.state.snapshot.states[of.joint];
            let points = &self.problem.model.joints[of.joint].coupling.points;
            for (p, (old, new)) in states.iter().zip(&of.memory).enumerate() {
                let moved = new.state.jump - old.jump;
                let work = new.viscous[0] * moved.x + new.viscous[1] * moved.y + new.released;
                stretch.at[of.joint][p] += work;
                if old.traction.x == 0.0 && old.traction.y == 0.0 && moved.x < 0.0 {
                    stretch.closing += self.problem.model.thickness * points[p].weight * work;
                }
            }
        }
        self.engine.accept();
        self.state.accept(self.problem, found, load);
        self.totals.parts += 1;
        stretch.work.push((level, self.state.released));
    }

    /// The equilibrium of the laws alone at the load reached, if there is one near.
    fn by_laws_alone(&mut self, leg: &Leg, at: &mut Progress, stretch: &mut Stretch) -> Result<bool> {
        let load = leg.start.at(at.level)?;
        match self.engine.solve(&self.state, &load, Ahead::default(), leg.complete) {
            Ok(found) => {
                stretch.iterations += found.iterations;
                self.take_viscous(found, load, stretch);
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

    /// Holds the load until the laws hold the jumps alone.
    fn rest(
        &mut self,
        leg: &Leg,
        at: &mut Progress,
        stretch: &mut Stretch,
        [stiffness, softening]: [f64; 2],
    ) -> Result<std::result::Result<(), Unconverged>> {
        let (mut c, mut hold) = (softening, 0);
        let mut why = Unconverged {
            reason: "nothing holds what slides or opens".into(),
            worst: Vec::new(),
            iterations: 0,
        };
        let (mut ahead, mut before, mut left) = (0.0, f64::INFINITY, f64::INFINITY);
        let (mut free, mut spent, mut refused) = (0, 0, false);
        for k in 0..STEPS {
            if c > 100.0 * stiffness || free >= FREE && spent >= FREE_ITERATIONS {
                break;
            }
            let strict = left < VERY_NEAR && !refused;
            match self.creep(leg, at, at.level, Viscous { viscosity: c, ahead, strict }, false, stretch)? {
                Ok(Motion { iterations, moved, closing, pull, pulled, change, .. }) => {
                    // the same force on growing steps of what only slides or opens: nothing holds it
                    let same =
                        (pull / before - 1.0).abs() < SAME && change < SAME && closing < CLOSES * moved;
                    (free, spent) = if same { (free + 1, spent + iterations) } else { (0, 0) };
                    (before, ahead) = (pull, 1.0);
                    let load = leg.start.at(at.level)?;
                    left = self.engine.imbalance(&self.state, &load);
                    let tolerance = self.problem.solution.tolerance;
                    // a viscosity that pulls at nothing leaves what rounding does: stiff joints that have slid far have few digits
                    let rounded = pulled < GONE * tolerance && left.max(change) <= ROUNDED;
                    if left.max(change) <= tolerance || rounded {
                        self.state.stands(left);
                        at.last = f64::INFINITY;
                        at.fresh = true;
                        return Ok(Ok(()));
                    }
                    let due = k % 3 == 2 || left < VERY_NEAR || c < 0.1 * softening;
                    if left <= NEAR && due && self.by_laws_alone(leg, at, stretch)? {
                        return Ok(Ok(()));
                    }
                    hold = if hold > 0 { hold - 1 } else { 0 };
                    if hold == 0 && iterations <= USUAL {
                        c /= if iterations < EASY { 4.0 } else { 2.0 };
                    }
                    c = c.max(1e-12 * stiffness);
                }
                Err(_) if strict => refused = true,
                Err(failed) => {
                    why = failed;
                    (c, hold, ahead) = (FACTOR * c, 3, 0.0);
                }
            }
        }
        if free >= FREE {
            why.reason = "nothing holds what slides or opens".into();
            why.worst = stretch.worst();
        }
        Ok(Err(why))
    }
}

impl Stretch {
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
