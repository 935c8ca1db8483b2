//! Which parameters a point of the cohesive law can follow.
//!
//! ```text
//! κ(B) = G q/a > max |S'| for every mixity B        else the traction snaps back at a point
//! ```

use super::super::admissible::{Inadmissible, error_at, not_negative, positive};
use super::parameters::{Cohesive, MixedMode, Softening};
use super::softening::SofteningCurve;
use crate::error::{Code, Warning};

/// Mixities at which the condition against snap-back is asked.
const MIXITIES: usize = 50;
/// The area below given points may miss the fracture energy by this before it is told.
const AREA: f64 = 0.01;

impl Cohesive {
    /// The softening curve.
    pub(super) fn curve(&self) -> SofteningCurve<'_> {
        SofteningCurve::new(&self.softening, self.bilinear_knee)
    }

    /// Every inequality that the parameters must satisfy; the first broken one is named with its numbers.
    pub(super) fn admit(&self) -> Result<(), Inadmissible> {
        positive("normal_stiffness", self.normal_stiffness)?;
        positive("tangential_stiffness", self.tangential_stiffness)?;
        positive("tensile_strength", self.tensile_strength)?;
        positive("shear_strength", self.shear_strength)?;
        positive("fracture_energy_i", self.fracture_energy_i)?;
        positive("fracture_energy_ii", self.fracture_energy_ii)?;
        not_negative("friction_coefficient", self.friction_coefficient)?;
        not_negative("viscosity", self.viscosity)?;
        let (MixedMode::BenzeggaghKenane(exponent) | MixedMode::Power(exponent)) = self.mixed_mode;
        if !(1.0..=100.0).contains(&exponent) {
            let what = format!("{exponent} is no exponent between the modes");
            return error_at("mixed_mode", what, "it lies between 1 and 100");
        }
        if ![self.bilinear_knee.0, self.bilinear_knee.1].iter().all(|share| *share > 0.0 && *share < 1.0) {
            let what = format!("bilinear_knee = {:?}", self.bilinear_knee);
            return error_at("bilinear_knee", what, "both shares lie between 0 and 1");
        }
        if let Softening::Points(points) = &self.softening {
            admit_points(points)?;
        }
        let curve = self.curve();
        let steepest = curve.steepest();
        for k in 0..=MIXITIES {
            let share = k as f64 / MIXITIES as f64;
            let strengths = self.strengths(share);
            let kappa = strengths.energy * strengths.per_square / curve.area;
            if kappa <= steepest * (1.0 + 1e-9) {
                let (key, stiffness) = match 2 * k <= MIXITIES {
                    true => ("normal_stiffness", self.normal_stiffness),
                    false => ("tangential_stiffness", self.tangential_stiffness),
                };
                let mode = if k == 0 {
                    "pure tension".into()
                } else if k == MIXITIES {
                    "pure shear".into()
                } else {
                    format!("a mixity of {share}")
                };
                let what = format!(
                    "{key} = {stiffness:e}, strength and fracture energy do not fit each other: a point would lose its strength at \
                     once in {mode}"
                );
                let least = stiffness * steepest / kappa;
                return error_at(
                    key,
                    what,
                    format!("{key} must be above {least:.3e}; are all of them in the same units?"),
                );
            }
        }
        Ok(())
    }

    /// Warnings of admissible parameters: points whose area is not the fracture energy.
    pub(super) fn doubts(&self) -> Vec<Warning> {
        let Softening::Points(points) = &self.softening else { return Vec::new() };
        let last = points.last().map_or(0.0, |point| point.0);
        let drawn = self.tensile_strength * last * self.curve().area;
        if (drawn - self.fracture_energy_i).abs() <= AREA * self.fracture_energy_i {
            return Vec::new();
        }
        let what = format!(
            "the area below the points of \"softening\" is {drawn:.4e}, fracture_energy_i is {:.4e}: openings are stretched by {:.4}",
            self.fracture_energy_i,
            self.fracture_energy_i / drawn
        );
        let help = "give the energy that the points have, or take their openings as a shape";
        vec![Warning::new(Code::Stretched, what, help)]
    }

    /// Steepest loss of traction per opening in modes I and II [stress / length].
    pub(super) fn softens(&self) -> f64 {
        let curve = self.curve();
        let per = curve.area * curve.steepest();
        let square = |strength: f64, energy: f64| strength * strength * per / energy;
        square(self.tensile_strength, self.fracture_energy_i)
            .max(square(self.shear_strength, self.fracture_energy_ii))
    }
}

/// From (0, 1) to a share of zero, openings growing, shares never.
fn admit_points(points: &[(f64, f64)]) -> Result<(), Inadmissible> {
    let help = "points (opening, share of the strength) go from [0, 1] to [w, 0], openings growing and shares falling";
    let ends =
        points.len() >= 2 && points[0] == (0.0, 1.0) && points.last().is_some_and(|last| last.1 == 0.0);
    if !ends {
        return error_at("softening", "the points do not go from [0, 1] to a share of 0", help);
    }
    for pair in points.windows(2) {
        let [(w0, s0), (w1, s1)] = [pair[0], pair[1]];
        let falls = w1 > w0 && s1 <= s0 && w1.is_finite() && s1.is_finite();
        if !falls {
            return error_at("softening", format!("[{w1}, {s1}] follows [{w0}, {s0}]"), help);
        }
    }
    if points[..points.len() - 1].iter().any(|point| point.1 <= 0.0) {
        return error_at("softening", "the share is 0 before the last point", help);
    }
    Ok(())
}
