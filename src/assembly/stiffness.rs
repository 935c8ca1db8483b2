//! Stiffness of an interface on the nodes: Gᵀ T G, and what it connects.

use super::{InterfaceOperator, InterfaceTangent, Pattern, Symmetric};
use crate::sparse::Csr;

/// Sets of nodes that the interface's stiffness connects with each other.
pub(super) fn cliques(interface: &InterfaceOperator) -> Vec<Vec<usize>> {
    let c = interface.coupling.components;
    let product = multiplied(interface, &vec![1.0; c * c * interface.coupling.points.len()]);
    let nodes_of = |i: usize| {
        let mut nodes: Vec<usize> =
            (c * i..c * (i + 1)).flat_map(|row| product.row(row).0).map(|dof| dof / c).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    };
    (0..interface.coupling.coefficients()).map(nodes_of).collect()
}

/// Adds the stiffness for symmetric law stiffnesses D, components² values per law point.
pub fn add_stiffness(interface: &InterfaceOperator, pattern: &Pattern, stiffness: &[f64], k: &mut Symmetric) {
    let c = interface.coupling.components;
    let product = multiplied(interface, stiffness);
    for row in 0..interface.jump.rows() {
        let (left, left_values) = interface.jump.row(row);
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
fn multiplied(interface: &InterfaceOperator, stiffness: &[f64]) -> Csr {
    let mut tangent = InterfaceTangent::new(interface);
    tangent.fill(interface, stiffness);
    tangent.matrix.product(&interface.jump)
}
