//! Modes of cracking and the two equations of one backward Euler step.
//!
//! Given the trial traction (σ_t, τ_t ≥ 0) and the old work W_n, a step has the unknowns (σ, τ, λ, W). The hyperbola
//! gives σ(τ, W) = (c − s)/t and the shear return gives λ = s (τ_t − τ)/(K_T τ), which leaves two equations for (τ, W):
//!
//! ```text
//! E₁ = τ (σ − σ_t) + (K_N/K_T)(τ_t − τ) s t f = 0              normal return, times τ: no pole at the vertex
//! E₂ = W − W_n − ω = 0
//! ω  = σ (σ_t − σ)/K_N + τ (τ_t − τ)/K_T                       T: all plastic work
//! ω  = (τ + σ t)(τ_t − τ)/K_T                                  C, Z: without friction
//! ```
//!
//! Two modes fix σ and leave W alone: compression without dilatancy (σ = σ_t) and Z (σ = 0). Where cracks close, dilation in C
//! is at most M times the slip: s t f ≤ M τ.

use super::mode::{Mode, RIDING_SLOPE};
use super::surface::{Hyperbola, Surface};

/// Trial traction with τ ≥ 0, and the old work.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trial {
    /// σ_t of T.
    pub sigma: f64,
    /// σ_t of C and Z: that of T, or more where faces may ride on each other (`crack`).
    pub sigma_faces: f64,
    pub tau: f64,
    pub work: f64,
}

impl Trial {
    /// σ_t of a mode.
    #[inline]
    pub fn normal(&self, mode: Mode) -> f64 {
        if matches!(mode, Mode::Compression | Mode::Sliding) { self.sigma_faces } else { self.sigma }
    }
}

/// A step's answer, τ ≥ 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer {
    pub mode: Mode,
    pub sigma: f64,
    pub tau: f64,
    pub work: f64,
}

/// A value with its derivatives by (τ, W).
#[derive(Debug, Clone, Copy)]
pub(super) struct ByTauWork {
    pub value: f64,
    pub tau: f64,
    pub work: f64,
}

/// Everything the two equations share at one (τ, W).
#[derive(Debug, Clone, Copy)]
pub(super) struct ReturnEquations {
    /// s t f, or what the slope of riding allows.
    pub flow: f64,
    pub sigma: ByTauWork,
    pub normal: ByTauWork,
    pub work: ByTauWork,
}

/// Compression without dilatancy, where the normal traction ignores sliding: f ≡ 0 up to the trial point.
#[inline]
pub(super) fn without_dilatancy(surface: &Surface, sigma_trial: f64, now: &Hyperbola) -> bool {
    now.fc == 0.0 || -sigma_trial >= surface.sigma_dil
}

/// E₁ at (τ, W) alone, as the nested solver needs it.
pub(super) fn normal_equation(
    surface: &Surface,
    mode: Mode,
    trial: &Trial,
    now: &Hyperbola,
    tau: f64,
) -> f64 {
    let s = now.root(tau);
    let sigma = now.sigma(tau, s);
    let f = if mode == Mode::Tension { 1.0 } else { surface.dilatancy(sigma).0 * now.fc };
    let flow = surface.bounded(mode, s * now.t * f, tau);
    tau * (sigma - trial.normal(mode)) + surface.kn / surface.kt * (trial.tau - tau) * flow
}

/// The work ω of the step that ends at (σ, τ).
pub(super) fn work_of_step(
    surface: &Surface,
    trial: &Trial,
    now: &Hyperbola,
    mode: Mode,
    sigma: f64,
    tau: f64,
) -> f64 {
    let slip = (trial.tau - tau) / surface.kt;
    match mode {
        Mode::Tension => sigma * (trial.sigma - sigma) / surface.kn + tau * slip,
        Mode::Compression => now.shear_above_friction(tau) * slip,
        Mode::Sliding => tau * slip,
        Mode::Elastic | Mode::Open => 0.0,
    }
}

/// E₁, E₂ and σ with derivatives by (τ, W), in T or in C with dilatancy.
#[inline]
pub(super) fn equations(
    surface: &Surface,
    mode: Mode,
    trial: &Trial,
    now: &Hyperbola,
    tau: f64,
    w: f64,
) -> ReturnEquations {
    let Hyperbola { t, b, dc, dt, db, fc, dfc, .. } = *now;
    let s = now.root(tau);
    let sigma = now.sigma(tau, s);
    let g = tau / s;
    let s_w = b * db / s;
    let sigma = ByTauWork { value: sigma, tau: -g / t, work: (dc - s_w - sigma * dt) / t };

    let (f, f_tau, f_w) = if mode == Mode::Tension {
        (1.0, 0.0, 0.0)
    } else {
        let (f_sigma, slope) = surface.dilatancy(sigma.value);
        (f_sigma * fc, slope * fc * sigma.tau, slope * fc * sigma.work + f_sigma * dfc)
    };
    let ratio = surface.kn / surface.kt;
    let shear = trial.tau - tau;
    let over = sigma.value - trial.normal(mode);
    let flow = surface.bounded(mode, s * t * f, tau);
    let normal = if flow < s * t * f {
        ByTauWork {
            value: tau * over + ratio * shear * flow,
            tau: over + tau * sigma.tau + ratio * RIDING_SLOPE * (shear - tau),
            work: tau * sigma.work,
        }
    } else {
        ByTauWork {
            value: tau * over + ratio * shear * s * t * f,
            tau: over + tau * sigma.tau + ratio * t * (shear * (g * f + s * f_tau) - s * f),
            work: tau * sigma.work + ratio * shear * (s_w * t * f + s * dt * f + s * t * f_w),
        }
    };

    let (value, omega_tau, omega_w) = if mode == Mode::Tension {
        let by_sigma = (trial.sigma - 2.0 * sigma.value) / surface.kn;
        (
            -sigma.value * over / surface.kn + tau * shear / surface.kt,
            by_sigma * sigma.tau + (trial.tau - 2.0 * tau) / surface.kt,
            by_sigma * sigma.work,
        )
    } else {
        let above = now.shear_above_friction(tau);
        (
            above * shear / surface.kt,
            ((1.0 - g) * shear - above) / surface.kt,
            (sigma.work * t + sigma.value * dt) * shear / surface.kt,
        )
    };
    let work = ByTauWork { value: w - trial.work - value, tau: -omega_tau, work: 1.0 - omega_w };
    ReturnEquations { flow, sigma, normal, work }
}
