//! `projected`: the jump is projected in L2 on the mid-plane's own grid.
//!
//! ```text
//! B_i u = Σ_q w_q φ_i(x_q) (u_B − u_A)(x_q),      M_ij = Σ_q w_q φ_i(x_q) φ_j(x_q),      G = M⁻¹ B
//! ```
//!
//! q runs over quadrature points of the segments, φ_i are the continuous functions of the grid (quadratic where both sides
//! have quadratic edges and it is asked for, else linear), and the law acts at the quadrature points of the grid's cells. The pointwise scheme asks two unmatched faces to agree at more points
//! than they have unknowns; this one asks for what the coarser face can give, so its error does not grow with stiffness.

use super::banded::Banded;
use super::{Coupling, Csr, LawPoint, Midplane, Points, grid, jump, pointwise};
use crate::shape::{GAUSS_2, GAUSS_3, lagrange2, lagrange3};

/// Entries of G below this are dropped. Of the largest in their row.
const NEGLIGIBLE: f64 = 1e-17;

pub(super) fn build(midplane: Midplane, points: Points, allow_quadratic: bool) -> Coupling {
    let components = 2;
    let quadratic = allow_quadratic && midplane.a.is_quadratic() && midplane.b.is_quadratic();
    let grid = Grid { ends: grid::nodes(&midplane), quadratic };
    let (nodes, band) = (grid.nodes(), grid.order());
    let width = components * (midplane.a.nodes.len() + midplane.b.nodes.len());

    // B by rows (grid node, component), M in its band; a quadratic side needs three points also on a linear grid
    let any = midplane.a.mids.iter().chain(&midplane.b.mids).any(Option::is_some);
    let mut b = Vec::new();
    let mut mass = vec![0.0; (band + 1) * nodes];
    for segment in &midplane.segments {
        let half = 0.5 * (segment.end - segment.start);
        let cell = grid.cell_of(segment.start + half);
        for &[xi, weight] in if any { GAUSS_3 } else { GAUSS_2 } {
            let s = segment.start + half * (1.0 + xi);
            let w = half * weight;
            let functions = grid.functions(cell, s);
            for (i, phi_i) in functions {
                for (j, phi_j) in functions.into_iter().filter(|&(j, phi)| j <= i && phi != 0.0) {
                    mass[i * (band + 1) + band + j - i] += w * phi_i * phi_j;
                }
            }
            jump::entries(&midplane, segment.edge_a, segment.edge_b, s, |entry| {
                for (i, phi) in functions.into_iter().filter(|(_, phi)| *phi != 0.0) {
                    let row = components * i + entry.component;
                    b.push((row, components * entry.node + entry.direction, w * phi * entry.value));
                }
            });
        }
    }
    let b = Csr::from_triplets(components * nodes, width, &b);
    let jump = solve(&Banded::factor(band, mass), &b, components, nodes);

    let mut law_points = Vec::new();
    for cell in 0..grid.ends.len() - 1 {
        let half = 0.5 * (grid.ends[cell + 1] - grid.ends[cell]);
        for &[xi, weight] in pointwise::rule(points, quadratic) {
            let s = grid.ends[cell] + half * (1.0 + xi);
            law_points.push(LawPoint {
                weight: half * weight,
                s,
                position: midplane.position(s),
                rotation: midplane.rotation(),
                interpolation: grid.functions(cell, s),
            });
        }
    }
    Coupling {
        components,
        nodes_a: midplane.a.nodes.clone(),
        nodes_b: midplane.b.nodes.clone(),
        jump,
        points: law_points,
        grid: grid.ends,
        midplane,
    }
}

/// The grid of the mid-plane: linear cells, or quadratic ones with a node in their middle. Nodes are numbered along C.
struct Grid {
    ends: Vec<f64>,
    quadratic: bool,
}

impl Grid {
    /// Polynomial order of a cell, which is also the half band width of its mass matrix.
    fn order(&self) -> usize {
        if self.quadratic { 2 } else { 1 }
    }

    fn nodes(&self) -> usize {
        self.order() * (self.ends.len() - 1) + 1
    }

    /// The cell that holds arc length `s`.
    fn cell_of(&self, s: f64) -> usize {
        self.ends.partition_point(|&node| node <= s).clamp(1, self.ends.len() - 1) - 1
    }

    /// Nodes and functions of a cell at arc length `s`; on linear cells the third has the value zero.
    fn functions(&self, cell: usize, s: f64) -> [(usize, f64); 3] {
        let xi = 2.0 * (s - self.ends[cell]) / (self.ends[cell + 1] - self.ends[cell]) - 1.0;
        if self.quadratic {
            let (n, _) = lagrange3(xi);
            [(2 * cell, n[0]), (2 * cell + 2, n[1]), (2 * cell + 1, n[2])]
        } else {
            let (n, _) = lagrange2(xi);
            [(cell, n[0]), (cell + 1, n[1]), (0, 0.0)]
        }
    }
}

/// G = M⁻¹ B, column by column and component by component; what decays to nothing is dropped.
fn solve(mass: &Banded, b: &Csr, components: usize, nodes: usize) -> Csr {
    let by_column = b.transposed();
    let mut column = vec![0.0; nodes];
    let mut triplets = Vec::new();
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
                triplets.push((components * i + component, j, column[i]));
                column[i] = 0.0;
            }
        }
    }
    let mut largest = vec![0.0_f64; b.rows()];
    for &(i, _, value) in &triplets {
        largest[i] = largest[i].max(value.abs());
    }
    triplets.retain(|&(i, _, value)| value.abs() > NEGLIGIBLE * largest[i]);
    Csr::from_triplets(b.rows(), b.width, &triplets)
}
