//! The way of an increment: plain backward Euler in equal parts, or the two-stage scheme in controlled sub-steps.
//!
//! Under error control the way is elastic up to the onset of cracking, found exactly, then runs in sub-steps of
//! absolute length, the last one cut at the end of the increment. Lengths depend on what lies behind, never on where
//! the increment ends, so the traction does not leap while a global Newton iteration moves that end.

use nalgebra::{Matrix2, Vector2};

use super::super::{Response, State, Unresolved};
use super::control::Control;
use super::flow::Mode;
use super::march::{Point, Slopes, stiff_rows};
use super::surface::Surface;

/// A state that does not move is outside above so many times the margin.
const LEFT_OUTSIDE: f64 = 1e3;

/// Where the sub-steps come from.
pub(super) enum Lengths<'a> {
    /// Error control with this tolerance; the accepted lengths are appended to the record, if there is one.
    Controlled(f64, Option<&'a mut Vec<f64>>),
    /// Given beforehand; the last one reaches to the end whatever its length.
    Given(&'a [f64]),
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
        if change == Vector2::zeros()
            && self.at(old.fracture_work).hyperbola(trial.x, trial.y) > LEFT_OUTSIDE * self.margin(trial)
        {
            return Ok(self.march_euler(jump, old, 1)); // a viscous step may leave a state outside
        }
        if !outside || change == Vector2::zeros() {
            point.traction = trial;
            point.mode = Mode::Elastic;
            // what is free of stress and has no strength to lose is taken to stay so
            let free = change == Vector2::zeros() && old.traction == Vector2::zeros();
            let slopes = match free && old.fracture_work > 0.0 && self.at(old.fracture_work).chi == 0.0 {
                true => Slopes::none(),
                false => Slopes { traction: stiff_rows(self, &Matrix2::identity()), ..Slopes::none() },
            };
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
            Lengths::Controlled(tolerance, _) => Some(Control::new(self, *tolerance, total)),
            Lengths::Given(_) => None,
        };
        let mut here = onset; // d(place on the way)/d(jump)
        let (mut done, mut count) = (0.0, 0);
        while done < total {
            let left = total - done;
            let step = match (&mut control, &mut lengths) {
                (Some(control), _) => control
                    .next(self, &point, direction, left)
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

    /// Fraction of the way to a jump at which the hyperbola is met; none if it is not.
    pub fn onset_of(&self, jump: Vector2<f64>, old: &State) -> Option<f64> {
        let change = jump - old.jump;
        let trial = old.traction + self.stiff(change);
        let outside = self.at(old.fracture_work).hyperbola(trial.x, trial.y) > self.margin(trial);
        outside.then(|| self.onset(&Point::start(old), change).0)
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
            released: 0.0,
        }
    }
}
