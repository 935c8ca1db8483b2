//! Stress recovery: cell means, nodal values smoothed over the cells around a node, energy.
//!
//! Stress at the points of the stiffness rule is fitted in every cell by the polynomial that those points carry (constant
//! on T3, linear on T6, bilinear on Q4, Q8, Q9), evaluated at the nodes, and averaged there with the areas of the cells.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::element::{cell_coordinates, gradients};
use super::{Elasticity, PointField};
use crate::mesh::Mesh;
use crate::shape::Shape;

/// Stresses of one body; components xx, yy, zz, xy.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Stresses {
    /// Mean over every cell.
    pub cells: Vec<[f64; 4]>,
    /// Smoothed value at every node.
    pub nodes: Vec<[f64; 4]>,
    /// Elastic energy [force × length].
    pub energy: f64,
    /// Difference of temperature at every node, where the scene gives some.
    pub temperatures: Option<Vec<f64>>,
    /// Mean of the strains of its own (xx, yy, zz, xy) over every cell, where the body has some [-].
    pub strains: Option<Vec<[f64; 4]>>,
}

/// Recovers the stresses from the displacements (x, y of every node) of one body, and from the stress that it has beyond
/// those of its strains.
pub fn recover(
    mesh: &Mesh,
    u: &[f64],
    elasticity: &Elasticity,
    thickness: f64,
    beyond: Option<&PointField>,
) -> Stresses {
    if beyond.is_none() && u.iter().all(|&u| u == 0.0) {
        let at_rest = |n: usize| vec![[0.0; 4]; n];
        let (cells, nodes) = (at_rest(mesh.cells.len()), at_rest(mesh.points.len()));
        return Stresses { cells, nodes, ..Stresses::default() };
    }
    let per_cell: Vec<(CellStress, f64)> = (0..mesh.cells.len())
        .into_par_iter()
        .map(|c| cell_stress(mesh, c, u, elasticity, thickness, beyond))
        .collect();
    let mut nodes = vec![[0.0; 4]; mesh.points.len()];
    let mut areas = vec![0.0; mesh.points.len()];
    let mut energy = 0.0;
    for (c, (stress, cell_energy)) in per_cell.iter().enumerate() {
        energy += cell_energy;
        for (i, &node) in mesh.cells.nodes(c).iter().enumerate() {
            let at_node = stress.at_node(mesh.cells.shapes[c], i);
            for k in 0..4 {
                nodes[node][[0, 1, 3, 2][k]] += stress.area * at_node[k];
            }
            areas[node] += stress.area;
        }
    }
    let complete = |s: [f64; 4]| {
        let zz = elasticity.out_of_plane * (s[0] + s[1]);
        [s[0], s[1], if beyond.is_some() { zz + s[2] } else { zz }, s[3]]
    };
    for (stress, area) in nodes.iter_mut().zip(areas) {
        *stress = complete(stress.map(|s| s / area));
    }
    let cells =
        per_cell.iter().map(|(s, _)| complete([s.mean[0], s.mean[1], s.mean[3], s.mean[2]])).collect();
    Stresses { cells, nodes, energy, ..Stresses::default() }
}

/// Stress (xx, yy, xy) of one cell and what σ_zz has beyond that of the others: its mean, and the fitted polynomial
/// c₀ + c₁ ξ + c₂ η + c₃ ξη per component.
struct CellStress {
    area: f64,
    mean: [f64; 4],
    fit: [[f64; 4]; 4],
}

impl CellStress {
    fn at_node(&self, shape: Shape, i: usize) -> [f64; 4] {
        let [xi, eta] = shape.node_points()[i];
        [0, 1, 2, 3]
            .map(|k| self.fit[0][k] + xi * self.fit[1][k] + eta * self.fit[2][k] + xi * eta * self.fit[3][k])
    }
}

fn cell_stress(
    mesh: &Mesh,
    c: usize,
    u: &[f64],
    elasticity: &Elasticity,
    thickness: f64,
    beyond: Option<&PointField>,
) -> (CellStress, f64) {
    let shape = mesh.cells.shapes[c];
    let nodes = mesh.cells.nodes(c);
    let x = cell_coordinates(mesh, c);
    let rule = shape.stiffness_rule();
    let mut cell = CellStress { area: 0.0, mean: [0.0; 4], fit: [[0.0; 4]; 4] };
    let mut energy = 0.0;
    // the points of every rule are balanced, so the fit is a sum of moments over them
    let centre = if shape.corners() == 3 { 1.0 / 3.0 } else { 0.0 };
    let spread: f64 = rule.iter().map(|q| (q[0] - centre).powi(2)).sum();
    for (q, &[xi, eta, weight]) in rule.iter().enumerate() {
        let (g, det) = gradients(shape, &x, &shape.values(xi, eta));
        let mut strain = [0.0; 3];
        for (g, &node) in g.iter().zip(nodes) {
            let (ux, uy) = (u[2 * node], u[2 * node + 1]);
            strain[0] += g[0] * ux;
            strain[1] += g[1] * uy;
            strain[2] += g[1] * ux + g[0] * uy;
        }
        let [xx, yy, xy] = elasticity.stress(strain);
        let mut stress = [xx, yy, xy, 0.0];
        let area = weight * det;
        cell.area += area;
        for k in 0..3 {
            energy += 0.5 * thickness * area * strain[k] * stress[k];
        }
        if let Some(beyond) = beyond {
            let [xx, yy, zz, xy] = beyond.at(c, q);
            let more = [xx, yy, xy, zz - elasticity.out_of_plane * (xx + yy)];
            (0..4).for_each(|k| stress[k] += more[k]);
            energy += thickness * area * (0..3).map(|k| strain[k] * more[k]).sum::<f64>();
        }
        (0..4).for_each(|k| cell.mean[k] += area * stress[k]);
        fit_point(shape, xi, eta, rule.len(), spread, stress, &mut cell.fit);
    }
    cell.mean = cell.mean.map(|s| s / cell.area);
    (cell, energy)
}

/// Adds one point to the least-squares fit of a cell.
fn fit_point(
    shape: Shape,
    xi: f64,
    eta: f64,
    points: usize,
    spread: f64,
    stress: [f64; 4],
    fit: &mut [[f64; 4]; 4],
) {
    let n = points as f64;
    let basis = match shape {
        Shape::Triangle3 => [1.0, 0.0, 0.0, 0.0],
        // three points at (1/6, 1/6), (2/3, 1/6), (1/6, 2/3): the linear function through them
        Shape::Triangle6 => {
            let (first, second) = (xi > 0.5, eta > 0.5);
            let (a, b) = (f64::from(u8::from(first)), f64::from(u8::from(second)));
            let c = 1.0 - a - b; // 1 at the point that is neither
            [5.0 / 3.0 * c - (a + b) / 3.0, 2.0 * (a - c), 2.0 * (b - c), 0.0]
        }
        // balanced squares: Σ ξ² = Σ η² = spread, Σ (ξη)² = spread² / n, all mixed sums vanish
        _ => [1.0 / n, xi / spread, eta / spread, n * xi * eta / (spread * spread)],
    };
    for (fit, basis) in fit.iter_mut().zip(basis) {
        for k in 0..4 {
            fit[k] += basis * stress[k];
        }
    }
}

/// von Mises' equivalent of a stress (xx, yy, zz, xy): √(½ ((σx − σy)² + (σy − σz)² + (σz − σx)²) + 3 τ²).
pub fn von_mises([xx, yy, zz, xy]: [f64; 4]) -> f64 {
    let squares = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * squares + 3.0 * xy * xy).sqrt()
}

/// Principal stresses in the plane, s₁ ≥ s₂, and σ_zz, of (xx, yy, zz, xy).
pub fn principal(stress: [f64; 4]) -> [f64; 3] {
    let [xx, yy, zz, xy] = stress;
    let (middle, radius) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
    [middle + radius, middle - radius, zz]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::continuum::PlaneState;
    use crate::mesh::Cells;
    use crate::shape::vector::in_space;

    /// One cell with an affine image of the reference nodes and a displacement field at them.
    fn one_cell(shape: Shape, field: impl Fn(f64, f64) -> [f64; 2]) -> (Mesh, Vec<f64>) {
        let points: Vec<[f64; 2]> =
            shape.node_points().iter().map(|p| [2.0 * p[0] + 0.3 * p[1], 0.4 * p[0] + 1.5 * p[1]]).collect();
        let mut cells = Cells::default();
        cells.push(shape, &(0..shape.nodes()).collect::<Vec<_>>());
        let u = points.iter().flat_map(|p| field(p[0], p[1])).collect();
        let points = points.into_iter().map(in_space).collect();
        (Mesh { points, cells, ..Mesh::default() }, u)
    }

    #[test]
    fn a_stress_that_the_element_can_carry_is_recovered_at_the_nodes() {
        // u = (a x + b xy, c y − b/2 x²): ε_xx = a + b y, ε_yy = c, γ_xy = 0; b = 0 for linear shapes
        let elasticity = Elasticity::new(1e4, 0.2, PlaneState::Stress);
        for shape in [
            Shape::Triangle3,
            Shape::Quadrilateral4,
            Shape::Triangle6,
            Shape::Quadrilateral8,
            Shape::Quadrilateral9,
        ] {
            let (a, b, c) = (1e-3, if shape.is_quadratic() { 2e-3 } else { 0.0 }, -3e-3);
            let (mesh, u) = one_cell(shape, |x, y| [a * x + b * x * y, c * y - 0.5 * b * x * x]);
            let stresses = recover(&mesh, &u, &elasticity, 1.0, None);
            for (p, stress) in mesh.points.iter().zip(&stresses.nodes) {
                let exact = elasticity.stress([a + b * p[1], c, 0.0]);
                for (got, exact) in
                    [(stress[0], exact[0]), (stress[1], exact[1]), (stress[3], 0.0), (stress[2], 0.0)]
                {
                    assert!((got - exact).abs() < 1e-11, "{shape:?} {got} {exact}");
                }
            }
        }
    }

    #[test]
    fn principal_stresses_of_pure_shear_are_plus_and_minus() {
        assert_eq!(principal([0.0, 0.0, 0.0, 3.0]), [3.0, -3.0, 0.0]);
        assert_eq!(principal([1.0, -2.0, 0.5, 0.0]), [1.0, -2.0, 0.5]);
    }
}
