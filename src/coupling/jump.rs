//! The jump of two sides at one place of C, as a row of the operator on nodal displacements.
//!
//! ```text
//! jump = u_B − u_A − θ ẑ × (x_B − x_A),      θ = ½ (θ_A + θ_B),      θ_edge = (x₂ − x₁) × (u₂ − u₁) / |x₂ − x₁|²
//! ```
//!
//! The last term takes out the rotation that the two edges carry where the faces do not coincide, so that a rigid motion
//! of the whole model gives no jump. On coincident faces it vanishes.

use super::Midplane;
use crate::shape::lagrange2;

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
    let first_b = midplane.a.ends.len();
    let mut place = [[0.0; 2]; 2];
    for (side, sign) in [(0, -1.0), (1, 1.0)] {
        let (chain, arc, edge, offset) = if side == 0 {
            (&midplane.a, &midplane.s_a, edge_a, 0)
        } else {
            (&midplane.b, &midplane.s_b, edge_b, first_b)
        };
        let xi = 2.0 * (s - arc[edge]) / (arc[edge + 1] - arc[edge]) - 1.0;
        let (n, _) = lagrange2(xi);
        for (i, n) in n.into_iter().enumerate() {
            for component in 0..2 {
                add(Entry { node: offset + edge + i, component, direction: component, value: sign * n });
                place[side][component] +=
                    n * (chain.points[edge + i][component] - midplane.origin[component]);
            }
        }
    }
    let apart = [place[1][0] - place[0][0], place[1][1] - place[0][1]];
    if apart[0].hypot(apart[1]) <= COINCIDENT * midplane.length {
        return;
    }
    let lever = [apart[1], -apart[0]]; // −ẑ × (x_B − x_A)
    for (chain, edge, offset) in [(&midplane.a, edge_a, 0), (&midplane.b, edge_b, first_b)] {
        let (p, q) = (chain.points[edge], chain.points[edge + 1]);
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let half = 0.5 / (dx * dx + dy * dy);
        for component in 0..2 {
            for (i, sign) in [(0, -1.0), (1, 1.0)] {
                let (node, c) = (offset + edge + i, sign * half * lever[component]);
                add(Entry { node, component, direction: 0, value: -c * dy });
                add(Entry { node, component, direction: 1, value: c * dx });
            }
        }
    }
}
