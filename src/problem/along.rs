//! s: the fraction of arc length along a curve, 0 at the end with smaller x (then y), 1 at the other.

use super::groups::edge_coordinates;
use crate::mesh::Facet;
use crate::shape::{GAUSS_3, LINE_NODES, Shape};

/// Ends of a curve whose x differ by less have the same x. Of its extent.
const SAME: f64 = 1e-9;

/// s at start and end of every edge, in the order of the edges; for a group that is no open line, what it is.
pub(super) fn fractions(points: &[[f64; 3]], edges: &[Facet]) -> Result<Vec<[f64; 2]>, String> {
    let mut by_node: Vec<(usize, usize)> = Vec::new(); // node, edge
    for (e, edge) in edges.iter().enumerate() {
        by_node.extend([(edge.nodes()[0], e), (edge.nodes()[1], e)]);
    }
    by_node.sort_unstable();
    let at = |node: usize| {
        let start = by_node.partition_point(|(n, _)| *n < node);
        let end = by_node.partition_point(|(n, _)| *n <= node);
        &by_node[start..end]
    };
    let place = |node: usize| format!("({}, {})", points[node][0], points[node][1]);
    if let Some(&(node, _)) = by_node.iter().find(|(node, _)| at(*node).len() > 2) {
        return Err(format!("the curve branches at {}", place(node)));
    }
    let ends: Vec<usize> =
        by_node.iter().map(|(node, _)| *node).filter(|node| at(*node).len() == 1).collect();
    let first = match ends.as_slice() {
        [] => return Err("the curve is a closed loop".into()),
        [a, b] => {
            let extent = (0..2).map(|d| (points[*a][d] - points[*b][d]).abs()).fold(0.0, f64::max);
            if points[*a] == points[*b] {
                return Err(format!("its two faces meet at {}", place(*a)));
            }
            let same_x = (points[*a][0] - points[*b][0]).abs() <= SAME * extent;
            let d = usize::from(same_x);
            if points[*a][d] <= points[*b][d] { *a } else { *b }
        }
        more => return Err(format!("the curve is in {} pieces", more.len() / 2)),
    };
    let (mut node, mut before, mut s) = (first, usize::MAX, 0.0);
    let mut fractions = vec![[f64::NAN; 2]; edges.len()];
    let mut walked = 0;
    while let Some(&(_, e)) = at(node).iter().find(|(_, e)| *e != before) {
        let edge = &edges[e];
        let (start, end) = (s, s + length(&edge_coordinates(points, edge), edge.shape));
        let along = edge.nodes()[0] == node;
        fractions[e] = if along { [start, end] } else { [end, start] };
        (node, before, s) = (edge.nodes()[usize::from(along)], e, end);
        walked += 1;
    }
    if walked < edges.len() {
        return Err("the curve is in several pieces".into()); // a line and a loop beside it
    }
    Ok(fractions.into_iter().map(|of_edge| of_edge.map(|at| at / s)).collect())
}

/// s at the place ξ of an edge whose ends have the values `ends`.
pub(super) fn at(ends: [f64; 2], x: &[[f64; 2]; LINE_NODES], shape: Shape, xi: f64) -> f64 {
    let share = if shape.is_quadratic() {
        let (before, after) = (arc(x, shape, -1.0, xi), arc(x, shape, xi, 1.0));
        before / (before + after)
    } else {
        0.5 * (1.0 + xi)
    };
    ends[0] + share * (ends[1] - ends[0])
}

/// Length of an edge.
fn length(x: &[[f64; 2]; LINE_NODES], shape: Shape) -> f64 {
    if shape.is_quadratic() {
        arc(x, shape, -1.0, 0.0) + arc(x, shape, 0.0, 1.0)
    } else {
        (x[1][0] - x[0][0]).hypot(x[1][1] - x[0][1])
    }
}

/// ∫ |dx/dξ| dξ of a curved edge between two places.
fn arc(x: &[[f64; 2]; LINE_NODES], shape: Shape, from: f64, to: f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let speed = |xi: f64| {
        let (_, dn) = shape.line_functions(xi);
        let [dx, dy] = [0, 1].map(|d| (0..LINE_NODES).map(|i| dn[i] * x[i][d]).sum::<f64>());
        dx.hypot(dy)
    };
    GAUSS_3.iter().map(|&[xi, weight]| half * weight * speed(middle + half * xi)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::vector::in_space;

    fn edge(start: usize, end: usize, mid: usize) -> Facet {
        let nodes = [start, end, mid];
        Facet::edge(&nodes[..if mid == end { 2 } else { 3 }], 0, true)
    }

    #[test]
    fn s_grows_from_the_smaller_x_whatever_the_order_and_direction_of_the_edges() {
        let points = [[3.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 4.0], [1.0, 1.0]].map(in_space);
        let edges = [edge(0, 1, 1), edge(1, 2, 2)];
        assert_eq!(fractions(&points, &edges).unwrap(), [[1.0, 1.0 / 3.0], [1.0 / 3.0, 0.0]]);
        let upright = [edge(3, 4, 4), edge(1, 4, 4)]; // the same x: the smaller y comes first
        assert_eq!(fractions(&points, &upright).unwrap(), [[1.0, 0.25], [0.0, 0.25]]);
    }

    #[test]
    fn s_follows_the_arc_of_a_curved_edge() {
        let points = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.5]].map(in_space);
        let x = edge_coordinates(&points, &edge(0, 1, 2));
        assert!(
            (at([0.0, 1.0], &x, Shape::Line3, 0.0) - 0.5).abs() < 1e-15,
            "a symmetric arc is halved by its mid-node"
        );
        // y = (1 − x²)/2: length asinh(1) + √2
        assert!((length(&x, Shape::Line3) - (1f64.asinh() + 2f64.sqrt())).abs() < 1e-3);
    }

    #[test]
    fn what_is_no_open_line_says_so() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 0.0], [3.0, 0.0]].map(in_space);
        for (edges, expected) in [
            (vec![edge(0, 1, 1), edge(1, 2, 2), edge(2, 0, 0)], "closed loop"),
            (vec![edge(0, 1, 1), edge(3, 4, 4)], "2 pieces"),
            (vec![edge(0, 1, 1), edge(1, 2, 2), edge(1, 3, 3)], "branches at (1, 0)"),
        ] {
            let message = fractions(&points, &edges).unwrap_err();
            assert!(message.contains(expected), "{message}");
        }
    }
}
