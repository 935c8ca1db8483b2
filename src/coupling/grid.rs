//! The mid-plane's own grid: as fine as the locally coarser side.
//!
//! From the current node the next is max(next A node, next B node). Every cell takes in at least one further node of
//! each side, so there are at most min(edges A, edges B) cells. The walk starts where the first edges are longer, so
//! that neither labels nor file order matter; on a tie at the end with smaller x, then y.

use super::Midplane;

/// "After" means farther than this. Of the common length.
const AFTER: f64 = 1e-9;

/// Arc lengths of the grid's nodes, ascending, from 0 to the length of C.
pub(super) fn nodes(midplane: &Midplane) -> Vec<f64> {
    let length = midplane.length;
    let [a, b] = midplane.ends().map(|s| within(s, length));
    if starts_at_the_far_end(midplane, &a, &b) {
        let mirror = |s: &[f64]| -> Vec<f64> { s.iter().rev().map(|&x| length - x).collect() };
        let mut nodes = mirror(&walk(&mirror(&a), &mirror(&b), length));
        // the mirror image of a node is that node to round-off only: take the node itself
        for s in &mut nodes {
            if let Some(&node) = a.iter().chain(&b).find(|&&node| (node - *s).abs() <= 1e-14 * length) {
                *s = node;
            }
        }
        nodes
    } else {
        walk(&a, &b, length)
    }
}

/// Nodes of one side on the common length, whose ends count as nodes of both sides.
fn within(s: &[f64], length: f64) -> Vec<f64> {
    let inner = s.iter().copied().filter(|&x| x > AFTER * length && x < length * (1.0 - AFTER));
    std::iter::once(0.0).chain(inner).chain(std::iter::once(length)).collect()
}

fn walk(a: &[f64], b: &[f64], length: f64) -> Vec<f64> {
    let after =
        |side: &[f64], s: f64| side[side.partition_point(|&x| x <= s + AFTER * length).min(side.len() - 1)];
    let mut nodes = vec![0.0];
    let mut s = 0.0;
    while s < length * (1.0 - AFTER) {
        s = after(a, s).max(after(b, s));
        nodes.push(s);
    }
    // a short last cell joins its neighbour, unless it is a whole edge of both sides
    if let [.., before, start, end] = nodes[..] {
        let is_edge =
            |side: &[f64]| side.len() >= 2 && (side[side.len() - 2] - start).abs() <= AFTER * length;
        if end - start < 0.5 * (start - before) && !(is_edge(a) && is_edge(b)) {
            nodes.remove(nodes.len() - 2);
        }
    }
    nodes
}

/// True if the walk starts at the end of C: compares the edges from both ends inwards, the larger of A and B first.
fn starts_at_the_far_end(midplane: &Midplane, a: &[f64], b: &[f64]) -> bool {
    let edge = |side: &[f64], i: usize, far: bool| {
        let n = side.len() - 1;
        if i >= n {
            0.0
        } else if far {
            side[n - i] - side[n - i - 1]
        } else {
            side[i + 1] - side[i]
        }
    };
    for i in 0..a.len().max(b.len()) {
        let near = edge(a, i, false).max(edge(b, i, false));
        let far = edge(a, i, true).max(edge(b, i, true));
        if (near - far).abs() > AFTER * midplane.length {
            return far > near;
        }
    }
    let [dx, dy] = midplane.tangent;
    if dx.abs() > AFTER { dx < 0.0 } else { dy < 0.0 }
}
