//! What checks, reports and pictures ask of a coupling: its edges, what the segments take of them, where things lie.

use super::{Chain, Coupling};

/// A segment as others see it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentView {
    /// Arc lengths of its start and end along C [length].
    pub s: [f64; 2],
    /// Its start and end in the plane.
    pub places: [[f64; 2]; 2],
    /// Parent edges on side A and side B.
    pub edges: [usize; 2],
    /// What it takes of either parent, as fractions from the edge's start to its end.
    pub taken: [[f64; 2]; 2],
}

impl Coupling {
    /// The segments in order.
    pub fn shares(&self) -> Vec<SegmentView> {
        let midplane = &self.midplane;
        let shares = midplane.segments.iter().enumerate().map(|(i, segment)| SegmentView {
            s: [segment.start, segment.end],
            places: [-1.0, 1.0].map(|eta| midplane.spot(i, eta).position),
            edges: [segment.edge_a, segment.edge_b],
            taken: [segment.xi_a, segment.xi_b].map(|xi| xi.map(|xi| 0.5 * (1.0 + xi))),
        });
        shares.collect()
    }

    /// Start and end of every grid cell in the plane, in order; none for `pointwise`.
    pub fn cells(&self) -> Vec<[[f64; 2]; 2]> {
        // where one piece of C ends and the next begins the same arc length stands twice
        let cells = self.grid.windows(2).filter(|pair| pair[1] > pair[0]);
        let place = |s: f64, pair: &[f64]| self.midplane.position(s, 0.5 * (pair[0] + pair[1]));
        cells.map(|pair| [place(pair[0], pair), place(pair[1], pair)]).collect()
    }

    /// Number of edges of a side, 0 for A and 1 for B.
    pub fn edges(&self, side: usize) -> usize {
        self.chain(side).edges()
    }

    /// Nodes of the model at an edge's start and end.
    pub fn nodes(&self, side: usize, e: usize) -> [usize; 2] {
        let chain = self.chain(side);
        chain.ends[e].map(|place| chain.nodes[place])
    }

    /// Places of an edge's start, mid-node (if it has one) and end.
    pub fn line(&self, side: usize, e: usize) -> Vec<[f64; 2]> {
        let (chain, origin) = (self.chain(side), self.midplane.origin);
        let [start, end] = chain.ends[e];
        let places = [Some(start), chain.mids[e], Some(end)].into_iter().flatten();
        places.map(|place| [0, 1].map(|d| origin[d] + chain.points[place][d])).collect()
    }

    /// From an edge's start to its end [length].
    pub fn chord(&self, side: usize, e: usize) -> f64 {
        self.chain(side).chord(e)
    }

    fn chain(&self, side: usize) -> &Chain {
        [&self.midplane.a, &self.midplane.b][side]
    }
}
