//! Softening curves: the share S of the strength that is left at a share ξ of the final crack opening.
//!
//! ```text
//! S(0) = 1, S falls, a = ∫ S dξ:   G = strength · final opening · a         exponential: S = e^{−ξ}, ξ = w · strength / G
//! κ ξ + S(ξ) = ε                   κ: final opening, ε: jump, over the jump at the strength; one root if κ > max |S'|
//! ```

use super::parameters::{NamedSoftening, Softening};
use crate::law::bounds::bounded;

/// A softening curve at hand.
#[derive(Debug, Clone, Copy)]
pub(super) struct SofteningCurve<'a> {
    form: CurveForm<'a>,
    /// a.
    pub area: f64,
}

#[derive(Debug, Clone, Copy)]
enum CurveForm<'a> {
    /// The knee, between (0, 1) and (1, 0).
    Knee((f64, f64)),
    Points(&'a [(f64, f64)]),
    Exponential,
}

/// ξ, S and S' at a point of a curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct CurvePlace {
    pub xi: f64,
    pub left: f64,
    pub slope: f64,
}

/// Iterations of Newton on the exponential curve, monotonic from its start.
const ITERATIONS: usize = 60;

impl<'a> SofteningCurve<'a> {
    /// A curve; the knee is that of `bilinear`.
    pub fn new(softening: &'a Softening, knee: (f64, f64)) -> SofteningCurve<'a> {
        let form = match softening {
            Softening::Named(NamedSoftening::Linear) => CurveForm::Knee((0.5, 0.5)),
            Softening::Named(NamedSoftening::Bilinear) => CurveForm::Knee(knee),
            Softening::Named(NamedSoftening::Exponential) => CurveForm::Exponential,
            Softening::Points(points) => CurveForm::Points(points),
        };
        let mut curve = SofteningCurve { form, area: 1.0 };
        if !matches!(form, CurveForm::Exponential) {
            curve.area = curve.segments().map(|[[x0, s0], [x1, s1]]| 0.5 * (s0 + s1) * (x1 - x0)).sum();
        }
        curve
    }

    /// The straight pieces, w from 0 to 1.
    fn segments(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        let (count, last) = match self.form {
            CurveForm::Knee(_) => (3, 1.0),
            CurveForm::Points(points) => (points.len(), points.last().map_or(1.0, |point| point.0)),
            CurveForm::Exponential => (0, 1.0),
        };
        let knot = move |k: usize| match self.form {
            CurveForm::Knee(knee) => [[0.0, 1.0], [knee.0, knee.1], [1.0, 0.0]][k],
            CurveForm::Points(points) => [points[k].0 / last, points[k].1],
            CurveForm::Exponential => [0.0, 1.0],
        };
        (1..count).map(move |k| [knot(k - 1), knot(k)])
    }

    /// max |S'|.
    pub fn steepest(&self) -> f64 {
        match self.form {
            CurveForm::Exponential => 1.0,
            _ => self.segments().map(|[[x0, s0], [x1, s1]]| (s0 - s1) / (x1 - x0)).fold(0.0, f64::max),
        }
    }

    /// ∫ S from 0 to ξ.
    pub fn area_to(&self, xi: f64) -> f64 {
        match self.form {
            CurveForm::Exponential => -(-xi).exp_m1(),
            _ => {
                let pieces = self.segments().map(|[[x0, s0], [x1, s1]]| {
                    let end = bounded(xi, x0, x1);
                    (end - x0) * (s0 + 0.5 * (s1 - s0) / (x1 - x0) * (end - x0))
                });
                pieces.sum()
            }
        }
    }

    /// The root of p ξ + q S(ξ) = r with p, q ≥ 0 that grows with r: `p ξ + q S` rises with ξ.
    fn root(&self, p: f64, q: f64, r: f64) -> CurvePlace {
        if let CurveForm::Exponential = self.form {
            // convex and rising where q ≥ 0, concave and rising where q ≤ 0: Newton from the far side falls on the root
            let mut xi = if q >= 0.0 { r / p } else { 0.0 };
            for _ in 0..ITERATIONS {
                let left = (-xi).exp();
                let step = (p * xi + q * left - r) / (p - q * left);
                let next = (xi - step).max(0.0);
                let done = next == xi || step.abs() <= 4.0 * f64::EPSILON * xi;
                xi = next;
                if done || !xi.is_finite() {
                    break;
                }
            }
            let left = (-xi).exp();
            return CurvePlace { xi, left, slope: -left };
        }
        for [[x0, s0], [x1, s1]] in self.segments() {
            if p * x1 + q * s1 >= r {
                let slope = (s1 - s0) / (x1 - x0);
                let xi = bounded(x0 + (r - p * x0 - q * s0) / (p + q * slope), x0, x1);
                return CurvePlace { xi, left: s0 + slope * (xi - x0), slope };
            }
        }
        CurvePlace { xi: (r / p).max(1.0), left: 0.0, slope: 0.0 }
    }

    /// κ ξ + S = ε for ε ≥ 1.
    pub fn at_jump(&self, kappa: f64, epsilon: f64) -> CurvePlace {
        self.root(kappa, 1.0, epsilon)
    }

    /// The place at which a share D < 1 of the stiffness is lost: κ ξ (1 − D) = D S.
    pub fn at_damage(&self, kappa: f64, damage: f64) -> CurvePlace {
        self.root(kappa * (1.0 - damage), -damage, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_has_its_area_and_its_roots() {
        let points = Softening::Points(vec![(0.0, 1.0), (0.1, 0.6), (0.3, 0.25), (0.8, 0.0)]);
        let named = [NamedSoftening::Linear, NamedSoftening::Bilinear, NamedSoftening::Exponential];
        for softening in named.map(Softening::Named).into_iter().chain([points]) {
            let curve = SofteningCurve::new(&softening, (0.25, 0.25));
            let end = if curve.area == 1.0 { 40.0 } else { 1.0 };
            assert!((curve.area_to(end) - curve.area).abs() < 1e-14, "{softening:?}");
            let kappa = 1.3 * curve.steepest();
            for k in 1..199 {
                let xi = end * (k as f64 / 199.0).powi(2);
                let left = (curve.area_to(xi + 1e-6) - curve.area_to(xi - 1e-6)) / 2e-6;
                let there = curve.at_jump(kappa, kappa * xi + left);
                assert!((there.xi - xi).abs() < 1e-8 * (1.0 + xi), "{softening:?} {xi} {}", there.xi);
                let damage = kappa * xi / (kappa * xi + there.left);
                if damage < 1.0 - 1e-9 {
                    let back = curve.at_damage(kappa, damage);
                    assert!((back.xi - xi).abs() < 1e-7 * (1.0 + xi), "{softening:?} {xi} {}", back.xi);
                }
            }
        }
    }
}
