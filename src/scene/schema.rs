//! JSON Schema of scenes, from the types themselves, for editors.

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema};
use serde_json::json;

use super::Scene;

/// JSON Schema of the scene file.
pub fn scene_schema() -> serde_json::Value {
    schema_of::<Scene>()
}

/// JSON Schema of a file as editors show it best.
pub fn schema_of<File: JsonSchema>() -> serde_json::Value {
    let settings = SchemaSettings::draft2020_12().with_transform(Described);
    settings.into_generator().into_root_schema_for::<File>().to_value()
}

/// Descriptions beside a reference are of the key: some editors show that of the referenced type unless the reference stands in an `allOf`.
#[derive(Debug, Clone)]
struct Described;

impl Transform for Described {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        if schema.get("description").is_some()
            && let Some(reference) = schema.remove("$ref")
        {
            schema.insert("allOf".into(), json!([{ "$ref": reference }]));
        }
    }
}
