//! The mesh of one subdomain: points, cells, and groups by physical name.
//!
//! Everything past this room may rely on: every index is in range, every point is finite and belongs to a cell, every
//! cell counts its nodes counter-clockwise and has a positive Jacobian at its nodes and integration points, no two
//! cells lie on the same side of an edge or disagree about its mid-node, every group that is usable has members and none twice, every
//! edge of a curve group knows the cell it bounds and runs with that cell on its left.
//!
//! From a geometry to a mesh: `mesh_all` (`cache`) asks what a .geo consists of (`sources`), runs `gmsh`, and keeps the
//! file; `read` takes its bytes apart (`msh`) and builds `cells`, `edges` and `groups`. Several subdomains may share a
//! mesh, each a `part` of it. Files of earlier formats go through gmsh as a geometry does.

mod cache;
mod cells;
mod confine;
mod edges;
mod gmsh;
mod groups;
mod log;
mod mirror;
mod msh;
mod open;
mod part;
mod pieces;
mod program;
mod quality;
mod read;
mod sources;
mod touch;
mod watch;

use std::path::PathBuf;

use indexmap::IndexMap;

pub use cache::{Job, Meshed, digest, mesh_all, parameters};
pub use gmsh::Gmsh;
pub use open::Branch;
pub use pieces::Pieces;
pub use read::{from_bytes, is_earlier_format, read};
pub use touch::{Touch, coinciding, touching};

use crate::shape::Shape;

/// A plane mesh.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// The `.msh` file it came from, for messages.
    pub file: PathBuf,
    /// Coordinates [length]; z is exactly zero in the plane.
    pub points: Vec<[f64; 3]>,
    /// The cells that fill the body.
    pub cells: Cells,
    /// Points that lie on points of the geometry, ascending; empty if the file does not tell.
    pub corners: Vec<usize>,
    /// Physical groups by name, in the order of the file.
    pub groups: IndexMap<String, Group>,
}

impl Mesh {
    /// Dimension of its cells, and so of the displacements of its points.
    pub fn dimension(&self) -> usize {
        self.cells.shapes.iter().map(|shape| shape.dimension()).max().unwrap_or(0)
    }
}

/// Cells in compressed rows: cell c has the nodes `nodes[offsets[c]..offsets[c + 1]]`.
#[derive(Debug, Clone, Default)]
pub struct Cells {
    /// Shape of every cell.
    pub shapes: Vec<Shape>,
    /// Start of every cell in `nodes`, one more entry than cells.
    pub offsets: Vec<usize>,
    /// Point numbers, corners first.
    pub nodes: Vec<usize>,
}

/// The members of a physical group, by dimension.
#[derive(Debug, Clone)]
pub enum Group {
    /// Physical points: point numbers, ascending.
    Points(Vec<usize>),
    /// Physical curves: edges.
    Edges(Vec<Facet>),
    /// Physical surfaces: cell numbers, ascending.
    Cells(Vec<usize>),
    /// Groups of one name and different dimensions: whoever asks for a curve means the curve.
    Namesakes(Vec<Group>),
    /// A group with a fault, which is told where the group is used.
    Unusable {
        /// "point", "curve", "surface" or "volume".
        kind: &'static str,
        /// The fault, naming the group.
        what: String,
        /// The way out.
        help: String,
    },
}

/// Most nodes of a facet.
const MOST_NODES: usize = 9;

/// A facet of a cell on a physical group: in the plane an edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Facet {
    /// Its shape.
    pub shape: Shape,
    nodes: [usize; MOST_NODES],
    /// The cell that it bounds; of an edge the one on its left.
    pub cell: usize,
    /// True if there is no cell on its other side, so that it lies on the boundary of the body.
    pub boundary: bool,
}

impl Facet {
    /// An edge from its start, its end and, of a quadratic cell, its mid-node.
    pub fn edge(nodes: &[usize], cell: usize, boundary: bool) -> Facet {
        let mut all = [0; MOST_NODES];
        all.iter_mut().zip(nodes).for_each(|(place, node)| *place = *node);
        Facet { shape: Shape::line(nodes.len()), nodes: all, cell, boundary }
    }

    /// Its nodes, corners first.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes[..self.shape.nodes()]
    }

    /// An edge walked the other way.
    pub fn turned(&self) -> Facet {
        let mut facet = *self;
        let order = self.shape.turned_line();
        facet.nodes.iter_mut().zip(order).for_each(|(node, &from)| *node = self.nodes[from]);
        facet
    }

    /// The same facet with other node numbers.
    pub fn renumbered(&self, number: impl Fn(usize) -> usize) -> Facet {
        let mut facet = *self;
        facet.nodes[..self.shape.nodes()].iter_mut().for_each(|node| *node = number(*node));
        facet
    }
}

impl Cells {
    /// Number of cells.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// True without cells.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// Nodes of cell `c`.
    pub fn nodes(&self, c: usize) -> &[usize] {
        &self.nodes[self.offsets[c]..self.offsets[c + 1]]
    }

    /// Adds a cell.
    pub fn push(&mut self, shape: Shape, nodes: &[usize]) {
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
        self.shapes.push(shape);
        self.nodes.extend_from_slice(nodes);
        self.offsets.push(self.nodes.len());
    }
}

impl Group {
    /// The points of the group, ascending, each once.
    pub fn points(&self, mesh: &Mesh) -> Vec<usize> {
        let mut points = match self {
            Group::Points(points) => points.clone(),
            Group::Edges(edges) => edges.iter().flat_map(|edge| edge.nodes().iter().copied()).collect(),
            Group::Cells(cells) => cells.iter().flat_map(|&c| mesh.cells.nodes(c).iter().copied()).collect(),
            Group::Namesakes(all) => all.iter().flat_map(|group| group.points(mesh)).collect(),
            Group::Unusable { .. } => Vec::new(),
        };
        points.sort_unstable();
        points.dedup();
        points
    }

    /// True without members.
    pub fn is_empty(&self) -> bool {
        match self {
            Group::Points(members) | Group::Cells(members) => members.is_empty(),
            Group::Edges(edges) => edges.is_empty(),
            Group::Namesakes(all) => all.is_empty(),
            Group::Unusable { .. } => false,
        }
    }

    /// The groups of this name, one of each dimension.
    pub fn each(&self) -> &[Group] {
        match self {
            Group::Namesakes(all) => all,
            one => std::slice::from_ref(one),
        }
    }

    /// "point", "curve", "surface" or "volume"; the name of several has no kind.
    pub fn kind(&self) -> &'static str {
        match self {
            Group::Points(_) => "point",
            Group::Edges(_) => "curve",
            Group::Cells(_) => "surface",
            Group::Namesakes(_) => "name of several groups",
            Group::Unusable { kind, .. } => kind,
        }
    }
}
