//! Reference shapes: node tables, shape functions and their derivatives, quadrature rules.
//!
//! Node orders are those of gmsh and of VTK, which agree for every plane shape used here.

mod line;
mod map;
mod quadrilateral;
mod rule;
mod triangle;
pub mod vector;

pub use line::{LINE_NODES, Line2, Line3, LineValues, lagrange2, lagrange3};
pub use map::{determinant, jacobian};
pub use rule::{GAUSS_2, GAUSS_3, LOBATTO_2, LOBATTO_3, LineRule, Rule};

/// Start and end of an interval, or its least and largest value.
pub type Ends = [f64; 2];
/// Reference coordinates on a facet; the second is 0 on a line.
pub type FacetPoint = [f64; 2];

/// Most nodes a plane cell can have.
pub const MAX_NODES: usize = 9;

/// The shapes of cells (surfaces) and edges (lines).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    /// Straight edge with two nodes.
    Line2,
    /// Edge with a mid-node.
    Line3,
    /// Linear triangle, T3.
    Triangle3,
    /// Quadratic triangle, T6.
    Triangle6,
    /// Bilinear quadrilateral, Q4.
    Quadrilateral4,
    /// Serendipity quadrilateral, Q8.
    Quadrilateral8,
    /// Biquadratic quadrilateral, Q9.
    Quadrilateral9,
}

/// Shape functions and their derivatives at one point of the reference cell.
#[derive(Debug, Clone, Copy)]
pub struct Values {
    /// N_i, `nodes` of them are used.
    pub n: [f64; MAX_NODES],
    /// ∂N_i/∂ξ, ∂N_i/∂η.
    pub dn: [[f64; 2]; MAX_NODES],
}

impl Shape {
    /// Number of nodes.
    pub const fn nodes(self) -> usize {
        match self {
            Shape::Line2 => 2,
            Shape::Line3 | Shape::Triangle3 => 3,
            Shape::Quadrilateral4 => 4,
            Shape::Triangle6 => 6,
            Shape::Quadrilateral8 => 8,
            Shape::Quadrilateral9 => 9,
        }
    }

    /// Dimension of the shape itself: 1 for edges, 2 for cells.
    pub const fn dimension(self) -> usize {
        match self {
            Shape::Line2 | Shape::Line3 => 1,
            _ => 2,
        }
    }

    /// Number of corner nodes; they come first.
    pub const fn corners(self) -> usize {
        match self {
            Shape::Line2 | Shape::Line3 => 2,
            Shape::Triangle3 | Shape::Triangle6 => 3,
            Shape::Quadrilateral4 | Shape::Quadrilateral8 | Shape::Quadrilateral9 => 4,
        }
    }

    /// True for shapes with mid-nodes.
    pub const fn is_quadratic(self) -> bool {
        self.nodes() > self.corners()
    }

    /// Shape of the cell's edges.
    pub const fn edge_shape(self) -> Shape {
        if self.is_quadratic() { Shape::Line3 } else { Shape::Line2 }
    }

    /// The name engineers use: T3, T6, Q4, Q8, Q9, L2, L3.
    pub const fn label(self) -> &'static str {
        match self {
            Shape::Line2 => "L2",
            Shape::Line3 => "L3",
            Shape::Triangle3 => "T3",
            Shape::Triangle6 => "T6",
            Shape::Quadrilateral4 => "Q4",
            Shape::Quadrilateral8 => "Q8",
            Shape::Quadrilateral9 => "Q9",
        }
    }

    /// VTK cell type number.
    pub const fn vtk(self) -> u8 {
        match self {
            Shape::Line2 => 3,
            Shape::Line3 => 21,
            Shape::Triangle3 => 5,
            Shape::Triangle6 => 22,
            Shape::Quadrilateral4 => 9,
            Shape::Quadrilateral8 => 23,
            Shape::Quadrilateral9 => 28,
        }
    }

    /// Local nodes of edge `e`, walking counter-clockwise: start, end and, on quadratic shapes, the mid-node.
    pub const fn edge(self, e: usize) -> [usize; 3] {
        let corners = self.corners();
        [e, (e + 1) % corners, corners + e]
    }

    /// Shape functions and derivatives of a plane cell at the reference point (ξ, η).
    pub fn values(self, xi: f64, eta: f64) -> Values {
        let mut values = Values { n: [0.0; MAX_NODES], dn: [[0.0; 2]; MAX_NODES] };
        match self {
            Shape::Triangle3 => triangle::linear(xi, eta, &mut values),
            Shape::Triangle6 => triangle::quadratic(xi, eta, &mut values),
            Shape::Quadrilateral4 => quadrilateral::bilinear(xi, eta, &mut values),
            Shape::Quadrilateral8 => quadrilateral::serendipity(xi, eta, &mut values),
            Shape::Quadrilateral9 => quadrilateral::biquadratic(xi, eta, &mut values),
            Shape::Line2 | Shape::Line3 => unreachable!("a line is not a plane cell"),
        }
        values
    }

    /// The rule that integrates the cell's stiffness: exact on parallelograms (T3 1, Q4 2×2, T6 3, Q8 and Q9 3×3).
    pub fn stiffness_rule(self) -> Rule {
        match self {
            Shape::Triangle3 => rule::TRIANGLE_1,
            Shape::Triangle6 => rule::TRIANGLE_3,
            Shape::Quadrilateral4 => rule::SQUARE_4,
            Shape::Quadrilateral8 | Shape::Quadrilateral9 => rule::SQUARE_9,
            Shape::Line2 | Shape::Line3 => unreachable!("a line is not a plane cell"),
        }
    }

    /// The rule that integrates loads and masses: exact for products of two shape functions on parallelograms.
    pub fn load_rule(self) -> Rule {
        match self {
            Shape::Triangle3 => rule::TRIANGLE_3,
            Shape::Triangle6 => rule::TRIANGLE_6,
            Shape::Quadrilateral4 => rule::SQUARE_4,
            Shape::Quadrilateral8 | Shape::Quadrilateral9 => rule::SQUARE_9,
            Shape::Line2 | Shape::Line3 => unreachable!("a line is not a plane cell"),
        }
    }

    /// The rule for loads that vary within a cell: degree 5, so that smooth data cost no rate of convergence.
    pub fn field_rule(self) -> Rule {
        match self {
            Shape::Triangle3 | Shape::Triangle6 => rule::TRIANGLE_7,
            Shape::Quadrilateral4 | Shape::Quadrilateral8 | Shape::Quadrilateral9 => rule::SQUARE_9,
            Shape::Line2 | Shape::Line3 => unreachable!("a line is not a plane cell"),
        }
    }

    /// Reference coordinates of the nodes.
    pub fn node_points(self) -> &'static [[f64; 2]] {
        match self {
            Shape::Triangle3 | Shape::Triangle6 => &triangle::POINTS[..self.nodes()],
            Shape::Quadrilateral4 | Shape::Quadrilateral8 | Shape::Quadrilateral9 => {
                &quadrilateral::POINTS[..self.nodes()]
            }
            Shape::Line2 | Shape::Line3 => &line::POINTS[..self.nodes()],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: [Shape; 5] = [
        Shape::Triangle3,
        Shape::Triangle6,
        Shape::Quadrilateral4,
        Shape::Quadrilateral8,
        Shape::Quadrilateral9,
    ];

    #[test]
    fn shape_functions_are_one_at_their_node_and_zero_at_the_others() {
        for shape in CELLS {
            for (j, p) in shape.node_points().iter().enumerate() {
                let values = shape.values(p[0], p[1]);
                for i in 0..shape.nodes() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    assert!((values.n[i] - expected).abs() < 1e-15, "{shape:?} N{i} at node {j}");
                }
            }
        }
    }

    #[test]
    fn shape_functions_sum_to_one_and_reproduce_the_coordinates() {
        for shape in CELLS {
            let (xi, eta) = (0.21, 0.34);
            let values = shape.values(xi, eta);
            let sum: f64 = values.n.iter().sum();
            let x: f64 = shape.node_points().iter().zip(values.n).map(|(p, n)| p[0] * n).sum();
            let dy: f64 = shape.node_points().iter().zip(values.dn).map(|(p, d)| p[1] * d[1]).sum();
            assert!(
                (sum - 1.0).abs() < 1e-15 && (x - xi).abs() < 1e-15 && (dy - 1.0).abs() < 1e-14,
                "{shape:?}"
            );
        }
    }

    #[test]
    fn derivatives_agree_with_central_differences() {
        let h = 1e-6;
        for shape in CELLS {
            let (xi, eta) = (0.17, 0.28);
            let at = shape.values(xi, eta);
            for i in 0..shape.nodes() {
                let d_xi = (shape.values(xi + h, eta).n[i] - shape.values(xi - h, eta).n[i]) / (2.0 * h);
                let d_eta = (shape.values(xi, eta + h).n[i] - shape.values(xi, eta - h).n[i]) / (2.0 * h);
                assert!(
                    (at.dn[i][0] - d_xi).abs() < 1e-9 && (at.dn[i][1] - d_eta).abs() < 1e-9,
                    "{shape:?} {i}"
                );
            }
        }
    }

    #[test]
    fn edges_walk_around_the_cell_and_their_mid_nodes_lie_between_the_ends() {
        for shape in CELLS {
            let p = shape.node_points();
            for e in 0..shape.corners() {
                let [a, b, m] = shape.edge(e);
                if shape.is_quadratic() {
                    for d in 0..2 {
                        assert_eq!(p[m][d], 0.5 * (p[a][d] + p[b][d]), "{shape:?} edge {e}");
                    }
                }
            }
        }
    }

    #[test]
    fn rules_integrate_the_monomials_they_promise() {
        // ∫ ξ^i η^j over the unit triangle = i! j! / (i + j + 2)!, over the square [-1, 1]² = product of 2/(i + 1)
        let factorial = |n: u32| (1..=n).map(f64::from).product::<f64>();
        for (rule, degree) in
            [(rule::TRIANGLE_1, 1), (rule::TRIANGLE_3, 2), (rule::TRIANGLE_6, 4), (rule::TRIANGLE_7, 5)]
        {
            for i in 0..=degree {
                for j in 0..=degree - i {
                    let exact = factorial(i) * factorial(j) / factorial(i + j + 2);
                    let sum: f64 =
                        rule.iter().map(|q| q[2] * q[0].powi(i as i32) * q[1].powi(j as i32)).sum();
                    assert!((sum - exact).abs() < 1e-15, "triangle {i} {j}");
                }
            }
        }
        let side = |i: u32| if i.is_multiple_of(2) { 2.0 / (f64::from(i) + 1.0) } else { 0.0 };
        for (rule, degree) in [(rule::SQUARE_4, 3), (rule::SQUARE_9, 5)] {
            for i in 0..=degree {
                for j in 0..=degree {
                    let sum: f64 =
                        rule.iter().map(|q| q[2] * q[0].powi(i as i32) * q[1].powi(j as i32)).sum();
                    assert!((sum - side(i) * side(j)).abs() < 1e-14, "square {i} {j}");
                }
            }
        }
    }
}
