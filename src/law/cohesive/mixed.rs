//! Onset and energy of fracture between the modes.
//!
//! ```text
//! e² = K_N ⟨r_n⟩² + K_T |r_t|²        B = K_T |r_t|²/e²: share of shear in the work of a way at one mixity
//! onset    (t_n/f_t)² + (t_t/f_s)² = 1:  e₀² = 1/q,  q = K_N (1 − B)/f_t² + K_T B/f_s²
//! energy   G = G_I + (G_II − G_I) B^η  |  ((1 − B)/G_I)^α + (B/G_II)^α = G^{−α}
//! ```
//!
//! In e the point is one-dimensional with stiffness 1: ε = e/e₀, κ = G/(a e₀²) = G q/a.

use super::super::local::{Local, N, S, T};
use super::parameters::{Cohesive, MixedMode};

/// A jump by its size and mixity, with gradients by (n, t, s).
#[derive(Debug, Clone, Copy)]
pub(super) struct Mixity {
    /// e², and half its gradient.
    pub square: f64,
    pub half_gradient: Local,
    pub share: f64,
    pub gradient: Local,
}

/// q and G of a mixity, with derivatives by B.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strengths {
    pub per_square: f64,
    pub per_square_slope: f64,
    pub energy: f64,
    pub energy_slope: f64,
}

impl Cohesive {
    /// Size and mixity of a jump that closes nothing but its normal part.
    pub(super) fn mixity(&self, jump: &Local) -> Mixity {
        let [kn, kt] = [self.normal_stiffness, self.tangential_stiffness];
        let half_gradient = Local::new(kn * jump[N].max(0.0), kt * jump[T], kt * jump[S]);
        let shear = kt * (jump[T] * jump[T] + jump[S] * jump[S]);
        let square = half_gradient[N] * jump[N].max(0.0) + shear;
        if square == 0.0 {
            let (share, gradient) = (0.0, Local::zeros());
            return Mixity { square, half_gradient, share, gradient };
        }
        let share = shear / square;
        let mut gradient = half_gradient * (2.0 * (1.0 - share) / square);
        gradient[N] = -2.0 * share * half_gradient[N] / square;
        Mixity { square, half_gradient, share, gradient }
    }

    /// q and G at a mixity.
    pub(super) fn strengths(&self, share: f64) -> Strengths {
        let by_tension = self.normal_stiffness / (self.tensile_strength * self.tensile_strength);
        let by_shear = self.tangential_stiffness / (self.shear_strength * self.shear_strength);
        let [g1, g2] = [self.fracture_energy_i, self.fracture_energy_ii];
        let (energy, energy_slope) = match self.mixed_mode {
            _ if g1 == g2 && matches!(self.mixed_mode, MixedMode::BenzeggaghKenane(_)) => (g1, 0.0),
            MixedMode::BenzeggaghKenane(eta) => {
                let power = share.powf(eta - 1.0);
                (g1 + (g2 - g1) * power * share, (g2 - g1) * eta * power)
            }
            MixedMode::Power(alpha) => {
                let [one, two] = [(1.0 - share) / g1, share / g2];
                let [p1, p2] = [one.powf(alpha - 1.0), two.powf(alpha - 1.0)];
                let sum = p1 * one + p2 * two;
                let energy = sum.powf(-1.0 / alpha);
                (energy, energy / sum * (p1 / g1 - p2 / g2))
            }
        };
        Strengths {
            per_square: (1.0 - share) * by_tension + share * by_shear,
            per_square_slope: by_shear - by_tension,
            energy,
            energy_slope,
        }
    }
}
