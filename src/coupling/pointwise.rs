//! `pointwise`: the law acts at quadrature points of every segment (paper eq. 14).
//!
//! K = ∫_C [B_A B_B]ᵀ D [B_A B_B] dL with B_A at ξ_A(ξ_C) and B_B at ξ_B(ξ_C). The jumps at the points are the
//! coefficients: M = I, N = I.

use super::{Coupling, LawPoint, Midplane, Points, jump};
use crate::shape::vector::dot;
use crate::shape::{GAUSS_2, GAUSS_3, LOBATTO_2, LOBATTO_3, LineRule};
use crate::sparse::Csr;

/// Two points where the jump is linear, three where it is quadratic.
pub(super) fn rule(points: Points, quadratic: bool) -> LineRule {
    match (points, quadratic) {
        (Points::Gauss, false) => GAUSS_2,
        (Points::Gauss, true) => GAUSS_3,
        (Points::Lobatto, false) => LOBATTO_2,
        (Points::Lobatto, true) => LOBATTO_3,
    }
}

/// Makes the weights of an interval sum to its length, whatever its curvature and the rule.
pub(super) fn share_out(points: &mut [LawPoint], length: f64) {
    let sum: f64 = points.iter().map(|point| point.weight).sum();
    points.iter_mut().for_each(|point| point.weight *= length / sum);
}

pub(super) fn build(midplane: Midplane, points: Points) -> Coupling {
    let components = 2;
    let mut triplets = Vec::new();
    let mut law_points: Vec<LawPoint> = Vec::new();
    for (i, segment) in midplane.segments.iter().enumerate() {
        let quadratic =
            midplane.a.mids[segment.edge_a].is_some() || midplane.b.mids[segment.edge_b].is_some();
        let first = law_points.len();
        for &[eta, weight] in rule(points, quadratic) {
            let spot = midplane.spot(i, eta);
            let row = components * law_points.len();
            jump::entries(&midplane, segment, &spot, |entry| {
                triplets.push((
                    row + entry.component,
                    components * entry.node + entry.direction,
                    entry.value,
                ));
            });
            law_points.push(LawPoint {
                weight: spot.speed * weight,
                s: segment.start + 0.5 * (segment.end - segment.start) * (1.0 + eta),
                position: spot.position,
                rotation: spot.rotation,
                gap: dot(jump::drawn(&midplane, segment, &spot), spot.rotation[0]),
                interpolation: [(law_points.len(), 1.0), (0, 0.0), (0, 0.0)],
            });
        }
        share_out(&mut law_points[first..], segment.end - segment.start);
    }
    let width = components * (midplane.a.nodes.len() + midplane.b.nodes.len());
    Coupling {
        components,
        nodes_a: midplane.a.nodes.clone(),
        nodes_b: midplane.b.nodes.clone(),
        jump: Csr::from_triplets(components * law_points.len(), width, &triplets),
        points: law_points,
        grid: Vec::new(),
        midplane,
    }
}
