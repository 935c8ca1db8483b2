//! The fast front: Newton on the two equations of a step, checked, with the nested solver behind it.
//!
//! The mode is that of the return at the old W. An answer is accepted only if it satisfies the equations and every
//! sign its mode promises; anything else is solved again, safely.

use super::flow::{Answer, ReturnEquations, Trial, equations, without_dilatancy};
use super::mode::Mode;
use super::nested::{mode_at, solve_nested};
use super::surface::{Hyperbola, Surface};

/// Iterations before giving up; five are usual.
const ITERATIONS: usize = 12;
/// Last correction, relative: the error left is its square.
const LAST_CORRECTION: f64 = 1e-8;

/// An answer near another: where Newton starts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Near {
    /// |τ|, 0 if unknown.
    pub tau: f64,
    /// W; the old one where this is less.
    pub work: f64,
}

/// The step from a trial outside the hyperbola `start` of the old W.
pub(super) fn solve(surface: &Surface, trial: &Trial, start: &Hyperbola, near: Near) -> Answer {
    let fast = solve_newton(surface, trial, start, near);
    let again =
        || solve_newton(surface, trial, start, Near { work: 0.0, ..near }).filter(|_| near.work > 0.0);
    fast.or_else(again).unwrap_or_else(|| solve_nested(surface, trial))
}

/// Newton's answer, if it passes all checks.
pub(super) fn solve_newton(
    surface: &Surface,
    trial: &Trial,
    start: &Hyperbola,
    near: Near,
) -> Option<Answer> {
    match mode_at(surface, trial, start) {
        Mode::Open => {
            (start.chi == 0.0).then_some(Answer { mode: Mode::Open, sigma: 0.0, tau: 0.0, work: trial.work })
        }
        Mode::Tension if trial.tau == 0.0 => newton_on_work(surface, trial, Mode::Tension, near),
        Mode::Compression if without_dilatancy(surface, trial.sigma_faces, start) => {
            newton_on_work(surface, trial, Mode::Compression, near)
        }
        Mode::Sliding => newton_on_work(surface, trial, Mode::Sliding, near),
        mode => newton_on_both(surface, trial, start, mode, near),
    }
}

/// T or C with dilatancy: unknowns (τ, W).
fn newton_on_both(
    surface: &Surface,
    trial: &Trial,
    start: &Hyperbola,
    mode: Mode,
    near: Near,
) -> Option<Answer> {
    // near the vertex E₁ is linear in τ
    let near_vertex = surface.kn / surface.kt * start.b * start.t;
    let from_vertex = trial.tau * near_vertex / ((trial.sigma - start.chi).max(0.0) + near_vertex);
    let mut tau = if near.tau > 0.0 { near.tau.min(trial.tau) } else { from_vertex };
    let mut w = near.work.max(trial.work);
    let mut now = if w > trial.work { surface.at(w) } else { *start };
    for _ in 0..ITERATIONS {
        let ReturnEquations { normal, work, .. } = equations(surface, mode, trial, &now, tau, w);
        let det = normal.tau * work.work - normal.work * work.tau;
        let d_tau = (normal.work * work.value - normal.value * work.work) / det;
        let d_w = (work.tau * normal.value - normal.tau * work.value) / det;
        if !(d_tau.is_finite() && d_w.is_finite()) {
            return None;
        }
        let next = tau + d_tau;
        tau = if next <= 0.0 { 0.1 * tau } else { next.min(trial.tau) };
        w = (w + d_w).max(trial.work);
        let settled = (next - tau).abs() <= LAST_CORRECTION * tau
            && d_tau.abs() <= LAST_CORRECTION * tau
            && d_w.abs() <= LAST_CORRECTION * (w - trial.work) + 4.0 * f64::EPSILON * w;
        now = surface.at(w);
        if settled {
            let sigma = now.sigma(tau, now.root(tau));
            let promised = match mode {
                Mode::Tension => sigma > 0.0 && now.chi > 0.0,
                _ => sigma < 0.0 && !without_dilatancy(surface, trial.sigma_faces, &now),
            };
            return (promised && sigma <= trial.normal(mode)).then_some(Answer { mode, sigma, tau, work: w });
        }
    }
    None
}

/// Pure tension, compression without dilatancy, and Z: the traction follows from W.
fn newton_on_work(surface: &Surface, trial: &Trial, mode: Mode, near: Near) -> Option<Answer> {
    let mut w = near.work.max(trial.work);
    for _ in 0..ITERATIONS {
        let now = surface.at(w);
        let (value, slope) = if mode == Mode::Tension {
            let over = trial.sigma - now.chi;
            (now.chi * over / surface.kn, now.dchi * (over - now.chi) / surface.kn)
        } else {
            let sigma = if mode == Mode::Sliding { 0.0 } else { trial.sigma_faces };
            let tau = now.tau(sigma);
            if tau <= 0.0 {
                return None;
            }
            let (_, tau_w) = now.tau_slopes(sigma, tau);
            let above = if mode == Mode::Sliding { tau } else { now.shear_above_friction(tau) };
            let slip = (trial.tau - tau) / surface.kt;
            (above * slip, (tau_w + sigma * now.dt) * slip - above * tau_w / surface.kt)
        };
        let d_w = -(w - trial.work - value) / (1.0 - slope);
        if !d_w.is_finite() {
            return None;
        }
        w = (w + d_w).max(trial.work);
        if d_w.abs() <= LAST_CORRECTION * (w - trial.work) + 4.0 * f64::EPSILON * w {
            return accept_on_work(surface, trial, mode, w);
        }
    }
    None
}

fn accept_on_work(surface: &Surface, trial: &Trial, mode: Mode, w: f64) -> Option<Answer> {
    let now = surface.at(w);
    let answer = match mode {
        Mode::Tension => Answer { mode, sigma: now.chi, tau: 0.0, work: w },
        Mode::Sliding => Answer { mode, sigma: 0.0, tau: now.tau(0.0), work: w },
        _ => Answer { mode, sigma: trial.sigma_faces, tau: now.tau(trial.sigma_faces), work: w },
    };
    let same_mode = mode_at(surface, trial, &now) == mode;
    let same_flow = mode != Mode::Compression || without_dilatancy(surface, trial.sigma_faces, &now);
    (same_mode && same_flow && answer.tau <= trial.tau).then_some(answer)
}
