//! Rigid motions of a body that its supports leave free: those of every connected piece.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::assembly::Pattern;

/// A motion that supports resist by less than this part of a node's is free.
const FREE: f64 = 1e-12;
/// What a motion must leave on the border when those before it are taken away.
const SEEN: f64 = 1e-8;

/// Free motions on all dofs of a body, orthonormal on its border (dofs with a place). At most `most` of the pattern.
pub(super) fn free_motions(
    pattern: &Pattern,
    coordinates: &[f64],
    held: &[bool],
    places: &[Option<u32>],
) -> Vec<Vec<f64>> {
    let pieces = pieces(pattern);
    pieces.iter().flat_map(|nodes| of_piece(nodes, pattern, coordinates, held, places)).collect()
}

/// Most motions that a body can have.
pub(super) fn most(pattern: &Pattern) -> usize {
    let c = pattern.components();
    pieces(pattern).len() * (c + c * (c - 1) / 2)
}

fn of_piece(
    nodes: &[usize],
    pattern: &Pattern,
    coordinates: &[f64],
    held: &[bool],
    places: &[Option<u32>],
) -> Vec<Vec<f64>> {
    let c = pattern.components();
    let at = |node: usize, d: usize| coordinates[c * node + d];
    let centre: Vec<f64> =
        (0..c).map(|d| nodes.iter().map(|&node| at(node, d)).sum::<f64>() / nodes.len() as f64).collect();
    let reach = |&node: &usize| (0..c).map(|d| (at(node, d) - centre[d]).powi(2)).sum::<f64>().sqrt();
    let size = nodes.iter().map(reach).fold(f64::MIN_POSITIVE, f64::max);
    let planes: Vec<(usize, usize)> = (0..c).flat_map(|p| (p + 1..c).map(move |q| (p, q))).collect();
    let value = |mode: usize, node: usize, d: usize| match mode.checked_sub(c) {
        None => f64::from(u8::from(mode == d)),
        Some(k) if planes[k].0 == d => -(at(node, planes[k].1) - centre[planes[k].1]) / size,
        Some(k) if planes[k].1 == d => (at(node, planes[k].0) - centre[planes[k].0]) / size,
        Some(_) => 0.0,
    };
    let count = c + planes.len();
    let mut resisted = DMatrix::<f64>::zeros(count, count);
    for &node in nodes {
        for d in (0..c).filter(|d| held[c * node + d]) {
            let row: Vec<f64> = (0..count).map(|mode| value(mode, node, d)).collect();
            for i in 0..count {
                for j in 0..count {
                    resisted[(i, j)] += row[i] * row[j];
                }
            }
        }
    }
    let eigen = SymmetricEigen::new(resisted);
    let mut motions: Vec<Vec<f64>> = Vec::new();
    for k in (0..count).filter(|&k| eigen.eigenvalues[k] <= FREE) {
        let mut motion = vec![0.0; held.len()];
        for &node in nodes {
            for d in 0..c {
                let share = |mode: usize| eigen.eigenvectors[(mode, k)] * value(mode, node, d);
                motion[c * node + d] = (0..count).map(share).sum();
            }
        }
        let on_border = |a: &[f64], b: &[f64]| -> f64 {
            let border = places.iter().enumerate().filter(|(_, place)| place.is_some());
            border.map(|(dof, _)| a[dof] * b[dof]).sum()
        };
        let before = on_border(&motion, &motion).sqrt();
        for other in &motions {
            let share = on_border(&motion, other);
            motion.iter_mut().zip(other).for_each(|(motion, other)| *motion -= share * other);
        }
        let length = on_border(&motion, &motion).sqrt();
        if length > SEEN * before {
            motion.iter_mut().for_each(|value| *value /= length);
            motions.push(motion);
        }
    }
    motions
}

/// Nodes of the connected pieces.
fn pieces(pattern: &Pattern) -> Vec<Vec<usize>> {
    let n = pattern.nodes();
    let mut root: Vec<usize> = (0..n).collect();
    fn find(root: &mut [usize], mut node: usize) -> usize {
        while root[node] != node {
            root[node] = root[root[node]];
            node = root[node];
        }
        node
    }
    for node in 0..n {
        for &other in pattern.neighbours(node) {
            let (a, b) = (find(&mut root, node), find(&mut root, other as usize));
            root[a.max(b)] = a.min(b);
        }
    }
    let mut pieces: Vec<Vec<usize>> = Vec::new();
    let mut number = vec![usize::MAX; n];
    for node in 0..n {
        let top = find(&mut root, node);
        if number[top] == usize::MAX {
            number[top] = pieces.len();
            pieces.push(Vec::new());
        }
        pieces[number[top]].push(node);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two separate triangles: one is held at a point, which leaves its rotation; the other floats.
    #[test]
    fn supports_leave_the_motions_that_they_do_not_resist() {
        let cells = [[0_usize, 1, 2], [3, 4, 5]];
        let pattern = Pattern::new(2, 6, || cells.iter().map(|cell| (0, &cell[..])));
        let x = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 3.0, 0.0, 4.0, 0.0, 3.0, 1.0];
        let mut held = [false; 12];
        (held[0], held[1]) = (true, true);
        let places: Vec<Option<u32>> = (0..12).map(|dof| (dof % 6 >= 2).then_some(dof as u32)).collect();
        let motions = free_motions(&pattern, &x, &held, &places);
        assert_eq!((motions.len(), most(&pattern)), (4, 6));
        let border = |a: &[f64], b: &[f64]| -> f64 {
            (0..12).filter(|&i| places[i].is_some()).map(|i| a[i] * b[i]).sum()
        };
        for (i, a) in motions.iter().enumerate() {
            assert!(a[0].abs() < 1e-12 && a[1].abs() < 1e-12, "the point stays");
            for (j, b) in motions.iter().enumerate() {
                assert!((border(a, b) - f64::from(u8::from(i == j))).abs() < 1e-12);
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
