//! Sub-steps of an increment: plain backward Euler in equal parts, or the two-stage scheme under error control.
//!
//! Under error control the way is: elastic up to the onset of cracking, found exactly, then sub-steps of absolute
//! length, the last one cut at the end of the increment. Each is done once whole and once in halves; the difference
//! rules the next length. Lengths depend on what lies behind, never on where the increment ends, so the traction
//! does not leap while a global Newton iteration moves that end.
//!
//! The tolerance ε bounds the error at the end of a way. A second-order step has a local error of third order, so
//! the local bound is LOCAL ε^{3/2}: then the number of steps drops out of the sum.

use nalgebra::{Matrix2, Vector2};

use super::super::{Response, State, Unresolved};
use super::flow::Mode;
use super::march::{Point, Slopes, Stage, stiff_rows};
use super::surface::Surface;

/// Local bound per ε^{3/2}, of the strength.
const LOCAL: f64 = 5.0;
/// First length per √ε, of the length over which the strength is lost.
const FIRST_LENGTH: f64 = 4.0;
/// Tolerances below this are rounding.
const SMALLEST_TOLERANCE: f64 = 1e-14;
/// Rounding of a step's difference, relative to the tractions in it.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A new length aims at this much less than the bound allows.
const SAFETY: f64 = 0.85;
/// The vertex is at the origin but for this part of G_I.
const AT_ORIGIN: f64 = 1e-10;
/// Bounds of the change of length from one sub-step to the next.
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;
/// A sub-step this short, of the first length, is not divided further.
const SHORTEST: f64 = 1e-10;
/// Change of traction in a sub-step across an event, per ε, of the strength.
const EVENT: f64 = 0.3;
/// Sub-steps tried before the way counts as a leap, and ten times fewer per 1/√ε.
const TRIES: usize = 1000;
/// A straight way meets a handful of events; beyond this number they are rounding.
const EVENTS: usize = 20;
/// Part of an energy that counts as all of it: W approaches its limit without end.
const USED_UP: f64 = 1.0 - 1e-9;
/// A change of traction within the shortest sub-step that counts as a leap, of the strength.
const LEAP: f64 = 1e-3;
/// So many shortest sub-steps may miss the bound before the whole way counts as a leap.
const LEAPS: usize = 50;

/// Where the sub-steps come from.
pub(super) enum Lengths<'a> {
    /// Error control with this tolerance; the accepted lengths are appended to the record, if there is one.
    Controlled(f64, Option<&'a mut Vec<f64>>),
    /// Given beforehand; the last one reaches to the end whatever its length.
    Given(&'a [f64]),
}

/// A sub-step done in halves.
struct Double {
    length: f64,
    stages: [[Stage; 2]; 2],
    end: Point,
}

/// Error control under way.
struct Control {
    bound: f64,
    event_bound: f64,
    shortest: f64,
    length: f64,
    /// An event lies within the first of these distances; a step across it may have the second as its length.
    event: Option<(f64, f64)>,
    /// Sub-steps that may still be tried.
    tries_left: usize,
    /// Events met so far.
    events: usize,
    /// Shortest sub-steps that still missed the bound.
    leaps: usize,
}

impl Surface {
    /// N equal backward Euler steps.
    pub fn march_euler(&self, jump: Vector2<f64>, old: &State, steps: usize) -> Response {
        let part = 1.0 / steps.max(1) as f64;
        let change = (jump - old.jump) * part;
        let mut point = Point::start(old);
        let mut slopes = Slopes::none();
        for _ in 0..steps.max(1) {
            let (end, stage) = self.euler_step(&point, change);
            slopes = slopes.over_euler_step(self, &stage, &(Matrix2::identity() * part));
            point = end;
        }
        self.response(jump, old, &point, &slopes)
    }

    /// The two-stage scheme in sub-steps.
    pub fn march(
        &self,
        jump: Vector2<f64>,
        old: &State,
        mut lengths: Lengths,
    ) -> Result<Response, Unresolved> {
        let change = jump - old.jump;
        let trial = old.traction + self.stiff(change);
        let mut point = Point::start(old);
        let outside = self.at(old.fracture_work).hyperbola(trial.x, trial.y) > self.margin(trial);
        if !outside || change == Vector2::zeros() {
            point.traction = trial;
            point.mode = Mode::Elastic;
            let slopes = Slopes { traction: stiff_rows(self, &Matrix2::identity()), ..Slopes::none() };
            return Ok(self.response(jump, old, &point, &slopes));
        }

        let (fraction, by_jump) = self.onset(&point, change);
        let onset = Matrix2::identity() * fraction + change * by_jump.transpose();
        point.traction += fraction * self.stiff(change);
        let mut slopes = Slopes { traction: stiff_rows(self, &onset), ..Slopes::none() };

        let distance = change.norm();
        let direction = change / distance;
        let turn = (Matrix2::identity() - direction * direction.transpose()) / distance;
        let total = (1.0 - fraction) * distance;
        let mut control = match &lengths {
            Lengths::Controlled(tolerance, _) => Some(self.control(*tolerance, total)),
            Lengths::Given(_) => None,
        };
        let mut here = onset; // d(place on the way)/d(jump)
        let (mut done, mut count) = (0.0, 0);
        while done < total {
            let left = total - done;
            let step = match (&mut control, &mut lengths) {
                (Some(control), _) => self
                    .controlled(control, &point, direction, left)
                    .ok_or(Unresolved::SnapBack { jump: jump - direction * left })?,
                (None, Lengths::Given(given)) if count + 1 < given.len() => {
                    self.in_halves(&point, direction, given[count].min(left))
                }
                (None, _) => self.in_halves(&point, direction, left),
            };
            if let Lengths::Controlled(_, Some(record)) = &mut lengths {
                record.push(step.length);
            }
            count += 1;
            done = if step.length >= left { total } else { done + step.length };
            let there = if done == total { Matrix2::identity() } else { onset + turn * done };
            let half = 0.5 * (there - here);
            for stages in &step.stages {
                slopes = slopes.over_two_stages(self, stages, &half);
            }
            here = there;
            point = step.end;
        }
        Ok(self.response(jump, old, &point, &slopes))
    }

    /// Fraction of the way at which an elastic point meets the hyperbola, and its derivative by the jump.
    ///
    /// F is convex along the way, not positive at its start and positive at its end: Newton from the end falls
    /// monotonically on the one crossing.
    fn onset(&self, start: &Point, change: Vector2<f64>) -> (f64, Vector2<f64>) {
        let now = self.at(start.work);
        let rate = self.stiff(change);
        let at = |x: f64| {
            let (sigma, tau) = (start.traction.x + x * rate.x, start.traction.y + x * rate.y);
            let s = now.root(tau);
            let shear = if s > 0.0 { tau / s } else { rate.y.signum() };
            (now.hyperbola(sigma, tau), Vector2::new(now.t, shear))
        };
        let none = (0.0, Vector2::zeros());
        let (f, normal) = at(0.0);
        if f >= -self.margin(start.traction) && normal.dot(&rate) >= 0.0 {
            return none;
        }
        let mut x = 1.0;
        loop {
            let (f, normal) = at(x);
            let slope = normal.dot(&rate);
            let next = x - f / slope;
            if slope <= 0.0 || next <= 0.0 || !next.is_finite() {
                return none;
            }
            if next >= x - 2.0 * f64::EPSILON {
                return (x, -x / slope * self.stiff(normal));
            }
            x = next;
        }
    }

    /// Bound of the local error of a sub-step [stress]; without strength (Coulomb friction) one step is exact.
    pub fn local_bound(&self, tolerance: f64) -> f64 {
        if self.scale() == 0.0 {
            return f64::INFINITY;
        }
        let tolerance = tolerance.max(SMALLEST_TOLERANCE);
        LOCAL * tolerance * tolerance.sqrt() * self.scale()
    }

    fn control(&self, tolerance: f64, total: f64) -> Control {
        let loss = 1.0 / (self.chi0 * self.per_gf_i).max(self.c0 * self.per_gf_iia); // infinite if nothing is lost
        let length = (FIRST_LENGTH * tolerance.max(SMALLEST_TOLERANCE).sqrt() * loss).min(total);
        Control {
            bound: self.local_bound(tolerance),
            event_bound: EVENT * tolerance.max(SMALLEST_TOLERANCE) * self.scale(),
            shortest: SHORTEST * length,
            length,
            event: None,
            tries_left: TRIES + (TRIES as f64 * 0.1 / tolerance.max(SMALLEST_TOLERANCE).sqrt()) as usize,
            events: 0,
            leaps: 0,
        }
    }

    /// The next sub-step, as long as the bound allows; `None` if the traction leaps.
    fn controlled(
        &self,
        control: &mut Control,
        from: &Point,
        direction: Vector2<f64>,
        left: f64,
    ) -> Option<Double> {
        loop {
            control.tries_left = control.tries_left.checked_sub(1)?;
            let length = control.length.min(left);
            let length = match control.event {
                Some((beyond, short)) if beyond > short => length.min(0.5 * beyond),
                Some((beyond, _)) => length.min(beyond),
                None => length,
            };
            let (whole, _) = self.two_stage_step(from, direction * length);
            let step = self.in_halves(from, direction, length);
            let misfit = (whole.traction - step.end.traction).amax();
            let strength = (whole.work - step.end.work).abs()
                * (self.chi0 * self.per_gf_i).max(self.c0 * self.per_gf_iia);
            let rounding = ROUNDING * from.traction.amax().max(step.end.traction.amax())
                + self.rounding_at_origin(step.end.work);
            let ratio = misfit.max(strength) / control.bound.max(rounding);
            let change = (step.end.traction - from.traction).amax();
            let across = self.is_across_event(from, &step);
            if length <= control.shortest {
                (control.length, control.event) = (GROW * length, None);
                control.leaps += usize::from(ratio > 1.0);
                let leap = ratio > 1.0 && (misfit > LEAP * self.scale() || control.leaps > LEAPS);
                return (!leap).then_some(step);
            }
            if across && change > control.event_bound.max(rounding) && control.events < EVENTS {
                control.events += usize::from(control.event.is_none());
                control.event = Some((length, length * control.event_bound / change));
                continue;
            }
            control.length = length * (SAFETY / ratio.cbrt()).clamp(SHRINK, GROW);
            if ratio <= 1.0 {
                control.event = match control.event {
                    Some((beyond, short)) if !across && beyond > length => Some((beyond - length, short)),
                    _ => None,
                };
                return Some(step);
            }
        }
    }

    /// Rounding of τ where the vertex arrives at the origin: there τ ~ √(1 − W/G_I).
    fn rounding_at_origin(&self, work: f64) -> f64 {
        if (1.0 - work * self.per_gf_i).abs() > AT_ORIGIN {
            return 0.0;
        }
        self.scale() * (ROUNDING * self.e_chi.max(1.0 / self.e_chi)).sqrt()
    }

    /// Whether the flow changes its law within a step: another mode, or an energy used up.
    fn is_across_event(&self, from: &Point, step: &Double) -> bool {
        let mode = step.end.mode;
        let used_up = |w: f64| [w * self.per_gf_i >= USED_UP, w * self.per_gf_iia >= USED_UP];
        (from.mode != Mode::Elastic && from.mode != mode)
            || step.stages.iter().flatten().any(|stage| stage.mode() != mode)
            || used_up(from.work) != used_up(step.end.work)
    }

    fn in_halves(&self, from: &Point, direction: Vector2<f64>, length: f64) -> Double {
        let change = direction * (0.5 * length);
        let (middle, first) = self.two_stage_step(from, change);
        let (end, second) = self.two_stage_step(&middle, change);
        Double { length, stages: [first, second], end }
    }

    fn response(&self, jump: Vector2<f64>, old: &State, end: &Point, slopes: &Slopes) -> Response {
        let traction = end.traction;
        let returned = old.traction + self.stiff(jump - old.jump) - traction;
        let jump_plastic = match end.mode {
            Mode::Elastic if end.work == old.fracture_work && end.dissipation == 0.0 => old.jump_plastic,
            _ => old.jump_plastic + self.compliant(returned),
        };
        Response {
            traction,
            stiffness: slopes.traction,
            state: State { jump, traction, jump_plastic, fracture_work: end.work, status: end.mode as u8 },
            dissipation: end.dissipation,
            dissipation_gradient: slopes.dissipation,
        }
    }
}
