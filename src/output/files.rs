//! JSON and CSV.

use std::path::Path;

use serde::Serialize;

use crate::error::{Error, Result, clean};
use crate::files::write_whole_by;

/// Writes a value as indented JSON.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    write_whole_by(path, |file| {
        let written = serde_json::to_writer_pretty(&mut *file, value).map_err(std::io::Error::from);
        written.and_then(|()| file.write_all(b"\n")).map_err(Error::io("write", path))
    })
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
