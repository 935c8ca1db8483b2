//! Local vectors (n, t, s): normal to the interface and along its two tangents; in the plane s is zero.
//!
//! Kernels of laws take the number of components D as a constant, 2 in the plane and 3 in space: in the plane nothing is
//! paid for the third one. A law knows no direction along the interface but that of the shear itself,
//!
//! ```text
//! τ = |τ| e,  e = τ_trial/|τ_trial|        dτ/dτ_trial = (d|τ|/d|τ_trial|) e eᵀ + (|τ|/|τ_trial|) (I − e eᵀ)
//! ```

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Components (n, t, s) of a jump or a traction.
pub type Local = Vector3<f64>;
/// Derivatives of one by another, rows and columns (n, t, s).
pub type LocalMatrix = Matrix3<f64>;

/// Index of the normal component.
pub const N: usize = 0;
/// Index of the first tangential component.
pub const T: usize = 1;
/// Index of the second tangential component.
pub const S: usize = 2;

/// A local vector from its leading components, the others zero.
#[inline]
pub fn local(components: &[f64]) -> Local {
    let mut all = Local::zeros();
    all.iter_mut().zip(components).for_each(|(to, from)| *to = *from);
    all
}

/// Derivatives diag(k) of the leading components, row by row.
pub fn diagonal_rows(k: &[f64]) -> Vec<f64> {
    let mut rows = vec![0.0; k.len() * k.len()];
    write_diagonal(k, &mut rows);
    rows
}

/// Writes diag(k) of the leading components, row by row.
#[inline]
pub fn write_diagonal(k: &[f64], rows: &mut [f64]) {
    rows.fill(0.0);
    rows.iter_mut().step_by(k.len() + 1).zip(k).for_each(|(entry, k)| *entry = *k);
}

/// Writes the leading rows and columns of derivatives, row by row.
#[inline]
pub fn write_rows(d: &LocalMatrix, components: usize, rows: &mut [f64]) {
    for (i, row) in rows.chunks_exact_mut(components).enumerate() {
        row.iter_mut().enumerate().for_each(|(j, entry)| *entry = d[(i, j)]);
    }
}

/// The first D components.
#[inline]
pub(super) fn narrow<const D: usize>(v: &Local) -> SVector<f64, D> {
    SVector::from_fn(|i, _| v[i])
}

/// All three, those that D has not zero.
#[inline]
pub(super) fn widen<const D: usize>(v: &SVector<f64, D>) -> Local {
    local(v.as_slice())
}

/// The same for derivatives; in the plane s stands alone, with `across`.
#[inline]
pub(super) fn widen_matrix<const D: usize>(m: &SMatrix<f64, D, D>, across: f64) -> LocalMatrix {
    let mut all = LocalMatrix::zeros();
    all.fixed_view_mut::<D, D>(0, 0).copy_from(m);
    if D <= S {
        all[(S, S)] = across;
    }
    all
}

/// diag(normal, tangential, tangential).
#[inline]
pub(super) fn diagonal<const D: usize>(normal: f64, tangential: f64) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| match (i == j, i) {
        (true, N) => normal,
        (true, _) => tangential,
        _ => 0.0,
    })
}

/// |τ| of a traction, or |slip| of a jump.
#[inline]
pub(super) fn shear<const D: usize>(v: &SVector<f64, D>) -> f64 {
    if D > S { v[T].hypot(v[S]) } else { v[T].abs() }
}

/// Unit vector of the shear of a vector, along t if it has none.
#[inline]
pub(super) fn direction<const D: usize>(v: &SVector<f64, D>) -> SVector<f64, D> {
    let mut e = SVector::zeros();
    let size = shear(v);
    if D > S && size > 0.0 {
        (e[T], e[S]) = (v[T] / size, v[S] / size);
    } else {
        e[T] = 1.0_f64.copysign(v[T]);
    }
    e
}

/// (σ, τ e).
#[inline]
pub(super) fn along<const D: usize>(sigma: f64, tau: f64, e: &SVector<f64, D>) -> SVector<f64, D> {
    let mut v = e * tau;
    v[N] = sigma;
    v
}

/// I − e eᵀ of the tangential plane, zero in the plane.
#[inline]
pub(super) fn across<const D: usize>(e: &SVector<f64, D>) -> SMatrix<f64, D, D> {
    if D > S { diagonal(0.0, 1.0) - e * e.transpose() } else { SMatrix::zeros() }
}
