//! A number of the scene: itself, or a formula in x, y, s and load_factor.

use std::{fmt, sync::Arc};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::expression::Expression;
use super::op::{FormulaPlace, Variable};

/// A number, or the text of a formula such as `"5*cos(pi*x)"`.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// The same everywhere.
    Number(f64),
    /// A formula.
    Expression(Arc<Expression>),
}

impl Value {
    /// The value at a place; not finite where a formula is not defined.
    pub fn at(&self, place: &FormulaPlace) -> f64 {
        match self {
            Value::Number(value) => *value,
            Value::Expression(expression) => expression.at(place),
        }
    }

    /// Its derivative by a variable at a place.
    pub fn derivative(&self, place: &FormulaPlace, by: Variable) -> f64 {
        match self {
            Value::Number(_) => 0.0,
            Value::Expression(expression) => expression.derivative(place, by),
        }
    }

    /// The value if it is the same everywhere and always.
    pub fn constant(&self) -> Option<f64> {
        match self {
            Value::Number(value) => Some(*value),
            Value::Expression(expression) => expression.constant(),
        }
    }

    /// True if it is the number 0.
    pub fn is_zero(&self) -> bool {
        *self == Value::Number(0.0)
    }

    /// True if the value is affine in a variable.
    pub fn is_affine_in(&self, variable: Variable) -> bool {
        match self {
            Value::Number(_) => true,
            Value::Expression(expression) => expression.is_affine_in(variable),
        }
    }

    /// True if the value depends on a variable.
    pub fn uses(&self, variable: Variable) -> bool {
        match self {
            Value::Number(_) => false,
            Value::Expression(expression) => expression.uses(variable),
        }
    }
}

impl Default for Value {
    fn default() -> Value {
        Value::Number(0.0)
    }
}

impl From<Expression> for Value {
    fn from(expression: Expression) -> Value {
        Value::Expression(Arc::new(expression))
    }
}

impl From<f64> for Value {
    fn from(value: f64) -> Value {
        Value::Number(value)
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(value) => write!(f, "{value}"),
            Value::Expression(expression) => write!(f, "\"{}\"", expression.text()),
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Value::Number(value) => serializer.serialize_f64(*value),
            Value::Expression(expression) => serializer.serialize_str(expression.text()),
        }
    }
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(NumberOrText)
    }
}

struct NumberOrText;

impl de::Visitor<'_> for NumberOrText {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a formula such as \"5*cos(pi*x)\"")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Value, E> {
        Ok(Value::Number(value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Value, E> {
        match Expression::parse(text) {
            Ok(expression) => Ok(Value::Expression(Arc::new(expression))),
            Err(fault) => Err(E::custom(fault.what)), // the reader, which has the text, adds place and help
        }
    }
}

impl JsonSchema for Value {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Value".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "type": ["number", "string"],
            "description": "A number, or a formula in x, y, z, s (0…1 along the group), load_factor (0…1 within the step), \
                            pi and e, such as \"5*cos(pi*x)\"."
        })
    }
}
