//! JSON Schema of scenes, from the types themselves, for editors.

use super::Scene;

/// The schema of a scene file.
pub fn scene_schema() -> serde_json::Value {
    schemars::schema_for!(Scene).to_value()
}
