//! `pointwise`: the law acts at quadrature points of every segment (paper eq. 14).
//!
//! K = ∫_C [B_A B_B]ᵀ D [B_A B_B] dL with B_A at ξ_A(ξ_C) and B_B at ξ_B(ξ_C). The jumps at the points are the
//! coefficients: M = I, N = I.

use super::{Coupling, Csr, LawPoint, Midplane, Points, jump};
use crate::shape::{GAUSS_2, LOBATTO_2, LineRule};

/// The rule on a linear interval.
pub(super) fn rule(points: Points) -> LineRule {
    match points {
        Points::Gauss => GAUSS_2,
        Points::Lobatto => LOBATTO_2,
    }
}

pub(super) fn build(midplane: Midplane, points: Points) -> Coupling {
    let components = 2;
    let mut triplets = Vec::new();
    let mut law_points: Vec<LawPoint> = Vec::new();
    for segment in &midplane.segments {
        let half = 0.5 * (segment.end - segment.start);
        for &[xi, weight] in rule(points) {
            let s = segment.start + half * (1.0 + xi);
            let row = components * law_points.len();
            jump::entries(&midplane, segment.edge_a, segment.edge_b, s, |entry| {
                triplets.push((
                    row + entry.component,
                    components * entry.node + entry.direction,
                    entry.value,
                ));
            });
            law_points.push(LawPoint {
                weight: half * weight,
                s,
                position: midplane.position(s),
                rotation: midplane.rotation(),
                interpolation: [(law_points.len(), 1.0), (0, 0.0), (0, 0.0)],
            });
        }
    }
    let width = components * (midplane.a.ends.len() + midplane.b.ends.len());
    Coupling {
        components,
        nodes_a: midplane.a.ends.clone(),
        nodes_b: midplane.b.ends.clone(),
        jump: Csr::from_triplets(components * law_points.len(), width, &triplets),
        points: law_points,
        grid: Vec::new(),
        midplane,
    }
}
