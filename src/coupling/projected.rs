//! `projected`: the jump is projected in L2 on the mid-plane's own grid.
//!
//! ```text
//! B_i u = Σ_q w_q φ_i(x_q) (u_B − u_A)(x_q),      M_ij = Σ_q w_q φ_i(x_q) φ_j(x_q),      G = M⁻¹ B
//! ```
//!
//! q runs over quadrature points of the segments, φ_i are the continuous functions of the grid (quadratic where both sides
//! have quadratic edges and it is asked for, else linear), and the law acts at the quadrature points of the grid's cells. The pointwise scheme asks two unmatched faces to agree at more points
//! than they have unknowns; this one asks for what the coarser face can give, so its error does not grow with stiffness.

use super::line::grid;
use super::{Coupling, LawPoint, Midplane, Points, jump, pointwise};
use crate::shape::vector::dot;
use crate::shape::{GAUSS_2, GAUSS_3, lagrange2, lagrange3};
use crate::sparse::{Banded, Csr};

/// Entries of G below this are dropped. Of the largest in their row.
const NEGLIGIBLE: f64 = 1e-17;

pub(super) fn build(midplane: Midplane, points: Points, allow_quadratic: bool) -> Coupling {
    let components = 2;
    let quadratic = allow_quadratic && midplane.a.is_quadratic() && midplane.b.is_quadratic();
    let grid = MidplaneGrid::new(&midplane, quadratic);
    let width = components * (midplane.a.nodes.len() + midplane.b.nodes.len());

    // B by rows (grid node, component), M in its band; a quadratic side needs three points also on a linear grid
    let any = midplane.a.mids.iter().chain(&midplane.b.mids).any(Option::is_some);
    let (mut b, mut own, mut apart) = (Vec::new(), Vec::new(), Vec::new());
    let band = grid.band();
    let mut mass = vec![0.0; (band + 1) * grid.nodes];
    let mut cell = 0;
    for (g, segment) in midplane.segments.iter().enumerate() {
        while 0.5 * (segment.start + segment.end) > grid.cells[cell].end && cell + 1 < grid.cells.len() {
            cell += 1;
        }
        for &[eta, weight] in if any { GAUSS_3 } else { GAUSS_2 } {
            let spot = midplane.spot(g, eta);
            let s = segment.start + 0.5 * (segment.end - segment.start) * (1.0 + eta);
            let w = spot.speed * weight;
            let functions = grid.functions(cell, s);
            for (i, phi_i) in functions.map(|(i, phi)| (grid.row[i], phi)) {
                for (j, phi_j) in functions.map(|(j, phi)| (grid.row[j], phi)) {
                    if j <= i && phi_j != 0.0 {
                        mass[i * (band + 1) + band + j - i] += w * phi_i * phi_j;
                    }
                }
            }
            let normal = spot.rotation[0];
            let gap = dot(jump::drawn(&midplane, segment, &spot), normal);
            let drawn = normal.map(|n| n * gap);
            for (i, phi) in functions.into_iter().filter(|(_, phi)| *phi != 0.0) {
                (0..components)
                    .for_each(|d| apart.push((components * grid.row[i] + d, 0, w * phi * drawn[d])));
            }
            jump::entries(&midplane, segment, &spot, |entry| {
                for (i, phi) in functions.into_iter().filter(|(_, phi)| *phi != 0.0) {
                    let row = components * grid.row[i] + entry.component;
                    own.push((row, components * entry.node + entry.direction, w * phi * entry.value));
                }
            });
        }
        // the points of a segment share their places
        own.sort_by_key(|&(i, j, _)| (i, j));
        for same in own.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
            b.push((same[0].0, same[0].1, same.iter().map(|entry| entry.2).sum()));
        }
        own.clear();
    }
    let b = Csr::from_triplets(components * grid.nodes, width, &b);
    let mass = Banded::factor(band, mass);
    let jump = solve(&mass, &b, components, &grid);
    // the drawn gap, projected as the jump is
    let apart = Csr::from_triplets(components * grid.nodes, 1, &apart);
    let apart = solve(&mass, &apart, components, &grid);
    let gap = |functions: &[(usize, f64); 3], normal: [f64; 2]| -> f64 {
        let at = |row: usize| apart.row(row).1.first().copied().unwrap_or(0.0);
        functions.iter().map(|&(i, n)| n * dot([at(components * i), at(components * i + 1)], normal)).sum()
    };

    let mut law_points = Vec::new();
    for (i, cell) in grid.cells.iter().enumerate() {
        let half = 0.5 * (cell.end - cell.start);
        let first = law_points.len();
        for &[xi, weight] in pointwise::rule(points, quadratic) {
            let s = cell.start + half * (1.0 + xi);
            let (g, eta) = midplane.locate(&midplane.pieces[cell.piece], s);
            let (spot, segment) = (midplane.spot(g, eta), &midplane.segments[g]);
            let interpolation = grid.functions(i, s);
            law_points.push(LawPoint {
                weight: half * weight * spot.speed / (0.5 * (segment.end - segment.start)),
                s,
                position: spot.position,
                rotation: spot.rotation,
                gap: gap(&interpolation, spot.rotation[0]),
                interpolation,
            });
        }
        pointwise::share_out(&mut law_points[first..], 2.0 * half);
    }
    Coupling {
        components,
        nodes_a: midplane.a.nodes.clone(),
        nodes_b: midplane.b.nodes.clone(),
        jump,
        points: law_points,
        grid: grid.ends(),
        midplane,
    }
}

/// The grid of the mid-plane: linear cells, or quadratic ones with a node in their middle. Nodes are numbered along C.
struct MidplaneGrid {
    cells: Vec<Cell>,
    quadratic: bool,
    nodes: usize,
    /// Place of every node in the mass matrix: from both ends of a loop in turn, so that its seam does not widen the band.
    row: Vec<usize>,
    closed: bool,
}

/// A cell between two arc lengths.
struct Cell {
    start: f64,
    end: f64,
    piece: usize,
    /// Node at its start, its end and, on a quadratic grid, its middle.
    nodes: [usize; 3],
}

impl MidplaneGrid {
    fn new(midplane: &Midplane, quadratic: bool) -> MidplaneGrid {
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

    /// Polynomial order of a cell.
    fn order(&self) -> usize {
        if self.quadratic { 2 } else { 1 }
    }

    /// Half band width of the mass matrix.
    fn band(&self) -> usize {
        self.order() * if self.closed { 2 } else { 1 }
    }

    /// Arc lengths of the ends of all cells; where the grid splits, twice.
    fn ends(&self) -> Vec<f64> {
        let mut ends = Vec::with_capacity(self.cells.len() + 1);
        for (i, cell) in self.cells.iter().enumerate() {
            if i == 0 || self.cells[i - 1].piece != cell.piece {
                ends.push(cell.start);
            }
            ends.push(cell.end);
        }
        ends
    }

    /// Nodes and functions of a cell at arc length `s`; on linear cells the third has the value zero.
    fn functions(&self, cell: usize, s: f64) -> [(usize, f64); 3] {
        let Cell { start, end, nodes, .. } = self.cells[cell];
        let xi = 2.0 * (s - start) / (end - start) - 1.0;
        if self.quadratic {
            let (n, _) = lagrange3(xi);
            [(nodes[0], n[0]), (nodes[1], n[1]), (nodes[2], n[2])]
        } else {
            let (n, _) = lagrange2(xi);
            [(nodes[0], n[0]), (nodes[1], n[1]), (0, 0.0)]
        }
    }
}

/// G = M⁻¹ B, column by column and component by component; what decays to nothing is dropped.
fn solve(mass: &Banded, b: &Csr, components: usize, grid: &MidplaneGrid) -> Csr {
    let nodes = grid.nodes;
    let mut node_of = vec![0; nodes];
    grid.row.iter().enumerate().for_each(|(node, &row)| node_of[row] = node);
    let by_column = b.transposed();
    let mut column = vec![0.0; nodes];
    let mut largest = vec![0.0_f64; b.rows()];
    let mut found = Csr { offsets: vec![0], width: b.rows(), ..Csr::default() };
    for j in 0..by_column.rows() {
        let (rows, values) = by_column.row(j);
        for component in 0..components {
            let (mut first, mut last) = (nodes, 0);
            for (&row, &value) in rows.iter().zip(values).filter(|(row, _)| *row % components == component) {
                let i = row / components;
                column[i] = value;
                (first, last) = (first.min(i), last.max(i + 1));
            }
            if first >= last {
                continue;
            }
            for i in mass.solve(&mut column, first, last) {
                let row = components * node_of[i] + component;
                largest[row] = largest[row].max(column[i].abs());
                found.columns.push(row);
                found.values.push(column[i]);
                column[i] = 0.0;
            }
        }
        found.offsets.push(found.columns.len());
    }
    found.transposed().retain(|i, value| value.abs() > NEGLIGIBLE * largest[i])
}
