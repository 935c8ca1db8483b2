//! Parameters of the cracking law.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Unloading of a crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Unloading {
    /// Free closing of an opening made under tension, with memory of the real gap.
    #[default]
    Closing,
    /// The published law: unloads with K_N, irreversible jumps stay.
    Plastic,
}

/// Parameters of the cracking law. Shape exponents α: 0 is linear in the work spent, more delays, less hastens.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cracking {
    /// Normal elastic (penalty) stiffness K_N [stress / length], above χ₀² e^|α| / G_I.
    pub normal_stiffness: f64,
    /// Tangential elastic (penalty) stiffness K_T [stress / length].
    pub tangential_stiffness: f64,
    /// Tensile strength of the intact interface χ₀ [stress].
    pub tensile_strength: f64,
    /// Apparent cohesion of the intact interface c₀ [stress], at least χ₀ tanφ₀.
    pub cohesion: f64,
    /// Tangent of the friction angle of the intact interface tanφ₀ [-].
    pub tan_friction: f64,
    /// Tangent of the residual friction angle tanφ_r [-]. Default: no loss.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tan_friction_residual: Option<f64>,
    /// Fracture energy in mode I, G_I [stress × length].
    pub fracture_energy_i: f64,
    /// Fracture energy in mode IIa (shear under very high compression), G_II [stress × length].
    pub fracture_energy_iia: f64,
    /// Compression σ_dil at which dilatancy vanishes [stress]; 0 is no dilatancy under any compression.
    pub dilatancy_stress: f64,
    /// Unloading: `closing` (default) or `plastic`, the published law.
    #[serde(default)]
    pub unloading: Unloading,
    /// Shape exponent of the loss of tensile strength [-]. Default 0.
    #[serde(default)]
    pub alpha_tensile_strength: f64,
    /// Shape exponent of the loss of cohesion [-]. Default 0.
    #[serde(default)]
    pub alpha_cohesion: f64,
    /// Shape exponent of the loss of friction [-]. Default 0.
    #[serde(default)]
    pub alpha_tan_friction: f64,
    /// Shape exponent of the loss of dilatancy with compression [-]. Default 0.
    #[serde(default)]
    pub alpha_dilatancy_stress: f64,
    /// Shape exponent of the loss of dilatancy with cohesion [-]. Default 0.
    #[serde(default)]
    pub alpha_dilatancy_cohesion: f64,
}
