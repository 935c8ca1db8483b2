//! The hyperbola and how it shrinks (paper §3.2, figure 3a).
//!
//! ```text
//! F(σ, τ; W) = s − (c − σ t) ≤ 0,  s = √(τ² + b²),  b = c − χ t,  t = tanφ
//! S(ξ; α) = e^{−α} ξ / (1 + (e^{−α} − 1) ξ),  0 ≤ ξ ≤ 1;  0 below, 1 above
//!
//!        |τ|                .    asymptote |τ| = c − σ t
//!          . .           .
//!             .  .    .  hyperbola
//!                .  c
//!                  . |
//!   ─────────────────┼──χ──── σ
//! ```
//!
//! The root form of F has one branch only; the squared form has a second one that means nothing.

use super::mode::{Mode, RIDING_SLOPE};
use super::parameters::{Cracking, Unloading};

/// The law's parameters made ready: exponentials and inverses are taken once per answer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surface {
    pub kn: f64,
    pub kt: f64,
    pub chi0: f64,
    pub c0: f64,
    pub t_residual: f64,
    pub t_loss: f64,
    pub per_gf_i: f64,   // 1/G_I, 0 if there is no tensile strength to lose
    pub per_gf_iia: f64, // 1/G_II, 0 if there is no cohesion to lose
    pub sigma_dil: f64,
    /// Cracks close (`crack`).
    pub closes: bool,
    pub e_chi: f64,
    e_c: f64,
    e_t: f64,
    e_dil: f64,
    e_dil_c: f64,
}

/// The hyperbola at one W, with derivatives by W (`d…`).
#[derive(Debug, Clone, Copy)]
pub(super) struct Hyperbola {
    pub chi: f64,
    pub c: f64,
    pub t: f64,
    pub b: f64,
    pub dchi: f64,
    pub dc: f64,
    pub dt: f64,
    pub db: f64,
    pub fc: f64,
    pub dfc: f64,
}

/// 1 − S(ξ) and S'(ξ), with e = e^{−α}.
#[inline]
fn shape(xi: f64, e: f64) -> (f64, f64) {
    if xi >= 1.0 {
        return (0.0, 0.0);
    }
    let xi = xi.max(0.0);
    if e == 1.0 {
        return (1.0 - xi, 1.0); // the usual α = 0 needs no division
    }
    let d = (1.0 - xi) + e * xi;
    ((1.0 - xi) / d, e / (d * d))
}

/// e^{−α}, free of charge for the usual α = 0.
fn decay(alpha: f64) -> f64 {
    if alpha == 0.0 { 1.0 } else { (-alpha).exp() }
}

impl Surface {
    pub fn new(law: &Cracking) -> Surface {
        let t_residual = law.tan_friction_residual.unwrap_or(law.tan_friction);
        let inverse = |strength: f64, energy: f64| if strength > 0.0 { 1.0 / energy } else { 0.0 };
        Surface {
            kn: law.normal_stiffness,
            kt: law.tangential_stiffness,
            chi0: law.tensile_strength,
            c0: law.cohesion,
            t_residual,
            t_loss: law.tan_friction - t_residual,
            per_gf_i: inverse(law.tensile_strength, law.fracture_energy_i),
            per_gf_iia: inverse(law.cohesion, law.fracture_energy_iia),
            sigma_dil: law.dilatancy_stress,
            closes: law.unloading == Unloading::Closing,
            e_chi: decay(law.alpha_tensile_strength),
            e_c: decay(law.alpha_cohesion),
            e_t: decay(law.alpha_tan_friction),
            e_dil: decay(law.alpha_dilatancy_stress),
            e_dil_c: decay(law.alpha_dilatancy_cohesion),
        }
    }

    /// The hyperbola once the work W has been spent.
    #[inline]
    pub fn at(&self, w: f64) -> Hyperbola {
        let (left, slope) = shape(w * self.per_gf_i, self.e_chi);
        let (chi, dchi) = (self.chi0 * left, -self.chi0 * slope * self.per_gf_i);
        let xi = w * self.per_gf_iia;
        let (left_c, slope) = shape(xi, self.e_c);
        let (c, dc) = (self.c0 * left_c, -self.c0 * slope * self.per_gf_iia);
        let (t, dt) = if self.t_loss > 0.0 {
            let (left, slope) = shape(xi, self.e_t);
            (self.t_residual + self.t_loss * left, -self.t_loss * slope * self.per_gf_iia)
        } else {
            (self.t_residual, 0.0)
        };
        let (fc, dfc) = if self.sigma_dil > 0.0 && c > 0.0 {
            let (left, slope) = shape(1.0 - left_c, self.e_dil_c);
            (left, slope * dc / self.c0)
        } else {
            (0.0, 0.0)
        };
        let b = (c - chi * t).max(0.0);
        Hyperbola { chi, c, t, b, dchi, dc, dt, db: dc - dchi * t - chi * dt, fc, dfc }
    }

    /// Dilatancy factor f_σ and its derivative by σ, for σ < 0. No quotient is formed for σ_dil = 0.
    #[inline]
    pub fn dilatancy(&self, sigma: f64) -> (f64, f64) {
        if -sigma >= self.sigma_dil {
            return (0.0, 0.0);
        }
        let (left, slope) = shape(-sigma / self.sigma_dil, self.e_dil);
        (left, slope / self.sigma_dil)
    }

    /// The normal flow s t f of a mode at a shear τ, within the slope of riding.
    #[inline]
    pub fn bounded(&self, mode: Mode, flow: f64, tau: f64) -> f64 {
        if self.closes && mode == Mode::Compression { flow.min(RIDING_SLOPE * tau) } else { flow }
    }

    /// True once nothing ties the faces: W ≥ G_I, or no tensile strength at all.
    #[inline]
    pub fn is_spent(&self, work: f64) -> bool {
        self.chi0 == 0.0 || work * self.per_gf_i >= 1.0
    }

    /// W/G_I up to 1; 1 without any tensile strength.
    #[inline]
    pub fn damage(&self, work: f64) -> f64 {
        if self.is_spent(work) { 1.0 } else { work * self.per_gf_i }
    }

    /// The work of a step, G_I where it misses that by rounding: √χ would be left as shear.
    pub fn settled(&self, work: f64) -> f64 {
        let xi = work * self.per_gf_i;
        if (1.0 - 4.0 * f64::EPSILON..1.0).contains(&xi) { self.all_of_mode_i() } else { work }
    }

    /// G_I, the least work that leaves no tensile strength.
    pub fn all_of_mode_i(&self) -> f64 {
        let spent = 1.0 / self.per_gf_i;
        if self.is_spent(spent) { spent } else { spent.next_up() }
    }

    /// Fastest loss of strength per irreversible jump, of the strength (α = 0) [1 / length].
    pub fn loss(&self) -> f64 {
        (self.chi0 * self.per_gf_i).max(self.c0 * self.per_gf_iia)
    }

    /// The larger of tensile strength and cohesion: what tolerances are relative to [stress].
    pub fn scale(&self) -> f64 {
        self.chi0.max(self.c0)
    }
}

impl Hyperbola {
    /// s = √(τ² + b²).
    #[inline]
    pub fn root(&self, tau: f64) -> f64 {
        (tau * tau + self.b * self.b).sqrt()
    }

    /// F(σ, τ): positive outside [stress].
    #[inline]
    pub fn hyperbola(&self, sigma: f64, tau: f64) -> f64 {
        self.root(tau) - (self.c - sigma * self.t)
    }

    /// σ on the hyperbola at τ, free of cancellation near the vertex.
    #[inline]
    pub fn sigma(&self, tau: f64, s: f64) -> f64 {
        let reach = self.chi * self.t;
        (reach * (2.0 * self.c - reach) - tau * tau) / (self.t * (self.c + s))
    }

    /// τ ≥ 0 on the hyperbola at σ ≤ χ, free of cancellation near the vertex.
    #[inline]
    pub fn tau(&self, sigma: f64) -> f64 {
        (self.t * (self.chi - sigma) * (2.0 * self.c - self.t * (self.chi + sigma))).max(0.0).sqrt()
    }

    /// τ + σ t on the hyperbola, c − b²/(s + τ): zero or more, the part of the shear that is not friction.
    #[inline]
    pub fn shear_above_friction(&self, tau: f64) -> f64 {
        let s = self.root(tau);
        if s == 0.0 {
            return self.c;
        }
        (self.c - self.b * self.b / (s + tau)).max(0.0)
    }

    /// ∂τ/∂σ and ∂τ/∂W on the hyperbola, τ > 0.
    #[inline]
    pub fn tau_slopes(&self, sigma: f64, tau: f64) -> (f64, f64) {
        let reach = self.c - sigma * self.t;
        (-reach * self.t / tau, (reach * (self.dc - sigma * self.dt) - self.b * self.db) / tau)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_starts_at_zero_ends_at_one_and_its_slope_is_the_difference_quotient() {
        for alpha in [-3.0, -0.5, 0.0, 0.7, 4.0_f64] {
            let e = decay(alpha);
            assert_eq!((shape(0.0, e).0, shape(1.0, e).0), (1.0, 0.0));
            assert!((shape(0.0, e).1 - (-alpha).exp()).abs() < 1e-12);
            for xi in [0.1, 0.5, 0.9] {
                let s = e * xi / (1.0 + (e - 1.0) * xi);
                let (left, slope) = shape(xi, e);
                assert!((1.0 - s - left).abs() < 1e-14);
                let quotient = (shape(xi - 1e-6, e).0 - shape(xi + 1e-6, e).0) / 2e-6;
                assert!((slope - quotient).abs() < 1e-8 * slope.max(1.0));
            }
        }
    }
}
