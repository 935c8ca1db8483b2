//! JSON and CSV.

use std::path::Path;

use serde::Serialize;

use crate::error::{Error, Result, clean};
use crate::files::write_whole;

/// Writes a value as indented JSON.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut text = serde_json::to_string_pretty(value).map_err(|error| Error::Io {
        action: "write",
        path: path.into(),
        source: std::io::Error::other(error),
    })?;
    text.push('\n');
    write_whole(path, text.as_bytes())
}

/// A field of a CSV file: one with a comma, quote or line break is quoted, control characters are replaced.
pub fn csv_field(text: &str) -> String {
    let text = clean(text);
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into_owned()
    }
}
