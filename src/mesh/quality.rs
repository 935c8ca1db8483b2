//! Quality of a cell: its scaled Jacobian (P. Knupp; as in the Verdict library).
//!
//! ```text
//!   q = min over the corners of  (a × b) / (|a| |b|),   a, b: the edges that leave the corner
//!   a triangle's by 2/√3, so that the equilateral one has 1, as the rectangle has
//! ```
//!
//! It is the sine of the worst angle: near 0 a corner is nearly flat, and stresses there mean little. Corners only:
//! mid-nodes do not enter.

use super::Mesh;
use crate::shape::vector::in_plane;

impl Mesh {
    /// Scaled Jacobian of a cell: 1 for a rectangle or an equilateral triangle, 0 for a flat corner.
    pub fn quality(&self, cell: usize) -> f64 {
        let corners = self.cells.shapes[cell].corners();
        let x: Vec<[f64; 2]> =
            self.cells.nodes(cell)[..corners].iter().map(|&node| in_plane(self.points[node])).collect();
        let at = |i: usize| {
            let edge = |j: usize| [x[j][0] - x[i][0], x[j][1] - x[i][1]];
            let (a, b) = (edge((i + 1) % corners), edge((i + corners - 1) % corners));
            (a[0] * b[1] - a[1] * b[0]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]))
        };
        let worst = (0..corners).map(at).fold(f64::INFINITY, f64::min);
        if corners == 3 { worst * 2.0 / 3f64.sqrt() } else { worst }
    }
}

#[cfg(test)]
mod tests {
    use crate::mesh::{Cells, Mesh};
    use crate::shape::Shape;
    use crate::shape::vector::in_space;

    fn quality(points: &[[f64; 2]]) -> f64 {
        let mut cells = Cells::default();
        let shape = if points.len() == 3 { Shape::Triangle3 } else { Shape::Quadrilateral4 };
        cells.push(shape, &(0..points.len()).collect::<Vec<_>>());
        let points = points.iter().map(|&x| in_space(x)).collect();
        Mesh { points, cells, ..Mesh::default() }.quality(0)
    }

    #[test]
    fn quality_is_the_sine_of_the_worst_angle() {
        let close = |got: f64, exact: f64| assert!((got - exact).abs() < 1e-15, "{got} instead of {exact}");
        close(quality(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]), 1.0);
        close(quality(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75f64.sqrt()]]), 1.0);
        // a right triangle with legs 1: sin 45° · 2/√3
        close(quality(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), (2.0f64 / 3.0).sqrt());
        // a rhombus of 30°
        let (sin, cos) = 30f64.to_radians().sin_cos();
        close(quality(&[[0.0, 0.0], [1.0, 0.0], [1.0 + cos, sin], [cos, sin]]), 0.5);
    }
}
