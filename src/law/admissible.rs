//! Parameters that no law point can follow are refused with the broken inequality and its numbers.

/// Parameters that no law point can follow: the inequality that is broken, with its numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{what}; {help}")]
pub struct Inadmissible {
    /// The key to blame.
    pub key: &'static str,
    /// The broken inequality with the numbers in it.
    pub what: String,
    /// The remedy.
    pub help: String,
}

/// `Err` with this key, fault and help.
pub(super) fn error_at<T>(
    key: &'static str,
    what: impl Into<String>,
    help: impl Into<String>,
) -> Result<T, Inadmissible> {
    Err(Inadmissible { key, what: what.into(), help: help.into() })
}

/// The value must be finite and zero or more.
pub(super) fn not_negative(key: &'static str, value: f64) -> Result<(), Inadmissible> {
    if value.is_finite() && value >= 0.0 {
        return Ok(());
    }
    error_at(key, format!("{key} = {value:e}"), "it must be zero or more")
}

/// The value must be finite and more than zero.
pub(super) fn positive(key: &'static str, value: f64) -> Result<(), Inadmissible> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    error_at(key, format!("{key} = {value:e}"), "it must be more than zero")
}
