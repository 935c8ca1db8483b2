//! Springs of interfaces as dense elements of a sparse matrix: Gᵀ T G on the unknowns that an interface joins.

use std::sync::Arc;

use faer::Mat;
use rayon::prelude::*;

use crate::assembly::InterfaceTangent;
use crate::sparse::Csr;

/// The elements of all interfaces, and the tangents that they were made of last.
#[derive(Debug)]
pub(super) struct SpringElements {
    elements: Vec<SpringElement>,
    made: Vec<Vec<f64>>,
}

/// The unknowns of an interface, and G on them.
#[derive(Debug)]
struct SpringElement {
    /// Ascending.
    unknowns: Vec<u32>,
    /// G on these.
    jump: Csr,
}

impl SpringElements {
    /// For G of every interface on all unknowns.
    pub(super) fn new<'a>(jumps: impl IndexedParallelIterator<Item = &'a Csr>) -> SpringElements {
        let elements: Vec<SpringElement> = jumps.map(SpringElement::new).collect();
        SpringElements { made: vec![Vec::new(); elements.len()], elements }
    }

    /// Unknowns of every interface, ascending.
    pub(super) fn unknowns(&self) -> Vec<Vec<u32>> {
        self.elements.iter().map(|element| element.unknowns.clone()).collect()
    }

    /// Gᵀ T G of the interfaces whose tangent, given for the `active` ones, is another than before; without the equations of unknowns
    /// that are `held`.
    pub(super) fn renewed(
        &mut self,
        active: &[usize],
        tangents: &[InterfaceTangent],
        held: &[bool],
    ) -> Vec<Option<Arc<Mat<f64>>>> {
        let mut tangent_of = vec![None; self.elements.len()];
        active.iter().zip(tangents).for_each(|(&k, tangent)| tangent_of[k] = Some(&tangent.matrix));
        let renew = |((element, made), tangent): ((&SpringElement, &mut Vec<f64>), Option<&Csr>)| {
            let tangent = tangent.filter(|tangent| *made != tangent.values)?;
            made.clone_from(&tangent.values);
            Some(Arc::new(element.element(tangent, held)))
        };
        self.elements.par_iter().zip(&mut self.made).zip(tangent_of).map(renew).collect()
    }

    /// Sum over the active interfaces of the squares of |T| |G| |x|, forces to the digits of displacements whose differences are jumps.
    pub(super) fn squares(&self, active: &[usize], tangents: &[InterfaceTangent], x: &[f64]) -> f64 {
        let of = |(&k, tangent): (&usize, &InterfaceTangent)| self.elements[k].squares(&tangent.matrix, x);
        active.iter().zip(tangents).map(of).sum()
    }
}

impl SpringElement {
    /// For G on all unknowns.
    fn new(jump: &Csr) -> SpringElement {
        let mut unknowns: Vec<u32> = jump.columns.iter().map(|&dof| dof as u32).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        let place = |dof: &usize| unknowns.partition_point(|&unknown| (unknown as usize) < *dof);
        let columns = jump.columns.iter().map(place).collect();
        SpringElement { jump: Csr { columns, width: unknowns.len(), ..jump.clone() }, unknowns }
    }

    /// Gᵀ T G without the equations of unknowns that are `held`.
    fn element(&self, tangent: &Csr, held: &[bool]) -> Mat<f64> {
        let size = self.unknowns.len();
        let mut transposed = Mat::<f64>::zeros(size, size);
        let mut row = vec![0.0; size];
        for i in 0..tangent.rows() {
            row.fill(0.0);
            let (columns, values) = tangent.row(i);
            for (&k, &value) in columns.iter().zip(values).filter(|(_, value)| **value != 0.0) {
                let (dofs, jumps) = self.jump.row(k);
                dofs.iter().zip(jumps).for_each(|(&j, jump)| row[j] += value * jump);
            }
            let (dofs, jumps) = self.jump.row(i);
            for (&j, jump) in dofs.iter().zip(jumps) {
                let column = transposed.col_as_slice_mut(j);
                column.iter_mut().zip(&row).for_each(|(entry, value)| *entry += jump * value);
            }
        }
        for (k, &unknown) in self.unknowns.iter().enumerate() {
            if held[unknown as usize] {
                transposed.col_as_slice_mut(k).fill(0.0);
            }
        }
        transposed.transpose().to_owned()
    }

    /// Sum of the squares of |T| |G| |x|.
    fn squares(&self, tangent: &Csr, x: &[f64]) -> f64 {
        let jump = |i: usize| {
            let (places, values) = self.jump.row(i);
            let at = |k: usize| x[self.unknowns[k] as usize];
            places.iter().zip(values).map(|(&k, value)| (value * at(k)).abs()).sum::<f64>()
        };
        let jumps: Vec<f64> = (0..self.jump.rows()).map(jump).collect();
        let force = |i: usize| {
            let (columns, values) = tangent.row(i);
            columns.iter().zip(values).map(|(&j, value)| value.abs() * jumps[j]).sum::<f64>()
        };
        (0..tangent.rows()).map(|i| force(i).powi(2)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_and_sizes_are_those_of_dense_products() {
        // two jumps between unknowns 1, 4 and 6 of seven, and a tangent that is not symmetric
        let jump = Csr::from_triplets(2, 7, &[(0, 1, -1.0), (0, 4, 0.5), (1, 4, -0.25), (1, 6, 2.0)]);
        let tangent = Csr::from_triplets(2, 2, &[(0, 0, 3.0), (0, 1, -1.0), (1, 1, 5.0)]);
        let entry = |of: &Csr, i: usize, j: usize| {
            let (columns, values) = of.row(i);
            columns.iter().position(|&column| column == j).map_or(0.0, |k| values[k])
        };
        let springs = SpringElement::new(&jump);
        assert_eq!(springs.unknowns, [1, 4, 6]);
        let held: Vec<bool> = (0..7).map(|k| k == 4).collect();
        let element = springs.element(&tangent, &held);
        for (a, row) in [1, 4, 6].into_iter().enumerate() {
            for (b, column) in [1, 4, 6].into_iter().enumerate() {
                let pairs = (0..2).flat_map(|i| (0..2).map(move |j| (i, j)));
                let product = pairs
                    .map(|(i, j)| entry(&jump, i, row) * entry(&tangent, i, j) * entry(&jump, j, column));
                assert_eq!(element[(a, b)], if row == 4 { 0.0 } else { product.sum() });
            }
        }
        // |G| |x| = (1·2 + 0.5·4, 0.25·4 + 2·1), |T| of these (3·4 + 3, 5·3)
        let x = [9.0, -2.0, 9.0, 9.0, 4.0, 9.0, -1.0];
        assert_eq!(springs.squares(&tangent, &x), 15.0_f64.powi(2) + 15.0_f64.powi(2));
    }
}
