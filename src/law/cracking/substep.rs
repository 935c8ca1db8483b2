//! The way of an increment: plain backward Euler in equal parts, or the two-stage scheme in controlled sub-steps.
//!
//! Under error control the way is elastic up to the onset of cracking, found exactly, then runs in sub-steps of
//! absolute length, the last one cut at the end of the increment. Lengths depend on what lies behind, never on where
//! the increment ends, so the traction does not snap while a global Newton iteration moves that end.

use nalgebra::{Matrix2, Vector2};

use super::super::{Response, State, Unresolved};
use super::control::{ErrorControl, in_halves};
use super::flow::Mode;
use super::march::{Slopes, WayPoint, compliant, euler_step, margin, stiff, stiff_rows};
use super::surface::Surface;

/// A state that does not move is outside above so many times the margin.
const LEFT_OUTSIDE: f64 = 1e3;

/// Source of the lengths of sub-steps.
pub(super) enum Lengths<'a> {
    /// Error control with this tolerance; the accepted lengths are appended to the record, if there is one.
    Controlled(f64, Option<&'a mut Vec<f64>>),
    /// Given beforehand; the last one reaches to the end whatever its length.
    Given(&'a [f64]),
}

/// N equal backward Euler steps.
pub(super) fn march_euler(surface: &Surface, jump: Vector2<f64>, old: &State, steps: usize) -> Response {
    let part = 1.0 / steps.max(1) as f64;
    let change = (jump - old.jump) * part;
    let mut point = WayPoint::start(old);
    let mut slopes = Slopes::none();
    for _ in 0..steps.max(1) {
        let (end, stage) = euler_step(surface, &point, change);
        slopes = slopes.over_euler_step(surface, &stage, &(Matrix2::identity() * part));
        point = end;
    }
    response(surface, jump, old, &point, &slopes)
}

/// The two-stage scheme in sub-steps.
pub(super) fn march(
    surface: &Surface,
    jump: Vector2<f64>,
    old: &State,
    mut lengths: Lengths,
) -> Result<Response, Unresolved> {
    let change = jump - old.jump;
    let trial = old.traction + stiff(surface, change);
    let mut point = WayPoint::start(old);
    let outside = surface.at(old.fracture_work).hyperbola(trial.x, trial.y) > margin(surface, trial);
    if change == Vector2::zeros()
        && surface.at(old.fracture_work).hyperbola(trial.x, trial.y) > LEFT_OUTSIDE * margin(surface, trial)
    {
        return Ok(march_euler(surface, jump, old, 1)); // a viscous step may leave a state outside
    }
    if !outside || change == Vector2::zeros() {
        point.traction = trial;
        point.mode = Mode::Elastic;
        // what is free of stress and has no strength to lose is taken to stay so
        let free = change == Vector2::zeros() && old.traction == Vector2::zeros();
        let slopes = match free && old.fracture_work > 0.0 && surface.at(old.fracture_work).chi == 0.0 {
            true => Slopes::none(),
            false => Slopes { traction: stiff_rows(surface, &Matrix2::identity()), ..Slopes::none() },
        };
        return Ok(response(surface, jump, old, &point, &slopes));
    }

    let (fraction, by_jump) = onset(surface, &point, change);
    let onset = Matrix2::identity() * fraction + change * by_jump.transpose();
    point.traction += fraction * stiff(surface, change);
    let mut slopes = Slopes { traction: stiff_rows(surface, &onset), ..Slopes::none() };

    let distance = change.norm();
    let direction = change / distance;
    let turn = (Matrix2::identity() - direction * direction.transpose()) / distance;
    let total = (1.0 - fraction) * distance;
    let mut control = match &lengths {
        Lengths::Controlled(tolerance, _) => Some(ErrorControl::new(surface, *tolerance, total)),
        Lengths::Given(_) => None,
    };
    let mut here = onset; // d(place on the way)/d(jump)
    let (mut done, mut count) = (0.0, 0);
    while done < total {
        let left = total - done;
        let step = match (&mut control, &mut lengths) {
            (Some(control), _) => control
                .next(surface, &point, direction, left)
                .ok_or(Unresolved::SnapBack { jump: jump - direction * left })?,
            (None, Lengths::Given(given)) if count + 1 < given.len() => {
                in_halves(surface, &point, direction, given[count].min(left))
            }
            (None, _) => in_halves(surface, &point, direction, left),
        };
        if let Lengths::Controlled(_, Some(record)) = &mut lengths {
            record.push(step.length);
        }
        count += 1;
        done = if step.length >= left { total } else { done + step.length };
        let there = if done == total { Matrix2::identity() } else { onset + turn * done };
        let half = 0.5 * (there - here);
        for stages in &step.stages {
            slopes = slopes.over_two_stages(surface, stages, &half);
        }
        here = there;
        point = step.end;
    }
    Ok(response(surface, jump, old, &point, &slopes))
}

/// Fraction of the way to a jump at which the hyperbola is met; none if it is not.
pub(super) fn onset_of(surface: &Surface, jump: Vector2<f64>, old: &State) -> Option<f64> {
    let change = jump - old.jump;
    let trial = old.traction + stiff(surface, change);
    let outside = surface.at(old.fracture_work).hyperbola(trial.x, trial.y) > margin(surface, trial);
    outside.then(|| onset(surface, &WayPoint::start(old), change).0)
}

/// Fraction of the way at which an elastic point meets the hyperbola, and its derivative by the jump.
///
/// F is convex along the way, not positive at its start and positive at its end: Newton from the end falls
/// monotonically on the one crossing.
fn onset(surface: &Surface, start: &WayPoint, change: Vector2<f64>) -> (f64, Vector2<f64>) {
    let now = surface.at(start.work);
    let rate = stiff(surface, change);
    let at = |x: f64| {
        let (sigma, tau) = (start.traction.x + x * rate.x, start.traction.y + x * rate.y);
        let s = now.root(tau);
        let shear = if s > 0.0 { tau / s } else { rate.y.signum() };
        (now.hyperbola(sigma, tau), Vector2::new(now.t, shear))
    };
    let none = (0.0, Vector2::zeros());
    let (f, normal) = at(0.0);
    if f >= -margin(surface, start.traction) && normal.dot(&rate) >= 0.0 {
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
            return (x, -x / slope * stiff(surface, normal));
        }
        x = next;
    }
}

fn response(surface: &Surface, jump: Vector2<f64>, old: &State, end: &WayPoint, slopes: &Slopes) -> Response {
    let traction = end.traction;
    let returned = old.traction + stiff(surface, jump - old.jump) - traction;
    let jump_plastic = match end.mode {
        Mode::Elastic if end.work == old.fracture_work && end.dissipation == 0.0 => old.jump_plastic,
        _ => old.jump_plastic + compliant(surface, returned),
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
