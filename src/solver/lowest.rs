//! The lowest eigenvalue of a symmetric matrix, if it is below a limit: one sparse factor says that it is not.
//!
//! ```text
//! A − limit I = L Lᵀ      nothing is below
//! else                    inverse iteration of a few vectors with A + floor I, Rayleigh's quotients of A
//! ```

use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Llt;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};
use nalgebra::{DMatrix, SymmetricEigen};

/// Up to this size all eigenvalues are found.
const DENSE: usize = 300;
/// Vectors that are iterated, and how often at most.
const VECTORS: usize = 6;
const MOST: usize = 60;
/// Change of the lowest value at which it counts as found.
const FOUND: f64 = 1e-6;
/// Shifts that are tried, ten times as large each: rounding may leave the first without a factor.
const SHIFTS: i32 = 6;

/// The lowest eigenvalue and its vector, if it is at most `limit`. `entries` of both triangles are summed; values below `floor` count
/// as zero.
pub fn lowest_below(
    size: usize,
    entries: &[(usize, usize, f64)],
    limit: f64,
    floor: f64,
) -> Option<(f64, Vec<f64>)> {
    if size > DENSE && factor(size, entries, -limit).is_some() {
        return None;
    }
    let shifts = if size > DENSE { SHIFTS } else { 0 };
    let shifted = (0..shifts).find_map(|k| factor(size, entries, floor * 10f64.powi(k)));
    let (value, vector) = match shifted {
        Some(factored) => iterate(size, entries, floor, &factored),
        None => least_of_all(size, entries),
    };
    (value <= limit).then_some((value, vector))
}

/// By all eigenvalues.
fn least_of_all(size: usize, entries: &[(usize, usize, f64)]) -> (f64, Vec<f64>) {
    let mut dense = DMatrix::<f64>::zeros(size, size);
    entries.iter().for_each(|&(i, j, value)| dense[(i, j)] += value);
    let eigen = SymmetricEigen::new(dense);
    let (least, value) = eigen.eigenvalues.argmin();
    (value, eigen.eigenvectors.column(least).as_slice().to_vec())
}

/// L of A + shift I; none if that is not positive definite.
fn factor(size: usize, entries: &[(usize, usize, f64)], shift: f64) -> Option<Llt<usize, f64>> {
    let all = entries.iter().copied().chain((0..size).map(|i| (i, i, shift)));
    let lower: Vec<_> =
        all.filter(|(i, j, _)| i >= j).map(|(i, j, value)| Triplet::new(i, j, value)).collect();
    SparseColMat::try_new_from_triplets(size, size, &lower).ok()?.sp_cholesky(Side::Lower).ok()
}

fn iterate(
    size: usize,
    entries: &[(usize, usize, f64)],
    floor: f64,
    factored: &Llt<usize, f64>,
) -> (f64, Vec<f64>) {
    // no direction is special to these
    let mut vectors = DMatrix::from_fn(size, VECTORS, |i, k| (1.0 + (i * (2 * k + 3)) as f64).sin());
    let mut before = f64::INFINITY;
    for _ in 0..MOST {
        let mut solved = Mat::from_fn(size, VECTORS, |i, k| vectors[(i, k)]);
        factored.solve_in_place(&mut solved);
        let basis = DMatrix::from_fn(size, VECTORS, |i, k| solved[(i, k)]).qr().q();
        let mut image = DMatrix::<f64>::zeros(size, VECTORS);
        for &(i, j, value) in entries {
            (0..VECTORS).for_each(|k| image[(i, k)] += value * basis[(j, k)]);
        }
        let eigen = SymmetricEigen::new(basis.transpose() * image);
        vectors = basis * &eigen.eigenvectors;
        let (least, value) = eigen.eigenvalues.argmin();
        vectors.swap_columns(0, least);
        if (value - before).abs() <= FOUND * value.abs() || value.abs() <= floor {
            return (value, vectors.column(0).as_slice().to_vec());
        }
        before = value;
    }
    (before, vectors.column(0).as_slice().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Springs in a row, the ends held by springs of `hold`: eigenvalues 2 − 2 cos(π k/(n + 1)) where hold = 1, 0 where 0.
    fn row(n: usize, hold: f64) -> Vec<(usize, usize, f64)> {
        let mut entries = vec![(0, 0, hold), (n - 1, n - 1, hold)];
        for i in 0..n - 1 {
            entries.extend([(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)]);
        }
        entries
    }

    #[test]
    fn the_lowest_value_of_a_row_of_springs_is_found() {
        for n in [200, 1500] {
            let entries = row(n, 1.0);
            let exact = 2.0 - 2.0 * (std::f64::consts::PI / (n + 1) as f64).cos();
            assert_eq!(lowest_below(n, &entries, 0.9 * exact, 1e-12), None, "{n}");
            let (value, vector) = lowest_below(n, &entries, 1.1 * exact, 1e-12).unwrap();
            assert!((value / exact - 1.0).abs() < 1e-5, "{n}: {value:e}, exact {exact:e}");
            let middle = vector[n / 2] / vector[n / 4];
            assert!((middle.abs() - std::f64::consts::SQRT_2).abs() < 3e-2, "{n}: {middle}");
            let (value, vector) = lowest_below(n, &row(n, 0.0), 1e-6, 1e-12).unwrap();
            assert!(value.abs() < 1e-11 && (vector[0] / vector[n - 1] - 1.0).abs() < 1e-6, "{n}: {value:e}");
        }
    }
}
