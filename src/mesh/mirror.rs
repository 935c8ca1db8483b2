//! Sources that end within a line, completed in copies: gmsh 4.8 executes only the first statement of such a line.
//!
//! ```text
//!   mirror/home/ann/dam/up.geo      a copy with the missing newline
//!                       b.step      a link to /home/ann/dam/b.step, as is everything else around
//! ```
//!
//! Every relative name in a source, written or computed, leads to the same file as before.

use std::os::unix::fs::symlink;
use std::path::{Component, Path, PathBuf};

use super::sources::Sources;
use crate::error::{Error, Result};

/// The path of `geo` for gmsh: itself where all sources end with a newline, else within a mirror in `folder`.
pub(super) fn completed(sources: &Sources, geo: &Path, folder: &Path) -> Result<PathBuf> {
    let ends_within_a_line = |text: &[u8]| !text.is_empty() && !text.ends_with(b"\n") && !text.contains(&0);
    let mut mirrored = false;
    for (path, content) in &sources.files {
        let Some(text) = content.as_deref().filter(|text| ends_within_a_line(text)) else { continue };
        let copy = place(folder, path).map_err(Error::io("write to", folder))?;
        // its link, if there is one; a link would lead the copy into the user's file
        let _ = std::fs::remove_file(&copy);
        std::fs::write(&copy, [text, b"\n"].concat()).map_err(Error::io("write", &copy))?;
        mirrored = true;
    }
    if !mirrored {
        return Ok(geo.into());
    }
    place(folder, geo).map_err(Error::io("write to", folder))
}

/// The path of a file in the mirror, all folders on its way being folders with links to what the true ones hold.
fn place(mirror: &Path, file: &Path) -> std::io::Result<PathBuf> {
    let (mut own, mut original) = (mirror.to_path_buf(), PathBuf::from("/"));
    fill(&own, &original)?;
    let mut steps = file.components().filter(|step| !matches!(step, Component::RootDir)).peekable();
    while let Some(step) = steps.next() {
        if step == Component::ParentDir {
            if original.pop() {
                own.pop();
            }
            continue;
        }
        own.push(step);
        original.push(step);
        if steps.peek().is_some() {
            fill(&own, &original)?;
        }
    }
    Ok(own)
}

/// Makes a folder of the mirror, with links to what the original holds.
fn fill(own: &Path, original: &Path) -> std::io::Result<()> {
    if own.is_symlink() {
        std::fs::remove_file(own)?;
    } else if own.is_dir() && std::fs::read_dir(own)?.next().is_some() {
        return Ok(());
    }
    std::fs::create_dir_all(own)?;
    // a folder that may be entered but not listed has only the files that are named
    let Ok(entries) = std::fs::read_dir(original) else { return Ok(()) };
    entries.flatten().try_for_each(|entry| symlink(entry.path(), own.join(entry.file_name())))
}
