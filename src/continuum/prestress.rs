//! Stresses beyond those of the strains: what a body has before anything is built, and what temperature and other strains of
//! its own take away.
//!
//! ```text
//! σ = C (ε − ε*) + σ₀ = C ε + σ_p,  σ_p = σ₀ − C ε*        nodal forces  p = h ∫ Bᵀ σ_p dA
//! energy  ∫ ½ (ε − ε*)ᵀ C (ε − ε*) + σ₀ : ε = ½ uᵀ K u + p · u + ½ ∫ ε*ᵀ C ε*        ε*, C in three directions
//! ```
//!
//! All of them are known at the points of the stiffness rule: strains of a free body make no stress then, to rounding. Forces of an
//! initial stress are integrated as loads are, so that one in equilibrium needs no other.

use super::Elasticity;
use super::element::{cell_coordinates, gradients};
use crate::mesh::Mesh;
use crate::shape::vector::{in_plane, plus};

/// Components xx, yy, zz, xy at the points of the stiffness rule, cell by cell.
#[derive(Debug, Clone, PartialEq)]
pub struct PointField {
    /// First point of every cell.
    first: Vec<usize>,
    values: Vec<[f64; 4]>,
}

impl PointField {
    /// A field by its value at a place.
    pub fn sample<E>(
        mesh: &Mesh,
        mut at: impl FnMut([f64; 3]) -> Result<[f64; 4], E>,
    ) -> Result<PointField, E> {
        let (mut first, mut values) = (Vec::with_capacity(mesh.cells.len()), Vec::new());
        for c in 0..mesh.cells.len() {
            let (shape, x) = (mesh.cells.shapes[c], cell_coordinates(mesh, c));
            let origin = in_plane(mesh.points[mesh.cells.nodes(c)[0]]);
            first.push(values.len());
            for &[xi, eta, _] in shape.stiffness_rule() {
                let n = shape.values(xi, eta).n;
                let place = [0, 1].map(|d| (0..shape.nodes()).map(|i| n[i] * x[i][d]).sum());
                let [x, y] = plus(origin, place);
                values.push(at([x, y, 0.0])?);
            }
        }
        Ok(PointField { first, values })
    }

    /// The field changed point by point.
    pub fn map(&self, change: impl Fn([f64; 4]) -> [f64; 4]) -> PointField {
        PointField {
            first: self.first.clone(),
            values: self.values.iter().map(|value| change(*value)).collect(),
        }
    }

    /// The sum with another field on the same mesh, times a factor.
    pub fn plus(&self, other: &PointField, factor: f64) -> PointField {
        let both = self.values.iter().zip(&other.values);
        let values = both.map(|(a, b)| std::array::from_fn(|i| a[i] + factor * b[i])).collect();
        PointField { first: self.first.clone(), values }
    }

    /// The value at a point of a cell.
    #[inline]
    pub(super) fn at(&self, cell: usize, point: usize) -> [f64; 4] {
        self.values[self.first[cell] + point]
    }

    /// Mean over every cell.
    pub fn cells(&self) -> Vec<[f64; 4]> {
        let ends = self.first.iter().skip(1).copied().chain([self.values.len()]);
        let mean = |(start, end): (usize, usize)| {
            let own = &self.values[start..end];
            std::array::from_fn(|i| own.iter().map(|value| value[i]).sum::<f64>() / own.len() as f64)
        };
        self.first.iter().copied().zip(ends).map(mean).collect()
    }

    /// Nodal forces h ∫ Bᵀ σ dA of a stress, x and y of every node.
    pub fn forces(&self, mesh: &Mesh, thickness: f64) -> Vec<f64> {
        let mut force = vec![0.0; 2 * mesh.points.len()];
        self.each(mesh, |nodes, g, area, [xx, yy, _, xy]| {
            for (&node, g) in nodes.iter().zip(g) {
                force[2 * node] += thickness * area * (g[0] * xx + g[1] * xy);
                force[2 * node + 1] += thickness * area * (g[1] * yy + g[0] * xy);
            }
        });
        force
    }

    /// Nodal forces h ∫ Bᵀ σ dA of a stress by its value at a place, with the rule of loads: exact in curved cells too if the
    /// stress is constant.
    pub fn forces_of<E>(
        mesh: &Mesh,
        thickness: f64,
        mut at: impl FnMut([f64; 3]) -> Result<[f64; 4], E>,
    ) -> Result<Vec<f64>, E> {
        let mut force = vec![0.0; 2 * mesh.points.len()];
        for c in 0..mesh.cells.len() {
            let (shape, nodes, x) = (mesh.cells.shapes[c], mesh.cells.nodes(c), cell_coordinates(mesh, c));
            let origin = in_plane(mesh.points[nodes[0]]);
            for &[xi, eta, weight] in shape.field_rule() {
                let values = shape.values(xi, eta);
                let (g, det) = gradients(shape, &x, &values);
                let place = [0, 1].map(|d| (0..shape.nodes()).map(|i| values.n[i] * x[i][d]).sum());
                let [x, y] = plus(origin, place);
                let [xx, yy, _, xy] = at([x, y, 0.0])?;
                for (&node, g) in nodes.iter().zip(g) {
                    force[2 * node] += thickness * weight * det * (g[0] * xx + g[1] * xy);
                    force[2 * node + 1] += thickness * weight * det * (g[1] * yy + g[0] * xy);
                }
            }
        }
        Ok(force)
    }

    /// h ∫ a : b dA of a stress and a tensor strain; the shear counts twice.
    pub fn product(&self, other: &PointField, mesh: &Mesh, thickness: f64) -> f64 {
        let both = self.values.iter().zip(&other.values);
        let values =
            both.map(|(a, b)| [a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * a[3] * b[3], 0.0, 0.0, 0.0]);
        let dots = PointField { first: self.first.clone(), values: values.collect() };
        let mut sum = 0.0;
        dots.each(mesh, |_, _, area, [dot, ..]| sum += thickness * area * dot);
        sum
    }

    /// Every point: nodes, gradients of their functions, area, value.
    fn each(&self, mesh: &Mesh, mut visit: impl FnMut(&[usize], &[[f64; 2]], f64, [f64; 4])) {
        for c in 0..mesh.cells.len() {
            let (shape, nodes) = (mesh.cells.shapes[c], mesh.cells.nodes(c));
            let x = cell_coordinates(mesh, c);
            for (q, &[xi, eta, weight]) in shape.stiffness_rule().iter().enumerate() {
                let (g, det) = gradients(shape, &x, &shape.values(xi, eta));
                visit(nodes, &g[..nodes.len()], weight * det, self.at(c, q));
            }
        }
    }
}

impl Elasticity {
    /// −C ε* of a tensor strain (xx, yy, zz, xy): the stress of a body that cannot deform. In plane stress zz is free.
    pub fn eigenstress(&self, [xx, yy, zz, xy]: [f64; 4]) -> [f64; 4] {
        let Elasticity { c11, c12, c33, .. } = *self;
        if self.is_plane_stress {
            return [-(c11 * xx + c12 * yy), -(c12 * xx + c11 * yy), 0.0, -2.0 * c33 * xy];
        }
        let along = |own: f64, others: f64| -(c11 * own + c12 * others);
        [along(xx, yy + zz), along(yy, xx + zz), along(zz, xx + yy), -2.0 * c33 * xy]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::continuum::{PlaneState, recover};
    use crate::mesh::Cells;
    use crate::shape::Shape;
    use crate::shape::vector::in_space;

    /// A cell that stretches as it likes has no stress, and one that cannot has the eigenstress.
    #[test]
    fn a_free_cell_has_no_stress() {
        for (plane, zz) in [(PlaneState::Stress, 0.4), (PlaneState::Strain, 0.0)] {
            let elasticity = Elasticity::new(1e4, 0.3, plane);
            for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
                let mut cells = Cells::default();
                cells.push(shape, &(0..shape.nodes()).collect::<Vec<_>>());
                let place = |p: &[f64; 2]| in_space([2.0 * p[0] + 0.3 * p[1], 0.4 * p[0] + 1.5 * p[1]]);
                let points = shape.node_points().iter().map(place).collect();
                let mesh = Mesh { points, cells, ..Mesh::default() };
                let strain = [1e-3, -2e-3, 1e-3 * zz, 5e-4];
                let field = PointField::sample::<()>(&mesh, |_| Ok(strain)).unwrap();
                let stress = field.map(|strain| elasticity.eigenstress(strain));
                let move_by = |p: &[f64; 3]| [1e-3 * p[0] + 1e-3 * p[1], -2e-3 * p[1]];
                let u: Vec<f64> = mesh.points.iter().flat_map(move_by).collect();
                let free = recover(&mesh, &u, &elasticity, 0.5, Some(&stress));
                let energy = free.energy - 0.5 * stress.product(&field, &mesh, 0.5);
                for got in free.cells.iter().chain(&free.nodes) {
                    assert!(got.iter().all(|s| s.abs() < 1e-11), "{shape:?} {got:?}");
                }
                assert!(energy.abs() < 1e-12, "{energy}");
                let held = recover(&mesh, &vec![0.0; u.len()], &elasticity, 0.5, Some(&stress));
                for got in held.cells.iter().chain(&held.nodes) {
                    for (got, exact) in got.iter().zip(elasticity.eigenstress(strain)) {
                        assert!((got - exact).abs() < 1e-11, "{shape:?}");
                    }
                }
            }
        }
    }
}
