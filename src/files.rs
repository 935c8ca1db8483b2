//! Files that are whole or absent at every moment.

use std::io::{BufWriter, Write};
use std::path::Path;

use crate::error::{Error, Result};

/// Beginning of the names of files that are being written: they count for nothing if the program has ended.
pub const HIDDEN: &str = ".midplane-";

/// Writes a file aside and renames it into place; makes the folder if needed.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<()> {
    write_whole_by(path, |file| file.write_all(content).map_err(Error::io("write", path)))
}

/// The same for a content that comes piece by piece.
pub fn write_whole_by(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
    let prefix = format!("{HIDDEN}writing-");
    let file =
        tempfile::Builder::new().prefix(&prefix).tempfile_in(folder).map_err(Error::io("write", path))?;
    // whoever clears up leaves it alone as long as it is locked; where nothing can be locked only its run clears up
    let _ = file.as_file().try_lock();
    let mut buffer = BufWriter::new(file.as_file());
    write(&mut buffer)?;
    buffer.flush().map_err(Error::io("write", path))?;
    drop(buffer);
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
