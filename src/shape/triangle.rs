//! Triangles T3 and T6.
//!
//! ```text
//!   η
//!   2
//!   │ ╲
//!   5   4
//!   │     ╲
//!   0 ─ 3 ─ 1  ξ
//! ```

use super::Values;

/// Reference coordinates of the nodes.
pub(super) const POINTS: [[f64; 2]; 6] =
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];

/// T3.
pub(super) fn linear(xi: f64, eta: f64, values: &mut Values) {
    values.n[..3].copy_from_slice(&[1.0 - xi - eta, xi, eta]);
    values.dn[..3].copy_from_slice(&[[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]]);
}

/// T6, with the area coordinate λ = 1 − ξ − η.
pub(super) fn quadratic(xi: f64, eta: f64, values: &mut Values) {
    let lambda = 1.0 - xi - eta;
    values.n[..6].copy_from_slice(&[
        lambda * (2.0 * lambda - 1.0),
        xi * (2.0 * xi - 1.0),
        eta * (2.0 * eta - 1.0),
        4.0 * lambda * xi,
        4.0 * xi * eta,
        4.0 * eta * lambda,
    ]);
    let corner = 1.0 - 4.0 * lambda;
    values.dn[..6].copy_from_slice(&[
        [corner, corner],
        [4.0 * xi - 1.0, 0.0],
        [0.0, 4.0 * eta - 1.0],
        [4.0 * (lambda - xi), -4.0 * xi],
        [4.0 * eta, 4.0 * xi],
        [-4.0 * eta, 4.0 * (lambda - eta)],
    ]);
}
