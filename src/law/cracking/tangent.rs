//! Derivative of a step's answer by its trial: d(σ, τ, W) / d(σ_t, τ_t, W_n), exact.
//!
//! The equations of the step hold for every trial, so their derivative is the derivative of the answer:
//! J d(τ, W) = −∂(E₁, E₂)/∂(σ_t, τ_t, W_n), with the same J as Newton's. For one backward Euler step
//! D = d(σ, τ)/d(σ_t, τ_t) · K; it is not symmetric, zero in A, with a first row of zeros in Z.

use nalgebra::Matrix3;

use super::flow::{Answer, Trial, equations, without_dilatancy};
use super::mode::Mode;
use super::surface::Surface;

/// The derivative for τ_t ≥ 0.
pub(super) fn linearise(surface: &Surface, trial: &Trial, answer: &Answer) -> Matrix3<f64> {
    let now = surface.at(answer.work);
    let Answer { mode, sigma, tau, work } = *answer;
    match mode {
        Mode::Elastic => Matrix3::identity(),
        Mode::Open => Matrix3::from_row_slice(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        Mode::Tension if tau == 0.0 && now.b == 0.0 => {
            // the corner: σ = χ(W), τ = 0, W = W_n + χ (σ_t − χ)/K_N
            let over = trial.sigma - now.chi;
            let own = 1.0 - now.dchi * (over - now.chi) / surface.kn;
            let (w_sigma, w_n) = (now.chi / surface.kn / own, 1.0 / own);
            Matrix3::from_row_slice(&[
                now.dchi * w_sigma,
                0.0,
                now.dchi * w_n,
                0.0,
                0.0,
                0.0,
                w_sigma,
                0.0,
                w_n,
            ])
        }
        Mode::Sliding => at_fixed_sigma(surface, trial, answer, 0.0),
        Mode::Compression if without_dilatancy(surface, trial.sigma_faces, &now) => {
            at_fixed_sigma(surface, trial, answer, 1.0)
        }
        Mode::Tension | Mode::Compression => {
            let eq = equations(surface, mode, trial, &now, tau, work);
            // columns σ_t, τ_t, W_n
            let normal = [-tau, surface.kn / surface.kt * eq.flow, 0.0];
            let omega = match mode {
                Mode::Tension => [sigma / surface.kn, tau / surface.kt],
                _ => [0.0, now.shear_above_friction(tau) / surface.kt],
            };
            let spent = [-omega[0], -omega[1], -1.0];
            let det = eq.normal.tau * eq.work.work - eq.normal.work * eq.work.tau;
            let mut rows = Matrix3::zeros();
            for i in 0..3 {
                let d_tau = (eq.normal.work * spent[i] - eq.work.work * normal[i]) / det;
                let d_w = (eq.work.tau * normal[i] - eq.normal.tau * spent[i]) / det;
                rows[(0, i)] = eq.sigma.tau * d_tau + eq.sigma.work * d_w;
                rows[(1, i)] = d_tau;
                rows[(2, i)] = d_w;
            }
            rows
        }
    }
}

/// σ = σ_t (`follows` 1) or σ = 0 (`follows` 0): τ = τ_y(σ, W), W = W_n + (τ + σ t)(τ_t − τ)/K_T.
fn at_fixed_sigma(surface: &Surface, trial: &Trial, answer: &Answer, follows: f64) -> Matrix3<f64> {
    let now = surface.at(answer.work);
    let Answer { sigma, tau, .. } = *answer;
    if tau <= 0.0 {
        return Matrix3::from_row_slice(&[follows, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }
    let (by_sigma, by_w) = now.tau_slopes(sigma, tau);
    let above = if answer.mode == Mode::Sliding { tau } else { now.shear_above_friction(tau) };
    let slip = (trial.tau - tau) / surface.kt;
    let own = 1.0 - ((by_w + sigma * now.dt) * slip - above * by_w / surface.kt);
    let w_sigma = follows * ((by_sigma + now.t) * slip - above * by_sigma / surface.kt) / own;
    let (w_tau, w_n) = (above / surface.kt / own, 1.0 / own);
    Matrix3::from_row_slice(&[
        follows,
        0.0,
        0.0,
        follows * by_sigma + by_w * w_sigma,
        by_w * w_tau,
        by_w * w_n,
        w_sigma,
        w_tau,
        w_n,
    ])
}
