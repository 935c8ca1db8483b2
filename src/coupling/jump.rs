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
//! A gap remains between the faces. It turns with the mean of both edges, so that a rigid motion of the
//! whole model gives no jump. On coincident straight faces there is nothing to add.

use super::place::{Facets, OnFacet, Place, Table};
use crate::shape::LineValues;
use crate::shape::vector::norm;

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

/// Calls `add` for every entry of the jump at a place.
pub(super) fn entries(table: &Table, place: &Place, components: usize, mut add: impl FnMut(Entry)) {
    let [a, b] = &table.sides;
    let sides = [OnSide::new(a, &place.on[0], 0), OnSide::new(b, &place.on[1], a.nodes.len())];
    for (side, sign) in sides.iter().zip([-1.0, 1.0]) {
        for (node, n, _) in side.functions() {
            for component in 0..components {
                add(Entry { node, component, direction: component, value: sign * n });
            }
        }
    }
    let gap = place.apart;
    let coincide = |way: [f64; 3]| norm(way) <= COINCIDENT * table.midplane.length;
    if place.on.iter().all(|on| coincide(on.off)) && coincide(gap) {
        return;
    }
    for ((side, on), sign) in sides.iter().zip(&place.on).zip([-1.0, 1.0]) {
        let [dx, dy, _] = side.facets.derivative(side.facet, side.dn);
        let stretch = on.off.map(|x| sign * x);
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

/// A place on a facet of a side.
struct OnSide<'a> {
    facets: &'a Facets,
    facet: usize,
    /// Column of the side's first node.
    first: usize,
    /// Shape functions and their derivatives, node by node.
    n: LineValues,
    dn: LineValues,
}

impl OnSide<'_> {
    fn new<'a>(facets: &'a Facets, on: &OnFacet, first: usize) -> OnSide<'a> {
        let (n, dn) = facets.functions(on);
        OnSide { facets, facet: on.facet, first, n, dn }
    }

    /// (column node, N, dN/dξ) of the facet's nodes.
    fn functions(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let nodes = self.facets.corners[self.facet].iter();
        nodes.zip(self.n).zip(self.dn).map(|((&i, n), dn)| (self.first + i, n, dn))
    }
}
