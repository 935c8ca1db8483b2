//! Components of the grid that follow others, a = P â: what P does to M, B and G.

use std::collections::BTreeMap;

use super::place::Nodes;
use crate::sparse::{Banded, Csr};

/// P, direction by direction.
pub(super) struct Slaves {
    components: usize,
    count: usize,
    /// Rows of the mass matrix that follow others, with weights, for every direction.
    by_row: Vec<BTreeMap<usize, Vec<(usize, f64)>>>,
    /// The same with the numbers of the nodes.
    by_node: Vec<BTreeMap<usize, Vec<(usize, f64)>>>,
}

impl Slaves {
    pub(super) fn new(nodes: &Nodes, components: usize) -> Slaves {
        let mut by_row = vec![BTreeMap::new(); components];
        let mut by_node = by_row.clone();
        for slave in &nodes.slaved {
            let rows = slave.from.iter().map(|&(node, weight)| (nodes.row[node], weight)).collect();
            by_row[slave.component].insert(nodes.row[slave.node], rows);
            by_node[slave.component].insert(slave.node, slave.from.clone());
        }
        Slaves { components, count: nodes.count, by_row, by_node }
    }

    fn none(&self) -> bool {
        self.by_row.iter().all(BTreeMap::is_empty)
    }

    /// Pᵀ B by its entries.
    pub(super) fn gathered(&self, entries: Vec<(usize, usize, f64)>) -> Vec<(usize, usize, f64)> {
        if self.none() {
            return entries;
        }
        let c = self.components;
        let mut found = Vec::with_capacity(entries.len());
        for (row, column, value) in entries {
            match self.by_row[row % c].get(&(row / c)) {
                Some(from) => found.extend(from.iter().map(|&(i, w)| (c * i + row % c, column, w * value))),
                None => found.push((row, column, value)),
            }
        }
        found
    }

    /// Pᵀ M P factored: one for all directions, or one for each; a row that follows others is a row of the identity.
    pub(super) fn masses(&self, mass: &[f64], band: usize) -> Vec<Banded> {
        if self.none() {
            return vec![Banded::factor(band, mass.to_vec())];
        }
        self.by_row.iter().map(|slaves| self.mass(slaves, mass, band)).collect()
    }

    fn mass(&self, slaves: &BTreeMap<usize, Vec<(usize, f64)>>, mass: &[f64], band: usize) -> Banded {
        let own = |i: usize| slaves.get(&i).cloned().unwrap_or_else(|| vec![(i, 1.0)]);
        let mut entries: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for i in 0..self.count {
            for j in i.saturating_sub(band)..=i {
                let value = mass[i * (band + 1) + band + j - i];
                let mut add = |p: &[(usize, f64)], q: &[(usize, f64)]| {
                    for &(p, left) in p {
                        for &(q, right) in q.iter().filter(|(q, _)| *q <= p) {
                            *entries.entry((p, q)).or_default() += left * right * value;
                        }
                    }
                };
                add(&own(i), &own(j));
                if i != j {
                    add(&own(j), &own(i));
                }
            }
        }
        slaves.keys().for_each(|&i| _ = entries.insert((i, i), 1.0));
        let width = entries.keys().map(|(i, j)| i - j).max().unwrap_or(0);
        let mut rows = vec![0.0; (width + 1) * self.count];
        entries.into_iter().for_each(|((i, j), value)| rows[i * (width + 1) + width + j - i] = value);
        Banded::factor(width, rows)
    }

    /// P Ĝ.
    pub(super) fn spread(&self, jump: Csr) -> Csr {
        if self.none() {
            return jump;
        }
        let c = self.components;
        let mut entries = Vec::with_capacity(jump.values.len());
        for row in 0..jump.rows() {
            let own = vec![(row / c, 1.0)];
            for &(i, weight) in self.by_node[row % c].get(&(row / c)).unwrap_or(&own) {
                let (columns, values) = jump.row(c * i + row % c);
                entries
                    .extend(columns.iter().zip(values).map(|(&column, value)| (row, column, weight * value)));
            }
        }
        Csr::from_triplets(jump.rows(), jump.width, &entries)
    }
}
