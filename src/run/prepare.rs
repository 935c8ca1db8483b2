//! Everything short of solving: scene, meshes, problem.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::folder::Folder;
use super::presets::read_scene;
use super::shared::{Shared, interfaces_key};
use super::{Event, Listener, Options};
use crate::error::{Result, name_help};
use crate::history::Clock;
use crate::mesh::{self, Job, Mesh, Meshed};
use crate::output::Listing;
use crate::problem::{Problem, subdomain_meshes};
use crate::scene::Scene;

/// A scene that is ready to be solved.
#[derive(Debug)]
pub struct Prepared {
    /// The scene.
    pub scene: Scene,
    /// Its name: that of its folder, and of its file unless that is `scene.json`.
    pub name: String,
    /// The scene bound to its meshes.
    pub problem: Problem,
    /// Folder of the results.
    pub folder: Folder,
    /// Time so far.
    pub clock: Clock,
}

/// Reads, meshes and binds a scene.
pub fn prepare(options: &Options, listen: Listener) -> Result<Prepared> {
    prepare_sharing(options, None, listen)
}

/// `prepare` with what other runs have left.
pub(super) fn prepare_sharing(
    options: &Options,
    shared: Option<&Shared>,
    listen: Listener,
) -> Result<Prepared> {
    let Ready { scene, name, folder, mut clock, files, file_of } = mesh_scene(options, shared, listen)?;
    clock.begin("read meshes");
    let read = |path: &PathBuf| shared.map_or_else(|| mesh::read(path), |shared| shared.read(path));
    let meshes = files.par_iter().map(read).collect::<Vec<Result<Mesh>>>();
    let meshes = meshes.into_iter().collect::<Result<Vec<Mesh>>>()?; // of several errors the first counts
    let (meshes, mut warnings) = subdomain_meshes(&scene, meshes, &file_of)?;
    clock.begin("bind");
    let mut problem = match shared {
        Some(shared) => {
            let key = interfaces_key(&scene, &files, &file_of);
            let known = shared.interfaces(&key);
            if known.is_some() {
                listen(Event::Reused("interfaces"));
            }
            let interfaces = known.as_deref().map_or(&[][..], Vec::as_slice);
            let problem = Problem::bind_joined(&scene, meshes, interfaces)?;
            if known.is_none() {
                shared.keep_interfaces(key, &problem.model.interfaces);
            }
            problem
        }
        None => Problem::bind(&scene, meshes)?,
    };
    warnings.append(&mut problem.warnings);
    problem.warnings = warnings;
    for interface in &problem.model.interfaces {
        listen(Event::Interface(interface));
    }
    for warning in &problem.warnings {
        listen(Event::Warning(warning));
    }
    Ok(Prepared { scene, name, problem, folder, clock })
}

/// The folder of the results of a scene of this name.
fn results_folder(options: &Options, name: &str) -> PathBuf {
    options.out.clone().unwrap_or_else(|| Path::new("results").join(name))
}

/// The folder of a run, if it holds the results of an earlier one.
pub(super) fn earlier_results(options: &Options) -> Option<PathBuf> {
    let file = &options.scene;
    let file = if file.is_dir() { file.join("scene.json") } else { file.clone() };
    let folder = results_folder(options, &scene_name(&file));
    Listing::read(&folder).ok().flatten().map(|_| folder)
}

/// Meshes a scene and nothing else.
pub fn mesh(options: &Options, listen: Listener) -> Result<PathBuf> {
    let mut folder = mesh_scene(options, None, listen)?.folder;
    folder.keep();
    Ok(folder.path().join("mesh"))
}

/// A scene whose meshes are on disk.
struct Ready {
    scene: Scene,
    name: String,
    folder: Folder,
    clock: Clock,
    /// Every mesh once.
    files: Vec<PathBuf>,
    /// Which of them a subdomain has.
    file_of: Vec<usize>,
}

fn mesh_scene(options: &Options, shared: Option<&Shared>, listen: Listener) -> Result<Ready> {
    let mut clock = Clock::new("read scene");
    listen(Event::Began(clock.now()));
    let scene = read_scene(&options.scene, &options.settings)?;
    let name = scene_name(&scene.source.file);
    let out = results_folder(options, &name);
    clock.begin("mesh");
    let (files, file_of) = files(&scene)?;
    let jobs: Vec<Job> = files.iter().filter_map(Origin::job).cloned().collect();
    let folder = Folder::open(&out)?;
    let meshed = match shared {
        Some(shared) => shared.mesh_all(&jobs)?,
        None => {
            let gmsh = options.mesher();
            let meshed = mesh::mesh_all(&gmsh, &folder.path().join("mesh"), &jobs)?;
            if !gmsh.is_confined() {
                listen(Event::Unconfined);
            }
            meshed
        }
    };
    for (job, Meshed { path, reused }) in jobs.iter().zip(&meshed) {
        listen(Event::Meshed { name: &job.name, path, reused: *reused });
    }
    let mut made = meshed.into_iter().map(|meshed| meshed.path);
    let files = files.into_iter().filter_map(|file| match file {
        Origin::Mesh(path) => Some(path),
        Origin::Geometry(_) => made.next(),
    });
    let files = files.collect();
    Ok(Ready { scene, name, folder, clock, files, file_of })
}

/// Origin of a mesh.
#[derive(Debug, PartialEq)]
enum Origin {
    Mesh(PathBuf),
    Geometry(Job),
}

impl Origin {
    fn job(&self) -> Option<&Job> {
        match self {
            Origin::Mesh(_) => None,
            Origin::Geometry(job) => Some(job),
        }
    }
}

/// Every mesh of the scene once, and which of them a subdomain has: what several subdomains share (one geometry with
/// the same parameters, one file) is meshed and read once.
fn files(scene: &Scene) -> Result<(Vec<Origin>, Vec<usize>)> {
    let base = scene.source.folder();
    let mut files: Vec<Origin> = Vec::new();
    let mut file_of = Vec::new();
    for (name, subdomain) in &scene.subdomains {
        // the scene's door has checked that there is one of them
        let (key, file) = match (&subdomain.geo, &subdomain.msh) {
            (Some(geo), _) => ("geo", geo),
            (None, msh) => ("msh", msh.as_ref().unwrap_or(name)),
        };
        let path = base.join(file);
        if !path.is_file() {
            let what = format!("there is no file {}", path.display());
            let here = std::path::absolute(&base).unwrap_or_else(|_| base.clone());
            let help = format!("in {} {}", here.display(), files_like(&base, file));
            return Err(scene.source.error_at(&["subdomains", name, key], what, help));
        }
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        let wanted = if key == "msh" && mesh::is_earlier_format(&path)? {
            Origin::Geometry(Job {
                name: stem.unwrap_or_else(|| name.clone()),
                geo: path,
                parameters: Vec::new(),
            })
        } else if key == "msh" {
            Origin::Mesh(path)
        } else {
            let parameters =
                subdomain.parameters.iter().map(|(name, value)| (name.clone(), *value)).collect();
            // a mesh of several subdomains has the name of its geometry
            let name = stem.filter(|_| subdomain.surface.is_some()).unwrap_or_else(|| name.clone());
            Origin::Geometry(Job { name, geo: path, parameters })
        };
        let known = files.iter().position(|file| *file == wanted);
        file_of.push(known.unwrap_or(files.len()));
        if known.is_none() {
            files.push(wanted);
        }
    }
    Ok((files, file_of))
}

/// The files of a folder that have the extension of one that is not there.
fn files_like(folder: &Path, file: &str) -> String {
    let kind = Path::new(file).extension();
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().extension() == kind)
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    name_help(file, names.iter().map(String::as_str))
}

/// `geo/shear/scene.json` is "shear", `geo/shear/stiff.json` is "shear_stiff".
fn scene_name(file: &Path) -> String {
    let stem = file.file_stem().map_or("scene".into(), |stem| stem.to_string_lossy().into_owned());
    let folder = std::path::absolute(file).ok();
    let folder = folder.as_deref().and_then(Path::parent).and_then(Path::file_name);
    let folder = folder.map(|name| name.to_string_lossy().into_owned());
    match (folder, stem.as_str()) {
        (Some(folder), "scene") => folder,
        (Some(folder), _) => format!("{folder}_{stem}"),
        (None, _) => stem,
    }
}
