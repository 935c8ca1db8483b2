//! A column of history.csv: a probe, or a formula over the columns before it.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::expression::Expression;
use super::probe::Probe;
use super::{Scene, Variable};
use crate::error;

/// A column of history.csv, as written.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// A probe such as `joint.traction_t@0.5`.
    Probe(String),
    /// A formula over the names of the columns before it and load_factor.
    Formula(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FormulaKey {
    formula: String,
}

struct ColumnVisitor;

impl<'de> de::Visitor<'de> for ColumnVisitor {
    type Value = Column;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a probe such as \"joint.traction_t@0.5\", or { \"formula\": \"-(r1 + r2)\" }")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Column, E> {
        Ok(Column::Probe(text.into()))
    }

    fn visit_map<A: de::MapAccess<'de>>(self, map: A) -> Result<Column, A::Error> {
        let FormulaKey { formula } = FormulaKey::deserialize(MapAccessDeserializer::new(map))?;
        Ok(Column::Formula(formula))
    }
}

impl<'de> Deserialize<'de> for Column {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Column, D::Error> {
        deserializer.deserialize_any(ColumnVisitor)
    }
}

impl Serialize for Column {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeMap;
        match self {
            Column::Probe(text) => serializer.serialize_str(text),
            Column::Formula(text) => {
                let mut map = serializer.serialize_map(Some(1))?;
                map.serialize_entry("formula", text)?;
                map.end()
            }
        }
    }
}

impl JsonSchema for Column {
    fn schema_name() -> Cow<'static, str> {
        "Column".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A probe such as \"joint.traction_t@0.5\", or a formula over the names of columns before it and load_factor.",
            "anyOf": [
                { "type": "string" },
                {
                    "type": "object",
                    "properties": { "formula": { "type": "string" } },
                    "required": ["formula"],
                    "additionalProperties": false
                }
            ]
        })
    }
}

impl Scene {
    /// Refuses columns that ask for nothing.
    pub(super) fn check_columns(&self) -> error::Result<()> {
        let mut before: Vec<&str> = Vec::new();
        for (name, column) in &self.output.history {
            let path = ["output", "history", name];
            match column {
                Column::Probe(text) => {
                    Probe::parse(text, self)
                        .map_err(|(what, help)| self.source.error_at(&path, what, help))?;
                }
                Column::Formula(text) => {
                    let path = ["output", "history", name, "formula"];
                    let error_at = |what: String, help: &str| Err(self.source.error_at(&path, what, help));
                    let formula = match Expression::over(text, &before) {
                        Ok(formula) => formula,
                        Err(fault) => return error_at(fault.what, &fault.help),
                    };
                    let unknown =
                        |variable: &Variable| *variable != Variable::LoadFactor && formula.uses(*variable);
                    if let Some(variable) = Variable::ALL.iter().find(|variable| unknown(variable)) {
                        let what = format!("{} in \"{text}\", which is no column before it", variable.name());
                        return error_at(what, "a column has the names of those before it, and load_factor");
                    }
                }
            }
            before.push(name);
        }
        Ok(())
    }
}
