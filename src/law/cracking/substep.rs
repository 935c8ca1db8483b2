//! The way of an increment: plain backward Euler in equal parts, or the two-stage scheme in controlled sub-steps.
//!
//! Under error control the way is elastic up to the onset of cracking, found exactly, then runs in sub-steps of
//! absolute length, the last one cut at the end of the increment. Lengths depend on what lies behind, never on where
//! the increment ends, so the traction does not snap while a global Newton iteration moves that end.

use nalgebra::{SMatrix, SVector};

use super::super::local::{Local, N, direction, narrow, shear, widen, widen_matrix};
use super::super::{Response, State, Unresolved};
use super::control::{ErrorControl, in_halves};
use super::flow::Mode;
use super::march::{Change, Slopes, WayPoint, compliant, euler_step, margin, stiff, stiff_rows};
use super::surface::Surface;
use super::variables::WORK;

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
pub(super) fn march_euler<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    steps: usize,
) -> Response {
    let part = 1.0 / steps.max(1) as f64;
    let change = (jump - narrow(&old.jump)) * part;
    let mut point = WayPoint::start(old);
    let mut slopes = Slopes::none();
    let change_of_jump = Change { along: SMatrix::identity() * part, across: part };
    for _ in 0..steps.max(1) {
        let (end, stage) = euler_step(surface, &point, change);
        slopes = slopes.over_euler_step(surface, &stage, &change_of_jump);
        point = end;
    }
    response(surface, jump, old, &point, &slopes)
}

/// The two-stage scheme in sub-steps.
pub(super) fn march<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    mut lengths: Lengths,
) -> Result<Response, Unresolved> {
    let change: SVector<f64, D> = jump - narrow(&old.jump);
    let still = change == SVector::<f64, D>::zeros();
    let trial: SVector<f64, D> = narrow(&old.traction) + stiff(surface, change);
    let mut point = WayPoint::start(old);
    let outside = surface.at(old.own[WORK]).hyperbola(trial[N], shear(&trial)) > margin(surface, trial);
    if still
        && surface.at(old.own[WORK]).hyperbola(trial[N], shear(&trial))
            > LEFT_OUTSIDE * margin(surface, trial)
    {
        return Ok(march_euler(surface, jump, old, 1)); // a viscous step may leave a state outside
    }
    if !outside || still {
        point.traction = trial;
        point.mode = Mode::Elastic;
        // what is free of stress and has no strength to lose is taken to stay so
        let free = still && old.traction == Local::zeros();
        let slopes = match free && old.own[WORK] > 0.0 && surface.at(old.own[WORK]).chi == 0.0 {
            true => Slopes::none(),
            false => Slopes {
                across: surface.kt,
                traction: stiff_rows(surface, &SMatrix::identity()),
                ..Slopes::none()
            },
        };
        return Ok(response(surface, jump, old, &point, &slopes));
    }

    let (fraction, by_jump) = onset(surface, &point, change);
    let onset = SMatrix::identity() * fraction + change * by_jump.transpose();
    point.traction += fraction * stiff(surface, change);
    let mut slopes =
        Slopes { across: surface.kt * fraction, traction: stiff_rows(surface, &onset), ..Slopes::none() };

    let distance = change.norm();
    let towards = change / distance;
    let turn = (SMatrix::identity() - towards * towards.transpose()) / distance;
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
                .next(surface, &point, towards, left)
                .ok_or(Unresolved::SnapBack { jump: widen(&(jump - towards * left)) })?,
            (None, Lengths::Given(given)) if count + 1 < given.len() => {
                in_halves(surface, &point, towards, given[count].min(left))
            }
            (None, _) => in_halves(surface, &point, towards, left),
        };
        if let Lengths::Controlled(_, Some(record)) = &mut lengths {
            record.push(step.length);
        }
        count += 1;
        let before = done;
        done = if step.length >= left { total } else { done + step.length };
        let there = if done == total { SMatrix::identity() } else { onset + turn * done };
        let half = Change { along: (there - here) * 0.5, across: 0.5 * (done - before) / distance };
        for stages in &step.stages {
            slopes = slopes.over_two_stages(surface, stages, &half);
        }
        here = there;
        point = step.end;
    }
    Ok(response(surface, jump, old, &point, &slopes))
}

/// Fraction of the way to a jump at which the hyperbola is met; none if it is not.
pub(super) fn onset_of<const D: usize>(surface: &Surface, jump: SVector<f64, D>, old: &State) -> Option<f64> {
    let change = jump - narrow(&old.jump);
    let trial: SVector<f64, D> = narrow(&old.traction) + stiff(surface, change);
    let outside = surface.at(old.own[WORK]).hyperbola(trial[N], shear(&trial)) > margin(surface, trial);
    outside.then(|| onset(surface, &WayPoint::start(old), change).0)
}

/// Fraction of the way at which an elastic point meets the hyperbola, and its derivative by the jump.
///
/// F is convex along the way, not positive at its start and positive at its end: Newton from the end falls
/// monotonically on the one crossing.
fn onset<const D: usize>(
    surface: &Surface,
    start: &WayPoint<D>,
    change: SVector<f64, D>,
) -> (f64, SVector<f64, D>) {
    let now = surface.at(start.work);
    let rate = stiff(surface, change);
    let at = |x: f64| {
        let traction = start.traction + rate * x;
        let s = now.root(shear(&traction));
        let mut normal = if s > 0.0 { traction / s } else { direction(&rate) };
        normal[N] = now.t;
        (now.hyperbola(traction[N], shear(&traction)), normal)
    };
    let none = (0.0, SVector::zeros());
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

fn response<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
    end: &WayPoint<D>,
    slopes: &Slopes<D>,
) -> Response {
    let traction = end.traction;
    let returned = narrow(&old.traction) + stiff(surface, jump - narrow(&old.jump)) - traction;
    let jump_plastic = match end.mode {
        Mode::Elastic if end.work == old.own[WORK] && end.dissipation == 0.0 => old.jump_plastic,
        _ => old.jump_plastic + widen(&compliant(surface, returned)),
    };
    let (jump, traction) = (widen(&jump), widen(&traction));
    let mut state = State { jump, traction, jump_plastic, status: end.mode as u8, ..*old };
    state.own[WORK] = end.work;
    Response {
        traction,
        stiffness: widen_matrix(&slopes.traction, slopes.across),
        state,
        dissipation: end.dissipation,
        dissipation_gradient: widen(&slopes.dissipation),
        released: 0.0,
    }
}
