//! Sides of a coupling, as checks, reports and pictures see them.

use super::{Coupling, LawPoint};
use crate::shape::vector::plus;

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

    /// Places of a facet's nodes from its start to its end.
    pub fn line(&self, side: usize, facet: usize) -> Vec<[f64; 3]> {
        let facets = &self.sides[side];
        let node = |&i: &usize| plus(self.midplane.origin, facets.points[facets.corners[facet][i]]);
        facets.shapes[facet].along_line().iter().map(node).collect()
    }

    /// The place of a facet at ξ.
    pub fn point(&self, side: usize, facet: usize, xi: f64) -> [f64; 3] {
        let facets = &self.sides[side];
        plus(self.midplane.origin, facets.point(facet, facets.shapes[facet].line_functions(xi).0))
    }

    /// Displacement of a side at a law point [length]; `u` has the components of every node of the model.
    pub fn displacement(&self, side: usize, point: &LawPoint, u: &[f64]) -> [f64; 3] {
        let (facets, on) = (&self.sides[side], &point.on[side]);
        let (n, _) = facets.functions(on);
        let mut sum = [0.0; 3];
        for (&i, n) in facets.corners[on.facet].iter().zip(n) {
            let node = &u[self.components * facets.nodes[i]..][..self.components];
            sum.iter_mut().zip(node).for_each(|(sum, u)| *sum += n * u);
        }
        sum
    }

    /// dx/dξ of a facet at ξ.
    pub fn derivative(&self, side: usize, facet: usize, xi: f64) -> [f64; 3] {
        let facets = &self.sides[side];
        facets.derivative(facet, facets.shapes[facet].line_functions(xi).1)
    }

    /// From a facet's start to its end [length].
    pub fn chord(&self, side: usize, facet: usize) -> f64 {
        self.sides[side].chord(facet)
    }
}
