//! One backward Euler solve of a step, and its derivatives.

use nalgebra::{Matrix3, RowSVector, SMatrix, SVector};

use super::super::local::{N, S, T, along, direction, shear};
use super::crack::{Crack, Line, Prediction, Regime};
use super::elastic::{compliant, margin};
use super::flow::{Answer, Trial};
use super::mode::{Mode, RIDING_SLOPE};
use super::nested::solve_nested;
use super::newton::solve;
use super::surface::Surface;
use super::tangent::linearise;

/// The old values of a solve: those at the start of a step, or shifted ones.
#[derive(Debug, Clone, Copy)]
pub(super) struct Old<const D: usize> {
    /// The traction with K Δr added.
    pub carried: SVector<f64, D>,
    pub work: f64,
    /// With the gap at the end.
    pub crack: Crack,
    pub opens: bool,
    /// A shear traction near the answer, 0 if unknown.
    pub tau_near: f64,
}

/// One backward Euler solve, as the derivatives need it again.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stage<const D: usize> {
    /// With the σ_t that its mode took.
    pub trial: SVector<f64, D>,
    pub work_old: f64,
    pub traction: SVector<f64, D>,
    pub answer: Answer,
    /// Work of a stage after which nothing is carried: at its end no traction tells it.
    last_work: Option<f64>,
    /// The crack before, with the gap at the end, and after.
    pub before: Crack,
    pub crack: Crack,
    pub by: Prediction,
}

/// Derivatives of what a crack knows by the jump at the end of the increment.
#[derive(Debug, Clone, Copy)]
pub(super) struct CrackSlopes<const D: usize> {
    pub gap: SVector<f64, D>,
    pub opening: SVector<f64, D>,
    pub bridge: SVector<f64, D>,
    pub stored: SVector<f64, D>,
    pub slip: SVector<f64, D>,
}

impl<const D: usize> CrackSlopes<D> {
    pub fn none() -> CrackSlopes<D> {
        let zero = SVector::zeros();
        CrackSlopes { gap: zero, opening: zero, bridge: zero, stored: zero, slip: zero }
    }
}

/// Derivatives after a stage.
pub(super) struct StageSlopes<const D: usize> {
    /// Derivative of the gap under the trial.
    pub gap: SVector<f64, D>,
    /// Derivative of the trial that the mode took.
    pub trial: SMatrix<f64, D, D>,
    pub traction: SMatrix<f64, D, D>,
    pub work: SVector<f64, D>,
    /// Derivative of the work before.
    work_old: SVector<f64, D>,
    pub crack: CrackSlopes<D>,
}

/// The solve from old values.
pub(super) fn stage<const D: usize>(surface: &Surface, old: &Old<D>) -> Stage<D> {
    solved_by(surface, old, |trial| solve(surface, trial, old.tau_near))
}

/// The same by the nested solver alone.
pub(super) fn stage_nested<const D: usize>(surface: &Surface, old: &Old<D>) -> Stage<D> {
    solved_by(surface, old, |trial| solve_nested(surface, trial))
}

fn solved_by<const D: usize>(surface: &Surface, old: &Old<D>, solver: impl Fn(&Trial) -> Answer) -> Stage<D> {
    let by = old.crack.predict(surface, old.carried[N], old.opens);
    let mut trial = old.carried;
    trial[N] = by.sigma;
    let tau = shear(&trial);
    let inside = surface.at(old.work).hyperbola(by.sigma, tau) <= margin(surface, trial);
    let mut answer = if old.crack.regime == Regime::Free {
        Answer { mode: Mode::Open, sigma: 0.0, tau: 0.0, work: old.work }
    } else if inside {
        Answer { mode: Mode::Elastic, sigma: by.sigma, tau, work: old.work }
    } else {
        solver(&Trial { sigma: by.sigma, sigma_faces: by.sigma_faces, tau, work: old.work })
    };
    let mut last_work = None;
    if surface.closes && answer.mode != Mode::Elastic {
        answer.work = surface.settled(answer.work);
        if answer.sigma >= 0.0 && surface.is_spent(answer.work) {
            (answer.sigma, answer.tau) = (0.0, 0.0);
            last_work = Some(answer.work - old.work);
        }
    }
    if answer.mode == Mode::Compression {
        trial[N] = by.sigma_faces;
    }
    let traction = match answer.mode {
        Mode::Elastic => trial,
        _ => along(answer.sigma, answer.tau, &direction(&trial)),
    };
    let crack = match surface.closes {
        true => old.crack.after(surface, &by, &answer, (tau - answer.tau) / surface.kt),
        false => old.crack,
    };
    Stage { trial, work_old: old.work, traction, answer, last_work, before: old.crack, crack, by }
}

impl<const D: usize> Stage<D> {
    /// Mode at the end of this stage.
    pub fn mode(&self) -> Mode {
        self.answer.mode
    }

    /// The trial went along the line of the regime that the crack was on, and the crack stays there.
    pub fn is_regular(&self) -> bool {
        let line = if self.before.regime == Regime::Secant { Line::Secant } else { Line::Carry };
        if self.mode() == Mode::Sliding && self.before.regime == Regime::Contact {
            return self.crack.regime == Regime::Contact; // σ = 0 whatever the gap
        }
        self.by.line == line
            && self.crack.regime == self.before.regime
            && !(self.mode() == Mode::Compression && self.by.rides)
    }

    /// Energy of the ties across the crack that is lost in this stage as such.
    fn ties_lost(&self) -> f64 {
        let lost = match self.mode() {
            Mode::Compression => self.by.rides,
            mode => mode == Mode::Open,
        };
        match self.by.line {
            _ if !lost => 0.0,
            Line::Secant => 0.5 * self.before.bridge * self.by.gap * self.by.gap,
            _ => 0.0,
        }
    }

    /// t · Δr^p of this stage alone, on the secant ½ g (σ_t − σ) for σ Δr_n^p; what the envelope keeps is not taken off.
    pub fn dissipation(&self, surface: &Surface) -> f64 {
        if !surface.closes {
            return self.traction.dot(&compliant(surface, self.trial - self.traction));
        }
        let mut plastic = compliant(surface, self.trial - self.traction);
        let normal = match self.on_secant() {
            true => 0.5 * self.by.gap * (self.trial[N] - self.traction[N]),
            false => self.traction[N] * plastic[N],
        };
        plastic[N] = 0.0;
        normal + self.traction.dot(&plastic) + self.ties_lost() + self.last_work.unwrap_or(0.0)
    }

    fn on_secant(&self) -> bool {
        self.by.line == Line::Secant && matches!(self.mode(), Mode::Tension | Mode::Sliding)
    }

    fn half(&self) -> Trial {
        let Prediction { sigma, sigma_faces, .. } = self.by;
        Trial { sigma, sigma_faces, tau: shear(&self.trial), work: self.work_old }
    }

    /// |τ|/|τ_trial|, its limit where there is no shear.
    pub fn turned(&self, surface: &Surface) -> f64 {
        let half = self.half();
        match (self.answer.mode, half.tau > 0.0) {
            (Mode::Elastic, _) => 1.0,
            (_, true) => self.answer.tau / half.tau,
            _ => linearise(surface, &half, &self.answer)[(1, 1)],
        }
    }

    /// Derivatives after this stage from those of the old values; `carried`: of the traction with K Δr added.
    pub fn slopes(
        &self,
        surface: &Surface,
        carried: &SMatrix<f64, D, D>,
        work: &SVector<f64, D>,
        old: &CrackSlopes<D>,
    ) -> StageSlopes<D> {
        let mut trial = *carried;
        let line = if self.mode() == Mode::Compression { self.by.line_faces } else { self.by.line };
        let mut gap = old.gap;
        if surface.closes {
            if self.before.regime == Regime::Contact {
                gap = carried.row(N).transpose() / surface.kn;
            }
            match line {
                Line::Carry => {}
                Line::Secant => {
                    trial.set_row(N, &(gap * self.before.bridge + old.bridge * self.by.gap).transpose())
                }
                Line::Flat => trial.row_mut(N).fill(0.0),
                Line::Beyond => trial.set_row(N, &((gap - old.opening) * surface.kn).transpose()),
                Line::Touch => trial.set_row(N, &(gap * surface.kn).transpose()),
                Line::Ridden => trial.set_row(N, &((gap - old.slip * RIDING_SLOPE) * surface.kn).transpose()),
            }
        }
        let work_old = *work;
        let (traction, work) = self.returned(surface, &trial, work);
        let crack = match surface.closes {
            true => self.crack_slopes(surface, old, gap, &trial, &traction),
            false => *old,
        };
        StageSlopes { gap, trial, traction, work, work_old, crack }
    }

    /// d(t, W) from d(trial, W_old).
    fn returned(
        &self,
        surface: &Surface,
        trial: &SMatrix<f64, D, D>,
        work: &SVector<f64, D>,
    ) -> (SMatrix<f64, D, D>, SVector<f64, D>) {
        if self.answer.mode == Mode::Elastic {
            return (*trial, *work);
        }
        if surface.closes && self.crack.regime == Regime::Free {
            let known = self.answer.work != self.work_old; // G_I
            return (SMatrix::zeros(), if known { SVector::zeros() } else { *work });
        }
        let e = direction(&self.trial);
        let by_trial: Matrix3<f64> = linearise(surface, &self.half(), &self.answer);
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

    /// Derivatives of the book-keeping, `Crack::after`; that of B is for this stage alone.
    fn crack_slopes(
        &self,
        surface: &Surface,
        old: &CrackSlopes<D>,
        gap: SVector<f64, D>,
        trial: &SMatrix<f64, D, D>,
        traction: &SMatrix<f64, D, D>,
    ) -> CrackSlopes<D> {
        let mut slopes = CrackSlopes { gap, ..*old };
        let zero = SVector::zeros();
        if self.by.line == Line::Flat {
            slopes.bridge = zero;
        }
        let sigma: SVector<f64, D> = traction.row(N).transpose();
        let returned = trial.row(N).transpose() - sigma;
        let slip = || {
            let e = direction(&self.trial);
            (T..D)
                .map(|i| (trial.row(i) - traction.row(i)).transpose() * (e[i] / surface.kt))
                .sum::<SVector<f64, D>>()
        };
        match self.mode() {
            Mode::Elastic | Mode::Open => {}
            Mode::Tension => {
                slopes.opening += returned / surface.kn;
                slopes.slip += slip();
                if self.crack.regime == Regime::Secant {
                    slopes.bridge = (sigma - gap * self.crack.bridge) / self.by.gap;
                }
            }
            Mode::Sliding => {
                slopes.opening += returned / surface.kn;
                slopes.slip += slip();
                slopes.bridge = zero;
                if self.crack.regime == Regime::Contact {
                    slopes.opening = if self.crack.opening > 0.0 { slopes.opening - gap } else { zero };
                }
            }
            Mode::Compression if self.by.rides => {
                slopes.opening = if self.crack.opening > 0.0 { old.opening - gap } else { zero };
                slopes.bridge = zero;
            }
            Mode::Compression => {}
        }
        match self.crack.regime {
            Regime::Contact => {
                (slopes.gap, slopes.slip) = (sigma / surface.kn, zero);
                if surface.is_spent(self.answer.work) {
                    (slopes.opening, slopes.bridge) = (zero, zero);
                }
            }
            Regime::Free => (slopes.opening, slopes.bridge, slopes.slip) = (gap, zero, zero),
            _ => {}
        }
        slopes
    }

    /// d(dissipation) of this stage.
    pub fn dissipation_slope(
        &self,
        surface: &Surface,
        old: &CrackSlopes<D>,
        at: &StageSlopes<D>,
    ) -> SVector<f64, D> {
        let StageSlopes { trial, traction, .. } = at;
        let mut plastic = compliant(surface, self.trial - self.traction);
        let mut stressed = compliant(surface, self.traction);
        let mut normal = SVector::zeros();
        if surface.closes && self.on_secant() {
            (plastic[N], stressed[N]) = (0.0, 0.0);
            let returned = (trial.row(N) - traction.row(N)).transpose();
            let gap = at.gap;
            normal = (gap * (self.trial[N] - self.traction[N]) + returned * self.by.gap) * 0.5;
        }
        if surface.closes && self.ties_lost() > 0.0 {
            let gap = at.gap;
            normal +=
                gap * (self.before.bridge * self.by.gap) + old.bridge * (0.5 * self.by.gap * self.by.gap);
        }
        if self.last_work.is_some() {
            normal += at.work - at.work_old;
        }
        normal + traction.tr_mul(&plastic) + (trial - traction).tr_mul(&stressed)
    }
}
