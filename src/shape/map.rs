//! The map x(ξ) = Σ N_i x_i from the reference cell.

use super::Values;

/// ∂x_d/∂ξ_a at \[a\]\[d\], for the coordinates of the nodes [length].
pub fn jacobian(values: &Values, x: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let mut j = [[0.0; 2]; 2];
    for (x, dn) in x.iter().zip(&values.dn) {
        for a in 0..2 {
            for d in 0..2 {
                j[a][d] += dn[a] * x[d];
            }
        }
    }
    j
}

/// det ∂x/∂ξ.
pub fn determinant(j: &[[f64; 2]; 2]) -> f64 {
    j[0][0] * j[1][1] - j[0][1] * j[1][0]
}
