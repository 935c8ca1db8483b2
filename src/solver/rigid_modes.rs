//! Rigid motions of a body that its supports leave free: those of every piece. Pieces that share a node move alike there.
//!
//! ```text
//! free motions of hinged pieces      null space of  Σ v vᵀ at held dofs  +  Σ (vₚ − v_q)(vₚ − v_q)ᵀ at their hinges
//! ```

use std::collections::BTreeMap;

use nalgebra::{DMatrix, SymmetricEigen};

use crate::assembly::RigidMotions;

/// A motion that supports and hinges resist by less than this part of a node's is free.
const FREE: f64 = 1e-12;
/// Least part of a mode on the separator that is independent of those before it.
const SEEN: f64 = 1e-8;

/// Free motions on all dofs of a body, orthonormal on its separator (dofs with a place). `pieces`: their nodes where it falls
/// into several. At most `most` of them.
pub(super) fn free_rigid_modes(
    components: usize,
    pieces: &[Vec<usize>],
    coordinates: &[f64],
    constrained: &[bool],
    places: &[Option<u32>],
) -> Vec<Vec<f64>> {
    let whole = [(0..coordinates.len() / components).collect()];
    let pieces = if pieces.is_empty() { &whole } else { pieces };
    let pieces: Vec<ModalPiece> =
        pieces.iter().map(|nodes| ModalPiece::new(components, nodes, coordinates)).collect();
    let mut of_node: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (p, piece) in pieces.iter().enumerate().filter(|_| pieces.len() > 1) {
        piece.nodes.iter().for_each(|&node| of_node.entry(node).or_default().push(p));
    }
    of_node.retain(|_, pieces| pieces.len() > 1);
    let chains = chains(pieces.len(), &of_node);
    chains.iter().flat_map(|chain| of_chain(chain, &pieces, &of_node, constrained, places)).collect()
}

/// Most motions that a body can have.
pub(super) fn most(components: usize, pieces: &[Vec<usize>]) -> usize {
    pieces.len().max(1) * RigidMotions::most(components)
}

/// A piece and its rigid motions.
struct ModalPiece<'a> {
    nodes: &'a [usize],
    coordinates: &'a [f64],
    motions: RigidMotions,
}

impl<'a> ModalPiece<'a> {
    fn new(c: usize, nodes: &'a [usize], coordinates: &'a [f64]) -> ModalPiece<'a> {
        let points = nodes.iter().map(|&node| &coordinates[c * node..c * (node + 1)]);
        ModalPiece { nodes, coordinates, motions: RigidMotions::of(c, points) }
    }

    fn components(&self) -> usize {
        self.motions.centre.len()
    }

    /// A component of a motion at a node.
    fn value(&self, mode: usize, node: usize, d: usize) -> f64 {
        let c = self.components();
        self.motions.value(mode, &self.coordinates[c * node..c * (node + 1)], d)
    }
}

/// Pieces that hang together by hinges, each chain ascending. `of_node`: pieces of the nodes that several share.
fn chains(count: usize, of_node: &BTreeMap<usize, Vec<usize>>) -> Vec<Vec<usize>> {
    let mut chain: Vec<usize> = (0..count).collect();
    for pieces in of_node.values() {
        let (to, from): (usize, Vec<usize>) =
            (pieces.iter().map(|&p| chain[p]).min().unwrap_or(0), pieces.iter().map(|&p| chain[p]).collect());
        chain.iter_mut().filter(|of| from.contains(of)).for_each(|of| *of = to);
    }
    let mut all: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    chain.iter().enumerate().for_each(|(p, &of)| all.entry(of).or_default().push(p));
    all.into_values().collect()
}

/// The free motions of pieces that hang together.
fn of_chain(
    chain: &[usize],
    pieces: &[ModalPiece],
    of_node: &BTreeMap<usize, Vec<usize>>,
    constrained: &[bool],
    places: &[Option<u32>],
) -> Vec<Vec<f64>> {
    let c = pieces[chain[0]].components();
    let each = pieces[chain[0]].motions.count();
    let count = each * chain.len();
    let mut resisted = DMatrix::<f64>::zeros(count, count);
    let mut resist = |row: &[(usize, f64)]| {
        for (i, a) in row {
            row.iter().for_each(|(j, b)| resisted[(*i, *j)] += a * b);
        }
    };
    let entries = |place: usize, node: usize, d: usize, sign: f64| {
        let piece = &pieces[chain[place]];
        (0..each).map(move |mode| (each * place + mode, sign * piece.value(mode, node, d)))
    };
    for (place, &p) in chain.iter().enumerate() {
        for &node in pieces[p].nodes {
            for d in (0..c).filter(|d| constrained[c * node + d]) {
                resist(&entries(place, node, d, 1.0).collect::<Vec<_>>());
            }
        }
    }
    for (&node, sharing) in of_node.iter().filter(|(_, sharing)| chain.contains(&sharing[0])) {
        let places: Vec<usize> = sharing.iter().filter_map(|p| chain.binary_search(p).ok()).collect();
        for pair in places.windows(2) {
            for d in 0..c {
                let row = entries(pair[0], node, d, 1.0).chain(entries(pair[1], node, d, -1.0));
                resist(&row.collect::<Vec<_>>());
            }
        }
    }
    let eigen = SymmetricEigen::new(resisted);
    let on_separator = |a: &[f64], b: &[f64]| -> f64 {
        let separator = places.iter().enumerate().filter(|(_, place)| place.is_some());
        separator.map(|(dof, _)| a[dof] * b[dof]).sum()
    };
    let mut rigid_modes: Vec<Vec<f64>> = Vec::new();
    for k in (0..count).filter(|&k| eigen.eigenvalues[k] <= FREE) {
        let mut motion = vec![0.0; constrained.len()];
        for (place, &p) in chain.iter().enumerate() {
            for &node in pieces[p].nodes {
                for d in 0..c {
                    let share = entries(place, node, d, 1.0);
                    motion[c * node + d] = share.map(|(i, value)| eigen.eigenvectors[(i, k)] * value).sum();
                }
            }
        }
        let before = on_separator(&motion, &motion).sqrt();
        for other in &rigid_modes {
            let share = on_separator(&motion, other);
            motion.iter_mut().zip(other).for_each(|(motion, other)| *motion -= share * other);
        }
        let length = on_separator(&motion, &motion).sqrt();
        if length > SEEN * before {
            motion.iter_mut().for_each(|value| *value /= length);
            rigid_modes.push(motion);
        }
    }
    rigid_modes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that hang together at a node, one of them held at another: both turn about it and the hinge.
    #[test]
    fn a_hinge_leaves_a_turn() {
        let pieces = [vec![0, 1, 2], vec![2, 3, 4]];
        let x = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 2.0, -1.0, 3.0];
        let mut constrained = [false; 10];
        (constrained[0], constrained[1]) = (true, true);
        let places: Vec<Option<u32>> = (0..10).map(Some).collect();
        let rigid_modes = free_rigid_modes(2, &pieces, &x, &constrained, &places);
        assert_eq!((rigid_modes.len(), most(2, &pieces)), (2, 6));
        for a in &rigid_modes {
            assert!(a[0].abs() < 1e-12 && a[1].abs() < 1e-12, "the point stays");
            for (p, q) in [(0, 1), (1, 2), (2, 0), (2, 3), (3, 4), (4, 2)] {
                let stretch: f64 =
                    (0..2).map(|d| (x[2 * q + d] - x[2 * p + d]) * (a[2 * q + d] - a[2 * p + d])).sum();
                assert!(stretch.abs() < 1e-12, "no distance changes");
            }
        }
    }

    /// Two separate triangles: one is held at a point, which leaves its rotation; the other floats.
    #[test]
    fn supports_leave_the_rigid_modes_that_they_do_not_resist() {
        let cells = [[0_usize, 1, 2], [3, 4, 5]];
        let pieces = cells.map(|cell| cell.to_vec());
        let x = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 3.0, 0.0, 4.0, 0.0, 3.0, 1.0];
        let mut constrained = [false; 12];
        (constrained[0], constrained[1]) = (true, true);
        let places: Vec<Option<u32>> = (0..12).map(|dof| (dof % 6 >= 2).then_some(dof as u32)).collect();
        let rigid_modes = free_rigid_modes(2, &pieces, &x, &constrained, &places);
        assert_eq!((rigid_modes.len(), most(2, &pieces)), (4, 6));
        let separator = |a: &[f64], b: &[f64]| -> f64 {
            (0..12).filter(|&i| places[i].is_some()).map(|i| a[i] * b[i]).sum()
        };
        for (i, a) in rigid_modes.iter().enumerate() {
            assert!(a[0].abs() < 1e-12 && a[1].abs() < 1e-12, "the point stays");
            for (j, b) in rigid_modes.iter().enumerate() {
                assert!((separator(a, b) - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
            for cell in cells {
                for (p, q) in [(0, 1), (1, 2), (2, 0)] {
                    let (p, q) = (cell[p], cell[q]);
                    let stretch: f64 =
                        (0..2).map(|d| (x[2 * q + d] - x[2 * p + d]) * (a[2 * q + d] - a[2 * p + d])).sum();
                    assert!(stretch.abs() < 1e-12, "no distance changes");
                }
            }
        }
    }
}
