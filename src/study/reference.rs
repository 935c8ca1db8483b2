//! References of measures: a number, or the limit of ever finer runs and how uncertain it is.
//!
//! ```text
//!   v(h) = v₀ + C h^p,  h → h/r:   r^p = (v₂ − v₁)/(v₃ − v₂),   v₀ = v₃ + (v₃ − v₂)/(r^p − 1)      (Richardson)
//! ```

use serde::{Deserialize, Serialize};

/// Stand-in for the exact value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// The value.
    pub value: f64,
    /// Its uncertainty; 0 for a number that the study gives.
    pub uncertainty: f64,
    /// Order of convergence that the last three runs show; absent where they show none.
    pub order: Option<f64>,
}

/// Errors within this many uncertainties of the reference say nothing.
pub const FLOOR: f64 = 3.0;
/// Orders beyond are chance.
const ORDERS: std::ops::RangeInclusive<f64> = 0.3..=8.0;

impl Limit {
    /// A number that is exact.
    pub(super) fn exact(value: f64) -> Limit {
        Limit { value, uncertainty: 0.0, order: None }
    }

    /// The limit of values of ever finer runs, each `ratio` times finer than the one before. Where they converge with an
    /// order it is extrapolated, uncertain by the last step of the extrapolation; else it is the finest, uncertain by
    /// its distance from the one before.
    pub(super) fn of(values: &[f64], ratio: f64) -> Option<Limit> {
        if !values.iter().all(|value| value.is_finite()) {
            return None;
        }
        let extrapolated = |three: &[f64]| {
            let [before, last] = [three[1] - three[0], three[2] - three[1]];
            let order = (before / last).ln() / ratio.ln();
            ORDERS.contains(&order).then(|| (three[2] + last / (before / last - 1.0), order))
        };
        match values {
            [] => None,
            [only] => Some(Limit { value: *only, uncertainty: f64::INFINITY, order: None }),
            [.., before, last] => {
                let plain = Limit { value: *last, uncertainty: (last - before).abs(), order: None };
                let three = values.windows(3).next_back().and_then(extrapolated);
                Some(three.map_or(plain, |(value, order)| Limit {
                    value,
                    uncertainty: (value - last).abs(),
                    order: Some(order),
                }))
            }
        }
    }

    /// |value − reference| / |reference|.
    pub fn error(&self, value: f64) -> f64 {
        let scale = if self.value == 0.0 { 1.0 } else { self.value.abs() };
        (value - self.value).abs() / scale
    }

    /// Relative error below which the reference decides nothing.
    pub fn floor(&self) -> f64 {
        FLOOR * self.error(self.value + self.uncertainty)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_of_h_is_extrapolated_exactly() {
        let v = |h: f64| 7.0 - 0.3 * h.powf(1.7);
        let limit = Limit::of(&[v(1.0), v(0.5), v(0.25)], 2.0).unwrap();
        assert!((limit.value - 7.0).abs() < 1e-13 && (limit.order.unwrap() - 1.7).abs() < 1e-12);
        assert!((limit.uncertainty - 0.3 * 0.25_f64.powf(1.7)).abs() < 1e-13);
        assert!((limit.floor() - 3.0 * limit.uncertainty / 7.0).abs() < 1e-13);
    }

    #[test]
    fn what_does_not_converge_keeps_its_finest_value() {
        let limit = Limit::of(&[1.0, 1.2, 1.1], 2.0).unwrap();
        assert_eq!((limit.value, limit.order), (1.1, None));
        assert!((limit.uncertainty - 0.1).abs() < 1e-15);
        assert_eq!(Limit::of(&[1.0, f64::NAN, 1.0], 2.0), None);
        assert_eq!(Limit::of(&[], 2.0), None);
    }
}
