//! Refinement of a factored solution: the residual of the true matrix, solved again, until rounding is all that is left.

/// Refinement ends at this backward error, or where it no longer gains much: then rounding of the residual is left.
const BACKWARD_ERROR: f64 = 4.0 * f64::EPSILON;
/// Largest share of the error after a refinement that is followed by another.
const GAIN: f64 = 0.05;
/// Most refinements.
const REFINEMENTS: usize = 5;

/// An answer of a linear system.
#[derive(Debug, Clone)]
pub struct NodalSolution {
    /// Displacement of every dof [length].
    pub u: Vec<f64>,
    /// Force of the supports at held dofs, zero elsewhere [force].
    pub reactions: Vec<f64>,
    /// max_i |r_i| / (|A| |u| + |f|)_i over the free dofs (Oettli and Prager); infinite if numbers overflowed.
    pub backward_error: f64,
}

/// State of the refinement of one solution.
struct Refined {
    u: Vec<f64>,
    residual: Vec<f64>,
    /// The smallest backward errors so far, with their solution and residual.
    best: ([f64; 2], Vec<f64>, Vec<f64>),
    done: bool,
}

/// A factored matrix with its supports.
pub trait Factored {
    /// True where a dof is prescribed.
    fn constrained(&self) -> &[bool];
    /// f − A u.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64>;
    /// scale += |A| |u| by differences of u, which is less where bodies move as a whole.
    fn add_moved(&self, u: &[f64], scale: &mut [f64]);
    /// |A| |u| + |f|, by which an answer is measured, and the same by differences: refinement goes on until the residual is small
    /// against both. One number where only differences are known.
    fn scales(&self, u: &[f64], mut f: Vec<f64>) -> [Vec<f64>; 2] {
        self.add_moved(u, &mut f);
        [f.clone(), f]
    }
    /// A⁻¹ b in place for several right-hand sides that are zero at held dofs.
    fn apply(&self, b: &mut [Vec<f64>]);

    /// Solves for external forces `f` and prescribed displacements (read where held).
    fn refined(&self, f: &[f64], prescribed: &[f64]) -> NodalSolution {
        let mut solutions = self.refined_all(&[(f, prescribed)]);
        solutions.remove(0)
    }

    /// Solves for several pairs of forces and prescribed displacements, side by side in one sweep through the factors.
    fn refined_all(&self, loads: &[(&[f64], &[f64])]) -> Vec<NodalSolution> {
        let free = |i: usize| !self.constrained()[i];
        let start = |&(f, prescribed): &(&[f64], &[f64])| {
            let u: Vec<f64> = (0..f.len()).map(|i| if free(i) { 0.0 } else { prescribed[i] }).collect();
            let residual = self.residual(f, &u);
            let done = (0..f.len()).all(|i| !free(i) || residual[i] == 0.0);
            let errors = [if done { 0.0 } else { f64::INFINITY }; 2];
            Refined { best: (errors, u.clone(), residual.clone()), u, residual, done }
        };
        let mut all: Vec<Refined> = loads.iter().map(start).collect();
        for _ in 0..=REFINEMENTS {
            let open: Vec<usize> = (0..all.len()).filter(|&k| !all[k].done).collect();
            let free_part = |&k: &usize| -> Vec<f64> {
                let part = |(i, &r): (usize, &f64)| if free(i) { r } else { 0.0 };
                all[k].residual.iter().enumerate().map(part).collect()
            };
            let mut corrections: Vec<Vec<f64>> = open.iter().map(free_part).collect();
            if open.is_empty() {
                break;
            }
            self.apply(&mut corrections);
            for (&k, correction) in open.iter().zip(&corrections) {
                let now = &mut all[k];
                (0..correction.len()).filter(|&i| free(i)).for_each(|i| now.u[i] += correction[i]);
                now.residual = self.residual(loads[k].0, &now.u);
                let errors = self.errors(loads[k].0, &now.u, &now.residual);
                let before = now.best.0;
                let better = |part: f64| (0..2).any(|m| errors[m] < part * before[m]);
                now.done = errors.iter().all(|error| *error <= BACKWARD_ERROR) || !better(GAIN);
                if better(GAIN) || (0..2).all(|m| errors[m] <= before[m]) {
                    now.best = (errors, now.u.clone(), now.residual.clone());
                }
            }
        }
        let solution = |Refined { best: ([backward_error, _], u, residual), .. }| NodalSolution {
            reactions: self.reactions(&residual),
            u,
            backward_error,
        };
        all.into_iter().map(solution).collect()
    }

    /// The residual with its sign changed at the supports.
    fn reactions(&self, residual: &[f64]) -> Vec<f64> {
        residual
            .iter()
            .zip(self.constrained())
            .map(|(r, &constrained)| if constrained { -r } else { 0.0 })
            .collect()
    }

    /// max |r| / (|A| |u| + |f|) over the free dofs; and the same with |A| |u| by differences.
    fn errors(&self, f: &[f64], u: &[f64], residual: &[f64]) -> [f64; 2] {
        self.scales(u, f.iter().map(|f| f.abs()).collect()).map(|scale| {
            if !scale.iter().all(|scale| scale.is_finite()) {
                return f64::INFINITY; // overflow: a maximum would pass over what is not a number
            }
            let free = (0..f.len()).filter(|&i| !self.constrained()[i] && scale[i] > 0.0);
            free.map(|i| residual[i].abs() / scale[i]).fold(0.0, f64::max)
        })
    }
}
