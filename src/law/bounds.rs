//! Bounds of a number that may be none: no number stays none, and bounds that are none do not bound.

/// x between two bounds. Unlike `f64::clamp` it never panics: numbers that have left their range end in a law's own checks.
#[inline]
pub(super) fn bounded(x: f64, low: f64, high: f64) -> f64 {
    let above = if x < low { low } else { x };
    if above > high { high } else { above }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_that_of_the_library_and_never_panics() {
        for x in [-1.0, -0.0, 0.0, 0.3, 1.0, 2.0, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(bounded(x, 0.0, 1.0).to_bits(), x.clamp(0.0, 1.0).to_bits(), "{x}");
        }
        assert!(bounded(f64::NAN, 0.0, 1.0).is_nan());
        assert_eq!(bounded(0.5, f64::NAN, f64::NAN), 0.5);
        assert_eq!(bounded(0.5, 1.0, 0.0), 0.0);
    }
}
