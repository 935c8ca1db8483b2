//! The edges of all cells, to find the cell beside an edge of a physical curve.
//!
//! Every counter-clockwise cell walks its edges with itself on the left, so that in an intact mesh each directed edge
//! start → end occurs once. They are kept in compressed rows by start: flat arrays, time linear in the mesh.

use super::msh::MeshFault;
use super::{Cells, Facet};

/// Directed edges by start node.
pub(super) struct EdgeTable {
    /// The edges that start at node n are `ends[rows[n]..rows[n + 1]]`.
    rows: Vec<u32>,
    /// End node and cell of every edge, ascending by end within a row.
    ends: Vec<[u32; 2]>,
}

impl EdgeTable {
    /// Collects the edges; refuses two cells on the same side of one edge and cells that disagree about its mid-node.
    pub(super) fn new(cells: &Cells, points: usize, tags: &[u64]) -> Result<EdgeTable, MeshFault> {
        if cells.len() > (u32::MAX / 4) as usize {
            return Err(MeshFault {
                what: format!("has {} cells", cells.len()),
                help: "use a coarser mesh".into(),
            });
        }
        let mut rows = vec![0_u32; points + 2];
        each_edge(cells, |_, [start, _, _]| rows[start + 2] += 1);
        for n in 2..rows.len() {
            rows[n] += rows[n - 1];
        }
        // rows[n + 1] is where the next edge from n goes; when all are placed it is where row n ends
        let mut ends = vec![[0_u32; 2]; rows[points + 1] as usize];
        each_edge(cells, |c, [start, end, _]| {
            let place = &mut rows[start + 1];
            ends[*place as usize] = [end as u32, c as u32];
            *place += 1;
        });
        rows.pop();
        for n in 0..points {
            let row = &mut ends[rows[n] as usize..rows[n + 1] as usize];
            row.sort_unstable();
            if let Some(pair) = row.windows(2).find(|pair| pair[0][0] == pair[1][0]) {
                let [a, b] = [pair[0][1], pair[1][1]].map(|c| tags[c as usize]);
                return Err(MeshFault {
                    what: format!("elements {a} and {b} lie on the same side of one edge: they overlap"),
                    help: "look for surfaces that cover each other in the .geo".into(),
                });
            }
        }
        let table = EdgeTable { rows, ends };
        table.same_mid_nodes(cells, tags)?;
        Ok(table)
    }

    /// The cell on the left of start → end, and its nodes there (start, end, mid-node or the end again).
    pub(super) fn left(&self, cells: &Cells, start: usize, end: usize) -> Option<(usize, [usize; 3])> {
        let row = &self.ends[self.rows[start] as usize..self.rows[start + 1] as usize];
        let found = row.binary_search_by_key(&end, |[end, _]| *end as usize).ok()?;
        let cell = row[found][1] as usize;
        let corners = cells.shapes[cell].corners();
        (0..corners).map(|e| (cell, edge(cells, cell, e))).find(|(_, nodes)| nodes[0] == start)
    }

    /// The edge of a curve with these nodes, turned so that a cell is on its left.
    pub(super) fn find(&self, cells: &Cells, start: usize, end: usize) -> Option<Facet> {
        let (along, against) = (self.left(cells, start, end), self.left(cells, end, start));
        let boundary = along.is_none() || against.is_none();
        along.or(against).map(|(cell, nodes)| facet(nodes, cell, boundary))
    }

    /// The edges without a cell on their right.
    pub(super) fn boundary(&self, cells: &Cells) -> Vec<Facet> {
        let mut found = Vec::new();
        each_edge(cells, |cell, nodes| {
            if self.left(cells, nodes[1], nodes[0]).is_none() {
                found.push(facet(nodes, cell, true));
            }
        });
        found
    }

    fn same_mid_nodes(&self, cells: &Cells, tags: &[u64]) -> Result<(), MeshFault> {
        if !cells.shapes.iter().any(|shape| shape.is_quadratic()) {
            return Ok(());
        }
        for c in 0..cells.len() {
            for e in 0..cells.shapes[c].corners() {
                let [start, end, mid] = edge(cells, c, e);
                let Some((other, nodes)) = self.left(cells, end, start) else { continue };
                let mids = [(mid, end), (nodes[2], start)].map(|(mid, last)| (mid != last).then_some(mid));
                if mids[0] != mids[1] {
                    return Err(MeshFault {
                        what: format!(
                            "elements {} and {} share an edge but not its mid-node",
                            tags[c], tags[other]
                        ),
                        help: "mesh the whole body with one Mesh.ElementOrder".into(),
                    });
                }
            }
        }
        Ok(())
    }
}

/// Start, end and mid-node of edge `e` of cell `c`; the end again on linear cells.
#[inline]
pub(super) fn edge(cells: &Cells, c: usize, e: usize) -> [usize; 3] {
    let (shape, nodes) = (cells.shapes[c], cells.nodes(c));
    let [start, end, mid] = shape.edge(e);
    [nodes[start], nodes[end], nodes[if shape.is_quadratic() { mid } else { end }]]
}

/// An edge as a facet.
pub(super) fn facet(nodes: [usize; 3], cell: usize, boundary: bool) -> Facet {
    let count = if nodes[2] == nodes[1] { 2 } else { 3 };
    Facet::edge(&nodes[..count], cell, boundary)
}

/// Every edge of every cell, with that cell on its left.
#[inline]
pub(super) fn each_edge(cells: &Cells, mut visit: impl FnMut(usize, [usize; 3])) {
    for c in 0..cells.len() {
        for e in 0..cells.shapes[c].corners() {
            visit(c, edge(cells, c, e));
        }
    }
}
