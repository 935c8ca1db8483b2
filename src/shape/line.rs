//! Lines: `0 ──── 1` and `0 ── 2 ── 1`, with ξ from −1 at node 0 to 1 at node 1.

/// Reference coordinates of the nodes (second component unused).
pub(super) const POINTS: [[f64; 2]; 3] = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];

/// Values of the two linear shape functions.
pub type Line2 = [f64; 2];
/// Values of the three quadratic shape functions, mid-node last.
pub type Line3 = [f64; 3];

/// Linear shape functions and their derivatives at ξ.
pub fn lagrange2(xi: f64) -> (Line2, Line2) {
    ([0.5 * (1.0 - xi), 0.5 * (1.0 + xi)], [-0.5, 0.5])
}

/// Quadratic shape functions and their derivatives at ξ.
pub fn lagrange3(xi: f64) -> (Line3, Line3) {
    ([0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), (1.0 - xi) * (1.0 + xi)], [xi - 0.5, xi + 0.5, -2.0 * xi])
}
