//! Cells of the grid on a line, and their functions.

use super::super::place::{Nodes, Slaved};
use super::{LineMidplane, grid};
use crate::shape::{lagrange2, lagrange3};

/// The grid of the mid-plane: linear cells, or quadratic ones with a node in their middle. Nodes are numbered along C.
pub(super) struct MidplaneGrid {
    pub cells: Vec<Cell>,
    quadratic: bool,
    nodes: usize,
    /// Place of every node in the mass matrix: from both ends of a loop in turn, so that its seam does not widen the band.
    row: Vec<usize>,
    closed: bool,
}

/// A cell between two arc lengths.
pub(super) struct Cell {
    pub start: f64,
    pub end: f64,
    pub piece: usize,
    /// Node at its start, its end and, on a quadratic grid, its middle.
    nodes: [usize; 3],
}

impl MidplaneGrid {
    pub fn new(midplane: &LineMidplane, quadratic: bool) -> MidplaneGrid {
        let mut grid =
            MidplaneGrid { cells: Vec::new(), quadratic, nodes: 0, row: Vec::new(), closed: false };
        let order = grid.order();
        for (p, piece) in midplane.pieces.iter().enumerate() {
            let ends = grid::nodes(midplane, piece);
            let first = grid.nodes;
            let count = order * (ends.len() - 1) + usize::from(!piece.closed);
            for (i, pair) in ends.windows(2).enumerate() {
                let node = |k: usize| first + (order * i + k) % count.max(1);
                let nodes = [node(0), node(order), if quadratic { node(1) } else { node(0) }];
                grid.cells.push(Cell { start: pair[0], end: pair[1], piece: p, nodes });
            }
            let fold = |k: usize| match (piece.closed, 2 * k <= count) {
                (false, _) => k,
                (true, true) => (2 * k).saturating_sub(1),
                (true, false) => 2 * (count - k),
            };
            grid.row.extend((0..count).map(|k| first + fold(k)));
            grid.closed |= piece.closed;
            grid.nodes += count;
        }
        grid
    }

    /// True if its cells have a node in their middle.
    pub fn is_quadratic(&self) -> bool {
        self.quadratic
    }

    /// Polynomial order of a cell.
    fn order(&self) -> usize {
        if self.quadratic { 2 } else { 1 }
    }

    /// Half band width of the mass matrix.
    fn band(&self) -> usize {
        self.order() * if self.closed { 2 } else { 1 }
    }

    /// Arc lengths of the ends of all cells; where the grid splits, twice.
    pub fn ends(&self) -> Vec<f64> {
        let mut ends = Vec::with_capacity(self.cells.len() + 1);
        for (i, cell) in self.cells.iter().enumerate() {
            if i == 0 || self.cells[i - 1].piece != cell.piece {
                ends.push(cell.start);
            }
            ends.push(cell.end);
        }
        ends
    }

    /// Nodes and functions of a cell at arc length `s`.
    pub fn functions(&self, cell: usize, s: f64) -> Vec<(usize, f64)> {
        let Cell { start, end, nodes, .. } = self.cells[cell];
        let xi = 2.0 * (s - start) / (end - start) - 1.0;
        if self.quadratic {
            let (n, _) = lagrange3(xi);
            nodes.into_iter().zip(n).collect()
        } else {
            let (n, _) = lagrange2(xi);
            nodes.into_iter().zip(n).collect()
        }
    }

    /// Nodes of a piece and their arc lengths, in order; on a loop the seam only at its start.
    pub fn along(&self, piece: usize) -> Vec<(usize, f64)> {
        let mut found: Vec<(usize, f64)> = Vec::new();
        for Cell { start, end, nodes, .. } in self.cells.iter().filter(|cell| cell.piece == piece) {
            if found.is_empty() {
                found.push((nodes[0], *start));
            }
            if self.quadratic {
                found.push((nodes[2], 0.5 * (start + end)));
            }
            found.push((nodes[1], *end));
        }
        if self.closed && found.len() > 1 && found[0].0 == found[found.len() - 1].0 {
            found.pop();
        }
        found
    }

    /// Its nodes, as the mass matrix sees them.
    pub fn nodes(&self, slaved: Vec<Slaved>) -> Nodes {
        Nodes { count: self.nodes, row: self.row.clone(), band: self.band(), slaved }
    }
}
