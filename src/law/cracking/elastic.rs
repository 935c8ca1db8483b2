//! K = diag(K_N, K_T, K_T) and its inverse on jumps, tractions and their derivatives.

use nalgebra::{SMatrix, SVector};

use super::super::local::N;
use super::surface::Surface;

/// A trial outside by less, relative to strength and traction, is elastic.
pub(super) const ELASTIC: f64 = 1e-13;

/// K Δr, or K dr.
pub(super) fn stiff<const D: usize>(surface: &Surface, jump: SVector<f64, D>) -> SVector<f64, D> {
    SVector::from_fn(|i, _| if i == N { surface.kn * jump[i] } else { surface.kt * jump[i] })
}

/// K⁻¹ Δt.
pub(super) fn compliant<const D: usize>(surface: &Surface, traction: SVector<f64, D>) -> SVector<f64, D> {
    SVector::from_fn(|i, _| if i == N { traction[i] / surface.kn } else { traction[i] / surface.kt })
}

/// Least distance of a trial from the surface that counts as outside [stress].
pub(super) fn margin<const D: usize>(surface: &Surface, traction: SVector<f64, D>) -> f64 {
    ELASTIC * surface.c0.max(traction.amax())
}

/// K times a derivative of a jump.
pub(super) fn stiff_rows<const D: usize>(surface: &Surface, jump: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| if i == N { surface.kn * jump[(i, j)] } else { surface.kt * jump[(i, j)] })
}
