//! Stress that a subdomain has before the first load.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Plane, Scene, Value, Variable};
use crate::error::Result;

/// Initial stress of a subdomain: it loads nothing by itself.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "neither {\"xx\", \"yy\", \"zz\", \"xy\"} nor {\"gravity\", \"surface\", \"overburden\", \"k0\"}"
)]
pub enum InitialStress {
    /// Ground at rest.
    Ground(Ground),
    /// Its components.
    Components(StressComponents),
}

/// Ground at rest below a level surface: σ_v = −q − ρ g (y₀ − y), σ_h = σ_zz = K₀ σ_v.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// Acceleration (0, −g), as in the first step [length / time²].
    pub gravity: [Value; 2],
    /// Height y₀ of the top of this ground [length].
    pub surface: f64,
    /// Vertical pressure q at y₀: the weight of what lies above, water included [stress]. Default 0.
    #[serde(default)]
    pub overburden: f64,
    /// Ratio K₀ of the horizontal stress to the vertical one [-].
    pub k0: f64,
}

/// Stresses, tension positive, numbers or formulas in x and y [stress].
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StressComponents {
    /// σ_xx. Default 0.
    #[serde(default)]
    pub xx: Value,
    /// σ_yy. Default 0.
    #[serde(default)]
    pub yy: Value,
    /// σ_zz, in plane strain. Default 0.
    #[serde(default)]
    pub zz: Value,
    /// σ_xy. Default 0.
    #[serde(default)]
    pub xy: Value,
}

impl StressComponents {
    /// By key: xx, yy, zz, xy.
    pub fn keys(&self) -> [(&'static str, &Value); 4] {
        [("xx", &self.xx), ("yy", &self.yy), ("zz", &self.zz), ("xy", &self.xy)]
    }
}

impl Scene {
    /// Refuses an initial stress that cannot be.
    pub(super) fn check_initial_stress(&self, name: &str) -> Result<()> {
        let subdomain = &self.subdomains[name];
        let error_at = |key: &str, what: String, help: &str| {
            Err(self.source.error_at(&["subdomains", name, "initial_stress", key], what, help))
        };
        match &subdomain.initial_stress {
            None => Ok(()),
            Some(InitialStress::Ground(Ground { gravity: [x, y], surface, overburden, k0 })) => {
                let points_down =
                    x.constant() == Some(0.0) && y.constant().is_some_and(|y| y < 0.0 && y.is_finite());
                if !points_down {
                    let what = format!("[{x}, {y}] does not point down");
                    return error_at("gravity", what, "give [0, -g], or the components of the stress");
                }
                for (key, value) in [("overburden", overburden), ("k0", k0)] {
                    if !(*value >= 0.0 && value.is_finite()) {
                        return error_at(key, format!("{value} is below zero"), "it must be zero or more");
                    }
                }
                if !surface.is_finite() {
                    return error_at("surface", format!("{surface} is no height"), "give a number");
                }
                if self.materials.get(&subdomain.material).is_some_and(|material| material.density == 0.0) {
                    let what = format!("the material \"{}\" has no density", subdomain.material);
                    return error_at("gravity", what, "give it one, or the components of the stress");
                }
                Ok(())
            }
            Some(InitialStress::Components(components)) => {
                for (key, value) in components.keys() {
                    for variable in Variable::ALL.into_iter().filter(|of| !Variable::OF_PLACES.contains(of)) {
                        if value.uses(variable) {
                            let what = format!("{} in {value}", variable.name());
                            return error_at(key, what, "the stress of a body is a formula in x and y");
                        }
                    }
                    let none = value.constant() == Some(0.0);
                    if key == "zz" && self.plane == Plane::Stress && !none {
                        return error_at(key, "plane stress has none".into(), "leave it out");
                    }
                }
                Ok(())
            }
        }
    }
}
