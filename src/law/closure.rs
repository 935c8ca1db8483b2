//! Hyperbolic closure of a joint: it gets stiffer as it closes, and cannot close further than V.
//!
//! ```text
//! σ = K u / (1 + u/V)           −V < u ≤ 0        x = 1 + u/V
//! dσ/du = K / x²                E = ∫ σ du = K V² (x − 1 − ln x)        u = σ / (K − σ/V)
//! between two jumps a, b:       (σ_b − σ_a) / (b − a) = K / (x_a x_b)
//!                               ∫ σ du / (b − a) = (K V / x_a) (a/V + φ(h)),   φ(h) = 1 − ln(1 + h)/h,  h = x_b/x_a − 1
//! ```
//!
//! The curve is Bandis's; not in the paper.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::admissible::{Inadmissible, error_at, positive};

/// φ is taken from its series for |h| below this, and so many terms of it.
const SERIES: f64 = 0.1;
const TERMS: i32 = 17;

/// Closure of a joint, in place of `normal_stiffness`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Closure {
    /// Normal stiffness K at no traction [stress / length].
    pub initial_stiffness: f64,
    /// Largest closure V [length]: no traction closes the joint so far.
    pub maximum: f64,
}

/// Normal springs of faces that touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Springs {
    /// One stiffness [stress / length].
    Linear(f64),
    /// Stiffer as they close.
    Closing(Closure),
}

impl Closure {
    /// Both numbers must be above zero.
    fn check(&self) -> Result<(), Inadmissible> {
        positive("closure.initial_stiffness", self.initial_stiffness)?;
        positive("closure.maximum", self.maximum)
    }

    /// 1 + u/V, above zero for a jump that can be; 1 or more for faces that are pulled.
    fn room(&self, u: f64) -> f64 {
        1.0 + u / self.maximum
    }
}

impl Springs {
    /// The springs of a law that states one of two keys.
    pub(super) fn of(normal_stiffness: Option<f64>, closure: Option<Closure>) -> Springs {
        match closure {
            Some(closure) => Springs::Closing(closure),
            None => Springs::Linear(normal_stiffness.unwrap_or_default()),
        }
    }

    /// Refuses both keys and none, and a closure that is none; the stiffness is the law's to check.
    pub(super) fn check(
        normal_stiffness: Option<f64>,
        closure: Option<Closure>,
        stiffness: impl Fn(&'static str, f64) -> Result<(), Inadmissible>,
    ) -> Result<(), Inadmissible> {
        match (normal_stiffness, closure) {
            (Some(normal), None) => stiffness("normal_stiffness", normal),
            (None, Some(closure)) => closure.check(),
            (None, None) => {
                error_at("normal_stiffness", "the law has no normal stiffness", "give it, or a \"closure\"")
            }
            (Some(_), Some(_)) => {
                let what = "closure and normal_stiffness are given";
                error_at("closure", what, "leave one out: the closure has a stiffness of its own")
            }
        }
    }

    /// Stiffness at no traction [stress / length].
    pub(super) fn initial(&self) -> f64 {
        match self {
            Springs::Linear(k) => *k,
            Springs::Closing(closure) => closure.initial_stiffness,
        }
    }

    /// The jump that faces cannot reach, −V; −∞ for linear springs [length].
    pub(super) fn narrowest(&self) -> f64 {
        match self {
            Springs::Linear(_) => f64::NEG_INFINITY,
            Springs::Closing(closure) => -closure.maximum,
        }
    }

    /// True if faces can be so near.
    pub(super) fn reach(&self, u: f64) -> bool {
        match self {
            Springs::Linear(_) => true,
            Springs::Closing(closure) => closure.room(u) > 0.0,
        }
    }

    /// Traction at a jump of either sign, and its slope; pulled springs have their stiffness at no traction.
    pub(super) fn answer(&self, u: f64) -> (f64, f64) {
        match self {
            Springs::Closing(closure) if u < 0.0 => {
                let x = closure.room(u);
                (closure.initial_stiffness * u / x, closure.initial_stiffness / (x * x))
            }
            _ => (self.initial() * u, self.initial()),
        }
    }

    /// Jump under a traction; none under none if there is no stiffness.
    pub(super) fn jump_under(&self, sigma: f64) -> f64 {
        match self {
            Springs::Linear(0.0) => 0.0,
            Springs::Closing(Closure { initial_stiffness, maximum }) if sigma < 0.0 => {
                sigma / (initial_stiffness - sigma / maximum)
            }
            _ => sigma / self.initial(),
        }
    }

    /// Energy stored under a traction [stress × length].
    pub(super) fn stored(&self, sigma: f64) -> f64 {
        let u = self.jump_under(sigma);
        match self {
            Springs::Closing(Closure { initial_stiffness, maximum }) if sigma < 0.0 => {
                initial_stiffness * maximum * bend(u / maximum).0 * u
            }
            _ => 0.5 * sigma * u,
        }
    }
}

/// φ(h) = 1 − ln(1 + h)/h and its derivative, h > −1.
pub(super) fn bend(h: f64) -> (f64, f64) {
    if h.abs() >= SERIES {
        let mean = h.ln_1p() / h;
        return (1.0 - mean, (mean - 1.0 / (1.0 + h)) / h);
    }
    // Σ (−1)^(k+1) h^k / (k + 1), from the last term down
    (1..=TERMS).rev().fold((0.0, 0.0), |(value, slope), k| {
        let factor = 1.0 / (k + 1) as f64;
        (h * (factor - value), factor - value - h * slope)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bend_is_one_function_on_both_sides_of_the_series() {
        for h in [-SERIES, SERIES] {
            let (outside, inside) = (bend(h), bend(h * (1.0 - f64::EPSILON)));
            assert!((outside.0 - inside.0).abs() < 1e-14 && (outside.1 - inside.1).abs() < 1e-13, "{h}");
        }
        // ∫ of σ from no traction, K = V = 1: x − 1 − ln x
        let exact = 0.25_f64 - 1.0 - 0.25_f64.ln();
        let springs = Springs::Closing(Closure { initial_stiffness: 1.0, maximum: 1.0 });
        assert!((springs.stored(-3.0) - exact).abs() < 1e-15);
        // and small: u²/2 − u³/3, of which the first digits would be lost in x − 1 − ln x
        let u = -1e-9_f64;
        let small = springs.stored(u / (1.0 + u)) / (0.5 * u * u * (1.0 - 2.0 / 3.0 * u));
        assert!((small - 1.0).abs() < 1e-15);
    }
}
