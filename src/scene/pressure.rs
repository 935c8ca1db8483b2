//! Pressure of a load: imposed, or that of steady flow along an interface.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::Value;
use super::expression::Expression;

/// Pressure of a load, positive against the body [stress].
#[derive(Debug, Clone, PartialEq)]
pub enum Pressure {
    /// A number or formula; in an interface also of `opening` and `damage`.
    Imposed(Value),
    /// Steady flow along an interface.
    Flow(Box<Flow>),
}

/// Steady flow along an interface between parallel plates, q = −w³/(12 μ) dp/ds for a unit thickness, with the aperture
/// w = w₀ + max(opening, 0).
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Flow {
    /// Aperture w₀ where the faces touch [length], above zero.
    pub aperture: f64,
    /// Dynamic viscosity μ of the water [stress × time], above zero.
    pub viscosity: f64,
    /// Pressures at s = 0 and s = 1: a number, a formula, `"wall"` (nothing flows through) or `"joined"` (one pressure with the
    /// interfaces with flow that meet there). Absent or null: joined.
    #[serde(default, skip_serializing_if = "are_joined")]
    pub ends: [Option<FlowEnd>; 2],
    /// Places with a given pressure, between which water goes out or comes in.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drains: Vec<Drain>,
}

/// A drain of an interface.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Drain {
    /// Its place as a fraction of the interface's length, above 0 and below 1.
    pub at: f64,
    /// Its pressure [stress].
    pub pressure: Value,
}

/// Condition of flow at an end of an interface.
#[derive(Debug, Clone, PartialEq)]
pub enum FlowEnd {
    /// A pressure [stress].
    Pressure(Value),
    /// Nothing flows through.
    Wall,
    /// One pressure with the interfaces that meet there.
    Joined,
}

const WALL: &str = "wall";
const JOINED: &str = "joined";

fn are_joined(ends: &[Option<FlowEnd>; 2]) -> bool {
    *ends == [None, None]
}

impl From<f64> for Pressure {
    fn from(value: f64) -> Pressure {
        Pressure::Imposed(value.into())
    }
}

/// A formula of a text, with the reader's words where it is none.
fn formula<E: de::Error>(text: &str) -> Result<Value, E> {
    Expression::parse(text).map(Value::from).map_err(|fault| E::custom(fault.what))
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FlowKey {
    flow: Flow,
}

struct PressureVisitor;

impl<'de> de::Visitor<'de> for PressureVisitor {
    type Value = Pressure;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, a formula such as \"9.81e-3*(60 - y)\", or { \"flow\": { … } }")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Pressure, E> {
        Ok(value.into())
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Pressure, E> {
        Ok((value as f64).into())
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Pressure, E> {
        Ok((value as f64).into())
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Pressure, E> {
        formula(text).map(Pressure::Imposed)
    }

    fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Pressure, A::Error> {
        let FlowKey { flow } = FlowKey::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Pressure::Flow(Box::new(flow)))
    }
}

impl<'de> Deserialize<'de> for Pressure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Pressure, D::Error> {
        deserializer.deserialize_any(PressureVisitor)
    }
}

impl Serialize for Pressure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeMap;
        match self {
            Pressure::Imposed(value) => value.serialize(serializer),
            Pressure::Flow(flow) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("flow", flow)?;
                map.end()
            }
        }
    }
}

impl JsonSchema for Pressure {
    fn schema_name() -> Cow<'static, str> {
        "Pressure".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (value, flow) = (generator.subschema_for::<Value>(), generator.subschema_for::<Flow>());
        json_schema!({
            "description": "A number or formula, in an interface also of opening and damage; or steady flow along an interface.",
            "anyOf": [
                value,
                { "type": "object", "properties": { "flow": flow }, "required": ["flow"], "additionalProperties": false }
            ]
        })
    }
}

struct FlowEndVisitor;

impl de::Visitor<'_> for FlowEndVisitor {
    type Value = FlowEnd;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a pressure (a number or formula), \"wall\" or \"joined\"")
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<FlowEnd, E> {
        Ok(FlowEnd::Pressure(value.into()))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<FlowEnd, E> {
        Ok(FlowEnd::Pressure((value as f64).into()))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<FlowEnd, E> {
        Ok(FlowEnd::Pressure((value as f64).into()))
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<FlowEnd, E> {
        match text {
            WALL => Ok(FlowEnd::Wall),
            JOINED => Ok(FlowEnd::Joined),
            text => formula(text).map(FlowEnd::Pressure),
        }
    }
}

impl<'de> Deserialize<'de> for FlowEnd {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<FlowEnd, D::Error> {
        deserializer.deserialize_any(FlowEndVisitor)
    }
}

impl Serialize for FlowEnd {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            FlowEnd::Pressure(value) => value.serialize(serializer),
            FlowEnd::Wall => serializer.serialize_str(WALL),
            FlowEnd::Joined => serializer.serialize_str(JOINED),
        }
    }
}

impl JsonSchema for FlowEnd {
    fn schema_name() -> Cow<'static, str> {
        "FlowEnd".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<Value>();
        json_schema!({
            "description": "A pressure (a number or formula), \"wall\" or \"joined\".",
            "anyOf": [value, { "enum": [WALL, JOINED] }]
        })
    }
}
