//! Data that several runs of one process share: mesh files, meshes, interfaces, condensed bodies.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::Options;
use crate::assembly::InterfaceOperator;
use crate::error::Result;
use crate::history::memory;
use crate::mesh::{self, Gmsh, Job, Mesh, Meshed};
use crate::problem::{duties, joinings};
use crate::scene::Scene;
use crate::solver::SubdomainCache;

/// Memory for condensed bodies where the system does not tell what it has [bytes].
const ROOM: u64 = 1 << 30;

/// Data that the runs of one process share. Runs in several threads may use it at a time.
#[derive(Debug)]
pub struct Shared {
    /// Folder of the meshes of all runs.
    folder: PathBuf,
    gmsh: Gmsh,
    meshing: Mutex<()>,
    meshes: Mutex<HashMap<PathBuf, Arc<Mesh>>>,
    interfaces: Mutex<HashMap<String, Arc<Vec<InterfaceOperator>>>>,
    /// Condensed bodies.
    pub(super) cache: Arc<SubdomainCache>,
}

impl Shared {
    /// With the mesher of these options and meshes in `folder`; a quarter of the memory is for condensed bodies.
    pub fn new(options: &Options, folder: &Path) -> Shared {
        let room = memory::available().map_or(ROOM, |available| available / 4) as usize;
        Shared {
            folder: folder.into(),
            gmsh: options.mesher(),
            meshing: Mutex::default(),
            meshes: Mutex::default(),
            interfaces: Mutex::default(),
            cache: Arc::new(SubdomainCache::new(room)),
        }
    }

    /// The version that the mesher states.
    pub fn mesher(&self) -> Result<&str> {
        self.gmsh.version()
    }

    /// Meshes what is stale, one run at a time so that none is meshed twice.
    pub(super) fn mesh_all(&self, jobs: &[Job]) -> Result<Vec<Meshed>> {
        let _one = lock(&self.meshing);
        mesh::mesh_all(&self.gmsh, &self.folder, jobs)
    }

    /// A mesh, read unless some run has read it.
    pub(super) fn read(&self, path: &Path) -> Result<Mesh> {
        if let Some(known) = lock(&self.meshes).get(path) {
            return Ok(Mesh::clone(known));
        }
        let mesh = mesh::read(path)?;
        lock(&self.meshes).insert(path.into(), Arc::new(mesh.clone()));
        Ok(mesh)
    }

    /// The interfaces of a scene on these meshes, if some run has bound them.
    pub(super) fn interfaces(&self, key: &str) -> Option<Arc<Vec<InterfaceOperator>>> {
        lock(&self.interfaces).get(key).cloned()
    }

    /// Keeps the interfaces of a scene.
    pub(super) fn keep_interfaces(&self, key: String, interfaces: &[InterfaceOperator]) {
        lock(&self.interfaces).insert(key, Arc::new(interfaces.to_vec()));
    }
}

/// All that decides the interfaces of a scene on these meshes: everything but laws, materials, loads and output;
/// supports decide where ends of the grid follow their neighbours.
pub(super) fn interfaces_key(scene: &Scene, files: &[PathBuf], file_of: &[usize]) -> String {
    let parts: Vec<_> = scene.subdomains.iter().map(|(name, part)| (name, &part.surface)).collect();
    format!("{:?}", (files, file_of, scene.thickness.to_bits(), parts, joinings(scene), duties(scene)))
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
