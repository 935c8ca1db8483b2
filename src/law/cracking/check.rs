//! Which parameters the cracking law can follow.
//!
//! ```text
//! b(W) = c − χ tanφ ≥ 0 for all W        else the vertex lies beyond the asymptotes
//! K_N > χ₀² e^{|α|} / G_I                else pure tension snaps back at a point
//! K_T well above c₀² e^{|α|} / G_II and χ₀ tanφ₀ c₀ e^{|α|} / G_I      rule of thumb for shear: a warning
//! K_T / K_N from 1e-12 to 1e12             else the smaller one is lost in rounding
//! K_T > |σ| c₀ (tanφ₀ − tanφ_r) e^{|α|} / G_II                        the same for the loss of friction
//! ```

use super::super::admissible::{Inadmissible, error_at, not_negative, positive};
use super::parameters::Cracking;
use super::surface::Surface;
use crate::error::{Code, Warning};

/// Stiffnesses that differ by more than this leave no digit of the smaller one where both are in one matrix.
const CONTRAST: f64 = 1e12;
/// Shapes beyond this exponent are steps in double precision.
const LARGEST_EXPONENT: f64 = 50.0;
/// b(W) may be below zero by rounding, relative to the cohesion.
const ROUNDING: f64 = 1e-12;
/// Samples of b(W) per shape, equally spaced in the strength that is left.
const SAMPLES: usize = 1000;
/// "Well above" in the rule of thumb for K_T.
const WELL_ABOVE: f64 = 2.0;
/// Compressions up to this many cohesions are taken to occur.
const HIGH_COMPRESSION: f64 = 10.0;

impl Cracking {
    /// Every inequality the parameters must satisfy; the first broken one is named with its numbers.
    pub(super) fn admit(&self) -> Result<(), Inadmissible> {
        positive("normal_stiffness", self.normal_stiffness)?;
        positive("tangential_stiffness", self.tangential_stiffness)?;
        let contrast = self.tangential_stiffness / self.normal_stiffness;
        if !(1.0 / CONTRAST..=CONTRAST).contains(&contrast) {
            let what = format!("tangential_stiffness is {contrast:.1e} times normal_stiffness");
            let help = format!("they may differ by factors up to {CONTRAST:e}");
            return error_at("tangential_stiffness", what, help);
        }
        not_negative("tensile_strength", self.tensile_strength)?;
        not_negative("cohesion", self.cohesion)?;
        positive("tan_friction", self.tan_friction)?;
        not_negative("dilatancy_stress", self.dilatancy_stress)?;
        for (key, strength, value) in [
            ("fracture_energy_i", self.tensile_strength, self.fracture_energy_i),
            ("fracture_energy_iia", self.cohesion, self.fracture_energy_iia),
        ] {
            if strength > 0.0 { positive(key, value)? } else { not_negative(key, value)? }
        }
        for (key, alpha) in self.exponents() {
            if alpha.is_nan() || alpha.abs() > LARGEST_EXPONENT {
                let help = format!("it must lie between -{LARGEST_EXPONENT} and {LARGEST_EXPONENT}");
                return error_at(key, format!("{key} = {alpha} is not a shape exponent"), help);
            }
        }
        self.check_residual_friction()?;
        self.check_vertex()?;
        self.check_normal_stiffness()
    }

    /// Warnings of admissible parameters: K_T too low for a smooth way past the peak in shear.
    pub(super) fn doubts(&self) -> Vec<Warning> {
        let (chi, c, kt) = (self.tensile_strength, self.cohesion, self.tangential_stiffness);
        let cohesion_loss = match c > 0.0 {
            true => c * c * self.alpha_cohesion.abs().exp() / self.fracture_energy_iia,
            false => 0.0,
        };
        let tensile_loss = match chi > 0.0 {
            true => {
                chi * self.tan_friction * c * self.alpha_tensile_strength.abs().exp() / self.fracture_energy_i
            }
            false => 0.0,
        };
        let mut warnings = Vec::new();
        let least = WELL_ABOVE * cohesion_loss.max(tensile_loss);
        if kt < least {
            let what = format!(
                "tangential_stiffness = {kt:e} is not well above c0^2 e^|alpha| / G_II = {cohesion_loss:.3e} and \
                 chi0 tanphi0 c0 e^|alpha| / G_I = {tensile_loss:.3e}: the traction may snap just past the peak in shear"
            );
            let help = format!("{least:.2e} or more is safer");
            warnings.push(Warning::new(Code::SnapInShear, what, help));
        }
        let friction_loss = self.tan_friction - self.tan_friction_residual.unwrap_or(self.tan_friction);
        let steepest = c * friction_loss * self.alpha_tan_friction.abs().exp();
        let highest = kt * self.fracture_energy_iia / steepest; // infinite without a loss
        if highest < HIGH_COMPRESSION * c {
            let what = format!(
                "under compression above tangential_stiffness * fracture_energy_iia / (cohesion * (tan_friction - \
                 tan_friction_residual) * e^|alpha|) = {highest:.3e} the loss of friction alone may make the traction \
                 snap in shear"
            );
            let help = "raise tangential_stiffness if the interface will carry that";
            warnings.push(Warning::new(Code::SnapByFriction, what, help));
        }
        warnings
    }

    /// Steepest loss of traction per jump: in tension, in shear under compression and by the loss of tensile strength.
    pub(super) fn softens(&self) -> f64 {
        let per = |energy: f64, alpha: f64| if energy > 0.0 { alpha.abs().exp() / energy } else { 0.0 };
        let tension = per(self.fracture_energy_i, self.alpha_tensile_strength);
        let shear = per(self.fracture_energy_iia, self.alpha_cohesion);
        let (chi, c) = (self.tensile_strength, self.cohesion);
        (chi * chi * tension).max(c * c * shear).max(chi * self.tan_friction * c * tension)
    }

    fn exponents(&self) -> [(&'static str, f64); 5] {
        [
            ("alpha_tensile_strength", self.alpha_tensile_strength),
            ("alpha_cohesion", self.alpha_cohesion),
            ("alpha_tan_friction", self.alpha_tan_friction),
            ("alpha_dilatancy_stress", self.alpha_dilatancy_stress),
            ("alpha_dilatancy_cohesion", self.alpha_dilatancy_cohesion),
        ]
    }

    fn check_residual_friction(&self) -> Result<(), Inadmissible> {
        let Some(residual) = self.tan_friction_residual else { return Ok(()) };
        positive("tan_friction_residual", residual)?;
        if residual > self.tan_friction {
            return error_at(
                "tan_friction_residual",
                format!("tan_friction_residual = {residual} > tan_friction = {}", self.tan_friction),
                "friction cannot grow with damage; give at most tan_friction, or leave it out",
            );
        }
        Ok(())
    }

    /// b(W) ≥ 0, sampled where the strengths change: S(·; −α) is the inverse of S(·; α).
    fn check_vertex(&self) -> Result<(), Inadmissible> {
        let (chi, c, t) = (self.tensile_strength, self.cohesion, self.tan_friction);
        if chi * t > c * (1.0 + ROUNDING) {
            return error_at(
                "cohesion",
                format!(
                    "cohesion = {c}, tensile_strength = {chi} and tan_friction = {t} do not fit each other"
                ),
                format!(
                    "the cohesion must be at least tensile_strength * tan_friction = {:.4}, or the curve of strength has its \
                     vertex outside itself; tan_friction is the tangent of the angle, 0.7002 at 35 degrees",
                    chi * t
                ),
            );
        }
        let surface = Surface::new(self);
        let shapes = [
            (self.fracture_energy_i, self.alpha_tensile_strength),
            (self.fracture_energy_iia, self.alpha_cohesion),
            (self.fracture_energy_iia, self.alpha_tan_friction),
        ];
        for (energy, alpha) in shapes {
            let e = alpha.exp();
            for sample in 0..=SAMPLES {
                let x = sample as f64 / SAMPLES as f64;
                let w = energy * e * x / ((1.0 - x) + e * x);
                let now = surface.at(w);
                if now.c - now.chi * now.t < -ROUNDING * c {
                    return error_at(
                        "fracture_energy_iia",
                        format!(
                            "after the work {w:.3e} is spent, cohesion = {:.4e} < tensile_strength * tan_friction = \
                             {:.4e} * {:.4e}",
                            now.c, now.chi, now.t
                        ),
                        "the cohesion is lost before the tensile strength; raise fracture_energy_iia above \
                         fracture_energy_i, or match the shape exponents",
                    );
                }
            }
        }
        Ok(())
    }

    fn check_normal_stiffness(&self) -> Result<(), Inadmissible> {
        let chi = self.tensile_strength;
        if chi == 0.0 {
            return Ok(());
        }
        let least = chi * chi * self.alpha_tensile_strength.abs().exp() / self.fracture_energy_i;
        if self.normal_stiffness > least {
            return Ok(());
        }
        error_at(
            "normal_stiffness",
            format!(
                "normal_stiffness = {:e}, tensile_strength = {chi} and fracture_energy_i = {:e} do not fit each other: a point \
                 that is pulled would lose its strength at once",
                self.normal_stiffness, self.fracture_energy_i
            ),
            format!(
                "normal_stiffness must be above tensile_strength^2 e^|alpha| / fracture_energy_i = {least:.3e}; are all three in \
                 the same units?"
            ),
        )
    }
}
