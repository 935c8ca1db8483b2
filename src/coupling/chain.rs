//! The edges of one side in order: a chain.
//!
//! ```text
//!   ends   0 ──── 1 ─────── 2 ── 3        with mid-nodes on quadratic edges
//! ```

use crate::error::{Error, Result};
use crate::mesh::Edge;

/// The edges of one side, as the mesh gives them: each with its body on the left.
#[derive(Debug, Clone, Copy)]
pub struct Side<'a> {
    /// How messages call it, such as `lower.top`.
    pub name: &'a str,
    /// Coordinates of the mesh.
    pub points: &'a [[f64; 2]],
    /// The edges in any order.
    pub edges: &'a [Edge],
}

/// An open chain of edges.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Point numbers: the edge ends in order, one more than edges, then the mid-nodes of quadratic edges in order.
    pub nodes: Vec<usize>,
    /// Coordinates of the nodes.
    pub points: Vec<[f64; 2]>,
    /// For every edge the place of its mid-node in `nodes`, if it has one.
    pub mids: Vec<Option<usize>>,
}

impl Chain {
    /// Orders the edges of a side; the body lies on the left of the chain.
    pub fn order(interface: &str, side: Side) -> Result<Chain> {
        let refuse =
            |what: String, cure: &str| Error::Interface { name: interface.into(), what, cure: cure.into() };
        let place = |node: usize| format!("({}, {})", side.points[node][0], side.points[node][1]);
        if let Some(edge) = side.edges.iter().find(|edge| !edge.boundary) {
            let what = format!("{} has an edge inside its body, near {}", side.name, place(edge.nodes[0]));
            return Err(refuse(what, "a side lies on the boundary of its subdomain"));
        }
        // edges by their start node: the chain follows from each end to the edge that starts there
        let mut by_start: Vec<[usize; 3]> = side.edges.iter().map(|edge| edge.nodes).collect();
        by_start.sort_unstable();
        by_start.dedup();
        let mut by_end: Vec<usize> = by_start.iter().map(|edge| edge[1]).collect();
        by_end.sort_unstable();
        let branch = by_start.windows(2).find(|pair| pair[0][0] == pair[1][0]).map(|pair| pair[0][0]);
        let merge = by_end.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
        if let Some(node) = branch.or(merge) {
            let what = format!("{} branches at {}", side.name, place(node));
            return Err(refuse(what, "a side is one line of edges"));
        }
        let starts: Vec<&[usize; 3]> =
            by_start.iter().filter(|edge| by_end.binary_search(&edge[0]).is_err()).collect();
        let Some(first) = starts.first() else {
            return Err(refuse(format!("{} is a closed loop", side.name), "join open lines"));
        };
        if let Some(second) = starts.get(1) {
            let places = format!("{} and at {}", place(first[0]), place(second[0]));
            let what = format!("{} is in {} pieces, that start at {places}", side.name, starts.len());
            return Err(refuse(what, "a side is one connected line: make an interface of every piece"));
        }
        let mut ends = vec![first[0]];
        let mut mids = Vec::new();
        while let Ok(i) = by_start.binary_search_by_key(&ends[ends.len() - 1], |edge| edge[0]) {
            let [_, end, mid] = by_start[i];
            ends.push(end);
            mids.push((mid != end).then_some(mid));
        }
        Ok(Chain::from_parts(side.points, ends, mids))
    }

    /// From the edge ends and the mid-node of every edge, in order.
    fn from_parts(points: &[[f64; 2]], ends: Vec<usize>, mids: Vec<Option<usize>>) -> Chain {
        let mut nodes = ends;
        let mids = mids
            .into_iter()
            .map(|mid| {
                mid.map(|mid| {
                    nodes.push(mid);
                    nodes.len() - 1
                })
            })
            .collect();
        let points = nodes.iter().map(|&node| points[node]).collect();
        Chain { nodes, points, mids }
    }

    /// The same chain walked the other way.
    pub(super) fn reversed(mut self) -> Chain {
        let (ends, all) = (self.edges() + 1, self.nodes.len());
        for range in [0..ends, ends..all] {
            self.nodes[range.clone()].reverse();
            self.points[range].reverse();
        }
        self.mids.reverse();
        for mid in self.mids.iter_mut().flatten() {
            *mid = ends + all - 1 - *mid;
        }
        self
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        self.mids.len()
    }

    /// Places in `nodes` of an edge's start, end and, if it is quadratic, mid-node.
    pub(super) fn edge(&self, e: usize) -> impl Iterator<Item = usize> {
        [Some(e), Some(e + 1), self.mids[e]].into_iter().flatten()
    }

    /// True if every edge has a mid-node.
    pub(super) fn is_quadratic(&self) -> bool {
        self.mids.iter().all(Option::is_some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]];

    fn side(edges: &[Edge]) -> Side<'_> {
        Side { name: "lower.top", points: &POINTS, edges }
    }

    fn edge(start: usize, end: usize) -> Edge {
        Edge { nodes: [start, end, end], cell: 0, boundary: true }
    }

    #[test]
    fn edges_in_any_order_become_one_chain() {
        let edges = [edge(1, 2), edge(2, 3), edge(0, 1)];
        assert_eq!(Chain::order("joint", side(&edges)).unwrap().nodes, [0, 1, 2, 3]);
    }

    #[test]
    fn mid_nodes_stay_with_their_edges_when_the_chain_is_turned() {
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.5, 0.0], [1.5, 0.0]];
        let quadratic = |nodes: [usize; 3]| Edge { nodes, cell: 0, boundary: true };
        let edges = [quadratic([1, 2, 4]), quadratic([0, 1, 3])];
        let chain = Chain::order("joint", Side { name: "s", points: &points, edges: &edges }).unwrap();
        for chain in [chain.clone(), chain.reversed()] {
            for e in 0..2 {
                let x: Vec<f64> = chain.edge(e).map(|i| chain.points[i][0]).collect();
                assert_eq!(x[2], 0.5 * (x[0] + x[1]));
            }
        }
    }

    #[test]
    fn what_is_not_a_line_is_refused_with_its_place() {
        for (edges, expected) in [
            (vec![edge(0, 1), edge(0, 2)], "branches at (0, 0)"),
            (vec![edge(0, 1), edge(2, 3)], "in 2 pieces"),
            (vec![edge(0, 1), edge(1, 2), edge(2, 0)], "closed loop"),
        ] {
            let message = Chain::order("joint", side(&edges)).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}
