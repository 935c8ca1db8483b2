//! The answer of a viscous step where friction lags: the surface of the old state, by its tangent as the flow sees it.
//!
//! ```text
//! |τ| ≤ Y₀ − a (σ − σ₀),   σ ≤ χ(W₀)        Y₀ = τ_y(σ₀; W₀),  a = f μ,  μ = −dτ_y/dσ = t (c − σ₀ t)/Y₀
//! ```
//!
//! A facet of slope a = f μ is associated with the law's own flow, m ∝ (f μ, 1): friction and strength lag by a step, dilatancy
//! does not. The answer is the nearest point of a convex set, so that a step of a whole interface has one answer whatever
//! the viscosity. A state that does not move lies inside the surface of the law itself.

use super::march::{compliant, stiff};
use nalgebra::{Matrix2, Vector2};

use super::super::{Response, State};
use super::flow::Mode;
use super::surface::Surface;

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
        let now = surface.at(old.fracture_work);
        let sigma = old.traction.x.min(now.chi);
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
    fn nearest(&self, trial: Vector2<f64>) -> (Vector2<f64>, SetRegion) {
        let ([kn, kt], a, chi) = (self.stiffness, self.slope, self.chi);
        let (sigma, tau) = (trial.x, trial.y.abs());
        let excess = tau - self.limit(sigma);
        let slip = excess / (kt + a * a * kn);
        let by_facet = Vector2::new(sigma - kn * a * slip, tau - kt * slip);
        let corner = self.limit(chi);
        let (end, part) = if excess <= 0.0 && sigma <= chi {
            (Vector2::new(sigma, tau), SetRegion::Inside)
        } else if excess > 0.0 && by_facet.x <= chi && by_facet.y >= 0.0 {
            (by_facet, SetRegion::Facet)
        } else if tau <= corner {
            (Vector2::new(chi, tau), SetRegion::Cut)
        } else if corner >= 0.0 {
            (Vector2::new(chi, corner), SetRegion::Corner)
        } else {
            (Vector2::new(self.from[0] + self.from[1] / a, 0.0), SetRegion::Corner)
        };
        (Vector2::new(end.x, end.y.copysign(trial.y)), part)
    }

    /// dt/dr, symmetric and never negative.
    fn tangent(&self, part: SetRegion, sign: f64) -> Matrix2<f64> {
        let ([kn, kt], a) = (self.stiffness, self.slope);
        match part {
            SetRegion::Inside => Matrix2::new(kn, 0.0, 0.0, kt),
            SetRegion::Facet => {
                let stiff = Vector2::new(kn * a, kt * sign);
                Matrix2::new(kn, 0.0, 0.0, kt) - stiff * stiff.transpose() / (kt + a * a * kn)
            }
            SetRegion::Cut => Matrix2::new(0.0, 0.0, 0.0, kt),
            SetRegion::Corner => Matrix2::zeros(),
        }
    }

    /// Fraction of a straight way at which the set is left.
    fn exit(&self, from: Vector2<f64>, to: Vector2<f64>) -> f64 {
        let over = |t: Vector2<f64>| [t.y.abs() - self.limit(t.x), t.x - self.chi];
        let share = |(a, b): (f64, f64)| if b > 0.0 { (a / (a - b)).clamp(0.0, 1.0) } else { 1.0 };
        over(from).into_iter().zip(over(to)).map(share).fold(1.0, f64::min)
    }
}

/// The answer at a jump from an old state. Where the surface has shrunk under that, its traction drops first.
pub(super) fn on_facet(surface: &Surface, jump: Vector2<f64>, old: &State) -> Response {
    let set = Set::new(surface, old);
    let start = set.nearest(old.traction).0;
    let trial = old.traction + stiff(surface, jump - old.jump);
    let (traction, part) = set.nearest(trial);
    let (dropped, plastic) = (compliant(surface, old.traction - start), compliant(surface, trial - traction));
    let leaves = start + set.exit(start, trial) * (trial - start);
    let dissipation =
        0.5 * ((old.traction + start).dot(&dropped) + (leaves + traction).dot(&(plastic - dropped)));
    let work = match traction.x > 0.0 {
        true => dissipation,
        false => (traction.y.abs() + traction.x * surface.at(old.fracture_work).t) * plastic.y.abs(),
    };
    let mode = match part {
        SetRegion::Inside => Mode::Elastic,
        _ if traction.x > 0.0 => Mode::Tension,
        _ => Mode::Compression,
    };
    Response {
        traction,
        stiffness: set.tangent(part, 1.0_f64.copysign(trial.y)),
        state: State {
            jump,
            traction,
            jump_plastic: old.jump_plastic + plastic,
            fracture_work: old.fracture_work + work.max(0.0),
            status: mode as u8,
        },
        dissipation,
        dissipation_gradient: Vector2::zeros(), // no path is followed in viscous steps
        released: 0.0,
    }
}
