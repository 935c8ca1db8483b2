//! The mesh of every subdomain: a whole file, or the part of a shared file that one physical surface marks.

use std::path::PathBuf;

use super::groups::{file, refusal};
use crate::error::{Code, Result, Warning, name_help};
use crate::mesh::{Group, Mesh};
use crate::scene::Scene;

/// The meshes of the subdomains in their order, and what of the files no subdomain takes. `files` holds every file
/// once; `file_of` says which of them a subdomain has.
pub fn subdomain_meshes(
    scene: &Scene,
    files: Vec<Mesh>,
    file_of: &[usize],
) -> Result<(Vec<Mesh>, Vec<Warning>)> {
    let mut owner: Vec<Vec<usize>> = files.iter().map(|mesh| vec![usize::MAX; mesh.cells.len()]).collect();
    let mut cells: Vec<Option<&[usize]>> = Vec::new();
    for (number, (name, subdomain)) in scene.subdomains.iter().enumerate() {
        let mesh = &files[file_of[number]];
        let Some(surface) = &subdomain.surface else {
            cells.push(None);
            continue;
        };
        let path = ["subdomains", name, "surface"];
        let of_surface = surface_cells(scene, name, mesh, surface)?;
        for &cell in of_surface {
            let before = std::mem::replace(&mut owner[file_of[number]][cell], number);
            if before != usize::MAX {
                let [x, y, _] = mesh.points[mesh.cells.nodes(cell)[0]];
                let other = &scene.subdomains[before].surface;
                let other = other.as_deref().unwrap_or_default();
                let what = format!("\"{surface}\" and \"{other}\" share cells, near ({x}, {y})");
                return Err(scene.source.error_at(&path, what, "every cell belongs to one subdomain"));
            }
        }
        cells.push(Some(of_surface));
    }
    let mut warnings = Vec::new();
    for (file, mesh) in files.iter().enumerate() {
        let shared = (0..cells.len()).any(|number| file_of[number] == file && cells[number].is_some());
        if shared {
            warnings.extend(left_out(mesh, &owner[file]));
        }
    }
    if cells.iter().all(Option::is_none) && in_order(&files, file_of) {
        return Ok((files, warnings));
    }
    let mut meshes: Vec<Option<Mesh>> = vec![None; cells.len()];
    for (file, mesh) in files.iter().enumerate() {
        let (numbers, kept): (Vec<usize>, Vec<&[usize]>) = (0..cells.len())
            .filter(|&number| file_of[number] == file)
            .filter_map(|number| Some((number, cells[number]?)))
            .unzip();
        for (number, part) in numbers.into_iter().zip(mesh.parts(&kept)?) {
            meshes[number] = Some(part);
        }
    }
    let whole = |number: usize| files[file_of[number]].clone();
    let meshes = meshes.into_iter().enumerate().map(|(number, mesh)| mesh.unwrap_or_else(|| whole(number)));
    Ok((meshes.collect(), warnings))
}

/// The cells of the physical surface that a subdomain consists of.
fn surface_cells<'a>(scene: &Scene, name: &str, mesh: &'a Mesh, surface: &str) -> Result<&'a [usize]> {
    let (path, subdomain) = (["subdomains", name, "surface"], &scene.subdomains[name]);
    let file = file(subdomain);
    let is_surface = |group: &&Group| group.kind() == "surface";
    let found = mesh.groups.get(surface);
    let what = match found.and_then(|group| group.each().iter().find(is_surface)) {
        Some(Group::Cells(cells)) => return Ok(cells),
        Some(fault) => {
            let subdomain = scene.subdomains.get_index_of(name).unwrap_or(0);
            return Err(refusal(scene, &path, (subdomain, surface), fault));
        }
        None => match found {
            Some(other) => format!("\"{surface}\" of {file} is a {}, not a surface", other.kind()),
            None => format!("no surface \"{surface}\" in {file}"),
        },
    };
    let surfaces = mesh.groups.iter().filter(|(_, group)| group.each().iter().any(|one| is_surface(&one)));
    let help = name_help(surface, surfaces.map(|(name, _)| name.as_str()));
    Err(scene.source.error_at(&path, what, help))
}

/// True if every subdomain has the file of its own number.
fn in_order(files: &[Mesh], file_of: &[usize]) -> bool {
    files.len() == file_of.len() && file_of.iter().enumerate().all(|(number, &file)| number == file)
}

/// Surfaces of a shared mesh that no subdomain takes.
fn left_out(mesh: &Mesh, owner: &[usize]) -> Option<Warning> {
    let free = |cells: &Vec<usize>| cells.iter().all(|&cell| owner[cell] == usize::MAX);
    let unused = mesh.groups.iter().filter(|(_, group)| {
        group.each().iter().any(|one| matches!(one, Group::Cells(cells) if free(cells)))
    });
    let names: Vec<String> = unused.map(|(name, _)| format!("\"{name}\"")).collect();
    let left = owner.iter().filter(|&&number| number == usize::MAX).count();
    let file = mesh.file.file_name().map_or_else(PathBuf::new, PathBuf::from);
    (left > 0).then(|| {
        let what = match names.len() {
            0 => format!("{}: {left} cells belong to no subdomain", file.display()),
            _ => format!("{}: no subdomain takes surface {}, {left} cells", file.display(), names.join(", ")),
        };
        Warning::new(
            Code::UnusedCells,
            what,
            "give them a subdomain with that \"surface\", or leave them out",
        )
    })
}
