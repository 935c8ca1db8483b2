//! The results folder: a run that is refused leaves nothing behind.

use std::path::{Path, PathBuf};

use crate::error::{Error, Result};

/// The results folder of a run; folders that did not exist before are removed again unless the run is kept.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    made: Option<PathBuf>,
}

impl Folder {
    /// Makes the folder if it is not there.
    pub fn open(path: &Path) -> Result<Folder> {
        let made = path
            .ancestors()
            .filter(|a| !a.as_os_str().is_empty() && !a.exists())
            .last()
            .map(Path::to_path_buf);
        std::fs::create_dir_all(path).map_err(Error::io("create", path))?;
        Ok(Folder { path: path.into(), made })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// From here on what is written stays.
    pub fn keep(&mut self) {
        self.made = None;
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if let Some(made) = &self.made {
            // nothing to be done if the folder resists: the run has failed for another reason already
            let _ = std::fs::remove_dir_all(made);
        }
    }
}
