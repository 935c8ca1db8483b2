//! Damage along a straight way of the jump, and what it dissipates.
//!
//! ```text
//! D̂(r) = κ ξ/ε,  κ ξ + S(ξ) = ε      D = max(D, D̂ on the way)
//! Φ(D; B) = (G/a) (∫ S − ½ S ξ)      energy lost up to D at one mixity; Φ(1; B) = G
//! ∫ ½ e² dD ≈ ½ Σ Φ(D₂; B) − Φ(D₁; B) at the mixities at both ends of the growth: exact where these are one
//! ```
//!
//! Between its ends a way may have the largest D̂ where modes mix; it is looked for where D̂ falls at the end.

use super::super::local::{Local, LocalMatrix};
use super::mixed::Mixity;
use super::parameters::Cohesive;
use super::softening::SofteningCurve;

/// A point is on its surface up to this part of D.
const ON_SURFACE: f64 = 1e-12;
/// Halvings of a bracket.
const HALVINGS: usize = 100;
/// Places at which a rise of D̂ is looked for before a fall.
const SAMPLES: usize = 8;

/// A value and its gradient by the jump (n, t, s).
#[derive(Debug, Clone, Copy)]
pub(super) struct ByJump {
    pub value: f64,
    pub gradient: Local,
}

/// A place of the way: its fraction, jump, derivative of the jump there by that at the end, and mixity.
#[derive(Debug, Clone, Copy)]
pub(super) struct WayPlace {
    pub jump: Local,
    pub by_end: LocalMatrix,
    pub mixity: Mixity,
}

/// Growth of damage on a way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Growth {
    /// D at the end.
    pub damage: ByJump,
    /// Beginning and end of the growth.
    pub ends: [WayPlace; 2],
}

impl Cohesive {
    /// D̂ and its gradient at a mixity; zero below the onset.
    pub(super) fn driven(&self, curve: &SofteningCurve, at: &Mixity) -> ByJump {
        let strengths = self.strengths(at.share);
        let epsilon = (at.square * strengths.per_square).sqrt();
        if epsilon <= 1.0 {
            return ByJump { value: 0.0, gradient: Local::zeros() };
        }
        let kappa = strengths.energy * strengths.per_square / curve.area;
        let place = curve.at_jump(kappa, epsilon);
        if place.left <= 0.0 {
            return ByJump { value: 1.0, gradient: Local::zeros() };
        }
        let damage = kappa * place.xi / epsilon;
        // ½ d(e²)/e² + ½ dq/q, and dκ
        let by_mixity = 0.5 * strengths.per_square_slope / strengths.per_square;
        let d_epsilon = (at.half_gradient / at.square + at.gradient * by_mixity) * epsilon;
        let d_kappa = at.gradient
            * ((strengths.energy_slope * strengths.per_square
                + strengths.energy * strengths.per_square_slope)
                / curve.area);
        let d_xi = (d_epsilon - d_kappa * place.xi) / (kappa + place.slope);
        let gradient = (d_kappa * place.xi + d_xi * kappa - d_epsilon * damage) / epsilon;
        ByJump { value: damage, gradient }
    }

    /// ε − 1 where nothing is lost yet, else D̂ − D: above zero where damage grows.
    fn beyond(&self, curve: &SofteningCurve, jump: &Local, damage: f64) -> ByJump {
        let at = self.mixity(jump);
        if damage > 0.0 {
            let driven = self.driven(curve, &at);
            return ByJump { value: driven.value - damage, ..driven };
        }
        let strengths = self.strengths(at.share);
        let epsilon = (at.square * strengths.per_square).sqrt();
        if epsilon == 0.0 {
            return ByJump { value: -1.0, gradient: Local::zeros() };
        }
        let by_mixity = 0.5 * strengths.per_square_slope / strengths.per_square;
        let gradient = (at.half_gradient / at.square + at.gradient * by_mixity) * epsilon;
        ByJump { value: epsilon - 1.0, gradient }
    }

    /// Growth on the way from one jump to another; none where D stays.
    pub(super) fn growth(
        &self,
        curve: &SofteningCurve,
        [from, to]: [&Local; 2],
        damage: f64,
    ) -> Option<Growth> {
        if damage >= 1.0 {
            return None;
        }
        let change = to - from;
        let at = |part: f64| from + change * part;
        let at_end = self.mixity(to);
        let mut end = self.driven(curve, &at_end);
        let mut until = 1.0;
        let mut by_end = LocalMatrix::identity();
        if end.value > 0.0 && end.value < 1.0 && end.gradient.dot(&change) < 0.0 {
            // D̂ falls at the end: its peak within the way stays the peak as the end moves (envelope)
            let slope = |part: f64| self.driven(curve, &self.mixity(&at(part))).gradient.dot(&change);
            let rises = (0..SAMPLES).rev().map(|k| k as f64 / SAMPLES as f64).find(|part| slope(*part) > 0.0);
            if let Some(low) = rises {
                until = bisect([low, 1.0], |part| -slope(part));
                end = self.driven(curve, &self.mixity(&at(until)));
                end.gradient *= until;
                by_end *= until;
            }
        }
        if end.value <= damage * (1.0 + f64::EPSILON) {
            return None;
        }
        if end.value >= 1.0 {
            // lost altogether within the way
            let whole = |part: f64| self.driven(curve, &self.mixity(&at(part))).value - 1.0;
            until = if whole(0.0) >= 0.0 { 0.0 } else { bisect([0.0, 1.0], whole) };
            let gradient = self.driven(curve, &self.mixity(&at(until * (1.0 - 1e-9)))).gradient;
            by_end = moving(until, &change, &gradient);
        }
        let start = self.beyond(curve, from, damage);
        let on_surface = start.value >= -ON_SURFACE * damage.max(f64::EPSILON);
        let begins = if on_surface {
            0.0
        } else {
            bisect([0.0, until], |part| self.beyond(curve, &at(part), damage).value)
        };
        let by_begin = match begins > 0.0 {
            true => moving(begins, &change, &self.beyond(curve, &at(begins), damage).gradient),
            false => LocalMatrix::zeros(),
        };
        let place = |part: f64, by_end: LocalMatrix| {
            let jump = at(part);
            WayPlace { jump, by_end, mixity: self.mixity(&jump) }
        };
        Some(Growth { damage: end, ends: [place(begins, by_begin), place(until, by_end)] })
    }

    /// Fraction of the way to a jump at which damage begins to grow, 0 on the surface.
    pub(super) fn begins(&self, curve: &SofteningCurve, [from, to]: [&Local; 2], damage: f64) -> Option<f64> {
        let growth = self.growth(curve, [from, to], damage)?;
        let (change, reached) = (to - from, growth.ends[0].jump - from);
        Some((reached.norm() / change.norm()).min(1.0))
    }

    /// Φ at a mixity, with its derivatives by D and by B.
    pub(super) fn spent(&self, curve: &SofteningCurve, damage: f64, share: f64) -> [f64; 3] {
        let strengths = self.strengths(share);
        if damage <= 0.0 {
            return [0.0, 0.5 / strengths.per_square, 0.0];
        }
        let per_area = 1.0 / curve.area;
        let kappa = strengths.energy * strengths.per_square * per_area;
        let place = match damage < 1.0 {
            true => curve.at_damage(kappa, damage),
            false => return [strengths.energy, 0.0, strengths.energy_slope],
        };
        let (xi, left) = (place.xi, place.left);
        let part = per_area * (curve.area_to(xi) - 0.5 * left * xi);
        let epsilon = kappa * xi / damage;
        let kappa_slope = (strengths.energy_slope * strengths.per_square
            + strengths.energy * strengths.per_square_slope)
            * per_area;
        let xi_slope = -xi * (1.0 - damage) * kappa_slope / (kappa * (1.0 - damage) - damage * place.slope);
        let by_xi = per_area * 0.5 * (left - place.slope * xi);
        [
            strengths.energy * part,
            0.5 * epsilon * epsilon / strengths.per_square,
            strengths.energy_slope * part + strengths.energy * by_xi * xi_slope,
        ]
    }

    /// Energy that a growth of damage dissipates [stress × length], with its gradient by the jump at the end.
    pub(super) fn dissipated(&self, curve: &SofteningCurve, before: f64, growth: &Growth) -> ByJump {
        let Growth { damage, ends } = growth;
        let mut sum = ByJump { value: 0.0, gradient: Local::zeros() };
        for WayPlace { by_end, mixity, .. } in ends {
            let [lost, by_damage, by_share] = self.spent(curve, damage.value, mixity.share);
            let [lost_before, _, by_share_before] = self.spent(curve, before, mixity.share);
            sum.value += 0.5 * (lost - lost_before);
            let own = by_end.tr_mul(&mixity.gradient) * (by_share - by_share_before);
            sum.gradient += (damage.gradient * by_damage + own) * 0.5;
        }
        sum.value = sum.value.max(0.0);
        sum
    }
}

/// The root of what is below zero at the first end of a bracket and not at the second.
pub(super) fn bisect([mut low, mut high]: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if value(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Derivative of a place x of a way where a function keeps its value as the end moves: x I + Δ ⊗ ∇x, ∇x = −x g/(g · Δ).
fn moving(part: f64, change: &Local, gradient: &Local) -> LocalMatrix {
    let along = gradient.dot(change);
    let slope = if along != 0.0 { gradient * (-part / along) } else { Local::zeros() };
    LocalMatrix::identity() * part + change * slope.transpose()
}
