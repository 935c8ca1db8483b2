//! Stiffness of a joint on the nodes: Gᵀ T G, and what it connects.

use super::{InterfaceTangent, Joint, Pattern, Symmetric};
use crate::sparse::Csr;

/// Sets of nodes that the joint's stiffness connects with each other.
pub(super) fn cliques(joint: &Joint) -> Vec<Vec<usize>> {
    let c = joint.coupling.components;
    let product = multiplied(joint, &vec![1.0; c * c * joint.coupling.points.len()]);
    let nodes_of = |i: usize| {
        let mut nodes: Vec<usize> =
            (c * i..c * (i + 1)).flat_map(|row| product.row(row).0).map(|dof| dof / c).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    };
    (0..joint.coupling.coefficients()).map(nodes_of).collect()
}

/// Adds the stiffness for symmetric law stiffnesses D, components² values per law point.
pub fn add_stiffness(joint: &Joint, pattern: &Pattern, stiffness: &[f64], k: &mut Symmetric) {
    let c = joint.coupling.components;
    let product = multiplied(joint, stiffness);
    for row in 0..joint.jump.rows() {
        let (left, left_values) = joint.jump.row(row);
        let (right, right_values) = product.row(row);
        for (&j, right) in right.iter().zip(right_values) {
            let from = left.partition_point(|&i| i < j);
            for (&i, left) in left[from..].iter().zip(&left_values[from..]) {
                let at = pattern.block(i / c, j / c);
                k.values[at[j % c] + i % c] += left * right;
            }
        }
    }
}

/// T G.
fn multiplied(joint: &Joint, stiffness: &[f64]) -> Csr {
    let mut tangent = InterfaceTangent::new(joint);
    tangent.fill(joint, stiffness);
    tangent.matrix.product(&joint.jump)
}
