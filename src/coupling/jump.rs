//! The jump of two sides at one place of C, as a row of the operator on nodal displacements.
//!
//! ```text
//! jump = u_B − u_A − θ ẑ × (x_B − x_A),      θ = ½ (θ_A + θ_B),      θ_edge = x′ × u′ / |x′|²
//! ```
//!
//! The last term takes out the rotation that the two edges carry where the faces do not coincide, so that a rigid motion
//! of the whole model gives no jump. On coincident faces it vanishes.

use super::{Chain, Midplane};
use crate::shape::{lagrange2, lagrange3};

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

/// Calls `add` for every entry of the jump at arc length `s` on a segment with parents `edge_a`, `edge_b`.
pub(super) fn entries(midplane: &Midplane, edge_a: usize, edge_b: usize, s: f64, mut add: impl FnMut(Entry)) {
    let sides = [
        OnEdge::new(&midplane.a, &midplane.s_a, edge_a, 0, s),
        OnEdge::new(&midplane.b, &midplane.s_b, edge_b, midplane.a.nodes.len(), s),
    ];
    for (side, sign) in sides.iter().zip([-1.0, 1.0]) {
        for (node, n, _) in side.functions() {
            for component in 0..2 {
                add(Entry { node, component, direction: component, value: sign * n });
            }
        }
    }
    let [place_a, place_b] = [0, 1].map(|i| sides[i].interpolate(midplane.origin, |(_, n, _)| n));
    let apart = [place_b[0] - place_a[0], place_b[1] - place_a[1]];
    if apart[0].hypot(apart[1]) <= COINCIDENT * midplane.length {
        return;
    }
    let lever = [apart[1], -apart[0]]; // −ẑ × (x_B − x_A)
    for side in &sides {
        let [dx, dy] = side.interpolate(midplane.origin, |(_, _, dn)| dn);
        let half = 0.5 / (dx * dx + dy * dy);
        for (node, _, dn) in side.functions() {
            for component in 0..2 {
                let c = dn * half * lever[component];
                add(Entry { node, component, direction: 0, value: -c * dy });
                add(Entry { node, component, direction: 1, value: c * dx });
            }
        }
    }
}

/// A place on one edge of a chain.
struct OnEdge<'a> {
    chain: &'a Chain,
    edge: usize,
    /// Column of the chain's first node.
    first: usize,
    /// Shape functions and their derivatives: start, end, mid-node.
    n: [f64; 3],
    dn: [f64; 3],
}

impl OnEdge<'_> {
    fn new<'a>(chain: &'a Chain, arc: &[f64], edge: usize, first: usize, s: f64) -> OnEdge<'a> {
        let (start, end) = (arc[edge], arc[edge + 1]);
        let (n, dn) = match chain.mids[edge] {
            None => {
                let (n, dn) = lagrange2(2.0 * (s - start) / (end - start) - 1.0);
                ([n[0], n[1], 0.0], [dn[0], dn[1], 0.0])
            }
            // s(ξ) = s_m + ½ (s₁ − s₀) ξ + (½ (s₀ + s₁) − s_m) ξ², solved without cancellation
            Some(mid) => {
                let (a, b, c) = (0.5 * (start + end) - arc[mid], 0.5 * (end - start), arc[mid] - s);
                lagrange3(-2.0 * c / (b + (b * b - 4.0 * a * c).max(0.0).sqrt()))
            }
        };
        OnEdge { chain, edge, first, n, dn }
    }

    /// (column node, N, dN/dξ) of the edge's nodes.
    fn functions(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        self.chain.edge(self.edge).zip(self.n).zip(self.dn).map(|((i, n), dn)| (self.first + i, n, dn))
    }

    /// Σ f_i (x_i − origin) over the edge's nodes.
    fn interpolate(&self, origin: [f64; 2], f: impl Fn((usize, f64, f64)) -> f64) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for function in self.functions() {
            let x = self.chain.points[function.0 - self.first];
            for d in 0..2 {
                sum[d] += f(function) * (x[d] - origin[d]);
            }
        }
        sum
    }
}
