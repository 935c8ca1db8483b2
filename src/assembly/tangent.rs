//! The tangent of an interface on its jump coefficients, T = h Σ_p w_p N_pᵀ R_pᵀ D_p R_p N_p: pattern once, values often.

use super::InterfaceOperator;
use crate::sparse::Csr;

/// T with its places.
#[derive(Debug, Clone)]
pub struct InterfaceTangent {
    /// The matrix; its pattern is symmetric.
    pub matrix: Csr,
    /// For every law point and every pair of its grid nodes the place of each component pair, none where N vanishes.
    places: Vec<Option<u32>>,
}

impl InterfaceTangent {
    /// The pattern of an interface, values zero.
    pub fn new(interface: &InterfaceOperator) -> InterfaceTangent {
        let c = interface.coupling.components;
        let mut entries = Vec::new();
        let visit = |point: &crate::coupling::LawPoint, entry: &mut dyn FnMut(usize, usize, bool)| {
            for &(i, ni) in &point.interpolation {
                for &(j, nj) in &point.interpolation {
                    for a in 0..c {
                        for b in 0..c {
                            entry(c * i + a, c * j + b, ni != 0.0 && nj != 0.0);
                        }
                    }
                }
            }
        };
        for point in &interface.coupling.points {
            visit(point, &mut |row, column, there| {
                if there {
                    entries.push((row, column, 0.0));
                }
            });
        }
        let size = c * interface.coupling.coefficients();
        let matrix = Csr::from_triplets(size, size, &entries);
        let mut places = Vec::new();
        for point in &interface.coupling.points {
            visit(point, &mut |row, column, there| {
                let place = there.then(|| matrix.row(row).0.partition_point(|&k| k < column));
                places.push(place.map(|k| (matrix.offsets[row] + k) as u32));
            });
        }
        InterfaceTangent { matrix, places }
    }

    /// T for law stiffnesses D, components² values per law point, row by row.
    pub fn fill(&mut self, interface: &InterfaceOperator, stiffness: &[f64]) {
        let c = interface.coupling.components;
        self.matrix.values.fill(0.0);
        let mut places = self.places.iter();
        for (point, d) in interface.coupling.points.iter().zip(stiffness.chunks_exact(c * c)) {
            let r = interface.rotation(point);
            for &(_, ni) in &point.interpolation {
                for &(_, nj) in &point.interpolation {
                    let w = interface.thickness() * point.weight * ni * nj;
                    for a in 0..c {
                        for b in 0..c {
                            if let Some(Some(at)) = places.next() {
                                let products = (0..c)
                                    .flat_map(|m| (0..c).map(move |n| r[m][a] * d[c * m + n] * r[n][b]));
                                self.matrix.values[*at as usize] += w * products.sum::<f64>();
                            }
                        }
                    }
                }
            }
        }
    }
}
