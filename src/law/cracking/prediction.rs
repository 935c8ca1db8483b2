//! The elastic answer of a crack that closes at the end of a change of jump, which is the trial of a stage, and the book-keeping
//! after that.

use super::crack::{AT_ANCHOR, Crack, Regime};
use super::flow::Answer;
use super::mode::{Mode, RIDING_SLOPE};
use super::surface::Surface;

/// The line that gives a trial σ_t.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Line {
    /// σ + K_N Δr_n.
    Carry,
    /// k g.
    Secant,
    /// K_N (g − o), from below the anchor.
    Beyond,
    /// 0: the ties give way within a step.
    Flat,
    /// K_N g, from an open gap.
    Touch,
    /// K_N (g − M q): faces that ride on each other.
    Ridden,
}

/// Trial tractions of T, and of C and Z.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prediction {
    pub sigma: f64,
    pub line: Line,
    pub sigma_faces: f64,
    pub line_faces: Line,
    /// Gap under the trial.
    pub gap: f64,
    /// In C faces ride on each other: they did not touch before.
    pub rides: bool,
}

impl Crack {
    /// ψ_n at the end of an elastic way.
    pub fn trial_energy(&self, surface: &Surface, by: &Prediction) -> f64 {
        let stiff = 0.5 * by.sigma * by.sigma / surface.kn;
        match by.line {
            Line::Secant | Line::Flat => 0.5 * by.sigma * by.gap,
            Line::Beyond => stiff + self.kept_at_anchor(surface),
            Line::Carry if self.regime == Regime::Envelope && by.sigma >= 0.0 => stiff + self.stored,
            _ => stiff,
        }
    }

    /// The elastic answer where `carry` is σ + K_N Δr_n and this has the gap at the end.
    pub fn predict(&self, surface: &Surface, carry: f64, opens: bool) -> Prediction {
        if !surface.closes {
            let (line, gap) = (Line::Carry, 0.0);
            return Prediction {
                sigma: carry,
                line,
                sigma_faces: carry,
                line_faces: line,
                gap,
                rides: false,
            };
        }
        let toe = |gap: f64| {
            let (secant, beyond) = (self.bridge * gap, surface.kn * (gap - self.opening));
            if beyond > secant { (beyond, Line::Beyond, gap) } else { (secant, Line::Secant, gap) }
        };
        let (sigma, line, gap) = match self.regime {
            Regime::Contact if carry <= 0.0 || self.opening == 0.0 => {
                (carry, Line::Carry, carry / surface.kn)
            }
            Regime::Contact => toe(carry / surface.kn),
            _ if self.gap < 0.0 && self.opening > 0.0 => (surface.kn * self.gap, Line::Touch, self.gap),
            Regime::Secant if opens => toe(self.gap),
            Regime::Secant => (self.bridge * self.gap, Line::Secant, self.gap),
            Regime::Envelope if carry < 0.0 && self.opening > 0.0 && opens => (0.0, Line::Flat, self.gap),
            Regime::Envelope if opens || self.opening == 0.0 => (carry, Line::Carry, self.gap),
            Regime::Envelope => {
                let secant = self.bridge * self.gap;
                if secant > carry { (secant, Line::Secant, self.gap) } else { (carry, Line::Carry, self.gap) }
            }
            Regime::Free => (0.0, Line::Secant, self.gap),
        };
        let (mut sigma_faces, mut line_faces) = (sigma, line);
        let ride = RIDING_SLOPE * if self.regime == Regime::Contact { 0.0 } else { self.slip };
        if surface.sigma_dil > 0.0 && gap >= 0.0 && ride < self.opening * (1.0 - AT_ANCHOR) {
            let ridden = surface.kn * (gap - ride);
            if ridden > sigma {
                (sigma_faces, line_faces) = (ridden, Line::Ridden);
            }
        }
        let rides = self.regime != Regime::Contact && gap > 0.0;
        Prediction { sigma, line, sigma_faces, line_faces, gap, rides }
    }

    /// The book-keeping after a stage; `slip` is what it added to u_t^p. B is that of one stage alone.
    pub fn after(&self, surface: &Surface, by: &Prediction, answer: &Answer, slip: f64) -> Crack {
        let mut crack = Crack { gap: by.gap, ..*self };
        let Answer { mode, sigma, .. } = *answer;
        let returned = by.sigma - sigma;
        match by.line {
            Line::Beyond => crack.stored = self.kept_at_anchor(surface),
            Line::Flat => (crack.bridge, crack.stored) = (0.0, 0.0),
            _ => {}
        }
        crack.regime = match by.line {
            Line::Secant | Line::Flat => Regime::Secant,
            Line::Touch => Regime::Contact,
            Line::Carry if sigma < 0.0 || (self.regime == Regime::Contact && by.sigma <= 0.0) => {
                Regime::Contact
            }
            _ => Regime::Envelope,
        };
        match mode {
            Mode::Elastic => {}
            Mode::Tension => {
                crack.opening += returned / surface.kn;
                crack.slip += slip;
                if crack.regime == Regime::Secant {
                    crack.bridge = sigma / by.gap;
                } else {
                    crack.keep(surface, crack.stored + sigma * returned / surface.kn, sigma);
                }
            }
            Mode::Sliding => {
                crack.opening += by.sigma / surface.kn;
                crack.slip += slip;
                (crack.bridge, crack.stored) = (0.0, 0.0);
                if crack.may_ride(surface, answer.work) {
                    crack.ride(surface);
                }
            }
            Mode::Compression => {
                crack.regime = Regime::Contact;
                crack.dilated |= by.rides || by.sigma_faces != sigma;
                if by.rides {
                    crack.ride(surface);
                }
            }
            Mode::Open => {}
        }
        if crack.regime == Regime::Contact {
            (crack.gap, crack.slip) = (sigma / surface.kn, 0.0);
        }
        if crack.regime != Regime::Envelope {
            crack.stored = 0.0;
        }
        if surface.is_spent(answer.work) {
            crack.spend(surface);
        }
        crack
    }
}
