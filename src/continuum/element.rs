//! Element stiffness K_e = h Σ_q w_q |J_q| B_qᵀ C B_q.

use super::Elasticity;
use crate::mesh::Mesh;
use crate::shape::{MAX_NODES, Shape, Values, determinant, jacobian};

/// Dofs of the largest element.
pub const MAX_DOFS: usize = 2 * MAX_NODES;

/// A symmetric element matrix, row-major, `2 · nodes` square in the leading part.
pub type ElementStiffness = [[f64; MAX_DOFS]; MAX_DOFS];

/// Coordinates of the nodes of cell `c`, relative to its first node so that large offsets cost no digits.
pub fn cell_coordinates(mesh: &Mesh, c: usize) -> [[f64; 2]; MAX_NODES] {
    let nodes = mesh.cells.nodes(c);
    let origin = mesh.points[nodes[0]];
    let mut x = [[0.0; 2]; MAX_NODES];
    for (x, &node) in x.iter_mut().zip(nodes) {
        *x = [mesh.points[node][0] - origin[0], mesh.points[node][1] - origin[1]];
    }
    x
}

/// Derivatives ∂N/∂x, ∂N/∂y at a reference point and the Jacobian's determinant there.
pub(super) fn gradients(
    shape: Shape,
    x: &[[f64; 2]; MAX_NODES],
    values: &Values,
) -> ([[f64; 2]; MAX_NODES], f64) {
    let j = jacobian(values, &x[..shape.nodes()]);
    let det = determinant(&j);
    let mut gradient = [[0.0; 2]; MAX_NODES];
    for i in 0..shape.nodes() {
        let [d_xi, d_eta] = values.dn[i];
        gradient[i] = [(j[1][1] * d_xi - j[0][1] * d_eta) / det, (j[0][0] * d_eta - j[1][0] * d_xi) / det];
    }
    (gradient, det)
}

/// Stiffness of one cell with its node coordinates, for a thickness.
pub fn element_stiffness(
    shape: Shape,
    x: &[[f64; 2]; MAX_NODES],
    elasticity: &Elasticity,
    thickness: f64,
) -> ElementStiffness {
    let mut k = [[0.0; MAX_DOFS]; MAX_DOFS];
    let Elasticity { c11, c12, c33, .. } = *elasticity;
    for &[xi, eta, weight] in shape.stiffness_rule() {
        let (g, det) = gradients(shape, x, &shape.values(xi, eta));
        let w = thickness * weight * det;
        for i in 0..shape.nodes() {
            let (xx, xy, yx, yy) =
                (w * c11 * g[i][0], w * c12 * g[i][0], w * c12 * g[i][1], w * c11 * g[i][1]);
            let (sx, sy) = (w * c33 * g[i][1], w * c33 * g[i][0]);
            for j in 0..=i {
                k[2 * i][2 * j] += xx * g[j][0] + sx * g[j][1];
                k[2 * i][2 * j + 1] += xy * g[j][1] + sx * g[j][0];
                k[2 * i + 1][2 * j] += yx * g[j][0] + sy * g[j][1];
                k[2 * i + 1][2 * j + 1] += yy * g[j][1] + sy * g[j][0];
            }
        }
    }
    for i in 0..2 * shape.nodes() {
        for j in 0..i {
            k[j][i] = k[i][j];
        }
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::continuum::PlaneState;

    const SHAPES: [Shape; 5] = [
        Shape::Triangle3,
        Shape::Triangle6,
        Shape::Quadrilateral4,
        Shape::Quadrilateral8,
        Shape::Quadrilateral9,
    ];

    /// A cell whose nodes are the reference nodes under an affine map.
    fn affine(shape: Shape) -> [[f64; 2]; MAX_NODES] {
        let mut x = [[0.0; 2]; MAX_NODES];
        for (x, p) in x.iter_mut().zip(shape.node_points()) {
            *x = [2.0 * p[0] + 0.3 * p[1], 0.4 * p[0] + 1.5 * p[1]];
        }
        x
    }

    #[test]
    fn a_linear_displacement_gives_the_exact_energy_and_a_rigid_motion_none() {
        let elasticity = Elasticity::new(1e4, 0.3, PlaneState::Strain);
        for shape in SHAPES {
            let x = affine(shape);
            let k = element_stiffness(shape, &x, &elasticity, 0.7);
            let energy = |u: &dyn Fn([f64; 2]) -> [f64; 2]| {
                let n = 2 * shape.nodes();
                let u: Vec<f64> = x.iter().take(shape.nodes()).flat_map(|&x| u(x)).collect();
                0.5 * (0..n)
                    .flat_map(|i| (0..n).map(move |j| (i, j)))
                    .map(|(i, j)| u[i] * k[i][j] * u[j])
                    .sum::<f64>()
            };
            // area of the image = reference area · det, energy = h A ½ ε C ε
            let area = (2.0 * 1.5 - 0.3 * 0.4) * if shape.corners() == 3 { 0.5 } else { 4.0 };
            let strain = [1e-3, -2e-3, 3e-3];
            let stress = elasticity.stress(strain);
            let exact = 0.7 * area * 0.5 * (0..3).map(|i| strain[i] * stress[i]).sum::<f64>();
            let stretched = energy(&|[x, y]| [1e-3 * x + 1e-3 * y, -2e-3 * y + 2e-3 * x]);
            assert!((stretched / exact - 1.0).abs() < 1e-12, "{shape:?}: {stretched} {exact}");
            let rotated = energy(&|[x, y]| [0.1 - 1e-3 * y, 0.2 + 1e-3 * x]);
            assert!(rotated.abs() < 1e-13 * 1e4 * 0.05, "{shape:?}: {rotated:e}");
        }
    }
}
