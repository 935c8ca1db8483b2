//! Checkpoints on disk: `checkpoint/latest`, and one for the end of every step whose fields are stored.
//!
//! ```text
//! midplane checkpoint 1      format
//! { "increment": ..., ... }  its place, one line of JSON
//! { "version": ..., ... }    what it belongs to, another
//! state                      results so far and history, as postcard writes them
//! CRC-32 of all this
//! ```

use std::cmp::Reverse;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::identity::Identity;
use super::places::{CheckpointPlace, FOLDER, LATEST};
use super::results::ResultsState;
use crate::error::{Error, Result};
use crate::files::write_whole;
use crate::history::Checkpoint;

const HEAD: &str = "midplane checkpoint 1\n";
const SUM: usize = size_of::<u32>();

/// Contents of a checkpoint that was read.
#[derive(Debug, Deserialize)]
pub(super) struct Kept {
    pub(super) results: ResultsState,
    pub(super) history: Checkpoint,
}

/// Contents of a checkpoint to be written; it has the shape of `Kept`.
#[derive(Debug, Serialize)]
pub(super) struct Keeping<'a, H> {
    pub(super) results: &'a ResultsState,
    pub(super) history: H,
}

/// A checkpoint file.
#[derive(Debug)]
pub(super) struct Found {
    pub(super) path: PathBuf,
    pub(super) place: CheckpointPlace,
    pub(super) identity: Identity,
    state: Vec<u8>,
}

impl Found {
    /// The state in it.
    pub(super) fn kept(&self) -> Result<Kept> {
        postcard::from_bytes(&self.state).map_err(|error| damaged(&self.path, &error.to_string()))
    }
}

/// The text of a checkpoint, into a buffer that is used again; `identity`: that of the run, as JSON.
pub(super) fn encode(
    place: &CheckpointPlace,
    identity: &[u8],
    state: &impl Serialize,
    into: &mut Vec<u8>,
) -> Result<()> {
    let failed =
        |error: &dyn std::fmt::Display| Error::io("write", LATEST)(std::io::Error::other(error.to_string()));
    into.clear();
    into.extend(HEAD.bytes());
    serde_json::to_writer(&mut *into, place).map_err(|error| failed(&error))?;
    into.push(b'\n');
    into.extend(identity);
    into.push(b'\n');
    let mut buffer = std::mem::take(into);
    buffer = postcard::to_extend(state, buffer).map_err(|error| failed(&error))?;
    let sum = crc32fast::hash(&buffer);
    buffer.extend(sum.to_le_bytes());
    *into = buffer;
    Ok(())
}

/// Writes a checkpoint.
pub(super) fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<()> {
    write_whole(&folder.join(name), bytes)
}

/// The checkpoints of a folder, the latest first; before them those whose place cannot be read.
pub(super) fn all_of(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder.join(FOLDER)).into_iter().flatten().flatten();
    let named = entries.map(|entry| entry.path()).filter(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name == "latest" || name.starts_with("step_")
    });
    let mut placed: Vec<(Option<CheckpointPlace>, PathBuf)> =
        named.map(|path| (place(&path), path)).collect();
    placed.sort_by_key(|(place, _)| place.map(Reverse));
    placed.into_iter().map(|(_, path)| path).collect()
}

/// The place of a checkpoint, from its second line.
fn place(path: &Path) -> Option<CheckpointPlace> {
    let line = BufReader::new(File::open(path).ok()?).split(b'\n').nth(1)?.ok()?;
    serde_json::from_slice(&line).ok()
}

/// Reads a checkpoint.
pub(super) fn read(path: &Path) -> Result<Found> {
    let bytes = std::fs::read(path).map_err(Error::io("read", path))?;
    let (text, sum) =
        bytes.split_at_checked(bytes.len().wrapping_sub(SUM)).ok_or_else(|| damaged(path, "too short"))?;
    if crc32fast::hash(text).to_le_bytes() != sum {
        return Err(damaged(path, "its checksum is another"));
    }
    let rest = text.strip_prefix(HEAD.as_bytes()).ok_or_else(|| {
        let what = "is of another version of midplane, in another format";
        let help = "go on with that version, or run without --resume to begin anew";
        Error::Checkpoint { file: path.into(), what: what.into(), help: help.into() }
    })?;
    let mut lines = rest.splitn(3, |byte| *byte == b'\n');
    let mut line = || lines.next().ok_or_else(|| damaged(path, "a line is missing"));
    let [place, identity, state] = [line()?, line()?, line()?];
    let place = serde_json::from_slice(place).map_err(|error| damaged(path, &error.to_string()))?;
    let identity = serde_json::from_slice(identity).map_err(|error| damaged(path, &error.to_string()))?;
    Ok(Found { path: path.into(), place, identity, state: state.to_vec() })
}

fn damaged(path: &Path, how: &str) -> Error {
    Error::Checkpoint {
        file: path.into(),
        what: format!("is damaged: {how}"),
        help: "run without --resume to begin anew".into(),
    }
}
