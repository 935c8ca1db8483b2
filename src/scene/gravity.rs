//! Gravity of a step: one acceleration for all parts, or by part.

use std::borrow::Cow;
use std::fmt;

use indexmap::IndexMap;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::Value;

/// Acceleration (x, y) that acts on densities [length / time²].
#[derive(Debug, Clone, PartialEq)]
pub enum Gravity {
    /// On all of them.
    Everywhere([Value; 2]),
    /// By subdomain; one that is not named keeps what it has.
    Parts(IndexMap<String, [Value; 2]>),
}

impl Gravity {
    /// The acceleration of a subdomain, if the step states it.
    pub fn of(&self, subdomain: &str) -> Option<&[Value; 2]> {
        match self {
            Gravity::Everywhere(values) => Some(values),
            Gravity::Parts(parts) => parts.get(subdomain),
        }
    }

    /// All that are stated, each with the subdomain whose it is.
    pub fn all(&self) -> Vec<(Option<&str>, &[Value; 2])> {
        match self {
            Gravity::Everywhere(values) => vec![(None, values)],
            Gravity::Parts(parts) => {
                parts.iter().map(|(name, values)| (Some(name.as_str()), values)).collect()
            }
        }
    }
}

struct GravityVisitor;

impl<'de> de::Visitor<'de> for GravityVisitor {
    type Value = Gravity;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("two numbers or formulas such as [0, -9.81], or { subdomain or pattern: [x, y] }")
    }

    fn visit_seq<A: de::SeqAccess<'de>>(self, list: A) -> Result<Gravity, A::Error> {
        Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(Gravity::Everywhere)
    }

    fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Gravity, A::Error> {
        Deserialize::deserialize(MapAccessDeserializer::new(map)).map(Gravity::Parts)
    }
}

impl<'de> Deserialize<'de> for Gravity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Gravity, D::Error> {
        deserializer.deserialize_any(GravityVisitor)
    }
}

impl Serialize for Gravity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Gravity::Everywhere(values) => values.serialize(serializer),
            Gravity::Parts(parts) => parts.serialize(serializer),
        }
    }
}

impl JsonSchema for Gravity {
    fn schema_name() -> Cow<'static, str> {
        "Gravity".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let both = generator.subschema_for::<[Value; 2]>();
        json_schema!({
            "description": "Acceleration (x, y) that acts on every density, or by subdomain, names or patterns [length / time²].",
            "anyOf": [both, { "type": "object", "additionalProperties": both }]
        })
    }
}
