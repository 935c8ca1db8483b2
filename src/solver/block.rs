//! Contribution of one body to the interfaces of `blocks`: the jumps it takes part in from forces on them and from
//! its rigid motions.
//!
//! ```text
//! Σ over bodies   a = … − G F̂ Gᵀ q + G N α
//! ```

use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, Par};

use super::modes::FloatingModes;
use crate::assembly::InterfaceOperator;

/// Contribution of one body to the interfaces.
#[derive(Debug)]
pub(super) struct SubdomainBlock {
    /// Its interfaces.
    pub(super) interfaces: Vec<usize>,
    /// Unknowns of the jumps that it takes part in.
    pub(super) touched: Vec<usize>,
    /// G F̂ Gᵀ on these.
    pub(super) flexibility: Mat<f64>,
    /// G N on these.
    pub(super) moved: Mat<f64>,
    /// Its first rigid motion among the unknowns, and how many there could be.
    pub(super) first: usize,
    pub(super) most: usize,
}

impl SubdomainBlock {
    /// The contribution of body `b`. `first`, `of`: first unknown of every interface, and the interfaces of the body; `start`: the body's first rigid motion among the unknowns, and
    /// how many there could be.
    pub(super) fn new(
        subdomains: &FloatingModes,
        interfaces: &[InterfaceOperator],
        (first, of): (&[usize], &[usize]),
        b: usize,
        start: (usize, usize),
    ) -> SubdomainBlock {
        let continuum = subdomains.continuum;
        let (dofs, separator) = (continuum.dofs_of(b), continuum.separator_of(b));
        let (mut touched, mut rows) = (Vec::new(), Vec::new());
        for &k in of {
            touched.extend(first[k]..first[k + 1]);
            rows.extend((0..interfaces[k].size()).map(|i| interfaces[k].row(i)));
        }
        let rigid_modes = &subdomains.rigid_modes[b];
        let mut x = Mat::zeros(separator.len(), touched.len());
        let mut moved = Mat::zeros(touched.len(), rigid_modes.len());
        for (column, (on, values)) in rows.iter().enumerate() {
            for (&dof, &value) in on.iter().zip(*values).filter(|(dof, _)| dofs.contains(dof)) {
                if let Some(place) = continuum.places[dof].filter(|_| !subdomains.constrained[dof]) {
                    x[(place as usize - separator.start, column)] = value;
                }
                for (k, motion) in rigid_modes.iter().enumerate() {
                    moved[(column, k)] += value * motion[dof - dofs.start];
                }
            }
        }
        solve_lower_triangular_in_place(subdomains.factors[b].as_ref(), x.as_mut(), Par::Seq);
        let mut flexibility = Mat::zeros(touched.len(), touched.len());
        matmul(flexibility.as_mut(), Accum::Replace, x.transpose(), x.as_ref(), 1.0, Par::Seq);
        SubdomainBlock { interfaces: of.to_vec(), touched, flexibility, moved, first: start.0, most: start.1 }
    }
}
