//! Results of an earlier run in a folder: found by what this program writes, so that nothing of anybody else is taken.

use std::io::Read;
use std::path::{Path, PathBuf};

use super::{pvd, vtu};
use crate::error::{Error, Result};

/// Removes the results of earlier runs in a folder, whatever the name of their scene.
pub(super) fn remove_results(folder: &Path) -> Result<()> {
    for file in ["history.csv", "summary.json"] {
        remove(folder.join(file))?;
    }
    remove_written(folder, "pvd", pvd::HEAD)?;
    for sub in ["fields", "midplane"] {
        remove_grids(&folder.join(sub))?;
    }
    Ok(())
}

/// Removes the grids that this program wrote into a folder.
pub(super) fn remove_grids(folder: &Path) -> Result<()> {
    remove_written(folder, "vtu", vtu::HEAD)
}

/// Removes the files of a folder that have this extension and begin as this program begins them.
fn remove_written(folder: &Path, extension: &str, head: &str) -> Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(()) };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.extension().is_some_and(|found| found == extension) && begins_with(&path, head) {
            remove(path)?;
        }
    }
    Ok(())
}

fn begins_with(path: &Path, head: &str) -> bool {
    let mut start = vec![0; head.len()];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == head.as_bytes()
}

fn remove(path: PathBuf) -> Result<()> {
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(Error::io("remove", path)(error)),
        _ => Ok(()),
    }
}
