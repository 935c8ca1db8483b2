//! Parameters of the cohesive law.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the cohesive law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cohesive {
    /// Normal (penalty) stiffness of the intact interface K_N, and of closed faces [stress / length].
    pub normal_stiffness: f64,
    /// Tangential (penalty) stiffness of the intact interface K_T [stress / length].
    pub tangential_stiffness: f64,
    /// Tensile strength f_t [stress].
    pub tensile_strength: f64,
    /// Shear strength f_s [stress].
    pub shear_strength: f64,
    /// Fracture energy in mode I, G_I [stress × length].
    pub fracture_energy_i: f64,
    /// Fracture energy in modes II and III, G_II [stress × length].
    pub fracture_energy_ii: f64,
    /// Softening: `linear` (default), `bilinear`, `exponential`, or points (opening, share of the strength) from (0, 1) to (w, 0).
    #[serde(default = "linear")]
    pub softening: Softening,
    /// Knee of `bilinear`: share of the final opening, share of the strength. Default 0.25, 0.25.
    #[serde(default = "knee")]
    pub bilinear_knee: (f64, f64),
    /// Fracture energy between the modes. Default: power law with exponent 1.
    #[serde(default)]
    pub mixed_mode: MixedMode,
    /// Friction coefficient μ of the share that is lost [-]. Default 0.
    #[serde(default)]
    pub friction_coefficient: f64,
    /// Delay of damage, in units of a step's load factor [-]. Default 0: none.
    #[serde(default)]
    pub viscosity: f64,
}

fn linear() -> Softening {
    Softening::Named(NamedSoftening::Linear)
}

fn knee() -> (f64, f64) {
    (0.25, 0.25)
}

/// Softening as a scene states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Softening {
    /// A curve by name.
    Named(NamedSoftening),
    /// Points (w, share of the strength) from (0, 1) to (w, 0), straight between. The curve is stretched along w so that the
    /// area below it is the fracture energy.
    Points(Vec<(f64, f64)>),
}

/// Softening by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum NamedSoftening {
    /// Straight to zero.
    Linear,
    /// Two straight lines that meet at `bilinear_knee`.
    Bilinear,
    /// Never quite zero.
    Exponential,
}

/// Fracture energy between modes I and II.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MixedMode {
    /// G_I + (G_II − G_I) B^η, η at least 1 (Benzeggagh and Kenane).
    BenzeggaghKenane(f64),
    /// (G_1/G_I)^α + (G_2/G_II)^α = 1, α at least 1.
    Power(f64),
}

impl Default for MixedMode {
    fn default() -> MixedMode {
        MixedMode::Power(1.0)
    }
}
