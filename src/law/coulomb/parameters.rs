//! Parameters and variables of the Coulomb law.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::law::LawVariable;
use crate::law::closure::{Closure, Springs};

/// Parameters of the Coulomb law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Coulomb {
    /// Normal (penalty) stiffness of the closed interface K_N [stress / length]; or `closure`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal_stiffness: Option<f64>,
    /// Hyperbolic closure in place of `normal_stiffness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closure: Option<Closure>,
    /// Tangential (penalty) stiffness of the sticking interface K_T [stress / length].
    pub tangential_stiffness: f64,
    /// Friction coefficient μ [-]; 0 is contact without friction.
    pub friction_coefficient: f64,
    /// Cohesion c [stress], constant, carried only while the interface is closed. Default 0.
    #[serde(default)]
    pub cohesion: f64,
    /// Dilatancy tan ψ [-]: opening per slip, at most the friction coefficient. Default 0.
    #[serde(default)]
    pub dilatancy: f64,
    /// Total |slip| at which dilatancy becomes 0 [length]. Default: never.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dilatancy_end: Option<f64>,
    /// Loss of cohesion: `never` (default) or `at_slip`.
    #[serde(default)]
    pub cohesion_lost: LossOfCohesion,
}

impl Coulomb {
    /// Springs of the faces where they touch.
    pub(super) fn normal(&self) -> Springs {
        Springs::of(self.normal_stiffness, self.closure)
    }

    /// Elastic energy of shear, τ²/(2 K_T) [stress × length].
    pub(super) fn shear_energy(&self, tau: f64) -> f64 {
        0.5 * tau * tau / self.tangential_stiffness
    }
}

/// Loss of cohesion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LossOfCohesion {
    /// Faces that meet again have it again.
    #[default]
    Never,
    /// For good, at the first slip or opening.
    AtSlip,
}

/// Index of the total |slip| among the variables.
pub(super) const SLIP_TOTAL: usize = 0;
/// Index of the loss of cohesion.
pub(super) const LOST: usize = 1;

/// Variables of the law.
pub(super) const VARIABLES: [LawVariable; 2] = [
    LawVariable { name: "slip_total", unit: "length", meaning: "total |slip|", place: SLIP_TOTAL },
    LawVariable { name: "cohesion_lost", unit: "-", meaning: "1 where cohesion is lost", place: LOST },
];
