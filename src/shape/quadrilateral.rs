//! Quadrilaterals Q4, Q8 and Q9 on the square [−1, 1]².
//!
//! ```text
//!   3 ── 6 ── 2
//!   │         │
//!   7    8    5
//!   │         │
//!   0 ── 4 ── 1
//! ```

use super::{Values, lagrange3};

/// Reference coordinates of the nodes.
pub(super) const POINTS: [[f64; 2]; 9] = [
    [-1.0, -1.0],
    [1.0, -1.0],
    [1.0, 1.0],
    [-1.0, 1.0],
    [0.0, -1.0],
    [1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
    [0.0, 0.0],
];

/// Q4.
pub(super) fn bilinear(xi: f64, eta: f64, values: &mut Values) {
    for (i, p) in POINTS[..4].iter().enumerate() {
        let (a, b) = (1.0 + p[0] * xi, 1.0 + p[1] * eta);
        values.n[i] = 0.25 * a * b;
        values.dn[i] = [0.25 * p[0] * b, 0.25 * p[1] * a];
    }
}

/// Q8.
pub(super) fn serendipity(xi: f64, eta: f64, values: &mut Values) {
    for (i, p) in POINTS[..4].iter().enumerate() {
        let (a, b, c) = (1.0 + p[0] * xi, 1.0 + p[1] * eta, p[0] * xi + p[1] * eta - 1.0);
        values.n[i] = 0.25 * a * b * c;
        values.dn[i] = [0.25 * p[0] * b * (c + a), 0.25 * p[1] * a * (c + b)];
    }
    let (bubble_xi, bubble_eta) = ((1.0 - xi) * (1.0 + xi), (1.0 - eta) * (1.0 + eta));
    for (i, eta_i) in [(4, -1.0), (6, 1.0)] {
        values.n[i] = 0.5 * bubble_xi * (1.0 + eta_i * eta);
        values.dn[i] = [-xi * (1.0 + eta_i * eta), 0.5 * bubble_xi * eta_i];
    }
    for (i, xi_i) in [(5, 1.0), (7, -1.0)] {
        values.n[i] = 0.5 * (1.0 + xi_i * xi) * bubble_eta;
        values.dn[i] = [0.5 * xi_i * bubble_eta, -eta * (1.0 + xi_i * xi)];
    }
}

/// Q9: products of the quadratic line functions.
pub(super) fn biquadratic(xi: f64, eta: f64, values: &mut Values) {
    let ((n_xi, d_xi), (n_eta, d_eta)) = (lagrange3(xi), lagrange3(eta));
    let along = |p: f64| {
        if p < 0.0 {
            0
        } else if p > 0.0 {
            1
        } else {
            2
        }
    }; // node of the line: ends, then middle
    for (i, p) in POINTS.iter().enumerate() {
        let (a, b) = (along(p[0]), along(p[1]));
        values.n[i] = n_xi[a] * n_eta[b];
        values.dn[i] = [d_xi[a] * n_eta[b], n_xi[a] * d_eta[b]];
    }
}
