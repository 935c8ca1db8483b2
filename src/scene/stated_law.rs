//! The law of an interface as a scene states it: any of its numbers may be a formula of the place.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use serde_json::Value as Json;

use super::Value;
use super::expression::Expression;
use super::op::{FormulaPlace, Variable};
use crate::law::Law;

/// A law whose numbers may be formulas.
#[derive(Debug, Clone)]
pub struct StatedLaw {
    /// As it is written.
    written: Json,
    /// With numbers for its formulas.
    text: Json,
    /// The formulas, by the keys that lead to them.
    formulas: Vec<(Vec<String>, Value)>,
    /// The law, with 1 for every formula: what kind of law it is.
    kind: Law,
}

impl StatedLaw {
    /// The law with 1 for every formula: what kind of law it is, and the law itself where there are none.
    pub fn kind(&self) -> &Law {
        &self.kind
    }

    /// True if no number depends on the place.
    pub fn is_uniform(&self) -> bool {
        self.formulas.is_empty()
    }

    /// The key of the first formula that depends on a variable, with its text.
    pub fn using(&self, variable: Variable) -> Option<(String, String)> {
        let (keys, value) = self.formulas.iter().find(|(_, value)| value.uses(variable))?;
        Some((keys.join("."), value.to_string()))
    }

    /// Its formulas at a place; the key and the text of one that has no value there.
    pub fn numbers(&self, place: &FormulaPlace) -> Result<Vec<f64>, (String, String)> {
        let number = |(keys, value): &(Vec<String>, Value)| {
            let number = value.at(place);
            if number.is_finite() { Ok(number) } else { Err((keys.join("."), value.to_string())) }
        };
        self.formulas.iter().map(number).collect()
    }

    /// The law with these numbers for its formulas.
    pub fn with(&self, numbers: &[f64]) -> Result<Law, String> {
        let mut text = self.text.clone();
        for ((keys, _), number) in self.formulas.iter().zip(numbers) {
            let at = keys.iter().try_fold(&mut text, |below, key| match below {
                Json::Array(list) => list.get_mut(key.parse::<usize>().ok()?),
                other => other.get_mut(key),
            });
            if let Some(at) = at {
                *at = Json::from(*number);
            }
        }
        serde_json::from_value(text).map_err(|error| error.to_string())
    }
}

impl From<Law> for StatedLaw {
    fn from(kind: Law) -> StatedLaw {
        let text = serde_json::to_value(&kind).unwrap_or_default();
        StatedLaw { written: text.clone(), text, formulas: Vec::new(), kind }
    }
}

/// Takes the formulas out of a text and leaves 1 in their places. A text that is none is left where it is.
fn take_formulas(
    text: &mut Json,
    keys: &mut Vec<String>,
    found: &mut Vec<(Vec<String>, Value)>,
) -> Result<(), String> {
    match text {
        // the name of a law is none, also where it is that of a variable
        Json::String(_) if keys.last().is_some_and(|key| key == "type") => {}
        Json::String(word) => match Expression::parse(word) {
            Ok(expression) => {
                *text = Json::from(expression.constant().unwrap_or(1.0));
                if expression.constant().is_none() {
                    found.push((keys.clone(), expression.into()));
                }
            }
            // a word alone is a choice such as "linear"
            Err(fault) if word.chars().any(|c| !(c.is_ascii_alphabetic() || c == '_')) => {
                return Err(format!("{}: {}", keys.join("."), fault.what));
            }
            Err(_) => {}
        },
        Json::Array(list) => {
            for (k, item) in list.iter_mut().enumerate() {
                keys.push(k.to_string());
                take_formulas(item, keys, found)?;
                keys.pop();
            }
        }
        Json::Object(map) => {
            for (key, item) in map.iter_mut() {
                keys.push(key.clone());
                take_formulas(item, keys, found)?;
                keys.pop();
            }
        }
        _ => {}
    }
    Ok(())
}

impl<'de> Deserialize<'de> for StatedLaw {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<StatedLaw, D::Error> {
        let text = Json::deserialize(deserializer)?;
        let (mut ones, mut formulas) = (text.clone(), Vec::new());
        take_formulas(&mut ones, &mut Vec::new(), &mut formulas).map_err(de::Error::custom)?;
        let kind = serde_json::from_value(ones.clone()).map_err(de::Error::custom)?;
        // what varies is put into a text whose other numbers are numbers
        Ok(StatedLaw { written: text, text: ones, formulas, kind })
    }
}

impl Serialize for StatedLaw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.written.serialize(serializer)
    }
}

impl JsonSchema for StatedLaw {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Law".into()
    }

    /// That of a law, with a formula wherever it has a number.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let value = generator.subschema_for::<Value>();
        let mut own = SchemaGenerator::new(SchemaSettings::draft2020_12());
        let mut law = Law::json_schema(&mut own);
        let mut parts = own.take_definitions(true);
        for part in parts.values_mut() {
            allow_formulas(part, value.as_value());
        }
        generator.definitions_mut().extend(parts);
        let mut text = std::mem::take(law.ensure_object());
        let mut whole = Json::Object(std::mem::take(&mut text));
        allow_formulas(&mut whole, value.as_value());
        whole.try_into().unwrap_or_default()
    }
}

/// Puts the schema of a value where that of a number is; its description stays.
fn allow_formulas(schema: &mut Json, value: &Json) {
    match schema {
        Json::Object(map) if map.get("type").is_some_and(|kind| kind == "number") => {
            let mut with = map.clone();
            ["type", "format"].into_iter().for_each(|key| drop(with.remove(key)));
            if let Some(link) = value.get("$ref") {
                with.insert("$ref".into(), link.clone());
            }
            *map = with;
        }
        Json::Object(map)
            if map.get("type").is_some_and(|kind| *kind == Json::from(["number", "null"].as_slice())) =>
        {
            ["type", "format"].into_iter().for_each(|key| drop(map.remove(key)));
            map.insert(
                "anyOf".into(),
                Json::from(vec![value.clone(), serde_json::json!({ "type": "null" })]),
            );
        }
        Json::Object(map) => map.values_mut().for_each(|below| allow_formulas(below, value)),
        Json::Array(list) => list.iter_mut().for_each(|below| allow_formulas(below, value)),
        _ => {}
    }
}
