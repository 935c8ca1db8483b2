//! Sides of a coupling, as checks, reports and pictures see them.

use super::Coupling;

impl Coupling {
    /// Number of facets of a side, 0 for A and 1 for B.
    pub fn facets(&self, side: usize) -> usize {
        self.sides[side].len()
    }

    /// Nodes of the model at a facet's start and end.
    pub fn nodes(&self, side: usize, facet: usize) -> [usize; 2] {
        let facets = &self.sides[side];
        [0, 1].map(|end| facets.nodes[facets.corners[facet][end]])
    }

    /// Places of a facet's start, mid-node (if it has one) and end.
    pub fn line(&self, side: usize, facet: usize) -> Vec<[f64; 3]> {
        let (facets, origin) = (&self.sides[side], self.midplane.origin);
        let corners = &facets.corners[facet];
        let order = if corners.len() > 2 { &[0, 2, 1][..] } else { &[0, 1] };
        order.iter().map(|&i| [0, 1, 2].map(|d| origin[d] + facets.points[corners[i]][d])).collect()
    }

    /// From a facet's start to its end [length].
    pub fn chord(&self, side: usize, facet: usize) -> f64 {
        self.sides[side].chord(facet)
    }
}
