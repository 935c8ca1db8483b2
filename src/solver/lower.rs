//! Symmetric matrices of which the lower triangle is given.

use faer::Mat;

/// The whole matrix, without the rows that are held.
pub(super) fn whole(lower: &Mat<f64>, held: &[bool]) -> Mat<f64> {
    let at = |i: usize, j: usize| match held[i] {
        true => 0.0,
        false => lower[(i.max(j), i.min(j))],
    };
    Mat::from_fn(lower.nrows(), lower.ncols(), at)
}

/// A x, the entries taken through `part`.
pub(super) fn symmetric_product(lower: &Mat<f64>, x: &[f64], part: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    for j in 0..x.len() {
        let column = &lower.col_as_slice(j)[j..];
        y[j] += part(column[0]) * x[j];
        let (mut sum, by) = (0.0, x[j]);
        for ((value, x), y) in column[1..].iter().zip(&x[j + 1..]).zip(&mut y[j + 1..]) {
            let value = part(*value);
            sum += value * x;
            *y += value * by;
        }
        y[j] += sum;
    }
    y
}
