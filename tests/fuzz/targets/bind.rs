//! Text as a scene, bound to the meshes in the folder of this run.

#![no_main]

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::OnceLock;

use libfuzzer_sys::{Corpus, fuzz_target};
use midplane::mesh::{self, Mesh};
use midplane::problem::{Problem, subdomain_meshes, unused_groups};
use midplane::run;

static MESHES: OnceLock<BTreeMap<String, Mesh>> = OnceLock::new();

fn folder() -> PathBuf {
    std::env::var_os("FUZZ_FOLDER").unwrap_or_default().into()
}

/// All meshes of the folder by the names of their files.
fn meshes() -> BTreeMap<String, Mesh> {
    let files = std::fs::read_dir(folder()).into_iter().flatten().flatten();
    let files =
        files.map(|file| file.path()).filter(|path| path.extension().is_some_and(|kind| kind == "msh"));
    let read =
        |path: PathBuf| Some((path.file_name()?.to_string_lossy().into_owned(), mesh::read(&path).ok()?));
    files.filter_map(read).collect()
}

fuzz_target!(|text: &str| -> Corpus {
    let meshes = MESHES.get_or_init(meshes);
    let file = folder().join("scene.json");
    let Ok(scene) = run::parse_scene(file, text.into(), &[]) else { return Corpus::Reject };
    let (mut files, mut file_of, mut names) = (Vec::new(), Vec::new(), Vec::new());
    for subdomain in scene.subdomains.values() {
        let Some(name) = &subdomain.msh else { return Corpus::Reject };
        let Some(mesh) = meshes.get(name) else { return Corpus::Reject };
        let known = names.iter().position(|other| other == name);
        file_of.push(known.unwrap_or(files.len()));
        if known.is_none() {
            names.push(name.clone());
            files.push(mesh.clone());
        }
    }
    let Ok((meshes, _)) = subdomain_meshes(&scene, files, &file_of) else { return Corpus::Keep };
    if let Ok(problem) = Problem::bind(&scene, meshes) {
        let _ = unused_groups(&scene, &problem.model);
        assert!(!problem.steps.is_empty());
    }
    Corpus::Keep
});
