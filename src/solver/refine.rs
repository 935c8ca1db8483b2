//! Refinement of a factored solution: the residual of the true matrix, solved again, until rounding is all that is left.

/// Refinement ends at this backward error, or where it no longer gains much: then rounding of the residual is left.
const BACKWARD_ERROR: f64 = 4.0 * f64::EPSILON;
/// What a refinement must leave at most of the error to be followed by another.
const GAIN: f64 = 0.05;
/// Most refinements.
const REFINEMENTS: usize = 5;

/// An answer of a linear system.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Displacement of every dof [length].
    pub u: Vec<f64>,
    /// Force of the supports at held dofs, zero elsewhere [force].
    pub reactions: Vec<f64>,
    /// max_i |r_i| / (|A| |u| + |f|)_i over the free dofs (Oettli and Prager); infinite if numbers overflowed.
    pub backward_error: f64,
}

/// A factored matrix with its supports.
pub(super) trait Factored {
    /// True where a dof is prescribed.
    fn held(&self) -> &[bool];
    /// f − A u.
    fn residual(&self, f: &[f64], u: &[f64]) -> Vec<f64>;
    /// scale += |A| |u|.
    fn add_scale(&self, u: &[f64], scale: &mut [f64]);
    /// A⁻¹ b in place, where b is zero at held dofs.
    fn apply(&self, b: &mut [f64]);

    /// Solves for external forces `f` and prescribed displacements (read where held).
    fn refined(&self, f: &[f64], prescribed: &[f64]) -> Solution {
        let free = |i: usize| !self.held()[i];
        let mut u: Vec<f64> = (0..f.len()).map(|i| if free(i) { 0.0 } else { prescribed[i] }).collect();
        let mut residual = self.residual(f, &u);
        let mut best: Option<(f64, Vec<f64>, Vec<f64>)> = None;
        for pass in 0..=REFINEMENTS {
            let mut correction: Vec<f64> =
                (0..f.len()).map(|i| if free(i) { residual[i] } else { 0.0 }).collect();
            if correction.iter().all(|&r| r == 0.0) && pass == 0 {
                return Solution { reactions: self.reactions(&residual), u, backward_error: 0.0 };
            }
            self.apply(&mut correction);
            for i in (0..f.len()).filter(|&i| free(i)) {
                u[i] += correction[i];
            }
            residual = self.residual(f, &u);
            let error = self.backward_error(f, &u, &residual);
            let previous = best.as_ref().map_or(f64::INFINITY, |(error, ..)| *error);
            if error < previous {
                best = Some((error, u.clone(), residual.clone()));
            }
            if error <= BACKWARD_ERROR || error > GAIN * previous {
                break;
            }
        }
        let (backward_error, u, residual) = best.unwrap_or((f64::INFINITY, u, residual));
        Solution { reactions: self.reactions(&residual), u, backward_error }
    }

    /// The residual with its sign changed at the supports.
    fn reactions(&self, residual: &[f64]) -> Vec<f64> {
        residual.iter().zip(self.held()).map(|(r, &held)| if held { -r } else { 0.0 }).collect()
    }

    /// max |r| / (|A| |u| + |f|) over the free dofs.
    fn backward_error(&self, f: &[f64], u: &[f64], residual: &[f64]) -> f64 {
        let mut scale: Vec<f64> = f.iter().map(|f| f.abs()).collect();
        self.add_scale(u, &mut scale);
        if !scale.iter().all(|scale| scale.is_finite()) {
            return f64::INFINITY; // overflow: a maximum would pass over what is not a number
        }
        let free = (0..f.len()).filter(|&i| !self.held()[i] && scale[i] > 0.0);
        free.map(|i| residual[i].abs() / scale[i]).fold(0.0, f64::max)
    }
}
