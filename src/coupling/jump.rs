//! The jump of two sides at one place of C, as a row of the operator on nodal displacements.
//!
//! ```text
//!        c_B ●──── the curve, as B's nodes and their angles draw it
//!        x_B ●──── an edge of B        v_B = u_B + ω_B (c_B − x_B)        likewise v_A
//!
//! jump = v_B − v_A − θ ẑ × (c_B − c_A),    ω v = θ ẑ × v + e v,    θ = ½ (θ_A + θ_B)
//! θ_edge = x′ × u′ / |x′|²,    e_edge = x′ · u′ / |x′|²
//! ```
//!
//! Two chords of one curve lie apart although nothing is between them. What an edge carries is therefore taken from its
//! chord to the curve by its own rotation θ and stretch e: of a displacement u(x) along the curve, a complex function of
//! a complex place, that is all of u″ which comes from the bend, u″ = (e + iθ) x″ + (e + iθ)′ x′; the rest is the
//! element's own error as on a straight side. By the same token a traction acts on either edge at its lever from the
//! curve, not from half-way between the chords: else the couples on neighbouring edges differ and shake the tractions
//! by as much as h.
//!
//! What then remains between the faces is a gap. It turns with the mean of both edges, so that a rigid motion of the
//! whole model gives no jump. On coincident straight faces there is nothing to add.

use super::Chain;
use super::line::midplane::{Midplane, MidplanePoint};
use super::line::segment::Segment;
use crate::shape::vector::*;

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
pub(super) fn entries(c: &Midplane, segment: &Segment, spot: &MidplanePoint, mut add: impl FnMut(Entry)) {
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
    let off = off_curves(c, segment, spot);
    let gap = apart(c, segment, spot, off);
    if [off[0], off[1], gap].iter().all(|v| norm(*v) <= COINCIDENT * c.length) {
        return;
    }
    for (i, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let side = &sides[i];
        let [dx, dy] = side.chain.derivative(side.edge, side.xi);
        let stretch = off[i].map(|x| sign * x);
        let lever = [0, 1].map(|d| stretch[d] - 0.5 * gap[d]);
        let turn = [-lever[1], lever[0]]; // ẑ × lever
        for (node, _, dn) in side.functions() {
            let factor = dn / (dx * dx + dy * dy);
            for component in 0..2 {
                let (t, e) = (factor * turn[component], factor * stretch[component]);
                add(Entry { node, component, direction: 0, value: e * dx - t * dy });
                add(Entry { node, component, direction: 1, value: e * dy + t * dx });
            }
        }
    }
}

/// Way from either edge to the curve that it is a chord of.
fn off_curves(c: &Midplane, segment: &Segment, spot: &MidplanePoint) -> [[f64; 2]; 2] {
    let [a, b] = &c.angles;
    [a.to_curve(&c.a, segment.edge_a, spot.xi_a), b.to_curve(&c.b, segment.edge_b, spot.xi_b)]
}

/// Way from the curve of A to that of B.
fn apart(c: &Midplane, segment: &Segment, spot: &MidplanePoint, off: [[f64; 2]; 2]) -> [f64; 2] {
    let edges = minus(c.b.point(segment.edge_b, spot.xi_b), c.a.point(segment.edge_a, spot.xi_a));
    plus(edges, minus(off[1], off[0]))
}

/// The drawn gap at a place of a segment: the way from one curve to the other, without what chords differ by.
pub(super) fn drawn(c: &Midplane, segment: &Segment, spot: &MidplanePoint) -> [f64; 2] {
    apart(c, segment, spot, off_curves(c, segment, spot))
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
