//! The manifest of a results folder: the files that a run has written there, so that no other is ever replaced or removed.
//!
//! The first line names the scene, every other a file, relative to the folder. A file is listed before it is written.

use std::collections::HashSet;
use std::fs::File;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use super::growing::{Measured, TextLength, beginning, changed};
use crate::error::{Error, Result};
use crate::files::write_whole;

/// Name of the file.
pub const MANIFEST: &str = "manifest";
const HEAD: &str = "midplane results of ";

/// The manifest of a run under way.
#[derive(Debug)]
pub(super) struct Manifest {
    path: PathBuf,
    file: File,
    measured: Measured,
}

impl Manifest {
    /// Begins one.
    pub(super) fn create(folder: &Path, scene: &str) -> Result<Manifest> {
        let line: String = scene.chars().map(|c| if c.is_control() { '_' } else { c }).collect();
        Manifest::begin(folder, &format!("{HEAD}{line}\n"))
    }

    fn begin(folder: &Path, text: &str) -> Result<Manifest> {
        let path = folder.join(MANIFEST);
        write_whole(&path, text.as_bytes())?;
        let file = File::options().append(true).open(&path).map_err(Error::io("write", &path))?;
        Ok(Manifest { path, file, measured: Measured::of(text) })
    }

    /// Goes back to a length that it has had: files that were listed later are removed.
    pub(super) fn reopen(folder: &Path, length: TextLength) -> Result<Manifest> {
        let path = folder.join(MANIFEST);
        let text = beginning(&path, length)?.ok_or_else(|| changed(&path))?;
        let kept: HashSet<&str> = text.lines().skip(1).collect();
        let later = Listing::read(folder)?.map_or_else(Vec::new, |listing| listing.files);
        remove(folder, later.iter().filter(|file| !kept.contains(file.as_str())))?;
        Manifest::begin(folder, &text)
    }

    /// Lists files that are about to be written.
    pub(super) fn add<'a>(&mut self, files: impl IntoIterator<Item = &'a str>) -> Result<()> {
        let text: String = files.into_iter().flat_map(|file| [file, "\n"]).collect();
        if let Err(error) = self.file.write_all(text.as_bytes()) {
            // a line that is not whole does not count; nothing more can be done where the disk is full
            let _ = self.file.set_len(self.measured.bytes);
            return Err(Error::io("write", &self.path)(error));
        }
        self.measured.add(&text);
        Ok(())
    }

    /// Its length so far.
    pub(super) fn length(&self) -> TextLength {
        self.measured.length()
    }

    /// The same file in another folder, into which it was moved.
    pub(super) fn moved_to(&mut self, folder: &Path) {
        self.path = folder.join(MANIFEST);
    }
}

/// The files of an earlier run.
#[derive(Debug, Clone, Default)]
pub struct Listing {
    /// Name of its scene.
    pub scene: String,
    /// Files, relative to the folder.
    pub files: Vec<String>,
}

impl Listing {
    /// Reads the manifest of a folder, if there is one.
    pub fn read(folder: &Path) -> Result<Option<Listing>> {
        let path = folder.join(MANIFEST);
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::io("read", &path)(error)),
        };
        let text = String::from_utf8_lossy(&bytes);
        let mut lines = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
        let Some(scene) = lines.next().and_then(|line| line.strip_prefix(HEAD)) else {
            let what = format!("{MANIFEST} is not a list of results");
            return Err(Error::folder(folder, what, "remove it, or choose another folder with -o"));
        };
        let inside = |line: &&str| {
            !line.is_empty() && Path::new(line).components().all(|part| matches!(part, Component::Normal(_)))
        };
        Ok(Some(Listing { scene: scene.into(), files: lines.filter(inside).map(str::to_string).collect() }))
    }

    /// Removes its files and the manifest, and folders that are empty then.
    pub fn remove_all(&self, folder: &Path) -> Result<()> {
        remove(folder, &self.files)?;
        remove(folder, [&MANIFEST.to_string()])
    }
}

/// Removes files of a folder, and folders in it that are empty then.
fn remove<'a>(folder: &Path, files: impl IntoIterator<Item = &'a String>) -> Result<()> {
    let mut within = HashSet::new();
    for file in files {
        let path = folder.join(file);
        match std::fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(Error::io("remove", path)(error));
            }
            _ => {}
        }
        within.extend(
            Path::new(file).parent().filter(|parent| !parent.as_os_str().is_empty()).map(Path::to_path_buf),
        );
    }
    // one that is not empty stays
    within.into_iter().for_each(|below| drop(std::fs::remove_dir(folder.join(below))));
    Ok(())
}

/// Refuses a folder in which files that no manifest lists stand where a run would write.
pub fn check_free(
    folder: &Path,
    listing: Option<&Listing>,
    wanted: &[String],
    fields: &[String],
) -> Result<()> {
    let listed: HashSet<&str> = listing.iter().flat_map(|own| own.files.iter().map(String::as_str)).collect();
    for below in ["fields", "midplane", "checkpoint"] {
        let path = folder.join(below);
        if path.is_symlink() {
            let what =
                format!("{below} is a link to another folder, and what is there might not be of this run");
            return Err(Error::folder(folder, what, "make the results folder itself the link"));
        }
    }
    let numbered = |name: &str| {
        let number = name.strip_suffix(".vtu").and_then(|stem| stem.rsplit_once('_'));
        number.is_some_and(|(part, digits)| {
            digits.len() >= 4
                && digits.bytes().all(|c| c.is_ascii_digit())
                && fields.iter().any(|own| own == part)
        })
    };
    let entries = std::fs::read_dir(folder.join("fields")).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let fields = names.filter(|name| numbered(name)).map(|name| format!("fields/{name}"));
    let there = wanted.iter().filter(|file| folder.join(file).symlink_metadata().is_ok()).cloned();
    if let Some(foreign) = there.chain(fields).find(|file| !listed.contains(file.as_str())) {
        let what = format!(
            "{foreign} is in the way: its {MANIFEST} does not list it, so no run has written it there"
        );
        return Err(Error::folder(folder, what, "move it away, or choose another folder with -o"));
    }
    Ok(())
}
