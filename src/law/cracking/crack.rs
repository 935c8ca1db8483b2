//! The elastic law of the normal jump of a crack that closes, and its book-keeping.
//!
//! ```text
//! g = r_n − d                                   gap; d: dilation, the place where the faces touch
//! σᵉ(g; k, o) = K_N g                   g < 0   contact
//!             = max(k g, K_N (g − o))   g ≥ 0   secant up to the anchor g_e = o K_N/(K_N − k), envelope beyond
//! ψ_n = ½ K_N g² | ½ k g² | ½ K_N (g − o)² + B  B = ½ o σᵉ(g_e): what the ties across the crack keep
//!
//!        σ          anchor
//!        |         _/·.           dots: the surface, which leads the anchor along
//!        |     _ ´ /   · .
//!   ─────d──k ´───o+d──────── r_n
//!       /
//!      / K_N
//! ```
//!
//! Intact: k = K_N, o = 0, one line. Opening under tension adds to o and lowers k to σ/g; dilation under compression moves d. On
//! a way that only opens the trial is K_N (g − o), that of the published law, so monotonic answers are the same.

use super::super::State;
use super::super::local::N;
use super::flow::Answer;
use super::mode::{Mode, RIDING_SLOPE};
use super::surface::Surface;
use super::variables::{BRIDGE, OPENING, SLIP_OPEN, WORK};

/// A gap this close to the anchor, relative, is at it.
const AT_ANCHOR: f64 = 1e-12;

/// Parts of the elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    /// The faces touch.
    Contact,
    /// Between the touching point and the anchor.
    Secant,
    /// At or beyond the anchor; all that the published law has.
    Envelope,
    /// Spent and open: free of stress.
    Free,
}

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

/// State of the normal jump at a point of the way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crack {
    pub regime: Regime,
    /// g.
    pub gap: f64,
    /// o.
    pub opening: f64,
    /// k.
    pub bridge: f64,
    /// B, on the envelope.
    pub stored: f64,
    /// q, slip in T and Z since the faces last touched.
    pub slip: f64,
    /// d has moved on the way.
    pub dilated: bool,
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
    /// Faces that just touch, without memory.
    pub fn closed(surface: &Surface) -> Crack {
        Crack {
            regime: Regime::Contact,
            gap: 0.0,
            opening: 0.0,
            bridge: surface.kn,
            stored: 0.0,
            slip: 0.0,
            dilated: false,
        }
    }

    /// At the start of an increment.
    pub fn of(surface: &Surface, old: &State) -> Crack {
        let mut crack = Crack::closed(surface);
        if !surface.closes {
            return Crack { regime: Regime::Envelope, ..crack };
        }
        let sigma = old.traction[N];
        crack.opening = old.own[OPENING];
        crack.slip = old.own[SLIP_OPEN];
        if crack.opening > 0.0 {
            crack.bridge = old.own[BRIDGE];
        }
        crack.gap = match sigma < 0.0 {
            true => sigma / surface.kn,
            false => (old.jump[N] - old.jump_plastic[N]).max(0.0),
        };
        crack.regime = if crack.gap <= 0.0 {
            Regime::Contact
        } else if surface.is_spent(old.own[WORK]) && sigma == 0.0 {
            Regime::Free
        } else if crack.gap >= crack.anchor(surface) * (1.0 - AT_ANCHOR) {
            crack.stored = crack.kept_at_anchor(surface).min(0.5 * sigma * crack.opening);
            Regime::Envelope
        } else {
            Regime::Secant
        };
        crack
    }

    /// A spent crack that is open where it carries nothing.
    pub fn spent(surface: &Surface, state: &State) -> Crack {
        let gap = state.jump[N] - state.jump_plastic[N];
        let closed = Crack::closed(surface);
        match state.traction[N] == 0.0 && gap > 0.0 {
            true => Crack { regime: Regime::Free, gap, opening: gap, bridge: 0.0, ..closed },
            false => closed,
        }
    }

    /// g_e.
    pub fn anchor(&self, surface: &Surface) -> f64 {
        if self.opening == 0.0 {
            return 0.0;
        }
        self.opening * surface.kn / (surface.kn - self.bridge).max(0.0)
    }

    /// B of k and o.
    pub fn kept_at_anchor(&self, surface: &Surface) -> f64 {
        if self.opening == 0.0 || self.bridge == 0.0 {
            return 0.0;
        }
        0.5 * self.bridge * self.anchor(surface) * self.opening
    }

    /// σ where B = ½ σ o.
    pub fn sigma_at_anchor(&self) -> f64 {
        2.0 * self.stored / self.opening
    }

    /// ψ_n.
    pub fn energy(&self, surface: &Surface, sigma: f64) -> f64 {
        match self.regime {
            Regime::Contact => 0.5 * sigma * sigma / surface.kn,
            Regime::Secant => 0.5 * sigma * self.gap,
            Regime::Envelope => 0.5 * sigma * sigma / surface.kn + self.stored,
            Regime::Free => 0.0,
        }
    }

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

    /// Slope of the elastic law in the direction of the way.
    pub fn slope(&self, surface: &Surface) -> f64 {
        match self.regime {
            Regime::Secant => self.bridge,
            Regime::Free => 0.0,
            Regime::Contact | Regime::Envelope => surface.kn,
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

    /// Faces that slide at σ = 0 go on as faces that touch, if the slip since they last did reaches up to the gap.
    fn may_ride(&self, surface: &Surface, work: f64) -> bool {
        surface.sigma_dil > 0.0
            && self.gap <= (self.opening * (1.0 + AT_ANCHOR)).min(RIDING_SLOPE * self.slip)
            && surface.at(work).fc > 0.0
    }

    /// The gap becomes dilation.
    fn ride(&mut self, surface: &Surface) {
        let left = self.opening - self.gap;
        self.opening = if left > AT_ANCHOR * self.gap { left } else { 0.0 };
        self.bridge = if self.opening == 0.0 { surface.kn } else { 0.0 };
        (self.regime, self.gap, self.dilated) = (Regime::Contact, 0.0, true);
    }

    /// B, no more than the anchor at the end allows, and the k that goes with it.
    pub fn keep(&mut self, surface: &Surface, stored: f64, sigma: f64) {
        self.stored = stored.min(0.5 * sigma * self.opening).max(0.0);
        if self.opening > 0.0 {
            let beta = 2.0 * self.stored / (self.opening * self.opening);
            self.bridge = beta * surface.kn / (surface.kn + beta);
        }
    }

    /// Nothing ties the faces any more.
    fn spend(&mut self, surface: &Surface) {
        (self.stored, self.slip) = (0.0, 0.0);
        if self.regime == Regime::Contact {
            (self.opening, self.bridge) = (0.0, surface.kn);
        } else {
            (self.regime, self.opening, self.bridge) = (Regime::Free, self.gap.max(0.0), 0.0);
        }
    }

    /// Writes what the law keeps.
    pub fn store(&self, surface: &Surface, state: &mut State) {
        if !surface.closes {
            return;
        }
        state.own[OPENING] = self.opening;
        state.own[BRIDGE] = if self.opening == 0.0 { surface.kn } else { self.bridge };
        state.own[SLIP_OPEN] = self.slip;
    }
}
