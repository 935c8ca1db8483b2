//! `projected`: the jump is projected in L2 on the mid-plane's own grid.
//!
//! ```text
//! B_i u = Σ_q w_q φ_i(x_q) (u_B − u_A)(x_q),      M_ij = Σ_q w_q φ_i(x_q) φ_j(x_q),      G = M⁻¹ B
//! ```
//!
//! q runs over quadrature points of the segments, φ_i are the continuous linear functions of the grid, and the law acts
//! at the quadrature points of the grid's cells. The pointwise scheme asks two unmatched faces to agree at more points
//! than they have unknowns; this one asks for what the coarser face can give, so its error does not grow with stiffness.

use super::banded::Banded;
use super::{Coupling, Csr, LawPoint, Midplane, Points, grid, jump, pointwise};
use crate::shape::{GAUSS_2, lagrange2};

/// Entries of G below this are dropped. Of the largest in their row.
const NEGLIGIBLE: f64 = 1e-17;

pub(super) fn build(midplane: Midplane, points: Points) -> Coupling {
    let components = 2;
    let grid = grid::nodes(&midplane);
    let width = components * (midplane.a.ends.len() + midplane.b.ends.len());

    // B by rows (grid node, component), M in its band
    let mut b = Vec::new();
    let mut mass = vec![0.0; 2 * grid.len()];
    for segment in &midplane.segments {
        let half = 0.5 * (segment.end - segment.start);
        let cell = cell_of(&grid, segment.start + half);
        for &[xi, weight] in GAUSS_2 {
            let s = segment.start + half * (1.0 + xi);
            let phi = functions(&grid, cell, s);
            let w = half * weight;
            mass[2 * cell + 1] += w * phi[0] * phi[0];
            mass[2 * cell + 2] += w * phi[0] * phi[1];
            mass[2 * cell + 3] += w * phi[1] * phi[1];
            jump::entries(&midplane, segment.edge_a, segment.edge_b, s, |entry| {
                for (i, phi) in phi.into_iter().enumerate() {
                    let row = components * (cell + i) + entry.component;
                    b.push((row, components * entry.node + entry.direction, w * phi * entry.value));
                }
            });
        }
    }
    let b = Csr::from_triplets(components * grid.len(), width, &b);
    let jump = solve(&Banded::factor(1, mass), &b, components, grid.len());

    let mut law_points = Vec::new();
    for cell in 0..grid.len() - 1 {
        let half = 0.5 * (grid[cell + 1] - grid[cell]);
        for &[xi, weight] in pointwise::rule(points) {
            let (n, _) = lagrange2(xi);
            let s = grid[cell] + half * (1.0 + xi);
            law_points.push(LawPoint {
                weight: half * weight,
                s,
                position: midplane.position(s),
                rotation: midplane.rotation(),
                interpolation: [(cell, n[0]), (cell + 1, n[1]), (0, 0.0)],
            });
        }
    }
    Coupling {
        components,
        nodes_a: midplane.a.ends.clone(),
        nodes_b: midplane.b.ends.clone(),
        jump,
        points: law_points,
        grid,
        midplane,
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

/// The grid cell that holds arc length `s`.
fn cell_of(grid: &[f64], s: f64) -> usize {
    grid.partition_point(|&node| node <= s).clamp(1, grid.len() - 1) - 1
}

/// The two functions of a cell at arc length `s`.
fn functions(grid: &[f64], cell: usize, s: f64) -> [f64; 2] {
    let xi = 2.0 * (s - grid[cell]) / (grid[cell + 1] - grid[cell]) - 1.0;
    lagrange2(xi).0
}
