//! Friction on the share of a point that is lost, while its faces touch.
//!
//! ```text
//! F = L τ_f,  |τ_f| ≤ μ |σ|        L: share that is lost; elastic with K_T until it slides
//! F_trial = F + K_T (L₀ Δr_t + (L − L₀) (r_t − r̄_t))        what is lost on the way has no shear when it is lost, in the mean at r̄
//! ```
//!
//! Both shares go on as one: the spread of their elastic slips, ½ K_T (L₀ (L − L₀)/L) |x₀ − x|², is dissipated.

use super::super::local::{Local, LocalMatrix, N};
use super::damage::ByJump;
use super::parameters::Cohesive;

/// The lost share before and after a way, and where it was lost in the mean.
#[derive(Debug, Clone, Copy)]
pub(super) struct LostShare {
    pub before: f64,
    pub after: ByJump,
    /// r̄, and its derivative by the jump at the end.
    pub mean: Local,
    pub mean_by_end: LocalMatrix,
}

/// Friction after a way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Friction {
    /// F, normal part zero, and its derivative by the jump.
    pub force: Local,
    pub stiffness: LocalMatrix,
    pub slides: bool,
    /// Energy dissipated [stress × length], and its gradient.
    pub dissipated: ByJump,
}

/// Removes the normal part.
fn tangential(mut v: Local) -> Local {
    v[N] = 0.0;
    v
}

/// Removes the normal row.
fn tangential_rows(mut m: LocalMatrix) -> LocalMatrix {
    m.row_mut(N).fill(0.0);
    m
}

impl Cohesive {
    /// Friction at the end of the way from one jump to another, from the force F that there was.
    pub(super) fn rub(&self, [from, to]: [&Local; 2], force: Local, lost: &LostShare) -> Friction {
        let LostShare { before, after, mean, mean_by_end } = *lost;
        let (kt, share) = (self.tangential_stiffness, after.value);
        let none = ByJump { value: 0.0, gradient: Local::zeros() };
        let apart = Friction {
            force: Local::zeros(),
            stiffness: LocalMatrix::zeros(),
            slides: false,
            dissipated: ByJump {
                value: if before > 0.0 { 0.5 * force.norm_squared() / (before * kt) } else { 0.0 },
                ..none
            },
        };
        if share <= 0.0 || self.friction_coefficient == 0.0 || to[N] >= 0.0 {
            return apart;
        }
        let change = tangential(to - from);
        let in_plane = tangential_rows(LocalMatrix::identity());
        let added = share - before;
        let (trial, by_end, mut spent) = if from[N] > 0.0 {
            // faces meet on the way: slip counts from there
            let open = from[N] / (from[N] - to[N]);
            let slope = from[N] / (from[N] - to[N]).powi(2);
            let mut by_end = in_plane * (1.0 - open);
            by_end.column_mut(N).axpy(-slope, &change, 1.0);
            let slip = change * (1.0 - open);
            let by_end = (by_end * share + slip * after.gradient.transpose()) * kt;
            (slip * (share * kt), by_end, none)
        } else {
            let fresh = tangential(to - mean);
            let fresh_by_end = in_plane - tangential_rows(mean_by_end);
            let trial = force + (change * before + fresh * added) * kt;
            let by_end = (in_plane * before + fresh_by_end * added + fresh * after.gradient.transpose()) * kt;
            let mut spent = none;
            if before > 0.0 && added > 0.0 {
                let spread = force / (before * kt) + change - fresh;
                let mixed = before * added / share;
                spent.value = 0.5 * kt * mixed * spread.norm_squared();
                spent.gradient = tangential_rows(mean_by_end).tr_mul(&spread) * (kt * mixed)
                    + after.gradient * (0.5 * kt * spread.norm_squared() * (before / share).powi(2));
            }
            (trial, by_end, spent)
        };
        let friction = |jump: &Local| self.friction_coefficient * self.normal_stiffness * (-jump[N]).max(0.0);
        let limit = share * friction(to);
        let size = trial.norm();
        if size <= limit {
            return Friction { force: trial, stiffness: by_end, slides: false, dissipated: spent };
        }
        let e = trial / size;
        let mut limit_by_end = after.gradient * friction(to);
        limit_by_end[N] -= share * self.friction_coefficient * self.normal_stiffness;
        let size_by_end = by_end.tr_mul(&e);
        let turned = (by_end - e * size_by_end.transpose()) * (limit / size);
        let slip = (size - limit) / (share * kt);
        let mean_limit = 0.5 * (before * friction(from) + limit);
        spent.value += mean_limit * slip;
        spent.gradient += (size_by_end - limit_by_end - after.gradient * (slip * kt))
            * (mean_limit / (share * kt))
            + limit_by_end * (0.5 * slip);
        Friction {
            force: e * limit,
            stiffness: e * limit_by_end.transpose() + turned,
            slides: true,
            dissipated: spent,
        }
    }
}
