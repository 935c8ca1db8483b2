//! J = I + F₀ (T − T₀): factored once for intact interfaces, and from there by the rows of T that are no longer intact.
//!
//! ```text
//! J = Jₛ (1 + W ΔT)      Jₛ = I + F₀ (Tₛ − T₀)      W = Jₛ⁻¹ F₀      ΔT = T − Tₛ
//! J⁻¹ b = z − W_R y      z = Jₛ⁻¹ b      (1 + ΔT_R W_R) y = ΔT_R z      R: rows of ΔT that are not zero
//! ```
//!
//! Only the small matrix of R is factored in an iteration: a sliding point has one row of its two, an intact one none. The base
//! depends on the supports alone and not on the way here, so that a run repeats bit by bit from any of its increments.
//! The whole is factored where hardly a row is intact, and where intact stiffnesses are much larger than the base: then
//! 1 + ΔT W is what is left of a difference.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef};
use rayon::prelude::*;

use super::dense::{Lu, parallelism};
use crate::assembly::InterfaceTangent;
use crate::sparse::Csr;

/// Largest part of all rows that is updated: the cubes of the sizes are then as one to two.
const PART: f64 = 0.8;
/// Intact stiffnesses of at most this many times the base stiffness leave half of the digits to 1 + ΔT W.
const STIFFER: f64 = 1e4;

/// The Jacobian of the condensed form.
#[derive(Debug)]
pub(super) struct Jacobian {
    /// Pattern of T over all active interfaces, with the values of T₀.
    base_stiffness: Csr,
    /// Values of Tₛ.
    intact: Vec<f64>,
    /// Intact stiffnesses are not too large for updates.
    updates: bool,
    base: Option<IntactFactor>,
    /// Values of T, and the factor for them.
    factored: Option<(Vec<f64>, JacobianFactor)>,
}

#[derive(Debug)]
struct IntactFactor {
    lu: Lu,
    /// W.
    flexibility: Mat<f64>,
}

#[derive(Debug)]
enum JacobianFactor {
    Whole(Lu),
    Update { rows: Vec<usize>, change: Csr, lu: Lu },
}

impl Jacobian {
    /// For interfaces with this base stiffness T₀ and intact stiffnesses Tₛ on the same patterns.
    pub(super) fn new(base_stiffness: &[Csr], intact: &[Csr]) -> Jacobian {
        let (base_stiffness, intact) = (stack(base_stiffness), stack(intact).values);
        let stiffer = |(s, t): (&f64, &f64)| s.abs() > STIFFER * t.abs() && *s != 0.0;
        let updates = !intact.iter().zip(&base_stiffness.values).any(stiffer);
        Jacobian { base_stiffness, intact, updates, base: None, factored: None }
    }

    /// Factors J for the tangents of all active interfaces, unless that is what is factored; `beyond` is added to them.
    pub(super) fn factor(
        &mut self,
        flexibility: MatRef<f64>,
        tangents: &[InterfaceTangent],
        beyond: Option<&Mat<f64>>,
    ) {
        let values: Vec<f64> = tangents.iter().flat_map(|tangent| &tangent.matrix.values).copied().collect();
        if let Some(beyond) = beyond {
            let mut matrix =
                whole(flexibility, &self.base_stiffness.less(&values, &self.base_stiffness.values));
            let par = parallelism(matrix.nrows());
            matmul(matrix.as_mut(), Accum::Add, flexibility, beyond.as_ref(), 1.0, par);
            self.factored = Some((Vec::new(), JacobianFactor::Whole(Lu::new(matrix))));
            return;
        }
        if self.factored.as_ref().is_some_and(|(of, _)| *of == values) {
            return;
        }
        let change = self.base_stiffness.less(&values, &self.intact);
        let rows: Vec<usize> = (0..change.rows()).filter(|&i| !change.row(i).0.is_empty()).collect();
        let factor = if self.updates && rows.len() as f64 <= PART * change.rows() as f64 {
            let of_base = || {
                IntactFactor::new(
                    flexibility,
                    &self.base_stiffness.less(&self.intact, &self.base_stiffness.values),
                )
            };
            let base = self.base.get_or_insert_with(of_base);
            let mut matrix = Mat::<f64>::zeros(rows.len(), rows.len());
            matrix.as_mut().par_col_iter_mut().enumerate().for_each(|(b, mut column)| {
                let moved = base.flexibility.col(rows[b]);
                for (a, &row) in rows.iter().enumerate() {
                    let (columns, values) = change.row(row);
                    let sum: f64 = columns.iter().zip(values).map(|(&k, value)| value * moved[k]).sum();
                    column[a] = if a == b { 1.0 + sum } else { sum };
                }
            });
            JacobianFactor::Update { rows, change, lu: Lu::new(matrix) }
        } else {
            JacobianFactor::Whole(Lu::new(whole(
                flexibility,
                &self.base_stiffness.less(&values, &self.base_stiffness.values),
            )))
        };
        self.factored = Some((values, factor));
    }

    /// J⁻¹ b in place.
    pub(super) fn solve(&self, b: &mut [f64]) {
        match (&self.factored, &self.base) {
            (Some((_, JacobianFactor::Whole(lu))), _) => lu.solve(b),
            (Some((_, JacobianFactor::Update { rows, change, lu })), Some(base)) => {
                base.lu.solve(b);
                let product = |&row: &usize| {
                    let (columns, values) = change.row(row);
                    columns.iter().zip(values).map(|(&k, value)| value * b[k]).sum()
                };
                let mut y: Vec<f64> = rows.iter().map(product).collect();
                lu.solve(&mut y);
                for (&row, y) in rows.iter().zip(&y) {
                    b.iter_mut().zip(base.flexibility.col(row).iter()).for_each(|(b, w)| *b -= y * w);
                }
            }
            _ => {}
        }
    }
}

impl IntactFactor {
    fn new(flexibility: MatRef<f64>, stiffer: &Csr) -> IntactFactor {
        let lu = Lu::new(whole(flexibility, stiffer));
        let mut moved = flexibility.to_owned();
        lu.solve_many(moved.as_mut());
        IntactFactor { lu, flexibility: moved }
    }
}

/// I + F₀ C for a sparse C.
fn whole(flexibility: MatRef<f64>, change: &Csr) -> Mat<f64> {
    let by_columns = change.transposed();
    let mut matrix = Mat::<f64>::zeros(flexibility.nrows(), flexibility.ncols());
    matrix.as_mut().par_col_iter_mut().enumerate().for_each(|(j, mut column)| {
        let (rows, values) = by_columns.row(j);
        for (&i, &factor) in rows.iter().zip(values) {
            faer::zip!(column.as_mut(), flexibility.col(i))
                .for_each(|faer::unzip!(into, from)| *into += factor * *from);
        }
        column[j] += 1.0;
    });
    matrix
}

/// Matrices one after the other on the diagonal.
fn stack(parts: &[Csr]) -> Csr {
    let mut all = Csr { offsets: vec![0], ..Csr::default() };
    for part in parts {
        let (rows, entries) = (all.rows(), all.values.len());
        all.offsets.extend(part.offsets[1..].iter().map(|offset| entries + offset));
        all.columns.extend(part.columns.iter().map(|column| rows + column));
        all.values.extend_from_slice(&part.values);
        all.width += part.width;
    }
    all
}
