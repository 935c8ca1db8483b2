//! Slip in one direction along a straight way.
//!
//! ```text
//! e(s) = r(s) − r^p at the start      that nothing had slipped; a = d K_T ė_t, b = ė_n
//! y = e_n − tanψ λ                    what is left of the normal jump after a slip λ
//! F(s, λ) = d K_T e_t − K_T λ + μ f(y) − c = 0          f: the normal springs, concave; λ(s) while it grows
//! λ̇ = (a + μ f′(y) b) / (K_T + μ f′(y) tanψ)           ẏ = (K_T b − tanψ a) / (K_T + μ f′(y) tanψ): of one sign
//! slip stops    f′(y) = −a / (μ b)                       for good: f′ goes on as y does
//! ∫ σ dλ = Δs (a [E] + μ b [f] (f_0 + f_1)/2) / (K_T + μ [f] tanψ)      [ ] over y: mean of f, and its slope
//! ```
//!
//! Linear springs: f′ = K_N, everything is linear in s and slip does not stop.

use super::Coulomb;
use super::jet::Jet;
use super::normal::{mean, secant, traction};
use crate::law::closure::{Closure, Springs};
use crate::law::local::{N, T};

/// Slip in the direction d = ±1 under the law's friction.
pub(super) struct Slide<'a> {
    pub law: &'a Coulomb,
    pub direction: f64,
}

/// A place on a way where slip has come so far.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slipped {
    /// Fraction of the way.
    pub s: Jet,
    /// λ.
    pub slip: Jet,
    /// y.
    pub left: Jet,
}

/// r − r^p at the start and at the end of a way.
pub(super) type WayEnds = [[Jet; 2]; 2];

/// e at a fraction of a way.
pub(super) fn at([from, to]: &WayEnds, s: Jet) -> [Jet; 2] {
    [N, T].map(|i| from[i] + s * (to[i] - from[i]))
}

impl Slide<'_> {
    fn springs(&self) -> Springs {
        self.law.normal()
    }

    /// d K_T e_t − c.
    fn shear(&self, elastic: &[Jet; 2]) -> Jet {
        self.direction * self.law.tangential_stiffness * elastic[T] - self.law.cohesion
    }

    /// F with no slip: d τ + μ σ − c.
    pub(super) fn excess(&self, elastic: &[Jet; 2]) -> Jet {
        self.shear(elastic) + self.law.friction_coefficient * traction(&self.springs(), elastic[N])
    }

    /// K_T e_n − tanψ (d K_T e_t − c), of the sign of y; linear in e.
    pub(super) fn parting(&self, elastic: &[Jet; 2]) -> Jet {
        self.law.tangential_stiffness * elastic[N] - self.law.dilatancy * self.shear(elastic)
    }

    /// λ and y on the surface.
    ///
    /// ```text
    /// K_T y + tanψ μ f(y) = K_T e_n − tanψ (d K_T e_t − c)
    /// ```
    pub(super) fn slipped(&self, s: Jet, elastic: &[Jet; 2]) -> Slipped {
        let Coulomb { tangential_stiffness: kt, friction_coefficient: mu, dilatancy: psi, .. } = *self.law;
        let springs = self.springs();
        let left = match springs {
            Springs::Linear(kn) => {
                let slip = (1.0 / (kt + mu * kn * psi)) * self.excess(elastic);
                return Slipped { s, slip, left: elastic[N] - psi * slip };
            }
            Springs::Closing(_) if psi == 0.0 => elastic[N],
            Springs::Closing(Closure { initial_stiffness: k, maximum }) => {
                let right = self.parting(elastic);
                let root = least_closed(kt, psi * mu * k, maximum, right.value);
                let (sigma, slope) = springs.answer(root);
                let off = Jet::from(kt * root + psi * mu * sigma) - right;
                Jet::from(root) - (1.0 / (kt + psi * mu * slope)) * off
            }
        };
        let slip = (1.0 / kt) * (self.shear(elastic) + mu * traction(&springs, left));
        Slipped { s, slip, left }
    }

    /// σ there.
    pub(super) fn sigma(&self, there: &Slipped) -> Jet {
        traction(&self.springs(), there.left)
    }

    /// c − μ σ.
    pub(super) fn limit(&self, sigma: Jet) -> Jet {
        Jet::from(self.law.cohesion) - self.law.friction_coefficient * sigma
    }

    /// Δr^p of a slip.
    pub(super) fn irreversible(&self, slip: Jet) -> [Jet; 2] {
        [self.law.dilatancy * slip, self.direction * slip]
    }

    /// a and b.
    fn rates(&self, [from, to]: &WayEnds) -> [Jet; 2] {
        [self.direction * self.law.tangential_stiffness * (to[T] - from[T]), to[N] - from[N]]
    }

    /// λ̇ without its denominator, at a normal jump.
    fn rate(&self, ends: &WayEnds, left: f64) -> f64 {
        let [a, b] = self.rates(ends);
        a.value + self.law.friction_coefficient * self.springs().answer(left).1 * b.value
    }

    /// The first s at which F with this much slip rises above zero, if it does before the end.
    pub(super) fn rise(&self, ends: &WayEnds, slip: Jet) -> Option<Jet> {
        let moved = self.irreversible(slip);
        let ends = &ends.map(|end| [N, T].map(|i| end[i] - moved[i]));
        let [from, to] = ends.map(|end| self.excess(&end));
        if matches!(self.springs(), Springs::Linear(_)) {
            return rise(from, to);
        }
        if from.value >= 0.0 && self.springs().reach(ends[0][N].value) {
            return (to.value > 0.0 || self.rate(ends, ends[0][N].value) > 0.0).then(|| 0.0.into());
        }
        let s = self.crossing(ends).or((to.value > 0.0).then_some(1.0))?;
        let there = at(ends, s.into());
        let rate = self.rate(ends, there[N].value);
        (rate > 0.0).then(|| Jet::from(s) - (1.0 / rate) * self.excess(&there))
    }

    /// The first root of F (1 + e_n/V), a parabola in s.
    fn crossing(&self, ends: &WayEnds) -> Option<f64> {
        let Springs::Closing(Closure { initial_stiffness, maximum }) = self.springs() else { return None };
        let [a, b] = self.rates(ends).map(|rate| rate.value);
        let k = self.law.friction_coefficient * initial_stiffness;
        let (room, widens) = (1.0 + ends[0][N].value / maximum, b / maximum);
        let (excess, shear) = (self.excess(&ends[0]).value, self.shear(&ends[0]).value);
        let roots = parabola(excess * room, a * room + shear * widens + k * b, a * widens);
        let inside = |s: &f64| (0.0..=1.0).contains(s) && room + s * widens > 0.0;
        roots.into_iter().filter(inside).min_by(f64::total_cmp)
    }

    /// The place between two others where slip stops, if it does.
    pub(super) fn stop(&self, ends: &WayEnds, start: Jet, last: &Slipped) -> Option<Slipped> {
        let Springs::Closing(Closure { initial_stiffness, maximum }) = self.springs() else { return None };
        let [a, b] = self.rates(ends);
        if self.rate(ends, last.left.value) >= 0.0 || a.value * b.value >= 0.0 {
            return None;
        }
        let Coulomb { tangential_stiffness: kt, friction_coefficient: mu, dilatancy: psi, .. } = *self.law;
        let room = (Jet::from(0.0) - (mu * initial_stiffness) * b / a).sqrt();
        let left = maximum * (room - 1.0);
        let away = left - ends[0][N];
        let over = Jet::from(0.0) - mu * traction(&self.springs(), left) - self.shear(&ends[0]);
        // b s − tanψ λ = y − e_n,  a s − K_T λ = −μ f(y) − (d K_T e_t − c)
        let whole = kt * b - psi * a;
        let (s, slip) = ((kt * away - psi * over) / whole, (a * away - b * over) / whole);
        (s.value < last.s.value).then(|| Slipped { s: s.max(start), slip: slip.max(0.0.into()), left })
    }

    /// Energy dissipated by slip from one place to another: slip times the mean of c + |σ| (μ − tanψ).
    pub(super) fn dissipation(&self, ends: &WayEnds, start: &Slipped, end: &Slipped) -> Jet {
        let Coulomb { tangential_stiffness: kt, friction_coefficient: mu, dilatancy: psi, .. } = *self.law;
        let [from, to] = [start, end].map(|place| self.sigma(place));
        let slip = end.slip - start.slip;
        let springs = self.springs();
        let worked = match springs {
            Springs::Linear(_) => slip * (0.5 * (from + to)),
            Springs::Closing(_) => {
                let [a, b] = self.rates(ends);
                let slope = secant(&springs, start.left, end.left);
                let work = a * mean(&springs, start.left, end.left) + (0.5 * mu) * b * slope * (from + to);
                (end.s - start.s) * work / ((mu * psi) * slope + kt)
            }
        };
        self.law.cohesion * slip - (mu - psi) * worked
    }
}

/// The s at which a quantity linear in it rises above zero, if it does before the end.
pub(super) fn rise(from: Jet, to: Jet) -> Option<Jet> {
    if to.value <= 0.0 {
        return None;
    }
    Some(if from.value < 0.0 { from / (from - to) } else { 0.0.into() })
}

/// The y > −V with k y + q y/(1 + y/V) = right, k and q not below zero.
fn least_closed(k: f64, q: f64, maximum: f64, right: f64) -> f64 {
    if right >= 0.0 {
        return right / (k + q);
    }
    let linear = k + q - right / maximum;
    let root = (linear * linear + 4.0 * k / maximum * right).max(0.0).sqrt();
    2.0 * right / (linear + root)
}

/// Roots of p0 + p1 s + p2 s².
fn parabola(p0: f64, p1: f64, p2: f64) -> [f64; 2] {
    let root = (p1 * p1 - 4.0 * p0 * p2).sqrt();
    let q = -0.5 * (p1 + root.copysign(p1));
    [q / p2, p0 / q]
}
