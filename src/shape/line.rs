//! Lines: `0 ──── 1` and `0 ── 2 ── 1`, with ξ from −1 at node 0 to 1 at node 1; inner nodes follow the ends.

use super::Shape;

/// Reference coordinates of the nodes (second component unused).
pub(super) const POINTS: [[f64; 2]; 3] = [[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]];

/// Values of the two linear shape functions.
pub type Line2 = [f64; 2];
/// Values of the three quadratic shape functions, mid-node last.
pub type Line3 = [f64; 3];

/// Most nodes of a line.
pub const LINE_NODES: usize = 3;
/// One value for every node of a line: ends, then inner nodes; zero beyond its nodes.
pub type LineValues = [f64; LINE_NODES];

impl Shape {
    /// The line with so many nodes.
    pub const fn line(nodes: usize) -> Shape {
        if nodes > 2 { Shape::Line3 } else { Shape::Line2 }
    }

    /// Shape functions of a line and their derivatives at ξ.
    pub fn line_functions(self, xi: f64) -> (LineValues, LineValues) {
        if self == Shape::Line3 {
            return lagrange3(xi);
        }
        let ([a, b], [da, db]) = lagrange2(xi);
        ([a, b, 0.0], [da, db, 0.0])
    }

    /// Places ξ of the nodes of a line.
    pub const fn line_places(self) -> &'static [f64] {
        match self {
            Shape::Line3 => &[-1.0, 1.0, 0.0],
            _ => &[-1.0, 1.0],
        }
    }

    /// Nodes of a line from its start to its end.
    pub const fn along_line(self) -> &'static [usize] {
        match self {
            Shape::Line3 => &[0, 2, 1],
            _ => &[0, 1],
        }
    }

    /// Nodes of a line in the order of the same line walked the other way.
    pub const fn turned_line(self) -> &'static [usize] {
        match self {
            Shape::Line3 => &[1, 0, 2],
            _ => &[1, 0],
        }
    }
}

/// Linear shape functions and their derivatives at ξ.
pub fn lagrange2(xi: f64) -> (Line2, Line2) {
    ([0.5 * (1.0 - xi), 0.5 * (1.0 + xi)], [-0.5, 0.5])
}

/// Quadratic shape functions and their derivatives at ξ.
pub fn lagrange3(xi: f64) -> (Line3, Line3) {
    ([0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), (1.0 - xi) * (1.0 + xi)], [xi - 0.5, xi + 0.5, -2.0 * xi])
}
