//! Consistent nodal forces: f_i = h ∫ N_i t dL on edges, f_i = h ∫ N_i b dA in cells.

use super::element::gradients;
use crate::shape::{GAUSS_2, GAUSS_3, MAX_NODES, Shape, lagrange2, lagrange3};

/// Points of an edge: shape values, outward normal times dL/dξ · weight. The body lies on the left of the edge.
fn edge_points(x: &[[f64; 2]; 3], quadratic: bool) -> impl Iterator<Item = ([f64; 3], [f64; 2])> {
    let rule = if quadratic { GAUSS_3 } else { GAUSS_2 };
    rule.iter().map(move |&[xi, weight]| {
        let (n, dn) = if quadratic {
            lagrange3(xi)
        } else {
            let (n, dn) = lagrange2(xi);
            ([n[0], n[1], 0.0], [dn[0], dn[1], 0.0])
        };
        let slope = [0, 1].map(|d| (0..3).map(|i| dn[i] * x[i][d]).sum::<f64>());
        (n, [weight * slope[1], -weight * slope[0]])
    })
}

/// Nodal forces (x, y) of an edge under a traction (x, y) and a pressure, both constant [stress]; times thickness.
/// `x` holds start, end and mid-node.
pub fn edge_force(
    x: &[[f64; 2]; 3],
    quadratic: bool,
    traction: [f64; 2],
    pressure: f64,
    thickness: f64,
) -> [[f64; 2]; 3] {
    let mut force = [[0.0; 2]; 3];
    for (n, normal) in edge_points(x, quadratic) {
        let length = normal[0].hypot(normal[1]);
        for (force, n) in force.iter_mut().zip(n) {
            for d in 0..2 {
                force[d] += thickness * n * (traction[d] * length - pressure * normal[d]);
            }
        }
    }
    force
}

/// ∫ N_i dL of an edge: start, end and mid-node [length].
pub fn edge_weights(x: &[[f64; 2]; 3], quadratic: bool) -> [f64; 3] {
    let mut weights = [0.0; 3];
    for (n, normal) in edge_points(x, quadratic) {
        for (weight, n) in weights.iter_mut().zip(n) {
            *weight += n * normal[0].hypot(normal[1]);
        }
    }
    weights
}

/// ∫ N_i dA of a cell [length²].
pub fn cell_weights(shape: Shape, x: &[[f64; 2]; MAX_NODES]) -> [f64; MAX_NODES] {
    let mut weights = [0.0; MAX_NODES];
    for &[xi, eta, weight] in shape.load_rule() {
        let values = shape.values(xi, eta);
        let (_, det) = gradients(shape, x, &values);
        for i in 0..shape.nodes() {
            weights[i] += weight * det * values.n[i];
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pressure_pushes_against_the_body_and_sums_to_pressure_times_length() {
        // the body lies above an edge that runs along +x: a pressure p pushes up
        let x = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        for quadratic in [false, true] {
            let force = edge_force(&x, quadratic, [0.0, 0.0], 3.0, 0.5);
            let total = [0, 1].map(|d| force.iter().map(|f| f[d]).sum::<f64>());
            assert!(total[0].abs() < 1e-15 && (total[1] - 3.0).abs() < 1e-15, "{total:?}");
        }
        // quadratic: 1/6, 1/6, 4/6 of the force
        let force = edge_force(&x, true, [0.0, 6.0], 0.0, 1.0);
        for (force, exact) in force.iter().zip([2.0, 2.0, 8.0]) {
            assert!((force[1] - exact).abs() < 1e-14);
        }
    }
}
