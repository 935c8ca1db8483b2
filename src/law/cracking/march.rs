//! One step of the integration and the derivatives it carries along.
//!
//! A step is a diagonally implicit Runge–Kutta step whose stages are backward Euler steps from shifted old values:
//!
//! ```text
//! γ │ γ                 γ = 1 − 1/√2: second order, L-stable (Alexander, SIAM J. Numer. Anal. 14, 1977)
//! 1 │ 1−γ   γ
//! ```
//!
//! The last stage is the end of the step, so F = 0 holds there to rounding; all weights are positive, so the work W
//! and the dissipation never fall. Plain backward Euler is the one stage γ = 1. Tractions are carried instead of the
//! irreversible jump: K r loses digits at high stiffness, K Δr of a sub-step does not.

use super::nested::solve_nested;
use super::newton::solve;
use super::tangent::linearise;
use nalgebra::{Matrix2, Matrix3, Vector2};

use super::super::State;
use super::flow::{Answer, Mode, Trial};
use super::surface::Surface;

/// γ of the two-stage scheme.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Weight of the first stage per its own step: (1 − γ)/γ.
const FIRST: f64 = (1.0 - GAMMA) / GAMMA;
/// A trial outside by less, relative to strength and traction, is elastic.
pub(super) const ELASTIC: f64 = 1e-13;

/// A point of the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct WayPoint {
    pub traction: Vector2<f64>,
    pub work: f64,
    pub dissipation: f64,
    pub mode: Mode,
}

/// Derivatives of a point by the jump at the end of the whole increment; columns (n, t).
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub traction: Matrix2<f64>,
    pub work: Vector2<f64>,
    pub dissipation: Vector2<f64>,
}

/// One backward Euler solve, as the derivatives need it again.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage {
    trial: Vector2<f64>,
    work_old: f64,
    traction: Vector2<f64>,
    answer: Answer,
}

impl WayPoint {
    /// The start of an increment.
    pub fn start(old: &State) -> WayPoint {
        WayPoint { traction: old.traction, work: old.fracture_work, dissipation: 0.0, mode: Mode::Elastic }
    }
}

/// K Δr, or K dr.
pub(super) fn stiff(surface: &Surface, jump: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(surface.kn * jump.x, surface.kt * jump.y)
}

/// K⁻¹ Δt.
pub(super) fn compliant(surface: &Surface, traction: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(traction.x / surface.kn, traction.y / surface.kt)
}

/// Least distance of a trial from the surface that counts as outside [stress].
pub(super) fn margin(surface: &Surface, traction: Vector2<f64>) -> f64 {
    ELASTIC * surface.c0.max(traction.amax())
}

fn stage(surface: &Surface, trial: Vector2<f64>, work_old: f64, tau_near: f64) -> Stage {
    if surface.at(work_old).hyperbola(trial.x, trial.y) <= margin(surface, trial) {
        let answer = Answer { mode: Mode::Elastic, sigma: trial.x, tau: trial.y.abs(), work: work_old };
        return Stage { trial, work_old, traction: trial, answer };
    }
    let half = Trial { sigma: trial.x, tau: trial.y.abs(), work: work_old };
    let answer = solve(surface, &half, tau_near);
    let traction = Vector2::new(answer.sigma, answer.tau.copysign(trial.y));
    Stage { trial, work_old, traction, answer }
}

/// One backward Euler step by the nested solver.
pub(super) fn step_nested(surface: &Surface, jump: Vector2<f64>, old: &State) -> (Vector2<f64>, f64) {
    let trial = old.traction + stiff(surface, jump - old.jump);
    if surface.at(old.fracture_work).hyperbola(trial.x, trial.y) <= margin(surface, trial) {
        return (trial, old.fracture_work);
    }
    let half = Trial { sigma: trial.x, tau: trial.y.abs(), work: old.fracture_work };
    let answer = solve_nested(surface, &half);
    (Vector2::new(answer.sigma, answer.tau.copysign(trial.y)), answer.work)
}

/// One backward Euler step along a change of jump.
pub(super) fn euler_step(surface: &Surface, from: &WayPoint, change: Vector2<f64>) -> (WayPoint, Stage) {
    let stage = stage(surface, from.traction + stiff(surface, change), from.work, from.traction.y.abs());
    (stage.end(from.dissipation + stage.dissipation(surface)), stage)
}

/// One step of the two-stage scheme along a change of jump.
pub(super) fn two_stage_step(
    surface: &Surface,
    from: &WayPoint,
    change: Vector2<f64>,
) -> (WayPoint, [Stage; 2]) {
    let first =
        stage(surface, from.traction + GAMMA * stiff(surface, change), from.work, from.traction.y.abs());
    let returned = first.trial - first.traction;
    let second = stage(
        surface,
        from.traction + stiff(surface, change) - FIRST * returned,
        from.work + FIRST * (first.answer.work - from.work),
        first.answer.tau,
    );
    let dissipation = from.dissipation + FIRST * first.dissipation(surface) + second.dissipation(surface);
    (second.end(dissipation), [first, second])
}

impl Stage {
    /// Mode at the end of this stage.
    pub fn mode(&self) -> Mode {
        self.answer.mode
    }

    /// t · Δr^p of this stage alone.
    fn dissipation(&self, surface: &Surface) -> f64 {
        self.traction.dot(&compliant(surface, self.trial - self.traction))
    }

    fn end(&self, dissipation: f64) -> WayPoint {
        WayPoint { traction: self.traction, work: self.answer.work, dissipation, mode: self.answer.mode }
    }

    /// d(t, W) of this stage from d(trial, W_old).
    fn slopes(
        &self,
        surface: &Surface,
        trial: &Matrix2<f64>,
        work: &Vector2<f64>,
    ) -> (Matrix2<f64>, Vector2<f64>) {
        if self.answer.mode == Mode::Elastic {
            return (*trial, *work);
        }
        let sign = 1.0_f64.copysign(self.trial.y);
        let half = Trial { sigma: self.trial.x, tau: self.trial.y.abs(), work: self.work_old };
        let by_trial: Matrix3<f64> = linearise(surface, &half, &self.answer);
        let flip = |i: usize| if i == 1 { sign } else { 1.0 };
        let row = |i: usize| -> Vector2<f64> {
            let from_sigma = trial.row(0).transpose() * by_trial[(i, 0)];
            let from_tau = trial.row(1).transpose() * (sign * by_trial[(i, 1)]);
            flip(i) * (from_sigma + from_tau + work * by_trial[(i, 2)])
        };
        (Matrix2::from_rows(&[row(0).transpose(), row(1).transpose()]), row(2))
    }

    /// d(t · Δr^p) of this stage.
    fn dissipation_slope(
        &self,
        surface: &Surface,
        trial: &Matrix2<f64>,
        traction: &Matrix2<f64>,
    ) -> Vector2<f64> {
        let plastic = compliant(surface, self.trial - self.traction);
        traction.tr_mul(&plastic) + (trial - traction).tr_mul(&compliant(surface, self.traction))
    }
}

impl Slopes {
    /// At the start of an increment nothing depends on its end.
    pub fn none() -> Slopes {
        Slopes { traction: Matrix2::zeros(), work: Vector2::zeros(), dissipation: Vector2::zeros() }
    }

    /// Carries the derivatives over a backward Euler step, whose change of jump has the derivative `change`.
    pub fn over_euler_step(&self, surface: &Surface, stage: &Stage, change: &Matrix2<f64>) -> Slopes {
        let trial = self.traction + stiff_rows(surface, change);
        let (traction, work) = stage.slopes(surface, &trial, &self.work);
        let dissipation = self.dissipation + stage.dissipation_slope(surface, &trial, &traction);
        Slopes { traction, work, dissipation }
    }

    /// Carries the derivatives over a step of the two-stage scheme.
    pub fn over_two_stages(&self, surface: &Surface, stages: &[Stage; 2], change: &Matrix2<f64>) -> Slopes {
        let stiff = stiff_rows(surface, change);
        let trial_1 = self.traction + GAMMA * stiff;
        let (traction_1, work_1) = stages[0].slopes(surface, &trial_1, &self.work);
        let trial_2 = self.traction + stiff - FIRST * (trial_1 - traction_1);
        let work_old = self.work + FIRST * (work_1 - self.work);
        let (traction, work) = stages[1].slopes(surface, &trial_2, &work_old);
        let dissipation = self.dissipation
            + FIRST * stages[0].dissipation_slope(surface, &trial_1, &traction_1)
            + stages[1].dissipation_slope(surface, &trial_2, &traction);
        Slopes { traction, work, dissipation }
    }
}

/// K times a derivative of a jump.
pub(super) fn stiff_rows(surface: &Surface, jump: &Matrix2<f64>) -> Matrix2<f64> {
    let m = jump;
    Matrix2::new(surface.kn * m.m11, surface.kn * m.m12, surface.kt * m.m21, surface.kt * m.m22)
}
