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
        // a row next to a slave meets what the slave meets
        let reach = |(&s, from): (&usize, &Vec<(usize, f64)>)| {
            let near = s.saturating_sub(band)..(s + band + 1).min(self.count);
            let others = near.filter(|&j| j != s).chain(from.iter().map(|(f, _)| *f));
            let meets = others.clone().any(|j| slaves.contains_key(&j));
            let farthest = from.iter().flat_map(|(f, _)| others.clone().map(|j| f.abs_diff(j))).max();
            farthest.unwrap_or(0) + if meets { 2 * band } else { 0 }
        };
        let width = slaves.iter().map(reach).max().unwrap_or(0).max(band).min(self.count - 1);
        let at = |i: usize, j: usize| i.max(j) * (width + 1) + width + i.min(j) - i.max(j);
        let mut rows = vec![0.0; (width + 1) * self.count];
        for i in 0..self.count {
            for j in i.saturating_sub(band)..=i {
                rows[at(i, j)] = mass[i * (band + 1) + band + j - i];
            }
        }
        for (&s, from) in slaves {
            let near = s.saturating_sub(width)..(s + width + 1).min(self.count);
            let own = rows[at(s, s)];
            let coupled: Vec<(usize, f64)> =
                near.filter(|&j| j != s).map(|j| (j, std::mem::take(&mut rows[at(s, j)]))).collect();
            for &(f, weight) in from {
                for &(j, value) in coupled.iter().filter(|(_, value)| *value != 0.0) {
                    rows[at(f, j)] += weight * value * if f == j { 2.0 } else { 1.0 };
                }
                for &(g, other) in from.iter().filter(|(g, _)| *g <= f) {
                    rows[at(f, g)] += weight * other * own;
                }
            }
            rows[at(s, s)] = 1.0;
        }
        Banded::factor(width, rows)
    }

    /// P Ĝ.
    pub(super) fn spread(&self, jump: Csr) -> Csr {
        if self.none() {
            return jump;
        }
        let c = self.components;
        let mut found = Csr { offsets: vec![0], width: jump.width, ..Csr::default() };
        for row in 0..jump.rows() {
            match self.by_node[row % c].get(&(row / c)) {
                None => {
                    let (columns, values) = jump.row(row);
                    found.columns.extend_from_slice(columns);
                    found.values.extend_from_slice(values);
                }
                Some(from) => {
                    let mut sum: BTreeMap<usize, f64> = BTreeMap::new();
                    for &(i, weight) in from {
                        let (columns, values) = jump.row(c * i + row % c);
                        for (&column, value) in columns.iter().zip(values) {
                            *sum.entry(column).or_default() += weight * value;
                        }
                    }
                    found.columns.extend(sum.keys());
                    found.values.extend(sum.values());
                }
            }
            found.offsets.push(found.columns.len());
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coupling::place::Slaved;

    /// Pᵀ M P by dense products against what the banded one solves, for slaves wherever their neighbours are kept.
    #[test]
    fn the_mass_of_kept_nodes_is_that_of_dense_products() {
        let mut seed = 3_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize
        };
        for case in 0..400 {
            let (n, band) = (5 + random() % 9, 1 + case % 2);
            let mut held: Vec<bool> = (0..n).map(|_| random() % 3 == 0).collect();
            (1..n).for_each(|i| held[i] &= !held[i - 1]);
            let kept: Vec<usize> = (0..n).filter(|&i| !held[i]).collect();
            let nearest = |i: usize| {
                let mut near = kept.clone();
                near.sort_by_key(|k| k.abs_diff(i));
                let (a, b) = (near[0] as f64, near[1] as f64);
                let share = (i as f64 - a) / (b - a);
                vec![(near[0], 1.0 - share), (near[1], share)]
            };
            let from: BTreeMap<usize, Vec<(usize, f64)>> =
                (0..n).filter(|&i| held[i]).map(|i| (i, nearest(i))).collect();
            let slaved = from.iter().map(|(&node, from)| Slaved { node, component: 0, from: from.clone() });
            let nodes = Nodes { count: n, row: (0..n).collect(), band, slaved: slaved.collect() };
            let dense = |i: usize, j: usize| match i.abs_diff(j) {
                0 => 6.0 + i as f64,
                d if d <= band => 1.0 / d as f64,
                _ => 0.0,
            };
            let mut mass = vec![0.0; (band + 1) * n];
            for i in 0..n {
                for j in i.saturating_sub(band)..=i {
                    mass[i * (band + 1) + band + j - i] = dense(i, j);
                }
            }
            let p = |i: usize, k: usize| match from.get(&i) {
                Some(from) => from.iter().find(|(node, _)| *node == k).map_or(0.0, |(_, w)| *w),
                None => f64::from(u8::from(i == k)),
            };
            let x: Vec<f64> = (0..n).map(|i| if held[i] { 0.0 } else { 0.3 + (i * i % 7) as f64 }).collect();
            let mut b = vec![0.0; n];
            for &k in &kept {
                for i in 0..n {
                    for j in 0..n {
                        b[k] += (0..n).map(|l| p(i, k) * dense(i, j) * p(j, l) * x[l]).sum::<f64>();
                    }
                }
            }
            Slaves::new(&nodes, 1).masses(&mass, band)[0].solve(&mut b, 0, n);
            (0..n).for_each(|i| assert!((b[i] - x[i]).abs() < 1e-12, "{held:?} {band}: {b:?} {x:?}"));
        }
    }
    /// Node 1 of three follows nodes 0 and 2 in y alone: what acts on it in y goes to them, in x it stays.
    #[test]
    fn a_slave_in_one_component_is_one() {
        let slave = Slaved { node: 1, component: 1, from: vec![(0, 0.25), (2, 0.75)] };
        let nodes = Nodes { count: 3, row: vec![0, 1, 2], band: 1, slaved: vec![slave] };
        let slaves = Slaves::new(&nodes, 2);
        assert!(!slaves.none());
        let mut dense = [[0.0; 2]; 6];
        for (row, column, value) in slaves.gathered(vec![(2, 0, 1.0), (3, 1, 1.0)]) {
            dense[row][column] += value;
        }
        assert_eq!(dense, [[0.0, 0.0], [0.0, 0.25], [1.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.75]]);
    }
}
