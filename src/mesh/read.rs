//! From an MSH file to a `Mesh`: every promise of this room is checked here.

use std::io::Read;
use std::path::Path;

use super::cells::orient;
use super::edges::EdgeTable;
use super::groups::{UNUSED, gather};
use super::msh::{self, Content, MeshFault};
use super::{Cells, Mesh};
use crate::error::{Error, Result};
use crate::shape::vector::in_space;

/// |z| up to this part of the mesh's extent counts as zero.
const ON_PLANE: f64 = 1e-9;
/// Bytes that hold the version of a mesh file.
const HEAD: usize = 64;

/// Reads an MSH 4.1 file, text or binary.
pub fn read(path: &Path) -> Result<Mesh> {
    let bytes = std::fs::read(path).map_err(Error::io("read", path))?;
    let content = msh::content(&bytes).map_err(at(path))?;
    drop(bytes); // the arrays below take its place in memory
    build(path, content).map_err(at(path))
}

/// True for a file of MSH 2 or 4.0, which gmsh can convert.
pub fn is_earlier_format(path: &Path) -> Result<bool> {
    let mut start = [0; HEAD];
    let mut file = std::fs::File::open(path).map_err(Error::io("read", path))?;
    let mut length = 0;
    while length < HEAD {
        match file.read(&mut start[length..]).map_err(Error::io("read", path))? {
            0 => break,
            more => length += more,
        }
    }
    let text = String::from_utf8_lossy(&start[..length]);
    let version = text.strip_prefix("$MeshFormat").and_then(|rest| rest.split_whitespace().next());
    Ok(version.is_some_and(|version| version.starts_with('2') || matches!(version, "4" | "4.0")))
}

/// Reads the bytes of an MSH 4.1 file; `path` is for messages.
pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    msh::content(bytes).and_then(|content| build(path, content)).map_err(at(path))
}

fn at(path: &Path) -> impl Fn(MeshFault) -> Error {
    move |fault| Error::mesh(path, fault.what, fault.help)
}

fn build(path: &Path, mut content: Content) -> std::result::Result<Mesh, MeshFault> {
    on_plane(&content)?;
    let numbers = drop_unused(&mut content);
    let mut cells =
        widen(std::mem::take(&mut content.shapes), std::mem::take(&mut content.cell_nodes), &numbers);
    orient(&mut cells, &content.points, &content.tags[2])?;
    let edges = EdgeTable::new(&cells, content.points.len(), &content.tags[2])?;
    let groups = gather(&content, &cells, &edges, &numbers)?;
    let kept = content.corners.iter().map(|&node| numbers[node as usize]).filter(|&number| number != UNUSED);
    let mut corners: Vec<usize> = kept.map(|number| number as usize).collect();
    corners.sort_unstable();
    Ok(Mesh {
        file: path.to_path_buf(),
        points: content.points.into_iter().map(in_space).collect(),
        cells,
        corners,
        groups,
    })
}

/// Refuses nodes off the plane z = 0.
fn on_plane(content: &Content) -> std::result::Result<(), MeshFault> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for point in &content.points {
        for d in 0..2 {
            (low[d], high[d]) = (low[d].min(point[d]), high[d].max(point[d]));
        }
    }
    let (z, tag) = content.off_plane;
    let extent = (high[0] - low[0]).max(high[1] - low[1]);
    if z > ON_PLANE * extent {
        return Err(MeshFault {
            what: format!("node {tag} is off the plane, |z| = {z:e}"),
            help: "all points of a plane mesh have z = 0".into(),
        });
    }
    Ok(())
}

/// Drops the nodes that no cell uses; returns the new number of every old one.
fn drop_unused(content: &mut Content) -> Vec<u32> {
    let mut numbers = vec![UNUSED; content.points.len()];
    for &node in &content.cell_nodes {
        numbers[node as usize] = 0;
    }
    let mut next = 0;
    for (old, number) in numbers.iter_mut().enumerate() {
        if *number != UNUSED {
            *number = next;
            content.points[next as usize] = content.points[old];
            next += 1;
        }
    }
    content.points.truncate(next as usize);
    numbers
}

/// Cells with their final node numbers.
fn widen(shapes: Vec<crate::shape::Shape>, nodes: Vec<u32>, numbers: &[u32]) -> Cells {
    let mut offsets = Vec::with_capacity(shapes.len() + 1);
    let mut offset = 0;
    offsets.push(0);
    for shape in &shapes {
        offset += shape.nodes();
        offsets.push(offset);
    }
    Cells { shapes, offsets, nodes: nodes.into_iter().map(|node| numbers[node as usize] as usize).collect() }
}
