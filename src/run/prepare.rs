//! Everything short of solving: scene, meshes, problem.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::folder::Folder;
use super::{Clock, Event, Listener, Options};
use crate::error::Result;
use crate::mesh::{self, Gmsh, Job, Mesh, Meshed};
use crate::problem::Problem;
use crate::scene::{self, Scene};

/// A scene that is ready to be solved.
#[derive(Debug)]
pub struct Prepared {
    /// The scene.
    pub scene: Scene,
    /// Its name: that of its folder, and of its file unless that is `scene.json`.
    pub name: String,
    /// The scene bound to its meshes.
    pub problem: Problem,
    /// Where results go.
    pub folder: Folder,
    /// Time so far.
    pub clock: Clock,
}

/// Reads, meshes and binds a scene.
pub fn prepare(options: &Options, listen: Listener) -> Result<Prepared> {
    let (scene, name, folder, mut clock, files) = mesh_scene(options, listen)?;
    listen(Event::Stage("read meshes"));
    clock.begin("read meshes");
    let meshes = files.par_iter().map(|path| mesh::read(path)).collect::<Vec<Result<Mesh>>>();
    let meshes = meshes.into_iter().collect::<Result<Vec<Mesh>>>()?; // of several errors the first counts
    listen(Event::Stage("bind"));
    clock.begin("bind");
    let problem = Problem::bind(&scene, meshes)?;
    for joint in &problem.model.joints {
        listen(Event::Joint(joint));
    }
    for warning in &problem.warnings {
        listen(Event::Warning(warning));
    }
    Ok(Prepared { scene, name, problem, folder, clock })
}

/// Meshes a scene and nothing else.
pub fn mesh(options: &Options, listen: Listener) -> Result<PathBuf> {
    let (_, _, mut folder, _, _) = mesh_scene(options, listen)?;
    folder.keep();
    Ok(folder.path().join("mesh"))
}

fn mesh_scene(options: &Options, listen: Listener) -> Result<(Scene, String, Folder, Clock, Vec<PathBuf>)> {
    listen(Event::Stage("read scene"));
    let mut clock = Clock::new("read scene");
    let scene = scene::read(&options.scene, &options.settings)?;
    let name = scene_name(&scene.source.file);
    let out = options.out.clone().unwrap_or_else(|| Path::new("results").join(&name));
    listen(Event::Stage("mesh"));
    clock.begin("mesh");
    let base = scene.source.folder();
    let mut jobs = Vec::new();
    for (name, subdomain) in &scene.subdomains {
        for (key, file) in [("geo", &subdomain.geo), ("msh", &subdomain.msh)] {
            let Some(file) = file else { continue };
            let path = base.join(file);
            if !path.is_file() {
                let what = format!("there is no file {}", path.display());
                let cure = format!("files are named relative to {}", base.display());
                return Err(scene.source.refuse(&["subdomains", name, key], what, cure));
            }
            if key == "geo" {
                let parameters =
                    subdomain.parameters.iter().map(|(name, value)| (name.clone(), *value)).collect();
                jobs.push(Job { subdomain: name.clone(), geo: path, parameters });
            }
        }
    }
    let folder = Folder::open(&out)?;
    let gmsh = Gmsh::new(&options.gmsh, options.gmsh_limit);
    let meshed = mesh::mesh_all(&gmsh, &folder.path().join("mesh"), &jobs)?;
    for (job, Meshed { path, reused }) in jobs.iter().zip(&meshed) {
        listen(Event::Meshed { name: &job.subdomain, path, reused: *reused });
    }
    let mut made = meshed.into_iter().map(|meshed| meshed.path);
    let files = scene.subdomains.values().filter_map(|subdomain| match &subdomain.msh {
        Some(file) => Some(base.join(file)),
        None => made.next(),
    });
    let files = files.collect();
    Ok((scene, name, folder, clock, files))
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

/// Names of the history's columns after the fixed ones: probes, then reactions.
pub(super) fn columns(problem: &Problem) -> Vec<String> {
    let reactions = problem
        .reactions
        .iter()
        .map(|reaction| format!("reaction:{}:{}", reaction.group, reaction.direction.name()));
    problem.probes.iter().map(|(name, _)| name.clone()).chain(reactions).collect()
}
