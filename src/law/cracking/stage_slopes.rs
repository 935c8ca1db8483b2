//! Derivatives of a backward Euler solve.

use nalgebra::{Matrix3, RowSVector, SMatrix, SVector};

use super::super::local::{N, S, T, direction};
use super::crack::Regime;
use super::elastic::compliant;
use super::mode::{Mode, RIDING_SLOPE};
use super::prediction::Line;
use super::stage::Stage;
use super::surface::Surface;
use super::tangent::linearise;

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

impl<const D: usize> Stage<D> {
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
