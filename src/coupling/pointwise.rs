//! `pointwise`: the law acts at quadrature points of every segment (paper eq. 14).
//!
//! K = ∫_C [B_A B_B]ᵀ D [B_A B_B] dL with B_A at ξ_A(ξ_C) and B_B at ξ_B(ξ_C). The jumps at the points are the
//! coefficients: M = I, N = I.

use super::place::Table;
use super::{Coupling, LawPoint, jump};
use crate::shape::vector::dot;
use crate::sparse::Csr;

/// The coupling of a table, displacements with so many components.
pub(super) fn build(table: Table, components: usize) -> Coupling {
    let mut triplets = Vec::new();
    for (i, place) in table.points.iter().enumerate() {
        jump::entries(&table, place, components, |entry| {
            let row = components * i + entry.component;
            triplets.push((row, components * entry.node + entry.direction, entry.value));
        });
    }
    let width = components * (table.sides[0].nodes.len() + table.sides[1].nodes.len());
    let jump = Csr::from_triplets(components * table.points.len(), width, &triplets);
    let point = |place| LawPoint::new(place, dot(place.apart, place.frame[0]));
    let points = table.points.iter().map(point).collect();
    Coupling::new(table, components, jump, points)
}
