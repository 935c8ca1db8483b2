//! One backward Euler solve of a step.

use nalgebra::SVector;

use super::super::local::{N, along, direction, shear};
use super::crack::{Crack, Regime};
use super::elastic::{compliant, margin};
use super::flow::{Answer, Trial};
use super::mode::Mode;
use super::nested::solve_nested;
use super::newton::{Near, solve};
use super::prediction::{Line, Prediction};
use super::surface::{Hyperbola, Surface};
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
    /// An answer near that of this solve.
    pub near: Near,
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
    pub last_work: Option<f64>,
    /// The crack before, with the gap at the end, and after.
    pub before: Crack,
    pub crack: Crack,
    pub by: Prediction,
}

/// The solve from old values.
pub(super) fn stage<const D: usize>(surface: &Surface, old: &Old<D>) -> Stage<D> {
    solved_by(surface, old, |trial, now| solve(surface, trial, now, old.near))
}

/// The same by the nested solver alone.
pub(super) fn stage_nested<const D: usize>(surface: &Surface, old: &Old<D>) -> Stage<D> {
    solved_by(surface, old, |trial, _| solve_nested(surface, trial))
}

fn solved_by<const D: usize>(
    surface: &Surface,
    old: &Old<D>,
    solver: impl Fn(&Trial, &Hyperbola) -> Answer,
) -> Stage<D> {
    let by = old.crack.predict(surface, old.carried[N], old.opens);
    let mut trial = old.carried;
    trial[N] = by.sigma;
    let tau = shear(&trial);
    let now = surface.at(old.work);
    let inside = now.hyperbola(by.sigma, tau) <= margin(surface, trial);
    let mut answer = if old.crack.regime == Regime::Free {
        Answer { mode: Mode::Open, sigma: 0.0, tau: 0.0, work: old.work }
    } else if inside {
        Answer { mode: Mode::Elastic, sigma: by.sigma, tau, work: old.work }
    } else {
        solver(&Trial { sigma: by.sigma, sigma_faces: by.sigma_faces, tau, work: old.work }, &now)
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
    pub fn ties_lost(&self) -> f64 {
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

    pub fn on_secant(&self) -> bool {
        self.by.line == Line::Secant && matches!(self.mode(), Mode::Tension | Mode::Sliding)
    }

    pub fn half(&self) -> Trial {
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
}
