//! The answer of a viscous step where friction lags: the surface of the old state, by its tangent as the flow sees it.
//!
//! ```text
//! |τ| ≤ Y₀ − a (σ − σ₀),   σ ≤ χ(W₀)        Y₀ = τ_y(σ₀; W₀),  a = f μ,  μ = −dτ_y/dσ = t (c − σ₀ t)/Y₀
//! ```
//!
//! A facet of slope a = f μ is associated with the law's own flow, m ∝ (f μ, 1): friction and strength lag by a step, dilatancy
//! does not. The answer is the nearest point of a convex set, so that a step of a whole interface has one answer whatever
//! the viscosity. A state that does not move lies inside the surface of the law itself.

use super::elastic::{compliant, stiff};
use nalgebra::SVector;

use super::super::local::{
    Local, LocalMatrix, N, across, along, diagonal, direction, narrow, shear, widen, widen_matrix,
};
use super::super::{Response, State};
use super::crack::Crack;
use super::flow::Answer;
use super::mode::Mode;
use super::prediction::Line;
use super::surface::Surface;
use super::variables::WORK;

/// Steepest facet: towards the vertex μ has no bound.
const STEEPEST: f64 = 1e3;

/// The convex set of one step.
struct Set {
    stiffness: [f64; 2],
    /// σ₀, Y₀ and a.
    from: [f64; 2],
    slope: f64,
    /// χ(W₀).
    chi: f64,
}

/// The part of its boundary that a trial returns to.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SetRegion {
    Inside,
    Facet,
    Cut,
    Corner,
}

impl Set {
    fn new(surface: &Surface, old: &State) -> Set {
        let now = surface.at(old.own[WORK]);
        let sigma = old.traction[N].min(now.chi);
        let limit = now.tau(sigma);
        let f = if sigma < 0.0 { surface.dilatancy(sigma).0 * now.fc } else { 1.0 };
        let steep = (now.t * (now.c - sigma * now.t) / limit).min(STEEPEST);
        let slope = if f == 0.0 { 0.0 } else { f * steep };
        Set { stiffness: [surface.kn, surface.kt], from: [sigma, limit], slope, chi: now.chi }
    }

    fn limit(&self, sigma: f64) -> f64 {
        self.from[1] - self.slope * (sigma - self.from[0])
    }

    /// The nearest traction of the set, in the measure of the compliance.
    fn nearest<const D: usize>(&self, trial: &SVector<f64, D>) -> (SVector<f64, D>, SetRegion) {
        let ([kn, kt], a, chi) = (self.stiffness, self.slope, self.chi);
        let (sigma, tau) = (trial[N], shear(trial));
        let excess = tau - self.limit(sigma);
        let slip = excess / (kt + a * a * kn);
        let by_facet = (sigma - kn * a * slip, tau - kt * slip);
        let corner = self.limit(chi);
        let (end, part) = if excess <= 0.0 && sigma <= chi {
            ((sigma, tau), SetRegion::Inside)
        } else if excess > 0.0 && by_facet.0 <= chi && by_facet.1 >= 0.0 {
            (by_facet, SetRegion::Facet)
        } else if tau <= corner {
            ((chi, tau), SetRegion::Cut)
        } else if corner >= 0.0 {
            ((chi, corner), SetRegion::Corner)
        } else {
            ((self.from[0] + self.from[1] / a, 0.0), SetRegion::Corner)
        };
        (along(end.0, end.1, &direction(trial)), part)
    }

    /// dt/dr, symmetric and never negative.
    fn tangent<const D: usize>(
        &self,
        part: SetRegion,
        trial: &SVector<f64, D>,
        end: &SVector<f64, D>,
    ) -> LocalMatrix {
        let ([kn, kt], a, e) = (self.stiffness, self.slope, direction(trial));
        let turned = if shear(trial) > 0.0 { kt * shear(end) / shear(trial) } else { 0.0 };
        let along_shear = e * e.transpose() * kt;
        let d = match part {
            SetRegion::Inside => diagonal(kn, kt),
            SetRegion::Facet => {
                let stiff = along(kn * a, kt, &e);
                let rest = along_shear + across(&e) * turned;
                diagonal(kn, 0.0) + rest - stiff * stiff.transpose() / (kt + a * a * kn)
            }
            SetRegion::Cut => diagonal(0.0, kt),
            SetRegion::Corner => across(&e) * turned,
        };
        widen_matrix(&d, if matches!(part, SetRegion::Inside | SetRegion::Cut) { kt } else { turned })
    }

    /// Fraction of a straight way at which the set is left; where the shear turns, of second order in its turn.
    fn exit<const D: usize>(&self, from: &SVector<f64, D>, to: &SVector<f64, D>) -> f64 {
        let over = |t: &SVector<f64, D>| [shear(t) - self.limit(t[N]), t[N] - self.chi];
        let share = |(a, b): (f64, f64)| if b > 0.0 { (a / (a - b)).clamp(0.0, 1.0) } else { 1.0 };
        over(from).into_iter().zip(over(to)).map(share).fold(1.0, f64::min)
    }
}

/// The answer at a jump from an old state. Where the surface has shrunk under that, its traction drops first.
pub(super) fn on_facet<const D: usize>(surface: &Surface, jump: Local, old: &State) -> Response {
    let mut set = Set::new(surface, old);
    let carried: SVector<f64, D> = narrow(&old.traction);
    let start = set.nearest(&carried).0;
    let change: SVector<f64, D> = narrow(&jump) - narrow(&old.jump);
    let mut trial = carried + stiff(surface, change);
    let was = Crack::of(surface, old);
    let by = Crack { gap: was.gap + change[N], ..was }.predict(surface, trial[N], change[N] >= 0.0);
    if by.line == Line::Secant {
        set.stiffness[N] = was.bridge; // the ties of an open crack
    }
    trial[N] = by.sigma;
    let (traction, part) = set.nearest(&trial);
    let (dropped, plastic) = (compliant(surface, carried - start), compliant(surface, trial - traction));
    let leaves = start + (trial - start) * set.exit(&start, &trial);
    let dissipation = 0.5 * ((carried + start).dot(&dropped) + (leaves + traction).dot(&(plastic - dropped)));
    let work = match traction[N] > 0.0 {
        true => dissipation,
        false => (shear(&traction) + traction[N] * surface.at(old.own[WORK]).t) * shear(&plastic),
    };
    let mode = match part {
        SetRegion::Inside => Mode::Elastic,
        _ if traction[N] > 0.0 => Mode::Tension,
        _ => Mode::Compression,
    };
    let mut state = State {
        jump,
        traction: widen(&traction),
        jump_plastic: old.jump_plastic + widen(&plastic),
        status: mode as u8,
        ..*old
    };
    state.own[WORK] = old.own[WORK] + work.max(0.0);
    let dissipation = match surface.closes {
        true => {
            let (sigma, work) = (traction[N], state.own[WORK]);
            let answer = Answer { mode, sigma, tau: shear(&traction), work };
            let crack = was.after(surface, &by, &answer, shear(&plastic));
            let d = if crack.dilated { jump[N] - crack.gap } else { old.jump_plastic[N] };
            state.jump_plastic[N] = d;
            crack.store(surface, &mut state);
            // ψ_n beside ½ σ²/K_N: what the ties take on the elastic way and do not keep is dissipated too
            let taken = was.trial_energy(surface, &by) - 0.5 * by.sigma * by.sigma / surface.kn;
            let kept = crack.energy(surface, sigma) - 0.5 * sigma * sigma / surface.kn;
            (dissipation + taken - kept).max(0.0)
        }
        false => dissipation,
    };
    Response {
        traction: state.traction,
        stiffness: set.tangent(part, &trial, &traction),
        state,
        dissipation,
        dissipation_gradient: Local::zeros(), // no path is followed in viscous steps
        damage_gradient: Local::zeros(),
        released: 0.0,
    }
}
