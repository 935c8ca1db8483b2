//! Meshes on demand: one gmsh run per geometry, side by side, and none for what has not changed.
//!
//! A mesh is kept as `<name>-<12 hex digits>.msh`. The digits are the SHA-256 of all that decides it: the .geo
//! and what it includes, the parameters, the options and the version of gmsh. A file appears there only whole and
//! checked, its own SHA-256 beside it; one that is damaged later is made again.

use std::io::Write;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use sha2::{Digest, Sha256};

use super::gmsh::{Gmsh, Task};
use super::mirror::completed;
use super::read::from_bytes;
use super::sources::Sources;
use crate::error::{Error, Result};
use crate::files::{HIDDEN, write_whole};

/// A disk with less room than this is full [bytes].
const LEFT: usize = 1 << 16;

/// A geometry to be meshed, or a mesh of an earlier format to be converted.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// The first part of the file name: the subdomain, or what several share.
    pub name: String,
    /// The .geo file, or an .msh file that is not MSH 4.1.
    pub geo: PathBuf,
    /// Values for names that the .geo declares with DefineConstant.
    pub parameters: Vec<(String, f64)>,
}

/// A mesh on disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Meshed {
    /// The .msh file.
    pub path: PathBuf,
    /// True if it was there already.
    pub reused: bool,
}

/// Meshes all jobs into the folder `cache`, in parallel, in the order of the jobs. Of several errors the first counts.
pub fn mesh_all(gmsh: &Gmsh, cache: &Path, jobs: &[Job]) -> Result<Vec<Meshed>> {
    if !jobs.is_empty() {
        gmsh.version()?; // asked before the jobs start, so that they do not ask all at once
    }
    let all: Vec<Result<Meshed>> = jobs.par_iter().map(|job| mesh_one(gmsh, cache, job)).collect();
    all.into_iter().collect()
}

/// Names that a .geo declares with DefineConstant, and their values where those are plain numbers.
pub fn parameters(geo: &Path) -> Result<Vec<(String, Option<f64>)>> {
    let geo = std::path::absolute(geo).map_err(Error::io("read", geo))?;
    Ok(Sources::read(&geo)?.declared)
}

/// Digest of a .geo and all it includes, or of a mesh file; none if what gmsh makes of it depends on more than files.
pub fn digest(file: &Path) -> Result<Option<String>> {
    let file = std::path::absolute(file).map_err(Error::io("read", file))?;
    let sources = Sources::read(&file)?;
    let mut hash = Sha256::new();
    sources.digest(&mut |part: &[u8]| {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    });
    let digits = hex(&hash.finalize());
    Ok(sources.closed.then_some(digits))
}

fn mesh_one(gmsh: &Gmsh, cache: &Path, job: &Job) -> Result<Meshed> {
    let geo = std::path::absolute(&job.geo).map_err(Error::io("read", &job.geo))?;
    let sources = Sources::read(&geo)?;
    if !gmsh.is_trusting() {
        sources.check_confined(&job.geo, &gmsh.readable(&geo))?;
    }
    for (name, value) in &job.parameters {
        sources.accepts(&job.geo, name)?;
        if !value.is_finite() {
            return Err(Error::mesh(
                &job.geo,
                format!("cannot take {name} = {value}"),
                "a parameter is a finite number",
            ));
        }
    }
    let task = Task { file: &geo, parameters: &job.parameters, conversion: sources.is_mesh };
    let key = key(&sources, &task, gmsh.version()?);
    let path = cache.join(format!("{}-{key}.msh", file_name(&job.name)));
    if sources.closed && is_good(&path) {
        return Ok(Meshed { path, reused: true });
    }
    std::fs::create_dir_all(cache).map_err(Error::io("create", cache))?;
    let cache = std::path::absolute(cache).map_err(Error::io("create", cache))?;
    let folder = tempfile::Builder::new()
        .prefix(&format!("{HIDDEN}gmsh-"))
        .tempdir_in(&cache)
        .map_err(Error::io("write to", &cache))?;
    let lock = folder.path().join("lock");
    let lock = std::fs::File::create(&lock).map_err(Error::io("write", &lock))?;
    // whoever clears up leaves the folder alone as long as it is locked
    let _ = lock.try_lock();
    let made = || -> Result<(PathBuf, String)> {
        let mirror = folder.path().join("mirror");
        let source = completed(&sources, &geo, &mirror)?;
        let written = gmsh.mesh(&task, &source, &mirror, folder.path())?;
        let bytes = std::fs::read(&written).map_err(Error::io("read", &written))?;
        if is_half(&bytes) {
            let what = "gmsh has written half of it: was the disk full?";
            return Err(Error::io("write the mesh to", &cache)(std::io::Error::other(what)));
        }
        from_bytes(&job.geo, &bytes)?;
        Ok((written, hex(&Sha256::digest(&bytes))))
    };
    let (written, digits) = made().map_err(|error| if_disk_is_full(&cache, error))?;
    std::fs::File::open(&written).and_then(|file| file.sync_all()).map_err(Error::io("write", &written))?;
    let sum = sum_file(&path);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    write_whole(&sum, format!("{digits}  {name}\n").as_bytes())?;
    std::fs::rename(&written, &path).map_err(Error::io("write", &path))?;
    Ok(Meshed { path, reused: false })
}

/// True for a mesh file that begins as one and has no end. gmsh, which does not say when it cannot write, leaves such.
fn is_half(bytes: &[u8]) -> bool {
    let begins = bytes.starts_with(b"$MeshFormat") || bytes.is_empty();
    let end = &bytes[bytes.len().saturating_sub(64)..];
    begins && !end.windows(4).any(|word| word == b"$End")
}

/// The file beside a mesh that holds its SHA-256, as `sha256sum -c` reads it.
fn sum_file(mesh: &Path) -> PathBuf {
    mesh.with_extension("msh.sha256")
}

/// True for a mesh that is as it was written.
fn is_good(path: &Path) -> bool {
    let sum = std::fs::read_to_string(sum_file(path)).unwrap_or_default();
    std::fs::read(path).is_ok_and(|bytes| sum.starts_with(&hex(&Sha256::digest(&bytes))))
}

/// gmsh does not say that the disk is full: an error of its output is that of the disk if nothing more can be written there.
fn if_disk_is_full(folder: &Path, error: Error) -> Error {
    let tried = tempfile::tempfile_in(folder).and_then(|mut file| {
        file.write_all(&[0; LEFT])?;
        file.sync_all()
    });
    match (&error, tried) {
        (Error::Stopped { .. } | Error::Io { .. }, _) | (_, Ok(())) => error,
        (_, Err(full)) => Error::io("write the mesh to", folder)(full),
    }
}

fn hex(digest: &[u8]) -> String {
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// 12 hex digits that change with whatever changes the mesh.
fn key(sources: &Sources, task: &Task, version: &str) -> String {
    let mut hash = Sha256::new();
    let mut add = |part: &[u8]| {
        hash.update((part.len() as u64).to_le_bytes()); // so that parts cannot run into each other
        hash.update(part);
    };
    add(version.as_bytes());
    for option in task.options() {
        add(option.as_encoded_bytes());
    }
    add(task.afterwards().as_bytes());
    sources.digest(&mut add);
    hex(&hash.finalize()[..6])
}

/// A name without what a file name cannot hold.
fn file_name(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
}
