//! `projected`: the jump is projected in L2 on the mid-plane's own grid.
//!
//! ```text
//! B_i u = Σ_q w_q φ_i(x_q) (u_B − u_A)(x_q),      M_ij = Σ_q w_q φ_i(x_q) φ_j(x_q),      G = M⁻¹ B
//! ```
//!
//! q runs over quadrature points of the segments, φ_i are the continuous functions of the grid (quadratic where both sides
//! have quadratic edges and it is asked for, else linear), and the law acts at the quadrature points of the grid's cells. The pointwise scheme asks two unmatched faces to agree at more points
//! than they have unknowns; this one asks for what the coarser face can give, so its error does not grow with stiffness.
//!
//! Components that follow others (`slaves`) are no unknowns: a = P â and G = P (Pᵀ M P)⁻¹ Pᵀ B, direction by direction.

use super::place::{Nodes, Table};
use super::slaves::Slaves;
use super::{Coupling, LawPoint, jump};
use crate::shape::vector::dot;
use crate::sparse::{Banded, Csr};

/// Entries of G below this are dropped. Of the largest in their row.
const NEGLIGIBLE: f64 = 1e-17;

/// The coupling of a table, displacements with so many components.
pub(super) fn build(table: Table, components: usize) -> Coupling {
    let Nodes { count, row, band, .. } = &table.nodes;
    let (count, band) = (*count, *band);
    let width = components * (table.sides[0].nodes.len() + table.sides[1].nodes.len());
    // B by rows (grid node, component), M in its band
    let (mut b, mut own, mut apart) = (Vec::new(), Vec::new(), Vec::new());
    let mut mass = vec![0.0; (band + 1) * count];
    for places in &table.projection {
        for place in places {
            let w = place.weight;
            for (i, phi_i) in place.functions.iter().map(|&(i, phi)| (row[i], phi)) {
                for (j, phi_j) in place.functions.iter().map(|&(j, phi)| (row[j], phi)) {
                    if j <= i && phi_j != 0.0 {
                        mass[i * (band + 1) + band + j - i] += w * phi_i * phi_j;
                    }
                }
            }
            let normal = place.frame[0];
            let gap = dot(place.apart, normal);
            let drawn = normal.map(|n| n * gap);
            let functions = || place.functions.iter().filter(|(_, phi)| *phi != 0.0);
            for (i, phi) in functions() {
                (0..components).for_each(|d| apart.push((components * row[*i] + d, 0, w * phi * drawn[d])));
            }
            jump::entries(&table, place, components, |entry| {
                for (i, phi) in functions() {
                    let row = components * row[*i] + entry.component;
                    own.push((row, components * entry.node + entry.direction, w * phi * entry.value));
                }
            });
        }
        // places over one pair of facets share their entries
        own.sort_by_key(|&(i, j, _)| (i, j));
        for same in own.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
            b.push((same[0].0, same[0].1, same.iter().map(|entry| entry.2).sum()));
        }
        own.clear();
    }
    let slaves = Slaves::new(&table.nodes, components);
    let b = Csr::from_triplets(components * count, width, &slaves.gathered(b));
    let masses = slaves.masses(&mass, band);
    let jump = slaves.spread(solve(&masses, &b, components, &table.nodes));
    let mass = [Banded::factor(band, mass)];
    // the drawn gap, projected as the jump is
    let apart = Csr::from_triplets(components * count, 1, &apart);
    let apart = solve(&mass, &apart, components, &table.nodes);
    let gap = |functions: &[(usize, f64)], normal: [f64; 3]| -> f64 {
        let at = |row: usize| apart.row(row).1.first().copied().unwrap_or(0.0);
        let along = |i: usize| {
            let products =
                normal.iter().enumerate().take(components).map(|(d, n)| at(components * i + d) * n);
            products.reduce(|a, b| a + b).unwrap_or(0.0)
        };
        functions.iter().map(|&(i, n)| n * along(i)).sum()
    };
    let points = table.points.iter().map(|place| LawPoint::new(place, gap(&place.functions, place.frame[0])));
    let points = points.collect();
    Coupling::new(table, components, jump, points)
}

/// G = M⁻¹ B, column by column and component by component, one M for all or one for each; what decays to nothing is dropped.
fn solve(masses: &[Banded], b: &Csr, components: usize, grid: &Nodes) -> Csr {
    let nodes = grid.count;
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
            let mass = &masses[component.min(masses.len() - 1)];
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
