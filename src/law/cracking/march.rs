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
use nalgebra::{Matrix3, RowSVector, SMatrix, SVector};

use super::super::State;
use super::super::local::{N, S, T, along, direction, narrow, shear};
use super::flow::{Answer, Mode, Trial};
use super::surface::Surface;
use super::variables::WORK;

/// γ of the two-stage scheme.
const GAMMA: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;
/// Weight of the first stage per its own step: (1 − γ)/γ.
const FIRST: f64 = (1.0 - GAMMA) / GAMMA;
/// A trial outside by less, relative to strength and traction, is elastic.
pub(super) const ELASTIC: f64 = 1e-13;

/// A point of the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct WayPoint<const D: usize> {
    pub traction: SVector<f64, D>,
    pub work: f64,
    pub dissipation: f64,
    pub mode: Mode,
}

/// Derivatives of a point by the jump at the end of the whole increment; columns (n, t, s).
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes<const D: usize> {
    /// ∂τ_s/∂r_s in the plane, where s depends on nothing else.
    pub across: f64,
    pub traction: SMatrix<f64, D, D>,
    pub work: SVector<f64, D>,
    pub dissipation: SVector<f64, D>,
}

/// Derivative of a change of jump by the jump at the end; in the plane that of s stands alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change<const D: usize> {
    pub along: SMatrix<f64, D, D>,
    pub across: f64,
}

/// One backward Euler solve, as the derivatives need it again.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage<const D: usize> {
    trial: SVector<f64, D>,
    work_old: f64,
    traction: SVector<f64, D>,
    answer: Answer,
}

impl<const D: usize> WayPoint<D> {
    /// The start of an increment.
    pub fn start(old: &State) -> WayPoint<D> {
        WayPoint {
            traction: narrow(&old.traction),
            work: old.own[WORK],
            dissipation: 0.0,
            mode: Mode::Elastic,
        }
    }
}

/// K Δr, or K dr.
pub(super) fn stiff<const D: usize>(surface: &Surface, jump: SVector<f64, D>) -> SVector<f64, D> {
    SVector::from_fn(|i, _| if i == N { surface.kn * jump[i] } else { surface.kt * jump[i] })
}

/// K⁻¹ Δt.
pub(super) fn compliant<const D: usize>(surface: &Surface, traction: SVector<f64, D>) -> SVector<f64, D> {
    SVector::from_fn(|i, _| if i == N { traction[i] / surface.kn } else { traction[i] / surface.kt })
}

/// Least distance of a trial from the surface that counts as outside [stress].
pub(super) fn margin<const D: usize>(surface: &Surface, traction: SVector<f64, D>) -> f64 {
    ELASTIC * surface.c0.max(traction.amax())
}

fn stage<const D: usize>(
    surface: &Surface,
    trial: SVector<f64, D>,
    work_old: f64,
    tau_near: f64,
) -> Stage<D> {
    if surface.at(work_old).hyperbola(trial[N], shear(&trial)) <= margin(surface, trial) {
        let answer = Answer { mode: Mode::Elastic, sigma: trial[N], tau: shear(&trial), work: work_old };
        return Stage { trial, work_old, traction: trial, answer };
    }
    let half = Trial { sigma: trial[N], tau: shear(&trial), work: work_old };
    let answer = solve(surface, &half, tau_near);
    let traction = along(answer.sigma, answer.tau, &direction(&trial));
    Stage { trial, work_old, traction, answer }
}

/// One backward Euler step by the nested solver.
pub(super) fn step_nested<const D: usize>(
    surface: &Surface,
    jump: SVector<f64, D>,
    old: &State,
) -> (SVector<f64, D>, f64) {
    let trial = narrow(&old.traction) + stiff(surface, jump - narrow(&old.jump));
    if surface.at(old.own[WORK]).hyperbola(trial[N], shear(&trial)) <= margin(surface, trial) {
        return (trial, old.own[WORK]);
    }
    let half = Trial { sigma: trial[N], tau: shear(&trial), work: old.own[WORK] };
    let answer = solve_nested(surface, &half);
    (along(answer.sigma, answer.tau, &direction(&trial)), answer.work)
}

/// One backward Euler step along a change of jump.
pub(super) fn euler_step<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    change: SVector<f64, D>,
) -> (WayPoint<D>, Stage<D>) {
    let stage = stage(surface, from.traction + stiff(surface, change), from.work, shear(&from.traction));
    (stage.end(from.dissipation + stage.dissipation(surface)), stage)
}

/// One step of the two-stage scheme along a change of jump.
pub(super) fn two_stage_step<const D: usize>(
    surface: &Surface,
    from: &WayPoint<D>,
    change: SVector<f64, D>,
) -> (WayPoint<D>, [Stage<D>; 2]) {
    let first =
        stage(surface, from.traction + GAMMA * stiff(surface, change), from.work, shear(&from.traction));
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

impl<const D: usize> Stage<D> {
    /// Mode at the end of this stage.
    pub fn mode(&self) -> Mode {
        self.answer.mode
    }

    /// t · Δr^p of this stage alone.
    fn dissipation(&self, surface: &Surface) -> f64 {
        self.traction.dot(&compliant(surface, self.trial - self.traction))
    }

    fn end(&self, dissipation: f64) -> WayPoint<D> {
        WayPoint { traction: self.traction, work: self.answer.work, dissipation, mode: self.answer.mode }
    }

    /// |τ|/|τ_trial|, its limit where there is no shear.
    fn turned(&self, surface: &Surface) -> f64 {
        let half = Trial { sigma: self.trial[N], tau: shear(&self.trial), work: self.work_old };
        match (self.answer.mode, half.tau > 0.0) {
            (Mode::Elastic, _) => 1.0,
            (_, true) => self.answer.tau / half.tau,
            _ => linearise(surface, &half, &self.answer)[(1, 1)],
        }
    }

    /// d(t, W) of this stage from d(trial, W_old).
    fn slopes(
        &self,
        surface: &Surface,
        trial: &SMatrix<f64, D, D>,
        work: &SVector<f64, D>,
    ) -> (SMatrix<f64, D, D>, SVector<f64, D>) {
        if self.answer.mode == Mode::Elastic {
            return (*trial, *work);
        }
        let e = direction(&self.trial);
        let half = Trial { sigma: self.trial[N], tau: shear(&self.trial), work: self.work_old };
        let by_trial: Matrix3<f64> = linearise(surface, &half, &self.answer);
        // d|τ_trial|
        let size = (T..D).map(|i| trial.row(i) * e[i]).sum::<RowSVector<f64, D>>();
        let row = |i: usize| -> SVector<f64, D> {
            let from_sigma = trial.row(N).transpose() * by_trial[(i, 0)];
            let from_tau = size.transpose() * by_trial[(i, 1)];
            from_sigma + from_tau + work * by_trial[(i, 2)]
        };
        let (sigma, tau) = (row(0).transpose(), row(1).transpose());
        let mut traction = SMatrix::<f64, D, D>::zeros();
        traction.set_row(N, &sigma);
        for i in T..D {
            let mut own = tau * e[i];
            if D > S {
                own += (trial.row(i) - size * e[i]) * self.turned(surface);
            }
            traction.set_row(i, &own);
        }
        (traction, row(2))
    }

    /// d(t · Δr^p) of this stage.
    fn dissipation_slope(
        &self,
        surface: &Surface,
        trial: &SMatrix<f64, D, D>,
        traction: &SMatrix<f64, D, D>,
    ) -> SVector<f64, D> {
        let plastic = compliant(surface, self.trial - self.traction);
        traction.tr_mul(&plastic) + (trial - traction).tr_mul(&compliant(surface, self.traction))
    }
}

impl<const D: usize> Slopes<D> {
    /// At the start of an increment nothing depends on its end.
    pub fn none() -> Slopes<D> {
        Slopes {
            across: 0.0,
            traction: SMatrix::zeros(),
            work: SVector::zeros(),
            dissipation: SVector::zeros(),
        }
    }

    /// Carries the derivatives over a backward Euler step, whose change of jump has the derivative `change`.
    pub fn over_euler_step(&self, surface: &Surface, stage: &Stage<D>, change: &Change<D>) -> Slopes<D> {
        let trial = self.traction + stiff_rows(surface, &change.along);
        let across = stage.turned(surface) * (self.across + surface.kt * change.across);
        let (traction, work) = stage.slopes(surface, &trial, &self.work);
        let dissipation = self.dissipation + stage.dissipation_slope(surface, &trial, &traction);
        Slopes { across, traction, work, dissipation }
    }

    /// Carries the derivatives over a step of the two-stage scheme.
    pub fn over_two_stages(
        &self,
        surface: &Surface,
        stages: &[Stage<D>; 2],
        change: &Change<D>,
    ) -> Slopes<D> {
        let stiff = stiff_rows(surface, &change.along);
        let (across, kt) = (self.across, surface.kt * change.across);
        let returned = (1.0 - stages[0].turned(surface)) * (across + GAMMA * kt);
        let across = stages[1].turned(surface) * (across + kt - FIRST * returned);
        let trial_1 = self.traction + GAMMA * stiff;
        let (traction_1, work_1) = stages[0].slopes(surface, &trial_1, &self.work);
        let trial_2 = self.traction + stiff - FIRST * (trial_1 - traction_1);
        let work_old = self.work + FIRST * (work_1 - self.work);
        let (traction, work) = stages[1].slopes(surface, &trial_2, &work_old);
        let dissipation = self.dissipation
            + FIRST * stages[0].dissipation_slope(surface, &trial_1, &traction_1)
            + stages[1].dissipation_slope(surface, &trial_2, &traction);
        Slopes { across, traction, work, dissipation }
    }
}

/// K times a derivative of a jump.
pub(super) fn stiff_rows<const D: usize>(surface: &Surface, jump: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| if i == N { surface.kn * jump[(i, j)] } else { surface.kt * jump[(i, j)] })
}
