//! The edges of one side in order: a chain of one or more runs, each open or closed.
//!
//! ```text
//!   ends   0 ──── 1 ─────── 2 ── 3        with inner nodes on curved edges
//! ```

use super::link::{self, Corner, Link, Orientation, Side};
use crate::error::Result;
use crate::shape::vector::*;
use crate::shape::{LINE_NODES, LineValues, Shape};

/// Most inner nodes of an edge.
const INNER: usize = LINE_NODES - 2;

/// The edges of a side in order, run after run.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Node numbers in the model: the edge ends in order, run after run, then the inner nodes in order.
    pub nodes: Vec<usize>,
    /// Coordinates of the nodes from the origin of the mid-plane.
    pub points: Vec<[f64; 2]>,
    /// Places in `nodes` of start and end of every edge.
    pub ends: Vec<[usize; 2]>,
    /// Shape of every edge.
    pub shapes: Vec<Shape>,
    /// Places in `nodes` of the inner nodes of every edge, as many as it has.
    inner: Vec<[usize; INNER]>,
    /// The connected lines of edges.
    pub runs: Vec<Run>,
    /// For every edge end whether the geometry may be kinked there.
    pub(in crate::coupling) corners: Vec<Corner>,
}

/// Edges that follow each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    /// Numbers of the edges.
    pub edges: std::ops::Range<usize>,
    /// True if the last edge ends where the first one starts.
    pub closed: bool,
}

impl Chain {
    /// Orders the edges of a side, coordinates from `origin`.
    pub(in crate::coupling) fn order(
        interface: &str,
        curves: &[Side],
        subdomain: Orientation,
        origin: [f64; 2],
    ) -> Result<Chain> {
        let links = link::sorted(interface, curves, subdomain, origin)?;
        // open runs from their first edges, then what is left: closed ones
        let next: Vec<usize> = (0..links.len()).map(|i| link::next(&links, i)).collect();
        let mut follows = vec![false; links.len()];
        next.iter().filter(|&&next| next < links.len()).for_each(|&next| follows[next] = true);
        let firsts = (0..links.len()).filter(|&i| !follows[i]);
        let mut used = vec![false; links.len()];
        let mut chain = Chain::empty();
        let mut order = Vec::new();
        for i in firsts.chain(0..links.len()) {
            if !used[i] {
                chain.walk(&links, &next, &mut used, i, &mut order);
            }
        }
        for i in order {
            let link = &links[i];
            let mut inner = [0; INNER];
            for (k, &node) in link.facet.nodes().iter().enumerate().skip(2) {
                inner[k - 2] = chain.nodes.len();
                chain.nodes.push(node);
                chain.points.push(link.x[k]);
            }
            chain.shapes.push(link.facet.shape);
            chain.inner.push(inner);
        }
        Ok(chain)
    }

    fn empty() -> Chain {
        let (nodes, points, ends) = (Vec::new(), Vec::new(), Vec::new());
        let (shapes, inner) = (Vec::new(), Vec::new());
        Chain { nodes, points, ends, shapes, inner, runs: Vec::new(), corners: Vec::new() }
    }

    /// Adds the run that starts with a link.
    fn walk(
        &mut self,
        links: &[Link],
        follower: &[usize],
        used: &mut [bool],
        first: usize,
        order: &mut Vec<usize>,
    ) {
        let (first_edge, first_place) = (self.ends.len(), self.nodes.len());
        let mut add = |node: usize, x: [f64; 2], corner: Corner| {
            self.nodes.push(node);
            self.points.push(x);
            self.corners.push(corner);
        };
        add(links[first].start, links[first].x[0], links[first].corner);
        let mut next = Some(first);
        let mut place = first_place;
        let mut closed = false;
        while let Some(i) = next {
            let link = &links[i];
            used[i] = true;
            order.push(i);
            next = Some(follower[i]).filter(|&next| next < links.len());
            closed = next == Some(first);
            if closed {
                self.ends.push([place, first_place]);
                break;
            }
            add(link.end, link.x[1], next.map_or(Corner::Yes, |next| links[next].corner));
            self.ends.push([place, place + 1]);
            place += 1;
        }
        self.runs.push(Run { edges: first_edge..self.ends.len(), closed });
    }

    /// The same edges walked the other way.
    pub(in crate::coupling) fn reversed(&self) -> Chain {
        let mut chain = self.clone();
        for run in &chain.runs {
            chain.ends[run.edges.clone()].reverse();
            chain.shapes[run.edges.clone()].reverse();
            chain.inner[run.edges.clone()].reverse();
        }
        chain.ends.iter_mut().for_each(|ends| ends.reverse());
        for (shape, inner) in chain.shapes.iter().zip(&mut chain.inner) {
            let places = *inner;
            for (k, &from) in shape.turned_line().iter().enumerate().skip(2) {
                inner[k - 2] = places[from - 2];
            }
        }
        chain
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        self.ends.len()
    }

    /// Places in `nodes` of an edge's start, end and inner nodes.
    pub(in crate::coupling) fn edge(&self, e: usize) -> impl Iterator<Item = usize> {
        let inner = self.shapes[e].nodes() - 2;
        self.ends[e].into_iter().chain(self.inner[e].into_iter().take(inner))
    }

    /// True if an edge is straight, whatever its nodes.
    pub(in crate::coupling) fn is_straight(&self, e: usize) -> bool {
        !self.shapes[e].is_quadratic()
    }

    /// True if every edge has inner nodes.
    pub(in crate::coupling) fn is_quadratic(&self) -> bool {
        self.shapes.iter().all(|shape| shape.is_quadratic())
    }

    /// Distance of the ends of an edge [length].
    pub fn chord(&self, e: usize) -> f64 {
        let [p, q] = self.ends[e].map(|place| self.points[place]);
        norm(minus(q, p))
    }

    /// Shape functions of an edge and their derivatives at ξ: start, end, inner nodes.
    pub(in crate::coupling) fn functions(&self, e: usize, xi: f64) -> (LineValues, LineValues) {
        self.shapes[e].line_functions(xi)
    }

    /// The point of an edge at ξ.
    pub(in crate::coupling) fn point(&self, e: usize, xi: f64) -> [f64; 2] {
        self.combine(e, self.functions(e, xi).0)
    }

    /// dx/dξ of an edge at ξ.
    pub(in crate::coupling) fn derivative(&self, e: usize, xi: f64) -> [f64; 2] {
        self.combine(e, self.functions(e, xi).1)
    }

    fn combine(&self, e: usize, factors: LineValues) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (place, factor) in self.edge(e).zip(factors) {
            for d in 0..2 {
                sum[d] += factor * self.points[place][d];
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Facet;

    const POINTS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]];

    fn order(points: &[[f64; 3]], edges: &[Facet], subdomain: Orientation) -> Result<Chain> {
        let side = Side { name: "lower.top", points, edges, corners: &[], first: 0 };
        Chain::order("joint", &[side], subdomain, [0.0; 2])
    }

    fn edge(start: usize, end: usize) -> Facet {
        Facet::edge(&[start, end], 0, true)
    }

    #[test]
    fn edges_in_any_order_become_runs() {
        let edges = [edge(1, 2), edge(2, 3), edge(0, 1)];
        assert_eq!(order(&POINTS, &edges, Orientation::Left).unwrap().nodes, [0, 1, 2, 3]);
        assert_eq!(order(&POINTS, &edges, Orientation::Right).unwrap().nodes, [3, 2, 1, 0]);
        let two = order(&POINTS, &[edge(2, 3), edge(0, 1)], Orientation::Left).unwrap();
        assert_eq!((two.nodes.as_slice(), two.runs.len()), ([0, 1, 2, 3].as_slice(), 2));
        let loop_and_line = [edge(1, 2), edge(2, 1), edge(0, 3)];
        let chain = order(&POINTS, &loop_and_line, Orientation::Left).unwrap();
        assert_eq!((chain.runs[0].closed, chain.runs[1].closed), (false, true));
        assert_eq!(chain.ends, [[0, 1], [2, 3], [3, 2]]);
    }

    #[test]
    fn mid_nodes_stay_with_their_edges_when_the_chain_is_turned() {
        let points = [0.0, 1.0, 2.0, 0.5, 1.5].map(|x| [x, 0.0, 0.0]);
        let quadratic = |nodes: [usize; 3]| Facet::edge(&nodes, 0, true);
        let edges = [quadratic([1, 2, 4]), quadratic([0, 1, 3])];
        for subdomain in [Orientation::Left, Orientation::Right] {
            let chain = order(&points, &edges, subdomain).unwrap();
            for e in 0..2 {
                let x: Vec<f64> = chain.edge(e).map(|i| chain.points[i][0]).collect();
                assert_eq!(x[2], 0.5 * (x[0] + x[1]));
            }
        }
    }

    #[test]
    fn a_branch_is_refused_with_its_place() {
        let message = order(&POINTS, &[edge(0, 1), edge(0, 2)], Orientation::Left).unwrap_err().to_string();
        assert!(message.contains("branches at (0, 0)"), "{message}");
    }
}
