//! The geometry of the interfaces before anything is solved, as VTU to look at: `midplane check --plot`.

use std::path::{Path, PathBuf};

use super::manifest::{Listing, Manifest, check_free};
use super::vtu::{Array, VtuGrid};
use crate::assembly::{BoundSubdomain, InterfaceOperator, Model};
use crate::error::{Error, Result};
use crate::files::write_whole;

/// Kinds of lines and points in the file.
#[derive(Debug, Clone, Copy)]
enum GeometryKind {
    /// A segment of C.
    Segment = 0,
    /// A cell of the grid.
    GridCell = 1,
    /// An edge of side A.
    EdgeA = 2,
    /// An edge of side B.
    EdgeB = 3,
    /// From the end of a segment to its place on side A.
    ProjectionA = 4,
    /// The same on side B.
    ProjectionB = 5,
    /// A law point, with its normal.
    LawPoint = 6,
}

/// VTK's vertex, line and polyline, by the number of points.
const TYPES: [u8; 3] = [1, 3, 4];

/// Writes `<subdomain>.vtu` with the quality of every cell and `<interface>.vtu` with chains A and B, segments, their
/// parents and feet, grid, law points and normals into a folder, and returns it. Those of an earlier scene go.
pub fn write_geometry(folder: &Path, name: &str, model: &Model) -> Result<PathBuf> {
    let parts = model.subdomains.iter().map(|subdomain| &subdomain.name);
    let all = parts.chain(model.interfaces.iter().map(|interface| &interface.name));
    let files: Vec<String> = all.map(|name| format!("{name}.vtu")).collect();
    if folder.is_symlink() {
        let help = "make the results folder itself the link";
        return Err(Error::folder(folder, "it is a link to another folder", help));
    }
    let earlier = Listing::read(folder)?;
    check_free(folder, earlier.as_ref(), &files, &[])?;
    if let Some(earlier) = earlier {
        earlier.remove_all(folder)?;
    }
    std::fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
    Manifest::create(folder, name)?.add(files.iter().map(String::as_str))?;
    for subdomain in &model.subdomains {
        write_whole(&folder.join(format!("{}.vtu", subdomain.name)), &quality(subdomain).encode())?;
    }
    for interface in &model.interfaces {
        write_whole(&folder.join(format!("{}.vtu", interface.name)), &geometry(interface).encode())?;
    }
    Ok(folder.to_path_buf())
}

fn quality(subdomain: &BoundSubdomain) -> VtuGrid {
    let mut grid = super::fields::mesh(subdomain);
    grid.cell_data =
        vec![Array::float("quality", 1, (0..subdomain.mesh.cells.len()).map(|c| subdomain.mesh.quality(c)))];
    grid
}

/// Lines and points with what they are.
#[derive(Default)]
struct Drawing {
    grid: VtuGrid,
    normals: Vec<f64>,
    /// Kind, number and parent edges of every line and point.
    cells: [Vec<i64>; 4],
}

impl Drawing {
    fn add(
        &mut self,
        kind: GeometryKind,
        number: usize,
        parents: [i64; 2],
        points: &[[f64; 3]],
        normal: [f64; 3],
    ) {
        for p in points {
            self.grid.connectivity.push(self.grid.points.len() as i64 / 3);
            self.grid.points.extend(p);
            self.normals.extend(normal);
        }
        self.grid.offsets.push(self.grid.connectivity.len() as i64);
        self.grid.types.push(TYPES[points.len().min(TYPES.len()) - 1]);
        for (list, value) in self.cells.iter_mut().zip([kind as i64, number as i64, parents[0], parents[1]]) {
            list.push(value);
        }
    }
}

fn geometry(interface: &InterfaceOperator) -> VtuGrid {
    let coupling = &interface.coupling;
    let mut drawing = Drawing::default();
    for (side, kind) in [GeometryKind::EdgeA, GeometryKind::EdgeB].into_iter().enumerate() {
        for e in 0..coupling.facets(side) {
            let mut parents = [-1; 2];
            parents[side] = e as i64;
            drawing.add(kind, e, parents, &coupling.line(side, e), [0.0; 3]);
        }
    }
    for (number, share) in coupling.midplane.segments.iter().enumerate() {
        let parents = share.facets.map(|e| e as i64);
        drawing.add(GeometryKind::Segment, number, parents, &share.places, [0.0; 3]);
        for (end, place) in share.places.into_iter().enumerate() {
            for (side, kind) in [GeometryKind::ProjectionA, GeometryKind::ProjectionB].into_iter().enumerate()
            {
                let xi = 2.0 * share.projections[side][end] - 1.0;
                let foot = coupling.point(side, share.facets[side], xi);
                drawing.add(kind, number, parents, &[place, foot], [0.0; 3]);
            }
        }
    }
    for (number, cell) in coupling.midplane.cells.iter().enumerate() {
        drawing.add(GeometryKind::GridCell, number, [-1; 2], &cell.places, [0.0; 3]);
    }
    for (number, point) in coupling.points.iter().enumerate() {
        drawing.add(GeometryKind::LawPoint, number, [-1; 2], &[point.position], point.rotation[0]);
    }
    let Drawing { mut grid, normals, cells: [kind, number, edge_a, edge_b] } = drawing;
    grid.point_data = vec![Array::float("normal", 3, normals)];
    grid.cell_data = vec![
        Array::int("kind", kind),
        Array::int("number", number),
        Array::int("edge_a", edge_a),
        Array::int("edge_b", edge_b),
    ];
    grid
}
