//! LU of sparse matrices that need not be symmetric: places analysed once, values often.
//!
//! Fronts exchange rows among their own pivots only, which is enough but for matrices that are close to singular somewhere inside.
//! So every solution is put into the equations: what misses is corrected, and where that does not help, faer's LU, which exchanges
//! rows freely, takes over.

use std::sync::{Arc, OnceLock};

use faer::Mat;
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use rayon::prelude::*;

use super::dense::column_mut;
use super::fronts::Layout;
use super::multifrontal::Multifrontal;

/// Misfit of an equation, over the sum of its terms, that is not corrected, the largest that is taken where corrections end, and
/// how many of these are tried. Who solves looks at a residual of its own: a correction of Newton's needs no more digits than that.
const SMALL: f64 = 1e-12;
const MISFIT: f64 = 1e-10;
const CORRECTIONS: usize = 4;

/// The factors of a matrix whose entries keep their places.
#[derive(Debug, Default)]
pub(super) struct SparseLu {
    layout: Layout,
    elements: Vec<Arc<Mat<f64>>>,
    entries: Vec<f64>,
    fronts: Option<Multifrontal>,
    /// The factor with free row exchanges, where it is needed; none where there is none.
    free: OnceLock<Option<Lu<usize, f64>>>,
}

impl SparseLu {
    /// True if the places of the entries are known.
    pub(super) fn is_planned(&self) -> bool {
        self.fronts.is_some()
    }

    /// Analyses the places of elements and of single entries, whose values stay.
    pub(super) fn plan(&mut self, layout: Layout, entries: Vec<f64>) {
        self.fronts = Some(Multifrontal::new(&layout));
        (self.layout, self.entries) = (layout, entries);
    }

    /// Factors the matrix of these elements, those that are `None` being as before, and the single entries; false if that cannot be
    /// done.
    pub(super) fn factor(&mut self, elements: Vec<Option<Arc<Mat<f64>>>>) -> bool {
        self.elements.resize_with(elements.len(), || Arc::new(Mat::new()));
        let changed: Vec<bool> = elements.iter().map(Option::is_some).collect();
        for (element, new) in self.elements.iter_mut().zip(elements) {
            if let Some(new) = new {
                *element = new;
            }
        }
        self.free = OnceLock::new();
        let regular = (self.fronts.as_mut())
            .is_some_and(|fronts| fronts.factor(&self.elements, &changed, &self.entries));
        regular || self.free.get_or_init(|| self.exchange()).is_some()
    }

    /// The factor with row exchanges anywhere.
    fn exchange(&self) -> Option<Lu<usize, f64>> {
        let size = self.layout.node_of.len();
        let single = self.layout.entries.iter().zip(&self.entries);
        let mut triplets: Vec<Triplet<usize, usize, f64>> =
            single.map(|(&(i, j), &value)| Triplet::new(i as usize, j as usize, value)).collect();
        for (rows, element) in self.layout.elements.iter().zip(&self.elements) {
            for (j, &column) in rows.iter().enumerate() {
                let of = rows.iter().zip(element.col_as_slice(j));
                triplets.extend(of.map(|(&i, &value)| Triplet::new(i as usize, column as usize, value)));
            }
        }
        SparseColMat::try_new_from_triplets(size, size, &triplets).ok()?.sp_lu().ok()
    }

    /// b − A x, and the most that an equation misses over the sum of its terms.
    fn misfit(&self, x: &[f64], b: &[f64]) -> (Vec<f64>, f64) {
        let terms = |(rows, element): (&Vec<u32>, &Arc<Mat<f64>>)| {
            let mut sums = vec![[0.0; 2]; rows.len()];
            for (j, &column) in rows.iter().enumerate() {
                let by = x[column as usize];
                for (sum, value) in sums.iter_mut().zip(element.col_as_slice(j)) {
                    let term = value * by;
                    *sum = [sum[0] + term, sum[1] + term.abs()];
                }
            }
            sums
        };
        let sums: Vec<Vec<[f64; 2]>> =
            self.layout.elements.par_iter().zip(&self.elements).map(terms).collect();
        let (mut residual, mut scale) = (b.to_vec(), b.iter().map(|b| b.abs()).collect::<Vec<f64>>());
        let mut take = |row: u32, term: f64, size: f64| {
            residual[row as usize] -= term;
            scale[row as usize] += size;
        };
        for (rows, sums) in self.layout.elements.iter().zip(sums) {
            rows.iter().zip(sums).for_each(|(&row, [sum, size])| take(row, sum, size));
        }
        for (&(row, column), value) in self.layout.entries.iter().zip(&self.entries) {
            let term = value * x[column as usize];
            take(row, term, term.abs());
        }
        let part = residual.iter().zip(&scale).filter(|(r, _)| **r != 0.0).map(|(r, s)| r.abs() / s);
        let worst = part.fold(0.0, |worst: f64, part| if part <= worst { worst } else { part });
        (residual, worst)
    }

    /// A⁻¹ b in place; b as it is without a factor.
    pub(super) fn solve(&self, b: &mut [f64]) {
        let Some(fronts) = &self.fronts else { return };
        if self.free.get().is_none() {
            let mut x = b.to_vec();
            fronts.solve(&mut x);
            let (mut left, mut worst) = self.misfit(&x, b);
            for _ in 0..CORRECTIONS {
                if worst <= SMALL {
                    break;
                }
                fronts.solve(&mut left);
                let next: Vec<f64> = x.iter().zip(&left).map(|(x, left)| x + left).collect();
                let (left_then, then) = self.misfit(&next, b);
                let ended = then > 0.5 * worst;
                if then < worst {
                    (x, left, worst) = (next, left_then, then);
                }
                if ended {
                    break;
                }
            }
            if worst <= MISFIT {
                b.copy_from_slice(&x);
                return;
            }
        }
        if let Some(free) = self.free.get_or_init(|| self.exchange()) {
            free.solve_in_place(column_mut(b));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 that look like chance (Lehmer 1951).
    struct Chance(u64);

    impl Chance {
        fn next(&mut self) -> f64 {
            self.0 = self.0 * 48_271 % 2_147_483_647;
            2.0 * self.0 as f64 / 2_147_483_647.0 - 1.0
        }

        fn element(&mut self, size: usize) -> Arc<Mat<f64>> {
            Arc::new(Mat::from_fn(size, size, |i, j| self.next() + if i == j { 2.0 } else { 0.0 }))
        }
    }

    /// Two unknowns at every node of a grid, an element on every cell, one more on nodes far apart, and a diagonal.
    fn grid(n: usize) -> Layout {
        let node = |i: usize, j: usize| (i * n + j) as u32;
        let unknowns = |nodes: &[u32]| nodes.iter().flat_map(|&node| [2 * node, 2 * node + 1]).collect();
        let mut elements: Vec<Vec<u32>> = Vec::new();
        for i in 0..n - 1 {
            for j in 0..n - 1 {
                elements.push(unknowns(&[node(i, j), node(i, j + 1), node(i + 1, j), node(i + 1, j + 1)]));
            }
        }
        elements.push(unknowns(&[node(0, 0), node(n - 1, n - 1)]));
        let size = 2 * n * n;
        Layout {
            node_of: (0..size).map(|k| (k / 2) as u32).collect(),
            coordinates: (0..n * n).flat_map(|k| [(k / n) as f64, (k % n) as f64]).collect(),
            nodes: n * n,
            elements,
            entries: (0..size as u32).map(|k| (k, k)).collect(),
        }
    }

    fn dense(lu: &SparseLu) -> Mat<f64> {
        let size = lu.layout.node_of.len();
        let mut whole = Mat::zeros(size, size);
        for (rows, element) in lu.layout.elements.iter().zip(&lu.elements) {
            for (i, &row) in rows.iter().enumerate() {
                for (j, &column) in rows.iter().enumerate() {
                    whole[(row as usize, column as usize)] += element[(i, j)];
                }
            }
        }
        for (&(i, j), value) in lu.layout.entries.iter().zip(&lu.entries) {
            whole[(i as usize, j as usize)] += value;
        }
        whole
    }

    fn solved(lu: &SparseLu) -> Vec<f64> {
        let mut b: Vec<f64> = (0..lu.layout.node_of.len()).map(|k| 1.0 + (k % 7) as f64).collect();
        lu.solve(&mut b);
        b
    }

    #[test]
    fn fronts_solve_what_dense_factors_solve_and_renewed_ones_are_those_of_all() {
        let mut chance = Chance(1);
        let layout = grid(14);
        let elements: Vec<_> = layout.elements.iter().map(|rows| chance.element(rows.len())).collect();
        let size = layout.node_of.len();
        let mut lu = SparseLu::default();
        lu.plan(layout, vec![6.0; size]);
        assert!(lu.factor(elements.iter().cloned().map(Some).collect()));
        let x = solved(&lu);
        let mut expected: Vec<f64> = (0..size).map(|k| 1.0 + (k % 7) as f64).collect();
        dense(&lu).partial_piv_lu().solve_in_place(column_mut(&mut expected));
        let most = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(x.iter().zip(&expected).all(|(x, expected)| (x - expected).abs() < 1e-12 * most));
        assert!(lu.free.get().is_none());
        // one element in a corner, and the one that reaches across
        let mut changed = elements;
        let mut news = vec![None; changed.len()];
        for k in [0, changed.len() - 1] {
            changed[k] = chance.element(changed[k].nrows());
            news[k] = Some(changed[k].clone());
        }
        assert!(lu.factor(news));
        let mut anew = SparseLu::default();
        anew.plan(grid(14), vec![6.0; size]);
        assert!(anew.factor(changed.into_iter().map(Some).collect()));
        assert_eq!(solved(&lu), solved(&anew));
        assert_ne!(solved(&lu), x);
    }

    #[test]
    fn what_fronts_cannot_factor_is_factored_with_rows_exchanged_anywhere() {
        // an unknown whose own equation is that of another: [0 1; 1 0] across two nodes
        let layout = |elements| Layout {
            node_of: vec![0, 1],
            coordinates: vec![0.0, 1.0],
            nodes: 2,
            elements,
            entries: vec![(0, 1), (1, 0)],
        };
        let mut lu = SparseLu::default();
        lu.plan(layout(vec![vec![0], vec![1]]), vec![2.0, 4.0]);
        let zero = || Some(Arc::new(Mat::zeros(1, 1)));
        assert!(lu.factor(vec![zero(), zero()]));
        let mut b = [2.0, 8.0];
        lu.solve(&mut b);
        assert_eq!(b, [2.0, 1.0]);
        let mut singular = SparseLu::default();
        singular.plan(layout(vec![vec![0, 1]]), vec![1.0, 1.0]);
        // singular: refused, or no numbers
        let unit = Arc::new(Mat::from_fn(2, 2, |i, j| f64::from(u8::from(i == j))));
        if singular.factor(vec![Some(unit)]) {
            let mut b = [1.0, 2.0];
            singular.solve(&mut b);
            assert!(b.iter().any(|x| !x.is_finite()), "{b:?}");
        }
    }
}
