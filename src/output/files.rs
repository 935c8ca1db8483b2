//! Files that are whole or absent.

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use crate::error::{Error, Result};

/// Writes a file aside and renames it into place; makes the folder if needed.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
    let mut file =
        tempfile::Builder::new().prefix(".writing-").tempfile_in(folder).map_err(Error::io("write", path))?;
    file.write_all(content).map_err(Error::io("write", path))?;
    readable(&file).map_err(Error::io("write", path))?;
    file.persist(path).map_err(|error| Error::Io {
        action: "write",
        path: path.into(),
        source: error.error,
    })?;
    Ok(())
}

/// Temporary files are private; results are for everybody whom the umask would let read them.
#[cfg(unix)]
fn readable(file: &tempfile::NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable(_: &tempfile::NamedTempFile) -> std::io::Result<()> {
    Ok(())
}

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

/// A field of a CSV file: one with a comma, quote or line break is quoted.
pub fn csv_field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}
