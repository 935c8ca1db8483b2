//! LU of a sparse matrix front by front, on faer's dense kernels; rows are exchanged among the pivots of a front.
//!
//! ```text
//!   F = ⎡ A  B ⎤ = ⎡ P⁻¹L    ⎤ ⎡ U  L⁻¹P B ⎤      D − C U⁻¹ L⁻¹ P B is left to the parent
//!       ⎣ C  D ⎦   ⎣ C U⁻¹ 1 ⎦ ⎣ 0    …    ⎦
//! ```
//!
//! All that a front leaves is kept, so that a new factorisation begins where something has changed: a front whose elements and
//! children are as they were stays as it is, bit for bit what a factorisation of everything gives.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting as lu;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::perm::{PermRef, permute_rows_in_place};
use faer::{Accum, Mat, Par};
use rayon::prelude::*;

use super::dense::{column_mut, parallelism};
use super::fronts::{Front, Fronts, Layout, PlaceRun};

/// The factors, and what is needed to renew them.
#[derive(Debug)]
pub(super) struct Multifrontal {
    plan: Fronts,
    factors: Vec<Factors>,
}

/// A front after its elimination: L, U and what is left, in one matrix.
#[derive(Debug)]
struct Factors {
    matrix: Mat<f64>,
    rows: Vec<usize>,
    rows_back: Vec<usize>,
    /// It has changed in this factorisation.
    changed: bool,
    regular: bool,
    made: bool,
}

/// Adds numbers to those at their places.
fn add_runs(of: &[f64], into: &mut [f64], places: &[PlaceRun]) {
    for &PlaceRun { from, to, length } in places {
        let into = &mut into[to..to + length];
        into.iter_mut().zip(&of[from..from + length]).for_each(|(into, value)| *into += value);
    }
}

impl Multifrontal {
    /// Plans the factorisation.
    pub(super) fn new(layout: &Layout) -> Multifrontal {
        let plan = Fronts::new(layout);
        let factors = plan.fronts.iter().map(|_| Factors::none()).collect();
        Multifrontal { plan, factors }
    }

    /// Factors the sum of dense elements, of which those that are the same as before need not be marked, and single entries, which
    /// stay; false if pivots are missing.
    pub(super) fn factor(&mut self, elements: &[Arc<Mat<f64>>], changed: &[bool], entries: &[f64]) -> bool {
        for level in self.plan.levels.windows(2) {
            let (below, rest) = self.factors.split_at_mut(level[0]);
            let fronts = &self.plan.fronts[level[0]..level[1]];
            let work = |(front, factors): (&Front, &mut Factors)| {
                factors.changed = !factors.made
                    || front.elements.iter().any(|(e, _)| changed[*e as usize])
                    || front.children.iter().any(|(child, _)| below[*child as usize].changed);
                if factors.changed {
                    factors.assemble(front, elements, entries);
                    for (child, places) in &front.children {
                        let below = &below[*child as usize];
                        factors.add(&below.matrix, below.rows.len(), places);
                    }
                    factors.eliminate(front.pivots);
                }
            };
            fronts.par_iter().zip(&mut rest[..level[1] - level[0]]).for_each(work);
        }
        self.factors.iter().all(|factors| factors.regular)
    }

    /// A⁻¹ b in place. Fronts of one level are worked on side by side, every one on numbers of its own.
    pub(super) fn solve(&self, b: &mut [f64]) {
        let Fronts { fronts, levels } = &self.plan;
        // L y = b: what a front leaves for its border waits until the parent takes it
        let (mut y, mut left): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        for level in levels.windows(2) {
            let forward = |(front, factors): (&Front, &Factors)| {
                let mut of: Vec<f64> =
                    front.rows[..front.pivots].iter().map(|&row| b[row as usize]).collect();
                of.resize(front.rows.len(), 0.0);
                for (child, places) in &front.children {
                    add_runs(&left[*child as usize], &mut of, places);
                }
                let border = of.split_off(front.pivots);
                factors.forward(of, border)
            };
            let of = level[0]..level[1];
            let solved: Vec<_> = fronts[of.clone()].par_iter().zip(&self.factors[of]).map(forward).collect();
            for (own, border) in solved {
                y.push(own);
                left.push(border);
            }
        }
        // U x = y
        for level in levels.windows(2).rev() {
            let of = level[0]..level[1];
            let backward = |((front, factors), own): ((&Front, &Factors), &mut Vec<f64>)| {
                let mut border: Vec<f64> =
                    front.rows[front.pivots..].iter().map(|&row| b[row as usize]).collect();
                factors.backward(own, &mut border);
            };
            (fronts[of.clone()].par_iter().zip(&self.factors[of.clone()]).zip(&mut y[of.clone()]))
                .for_each(backward);
            for (front, own) in fronts[of.clone()].iter().zip(&y[of]) {
                front.rows.iter().zip(own).for_each(|(&row, x)| b[row as usize] = *x);
            }
        }
    }
}

impl Factors {
    fn none() -> Factors {
        let (rows, rows_back) = (Vec::new(), Vec::new());
        Factors { matrix: Mat::new(), rows, rows_back, changed: false, regular: false, made: false }
    }

    /// The front with its own elements and entries.
    fn assemble(&mut self, front: &Front, elements: &[Arc<Mat<f64>>], entries: &[f64]) {
        let n = front.rows.len();
        if self.made {
            self.matrix.fill(0.0);
        } else {
            self.matrix = Mat::zeros(n, n);
            self.made = true;
        }
        self.rows.resize(front.pivots, 0);
        self.rows_back.resize(front.pivots, 0);
        for (e, places) in &front.elements {
            self.add(&elements[*e as usize], 0, places);
        }
        for &(e, i, j) in &front.entries {
            self.matrix[(i as usize, j as usize)] += entries[e as usize];
        }
    }

    /// Adds the trailing part of a matrix, from a row and column on.
    fn add(&mut self, matrix: &Mat<f64>, from: usize, places: &[PlaceRun]) {
        for columns in places {
            for k in 0..columns.length {
                let of = &matrix.col_as_slice(from + columns.from + k)[from..];
                add_runs(of, self.matrix.col_as_slice_mut(columns.to + k), places);
            }
        }
    }

    /// L, U and what is left.
    fn eliminate(&mut self, pivots: usize) {
        let n = self.matrix.nrows();
        let par = parallelism(n);
        let (left, right) = self.matrix.as_mut().split_at_col_mut(pivots);
        let (mut a, mut c) = left.split_at_row_mut(pivots);
        let (mut b, d) = right.split_at_row_mut(pivots);
        let scratch = lu::factor::lu_in_place_scratch::<usize, f64>(pivots, pivots, par, Default::default());
        let scratch = scratch.or(faer::perm::permute_rows_in_place_scratch::<usize, f64>(pivots, n - pivots));
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        lu::factor::lu_in_place(
            a.as_mut(),
            &mut self.rows,
            &mut self.rows_back,
            par,
            stack,
            Default::default(),
        );
        self.regular = (0..pivots).all(|j| a[(j, j)].is_normal());
        let order = PermRef::new_checked(&self.rows, &self.rows_back, pivots);
        permute_rows_in_place(b.as_mut(), order, MemStack::new(&mut memory));
        solve_unit_lower_triangular_in_place(a.as_ref(), b.as_mut(), par);
        solve_lower_triangular_in_place(a.as_ref().transpose(), c.as_mut().transpose_mut(), par);
        matmul(d, Accum::Add, c.as_ref(), b.as_ref(), -1.0, par);
    }

    /// L⁻¹ of the pivots' part, and what the border has then.
    fn forward(&self, of: Vec<f64>, mut border: Vec<f64>) -> (Vec<f64>, Vec<f64>) {
        let mut own: Vec<f64> = self.rows.iter().map(|&row| of[row]).collect();
        let (l, below) = self.matrix.as_ref().subcols(0, own.len()).split_at_row(own.len());
        solve_unit_lower_triangular_in_place(l, column_mut(&mut own), Par::Seq);
        matmul(column_mut(&mut border), Accum::Add, below, column_mut(&mut own), -1.0, Par::Seq);
        (own, border)
    }

    /// The pivots' part of the solution, for the border's.
    fn backward(&self, own: &mut [f64], border: &mut [f64]) {
        let (u, right) = self.matrix.as_ref().subrows(0, own.len()).split_at_col(own.len());
        matmul(column_mut(own), Accum::Add, right, column_mut(border), -1.0, Par::Seq);
        solve_upper_triangular_in_place(u, column_mut(own), Par::Seq);
    }
}
