//! The jump of two sides at one place of C, as a row of the operator on nodal displacements.
//!
//! ```text
//! jump = u_B − u_A − θ ẑ × (x_B − x_A),      θ = ½ (θ_A + θ_B),      θ_edge = x′ × u′ / |x′|²
//! ```
//!
//! The last term takes out the rotation that the two edges carry where the faces do not coincide, so that a rigid motion
//! of the whole model gives no jump. On coincident faces it vanishes.

use super::midplane::{Midplane, Segment, Spot};
use super::{Chain, vector::*};

/// Faces closer than this coincide. Of the common length.
const COINCIDENT: f64 = 1e-14;

/// One entry of a jump row: jump[component] += value · u[node][direction].
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Column node: chain A's nodes first, then chain B's.
    pub node: usize,
    /// Component of the jump, in x, y.
    pub component: usize,
    /// Direction of the displacement.
    pub direction: usize,
    /// Coefficient.
    pub value: f64,
}

/// Calls `add` for every entry of the jump at a place of a segment.
pub(super) fn entries(c: &Midplane, segment: &Segment, spot: &Spot, mut add: impl FnMut(Entry)) {
    let sides = [
        OnEdge::new(&c.a, segment.edge_a, spot.xi_a, 0),
        OnEdge::new(&c.b, segment.edge_b, spot.xi_b, c.a.nodes.len()),
    ];
    for (side, sign) in sides.iter().zip([-1.0, 1.0]) {
        for (node, n, _) in side.functions() {
            for component in 0..2 {
                add(Entry { node, component, direction: component, value: sign * n });
            }
        }
    }
    let apart = minus(c.b.point(segment.edge_b, spot.xi_b), c.a.point(segment.edge_a, spot.xi_a));
    if norm(apart) <= COINCIDENT * c.length {
        return;
    }
    let lever = [apart[1], -apart[0]]; // −ẑ × (x_B − x_A)
    for side in &sides {
        let [dx, dy] = side.chain.derivative(side.edge, side.xi);
        let half = 0.5 / (dx * dx + dy * dy);
        for (node, _, dn) in side.functions() {
            for component in 0..2 {
                let factor = dn * half * lever[component];
                add(Entry { node, component, direction: 0, value: -factor * dy });
                add(Entry { node, component, direction: 1, value: factor * dx });
            }
        }
    }
}

/// A place on one edge of a chain.
struct OnEdge<'a> {
    chain: &'a Chain,
    edge: usize,
    xi: f64,
    /// Column of the chain's first node.
    first: usize,
    /// Shape functions and their derivatives: start, end, mid-node.
    n: [f64; 3],
    dn: [f64; 3],
}

impl OnEdge<'_> {
    fn new(chain: &Chain, edge: usize, xi: f64, first: usize) -> OnEdge<'_> {
        let (n, dn) = chain.functions(edge, xi);
        OnEdge { chain, edge, xi, first, n, dn }
    }

    /// (column node, N, dN/dξ) of the edge's nodes.
    fn functions(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        self.chain.edge(self.edge).zip(self.n).zip(self.dn).map(|((i, n), dn)| (self.first + i, n, dn))
    }
}
