//! Pieces of a mesh: cells that hang together by edges. A node alone holds no moment, so that two pieces with one common
//! node are a hinge.
//!
//! ```text
//!       \  2  /
//!        \   /
//!   ┌─────╳─────┐     two pieces, one hinge
//!   │     1     │
//! ```

use super::edges::EdgeTable;
use super::{Mesh, edges};
use crate::error::Result;

/// The pieces of a mesh.
#[derive(Debug, Clone)]
pub struct Pieces {
    /// Piece of every cell, numbered in the order of their first cells.
    pub of_cell: Vec<usize>,
    /// Their number.
    pub count: usize,
    /// Nodes of several pieces, ascending, with those pieces, ascending.
    pub hinges: Vec<(usize, Vec<usize>)>,
}

impl Mesh {
    /// The pieces of the mesh.
    pub fn pieces(&self) -> Result<Pieces> {
        let table = super::part::table(self, &self.cells, self.points.len())?;
        let of_cell = by_edges(self, &table);
        let count = of_cell.iter().max().map_or(0, |last| last + 1);
        let mut hinges = Vec::new();
        if count > 1 {
            let mut of_node: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
            for (cell, &piece) in of_cell.iter().enumerate() {
                self.cells.nodes(cell).iter().for_each(|&node| of_node[node].push(piece));
            }
            for (node, mut pieces) in of_node.into_iter().enumerate() {
                pieces.sort_unstable();
                pieces.dedup();
                if pieces.len() > 1 {
                    hinges.push((node, pieces));
                }
            }
        }
        Ok(Pieces { of_cell, count, hinges })
    }
}

/// Piece of every cell: a walk over common edges from every cell that has none yet.
fn by_edges(mesh: &Mesh, table: &EdgeTable) -> Vec<usize> {
    let cells = &mesh.cells;
    let mut piece = vec![usize::MAX; cells.len()];
    let (mut count, mut open) = (0, Vec::new());
    for first in 0..cells.len() {
        if piece[first] != usize::MAX {
            continue;
        }
        piece[first] = count;
        open.push(first);
        while let Some(cell) = open.pop() {
            for e in 0..cells.shapes[cell].corners() {
                let [start, end, _] = edges::edge(cells, cell, e);
                if let Some((other, _)) = table.left(cells, end, start)
                    && piece[other] == usize::MAX
                {
                    piece[other] = count;
                    open.push(other);
                }
            }
        }
        count += 1;
    }
    piece
}
