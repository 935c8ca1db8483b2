//! The energy B that the ties across an opened crack keep on the envelope, through a step.
//!
//! ```text
//! B' = min(B + Σ w σ Δo, ½ σ' o')        a step pays for what it keeps; the anchor at its end allows no more
//! ```
//!
//! Kept energy is no dissipation yet; it becomes one where it is lost.

use nalgebra::SVector;

use super::super::local::N;
use super::crack::{Crack, Regime};
use super::mode::Mode;
use super::prediction::Line;
use super::stage::Stage;
use super::stage_slopes::{CrackSlopes, StageSlopes};
use super::surface::Surface;

impl<const D: usize> Stage<D> {
    /// B at the start of this stage.
    fn kept(&self, surface: &Surface) -> f64 {
        if self.by.line == Line::Beyond { self.before.kept_at_anchor(surface) } else { self.before.stored }
    }

    /// σ Δo of this stage.
    pub fn spent_on_opening(&self, surface: &Surface) -> f64 {
        match self.mode() {
            Mode::Tension => self.traction[N] * (self.trial[N] - self.traction[N]) / surface.kn,
            _ => 0.0,
        }
    }

    /// d(σ Δo).
    pub fn spent_slope(&self, surface: &Surface, at: &StageSlopes<D>) -> SVector<f64, D> {
        if self.mode() != Mode::Tension {
            return SVector::zeros();
        }
        let (sigma, trial) = (at.traction.row(N).transpose(), at.trial.row(N).transpose());
        (sigma * (self.trial[N] - 2.0 * self.traction[N]) + trial * self.traction[N]) / surface.kn
    }

    /// dB at the start of this stage.
    fn kept_slope(&self, surface: &Surface, old: &CrackSlopes<D>) -> SVector<f64, D> {
        if self.by.line != Line::Beyond {
            return old.stored;
        }
        let Crack { bridge, opening, .. } = self.before;
        let left = surface.kn - bridge;
        let by_bridge = 0.5 * (surface.kn * opening / left).powi(2);
        old.opening * (bridge * surface.kn * opening / left) + old.bridge * by_bridge
    }

    /// B is lost or gained by this stage; on the way back along the secant it only changes its name.
    fn changes_kept(&self) -> bool {
        self.crack.regime == Regime::Envelope
            || self.by.line == Line::Flat
            || (self.mode() != Mode::Elastic && self.crack.regime != Regime::Secant)
    }

    /// Increase of B by this stage alone.
    pub fn kept_change(&self, surface: &Surface) -> f64 {
        if self.changes_kept() { self.crack.stored - self.kept(surface) } else { 0.0 }
    }

    /// dB after this stage alone, and that of what it adds.
    pub fn kept_slopes(
        &self,
        surface: &Surface,
        old: &CrackSlopes<D>,
        at: &StageSlopes<D>,
    ) -> [SVector<f64, D>; 2] {
        let start = self.kept_slope(surface, old);
        let end = match (self.crack.regime, self.mode()) {
            (Regime::Envelope, Mode::Elastic) => start,
            (Regime::Envelope, Mode::Tension) => {
                let paid = self.kept(surface) + self.spent_on_opening(surface);
                bounded_slope(&self.crack, paid, start + self.spent_slope(surface, at), at)
            }
            _ => SVector::zeros(),
        };
        [end, if self.changes_kept() { end - start } else { SVector::zeros() }]
    }
}

/// dB' of B' = min(paid, ½ σ' o').
pub(super) fn bounded_slope<const D: usize>(
    end: &Crack,
    paid: f64,
    paid_slope: SVector<f64, D>,
    at: &StageSlopes<D>,
) -> SVector<f64, D> {
    if end.stored < paid { at.anchored(end) } else { paid_slope }
}

impl<const D: usize> StageSlopes<D> {
    /// d(½ σ o).
    fn anchored(&self, end: &Crack) -> SVector<f64, D> {
        let sigma: SVector<f64, D> = self.traction.row(N).transpose();
        (sigma * end.opening + self.crack.opening * end.sigma_at_anchor()) * 0.5
    }
}

impl<const D: usize> CrackSlopes<D> {
    /// dk of k = β K_N/(K_N + β), β = 2 B/o².
    pub fn set_bridge_by_stored(&mut self, surface: &Surface, end: &Crack) {
        if end.opening == 0.0 {
            return;
        }
        let square = end.opening * end.opening;
        let beta = 2.0 * end.stored / square;
        let by_beta = (surface.kn / (surface.kn + beta)).powi(2);
        self.bridge = (self.stored * (2.0 / square) - self.opening * (2.0 * beta / end.opening)) * by_beta;
    }
}
