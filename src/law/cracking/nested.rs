//! The safe base: one backward Euler step as two nested scalar problems, which cannot diverge.
//!
//! Inner, W fixed: with μ(σ) = (τ_t/τ_y(σ) − 1)/K_T the normal return G(σ; f) = σ − σ_t + K_N μ f t (c − σ t) grows with
//! σ, so the set-valued flow rule has one solution, and its mode follows from the signs of G at σ = 0:
//!
//! ```text
//! T   χ > 0 and (τ_y(0) > τ_t or G(0; 1) < 0)
//! Z   otherwise, G(0; f⁻) ≤ 0      (A if τ_y(0) = 0)
//! C   otherwise
//! ```
//!
//! Outer: W − W_n − ω(W) = 0, negative at W_n. Both roots are bracketed.

use super::flow::{Answer, Trial, normal_equation, without_dilatancy, work_of_step};
use super::mode::{Mode, RIDING_SLOPE};
use super::surface::{Hyperbola, Surface};
use crate::law::bounds::bounded;

/// Steps of the root finder; it halves the bracket at least every other step.
const STEPS: usize = 120;

/// The step from a trial outside the hyperbola.
pub(super) fn solve_nested(surface: &Surface, trial: &Trial) -> Answer {
    let residual = |w: f64| {
        let now = surface.at(w);
        let (mode, sigma, tau) = return_at(surface, trial, &now);
        w - trial.work - work_of_step(surface, trial, &now, mode, sigma, tau)
    };
    let lo = trial.work;
    let r_lo = residual(lo);
    let mut work = lo;
    if r_lo < 0.0 {
        let (mut hi, mut r_hi) = (lo - r_lo, residual(lo - r_lo));
        while r_hi < 0.0 && hi > lo && hi.is_finite() {
            hi = lo + 2.0 * (hi - lo);
            r_hi = residual(hi);
        }
        // a rise of W below rounding is taken as it is: none
        work = if hi > lo { root(residual, (lo, r_lo), (hi, r_hi)) } else { lo };
    }
    let (mode, sigma, tau) = return_at(surface, trial, &surface.at(work));
    Answer { mode, sigma, tau, work }
}

/// Mode and traction of the return to the hyperbola at a fixed W.
pub(super) fn return_at(surface: &Surface, trial: &Trial, now: &Hyperbola) -> (Mode, f64, f64) {
    match mode_at(surface, trial, now) {
        Mode::Tension if trial.tau == 0.0 => (Mode::Tension, now.chi, 0.0),
        Mode::Tension => {
            let hi = trial.tau.min(now.tau(0.0));
            let tau = root_of_normal_equation(surface, Mode::Tension, trial, now, 0.0, hi);
            (Mode::Tension, bounded(now.sigma(tau, now.root(tau)), 0.0, now.chi), tau)
        }
        Mode::Compression if without_dilatancy(surface, trial.sigma_faces, now) => {
            (Mode::Compression, trial.sigma_faces, now.tau(trial.sigma_faces))
        }
        Mode::Compression => {
            let lo = now.tau(0.0).min(trial.tau);
            let tau = root_of_normal_equation(surface, Mode::Compression, trial, now, lo, trial.tau);
            (Mode::Compression, now.sigma(tau, now.root(tau)).min(0.0), tau)
        }
        mode => (mode, 0.0, if mode == Mode::Sliding { now.tau(0.0) } else { 0.0 }),
    }
}

/// Mode of the return at a fixed W; G is multiplied by τ_y(0), so nothing is divided.
pub(super) fn mode_at(surface: &Surface, trial: &Trial, now: &Hyperbola) -> Mode {
    if trial.tau == 0.0 {
        return if now.chi > 0.0 { Mode::Tension } else { Mode::Open };
    }
    let tau0 = now.tau(0.0);
    let back = surface.kn / surface.kt * (trial.tau - tau0) * now.t * now.c;
    if now.chi > 0.0 && (tau0 > trial.tau || back < trial.sigma * tau0) {
        return Mode::Tension;
    }
    // f at 0⁻ is f_c, or nothing without dilatancy
    let to_the_right = if now.fc == 0.0 {
        trial.sigma_faces >= 0.0
    } else if !surface.closes {
        back * now.fc <= trial.sigma_faces * tau0
    } else {
        let most = surface.kn / surface.kt * (trial.tau - tau0) * RIDING_SLOPE;
        most <= trial.sigma_faces || (tau0 > 0.0 && back * now.fc <= trial.sigma_faces * tau0)
    };
    match to_the_right {
        true if tau0 > 0.0 => Mode::Sliding,
        true => Mode::Open,
        false => Mode::Compression,
    }
}

fn root_of_normal_equation(
    surface: &Surface,
    mode: Mode,
    trial: &Trial,
    now: &Hyperbola,
    lo: f64,
    hi: f64,
) -> f64 {
    // with b = 0 the vertex is a corner, E₁ has the root τ = 0 always, as where the flow is bounded: divide it out
    let bounded = surface.closes && mode == Mode::Compression;
    let corner = lo == 0.0 && (now.b == 0.0 || bounded);
    let equation = |tau: f64| normal_equation(surface, mode, trial, now, tau);
    let at_lo = match corner {
        true => {
            let slope = if bounded { RIDING_SLOPE } else { now.t };
            now.chi - trial.normal(mode) + surface.kn / surface.kt * trial.tau * slope
        }
        false => equation(lo),
    };
    let at_hi = equation(hi);
    if at_lo <= 0.0 {
        return lo; // rounding, or the corner itself
    }
    if at_hi >= 0.0 {
        return hi;
    }
    match corner {
        true => {
            root(|tau| if tau > 0.0 { equation(tau) / tau } else { at_lo }, (lo, at_lo), (hi, at_hi / hi))
        }
        false => root(equation, (lo, at_lo), (hi, at_hi)),
    }
}

/// A root between two points of opposite sign, to rounding: inverse quadratic steps where they are safe, halving
/// where not (Chandrupatla, Adv. Eng. Softw. 28, 1997).
fn root(f: impl Fn(f64) -> f64, (a, f_a): (f64, f64), (b, f_b): (f64, f64)) -> f64 {
    if f_a == 0.0 {
        return a;
    }
    if f_b == 0.0 || (f_a < 0.0) == (f_b < 0.0) {
        return b; // a bracket spoiled by rounding: its end is the answer
    }
    let (mut x1, mut f1) = (b, f_b);
    let (mut x2, mut f2) = (a, f_a);
    let (mut x3, mut f3);
    let mut fraction = 0.5;
    for _ in 0..STEPS {
        let x = x1 + fraction * (x2 - x1);
        let f_x = f(x);
        if (f_x < 0.0) == (f1 < 0.0) {
            (x3, f3) = (x1, f1);
        } else {
            (x3, f3) = (x2, f2);
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, f_x);
        let (best, f_best) = if f2.abs() < f1.abs() { (x2, f2) } else { (x1, f1) };
        let width = 2.0 * f64::EPSILON * best.abs() / (x2 - x1).abs();
        if f_best == 0.0 || width > 0.5 || x1 == x2 {
            return best;
        }
        let (xi, phi) = ((x1 - x2) / (x3 - x2), (f1 - f2) / (f3 - f2));
        fraction = if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
            f1 / (f2 - f1) * f3 / (f2 - f3) + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        };
        fraction = bounded(fraction, width, 1.0 - width);
    }
    x1
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn the_root_finder_reaches_rounding() {
        for (f, expected) in [
            ((|x: f64| x * x - 2.0) as fn(f64) -> f64, 2.0_f64.sqrt()),
            (|x| (x - 1.0).powi(3), 1.0),
            (|x| x.exp() - 3.0, 3.0_f64.ln()),
        ] {
            let x = root(f, (0.0, f(0.0)), (5.0, f(5.0)));
            assert!((x - expected).abs() < 1e-15 * 4.0, "{x} {expected}");
        }
    }
}
