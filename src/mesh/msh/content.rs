//! The content of a mesh file, and what may be wrong with it.

use crate::shape::{LINE_NODES, Shape};

/// A fault of a file and its remedy; the caller knows its name.
#[derive(Debug)]
pub(in crate::mesh) struct MeshFault {
    pub(in crate::mesh) what: String,
    pub(in crate::mesh) help: String,
}

/// A file that gmsh did not write like this.
pub(in crate::mesh) fn damaged(what: impl Into<String>) -> MeshFault {
    MeshFault { what: what.into(), help: "the file is damaged: write it again (gmsh -format msh41)".into() }
}

/// The content of a file. Elements refer to nodes by number.
#[derive(Debug, Default)]
pub(in crate::mesh) struct Content {
    /// Tags of the nodes, for messages.
    pub(in crate::mesh) node_tags: Vec<u64>,
    /// Their coordinates.
    pub(in crate::mesh) points: Vec<[f64; 2]>,
    /// Nodes that belong to points of the geometry.
    pub(in crate::mesh) corners: Vec<u32>,
    /// Largest |z| and the node that has it.
    pub(in crate::mesh) off_plane: (f64, u64),
    /// Physical points: node.
    pub(in crate::mesh) vertices: Vec<u32>,
    /// Shapes of the elements of curves.
    pub(in crate::mesh) edge_shapes: Vec<Shape>,
    /// Their nodes: ends, then inner nodes, as many as each has.
    pub(in crate::mesh) edges: Vec<[u32; LINE_NODES]>,
    /// Shapes of the cells.
    pub(in crate::mesh) shapes: Vec<Shape>,
    /// Nodes of the cells, one after the other.
    pub(in crate::mesh) cell_nodes: Vec<u32>,
    /// Tags of vertices, edges and cells, for messages.
    pub(in crate::mesh) tags: [Vec<u64>; 3],
    /// Runs of elements that belong to the same groups.
    pub(in crate::mesh) blocks: Vec<EntityBlock>,
    /// All groups, named ones first.
    pub(in crate::mesh) declared: Vec<Declared>,
}

/// Consecutive vertices, edges or cells (by `dim`) of one entity.
#[derive(Debug)]
pub(in crate::mesh) struct EntityBlock {
    pub(in crate::mesh) dim: usize,
    pub(in crate::mesh) members: std::ops::Range<usize>,
    pub(in crate::mesh) groups: Vec<u32>,
}

/// Names of the dimensions.
pub(in crate::mesh) const KINDS: [&str; 4] = ["point", "curve", "surface", "volume"];

/// A physical group as gmsh declares it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::mesh) struct Declared {
    /// 0 point, 1 curve, 2 surface, 3 volume.
    pub(in crate::mesh) dim: usize,
    /// Its number, unique within the dimension.
    pub(in crate::mesh) tag: u32,
    /// Its name; the number as text if it has none.
    pub(in crate::mesh) name: String,
}

impl Declared {
    /// The refusal of a group that holds nothing.
    pub(in crate::mesh) fn empty(&self) -> MeshFault {
        let kind = KINDS[self.dim];
        let help = match self.dim {
            3 => "a plane mesh has physical points, curves and surfaces".into(),
            _ => format!("a physical {kind} lists {kind}s that exist and are meshed"),
        };
        MeshFault { what: format!("physical {kind} \"{}\" has no elements", self.name), help }
    }
}
