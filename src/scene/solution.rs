//! Settings of the search for equilibrium: knobs that trade speed for accuracy. A linear scene uses none of them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Settings of the search for equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solution {
    /// On which unknowns Newton works.
    pub strategy: Strategy,
    /// Largest out-of-balance force, relative to the forces in the model.
    pub tolerance: f64,
    /// Most iterations of a part of an increment; what needs more is divided.
    pub iterations: usize,
    /// Largest error of an increment against its parts: of the tractions of the interfaces over the largest carried so far, of
    /// energies over the largest so far. What has a larger one is divided; with 1 increments stay as they are asked.
    pub path_tolerance: f64,
    /// The tangent of the iteration.
    pub tangent: Tangent,
}

/// On which unknowns Newton works.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Strategy {
    /// The form that is estimated to take less work. A linear scene is solved for its displacements, its stiff interfaces for their jumps.
    #[default]
    Auto,
    /// The jump coefficients: the bodies are factored once, an iteration touches the interfaces only.
    Condensed,
    /// On the displacements of the nodes on interfaces, every body condensed on them, in a system that is sparse by bodies: for walls
    /// of many bricks. Where an elastic interface is stiff, on the jumps of all interfaces and the rigid motions of floating bodies.
    Blocks,
    /// All displacements: the whole matrix is factored in every iteration.
    Plain,
}

/// The tangent of the iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Tangent {
    /// The derivative of the laws: quadratic convergence.
    #[default]
    Consistent,
    /// The stiffness of the intact interfaces: linear convergence at best.
    Initial,
}

/// Control from increment to increment of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Control {
    /// The load factor: loads and displacements grow in equal parts.
    #[default]
    Load,
    /// The change of the jumps of the interfaces, in steps that are as long as iterations allow: loads and displacements fall
    /// where the path of equilibria does. `increments` is the least number that the step is divided in.
    Arclength,
    /// The load factor while nothing dissipates, else the energy that the interfaces dissipate, along the same path.
    Auto,
}

impl Default for Solution {
    fn default() -> Solution {
        let (strategy, tangent) = (Strategy::default(), Tangent::default());
        Solution { strategy, tolerance: 1e-12, iterations: 25, path_tolerance: 1e-3, tangent }
    }
}
