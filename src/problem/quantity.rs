//! A number of the scene with the key it stands at, so that a formula that has no value somewhere is refused there.

use crate::error::{At, Error, Result};
use crate::scene::{FormulaPlace, Scene, Value, Variable};

/// A number or formula with its key.
#[derive(Debug, Clone)]
pub(super) struct Quantity {
    value: Value,
    /// Its key; numbers need none.
    key: Option<Box<At>>,
}

impl Quantity {
    /// The quantity at a key.
    pub(super) fn new(scene: &Scene, path: &[&str], value: &Value) -> Quantity {
        match value.constant() {
            Some(number) => Quantity::number(number),
            None => Quantity { value: value.clone(), key: Some(Box::new(scene.source.at(path))) },
        }
    }

    /// A plain number.
    pub(super) fn number(value: f64) -> Quantity {
        Quantity { value: Value::Number(value), key: None }
    }

    /// Its value if that is the same everywhere and always.
    pub(super) fn constant(&self) -> Option<f64> {
        self.value.constant()
    }

    /// True if it depends on a variable.
    pub(super) fn uses(&self, variable: Variable) -> bool {
        self.value.uses(variable)
    }

    /// True if it is affine in the load factor.
    pub(super) fn is_affine(&self) -> bool {
        self.value.is_affine_in(Variable::LoadFactor)
    }

    /// Its value at a place, which must be finite.
    pub(super) fn at(&self, place: &FormulaPlace) -> Result<f64> {
        let value = self.value.at(place);
        if value.is_finite() {
            return Ok(value);
        }
        let used = Variable::ALL
            .into_iter()
            .filter(|variable| matches!(variable, Variable::X | Variable::Y) || self.uses(*variable));
        let at: Vec<String> =
            used.map(|variable| format!("{} = {}", variable.name(), place.value(variable))).collect();
        let what = format!("{} is {value} at {}", self.value, at.join(", "));
        Err(self
            .error_at(what, "it must be finite wherever it acts; if(condition, a, b) chooses between two"))
    }

    /// Its derivative by a variable at a place.
    pub(super) fn derivative(&self, place: &FormulaPlace, by: Variable) -> f64 {
        self.value.derivative(place, by)
    }

    /// Refuses it with its key.
    pub(super) fn error_at(&self, what: impl Into<String>, help: impl Into<String>) -> Error {
        Error::Text { at: self.key.clone().unwrap_or_default(), what: what.into(), help: help.into() }
    }

    /// Refuses s where a group has none; `why` says what the group is.
    pub(super) fn error_at_s(&self, why: &str) -> Error {
        let what = format!("s in {}, but {why}", self.value);
        self.error_at(what, "s runs along one open curve; write it in x and y")
    }
}
