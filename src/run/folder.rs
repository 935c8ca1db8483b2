//! The results folder: it belongs to one run at a time, and a run that is refused leaves nothing behind and takes nothing away.
//!
//! ```text
//! open      lock, finish or remove what a run that was killed has left
//! staged    where results of an earlier run are there, the first row is written aside ...
//! promote   ... and takes their place when it is complete
//! ```

use std::path::{Path, PathBuf};

use super::lock::Lock;
use crate::error::{Error, Result};
use crate::files::HIDDEN;
use crate::output::{Listing, MANIFEST};

/// The results folder of a run. Folders and meshes that were not there before are removed again unless the run is kept.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Folders that were made for it, from the outermost to the innermost.
    made: Vec<PathBuf>,
    kept: bool,
    lock: Option<Lock>,
}

impl Folder {
    /// Makes the folder if it is not there, takes its lock and clears up after a run that was killed there.
    pub fn open(path: &Path) -> Result<Folder> {
        loop {
            let mut made: Vec<PathBuf> = path
                .ancestors()
                .filter(|a| !a.as_os_str().is_empty() && !a.exists())
                .map(Path::to_path_buf)
                .collect();
            made.reverse();
            std::fs::create_dir_all(path).map_err(Error::io("create", path))?;
            let lock = match Lock::take(path) {
                Ok(Some(lock)) => lock,
                Ok(None) => continue, // it was removed in between by the run that had made it
                Err(error) => {
                    remove_empty(&made);
                    return Err(error);
                }
            };
            let folder = Folder { path: path.into(), made, kept: false, lock: Some(lock) };
            folder.clear_up()?;
            return Ok(folder);
        }
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// From here on what is written stays.
    pub fn keep(&mut self) {
        self.kept = true;
    }

    /// The folder for results while those of an earlier run are in place.
    pub(super) fn staged(&self) -> PathBuf {
        self.path.join(format!("{HIDDEN}next"))
    }

    /// Puts the staged results in the place of the earlier ones.
    pub(super) fn promote(&self) -> Result<()> {
        let ready = self.ready();
        std::fs::rename(self.staged(), &ready).map_err(Error::io("write", &ready))?;
        self.finish(&ready)
    }

    fn ready(&self) -> PathBuf {
        self.path.join(format!("{HIDDEN}ready"))
    }

    /// The rest of a promotion, from wherever it was interrupted: the earlier results go before the new manifest comes.
    fn finish(&self, ready: &Path) -> Result<()> {
        let manifest = ready.join(MANIFEST);
        if manifest.is_file() {
            if let Some(earlier) = Listing::read(&self.path)? {
                earlier.remove_all(&self.path)?;
            }
            let place = self.path.join(MANIFEST);
            std::fs::rename(&manifest, &place).map_err(Error::io("write", &place))?;
        }
        move_all(ready, &self.path)
    }

    fn clear_up(&self) -> Result<()> {
        let ready = self.ready();
        if ready.is_dir() {
            self.finish(&ready)?;
        }
        for below in ["", "fields", "midplane", "checkpoint", "check", "mesh", "points"] {
            remove_litter(&self.path.join(below));
        }
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(self.staged()); // what resists is removed by the next run
        if !self.kept {
            let meshes = self.path.join("mesh");
            // in a folder that was there they serve the next run
            let _ = match self.made.is_empty() {
                true => std::fs::remove_dir(meshes), // if there is none
                false => std::fs::remove_dir_all(meshes),
            };
        }
        self.lock = None; // another run may have it before the folder goes, and then it stays
        if !self.kept {
            remove_empty(&self.made);
        }
    }
}

/// Removes folders, from the innermost, as far as nobody has put anything there.
fn remove_empty(folders: &[PathBuf]) {
    let _ = folders.iter().rev().try_for_each(std::fs::remove_dir);
}

/// Moves all files of a folder to the same places in another, and removes it.
fn move_all(from: &Path, to: &Path) -> Result<()> {
    std::fs::create_dir_all(to).map_err(Error::io("create", to))?;
    for entry in std::fs::read_dir(from).map_err(Error::io("read", from))?.flatten() {
        let (source, target) = (entry.path(), to.join(entry.file_name()));
        if source.is_dir() {
            move_all(&source, &target)?;
        } else {
            std::fs::rename(&source, &target).map_err(Error::io("write", &target))?;
        }
    }
    std::fs::remove_dir(from).map_err(Error::io("remove", from))
}

/// Removes from a folder what a program that was killed was writing there. What is locked is of one that is at work.
pub(crate) fn remove_litter(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let (name, path) = (entry.file_name().to_string_lossy().into_owned(), entry.path());
        let Some(kind) = name.strip_prefix(HIDDEN).filter(|kind| *kind != "lock") else { continue };
        let locked = |path: &Path| {
            let file = std::fs::File::options().read(true).write(true).open(path);
            file.is_ok_and(|file| matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock)))
        };
        // what resists is nobody's loss
        match kind.split('-').next() {
            Some("writing") if locked(&path) => {}
            Some("gmsh") if locked(&path.join("lock")) => {}
            _ if path.is_dir() && !path.is_symlink() => drop(std::fs::remove_dir_all(&path)),
            _ => drop(std::fs::remove_file(&path)),
        }
    }
}
