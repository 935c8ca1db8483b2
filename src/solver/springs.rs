//! The springs of an interface as a dense element of a sparse matrix: Gᵀ T G on the dofs that it joins.

use faer::Mat;

use crate::sparse::Csr;

/// Where the springs of an interface act.
#[derive(Debug)]
pub(super) struct SpringElement {
    /// Its unknowns, ascending.
    pub(super) unknowns: Vec<u32>,
    /// G on these.
    jump: Csr,
}

impl SpringElement {
    /// For G on all unknowns.
    pub(super) fn new(jump: &Csr) -> SpringElement {
        let mut unknowns: Vec<u32> = jump.columns.iter().map(|&dof| dof as u32).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        let place = |dof: &usize| unknowns.partition_point(|&unknown| (unknown as usize) < *dof);
        let columns = jump.columns.iter().map(place).collect();
        SpringElement { jump: Csr { columns, width: unknowns.len(), ..jump.clone() }, unknowns }
    }

    /// Gᵀ T G without the equations of `held` unknowns.
    pub(super) fn element(&self, tangent: &Csr, held: impl Fn(usize) -> bool) -> Mat<f64> {
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
            if held(unknown as usize) {
                transposed.col_as_slice_mut(k).fill(0.0);
            }
        }
        transposed.transpose().to_owned()
    }
}
