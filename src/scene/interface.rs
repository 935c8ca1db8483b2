//! Interfaces of a scene: two sides by name, or two patterns that make an interface of every pair that touches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Scene, StatedLaw, Value};
use crate::law::LAW_TOLERANCE;

/// Between the parts of a derived name, `NAME~A~B`: no name of a scene holds it, every file system takes it.
pub const JOINED: char = '~';

/// An interface between two sides.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Interface {
    /// Curve or curves of side A. The normal points from A to B.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side_a: Option<OneOrMany>,
    /// Curve or curves of side B.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub side_b: Option<OneOrMany>,
    /// In place of the sides: two patterns of subdomain names (`*` any text, `?` any character). Wherever a subdomain
    /// of the first (side A) touches one of the second, there is an interface `NAME~A~B`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// In place of the sides: curves drawn inside a body, along which its mesh is opened. Ends inside the body stay closed; where
    /// curves cross or meet, every branch is an interface of its own, `NAME~1`, `NAME~2`, …
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<OneOrMany>,
    /// Coupling of the unmatched sides.
    #[serde(default)]
    pub coupling: CouplingKind,
    /// Polynomial order of the grid of `projected`.
    #[serde(default)]
    pub grid: Grid,
    /// Points of an interval at which the law acts.
    #[serde(default)]
    pub quadrature: Quadrature,
    /// The law; any of its numbers may be a formula of the place.
    pub law: StatedLaw,
    /// Error control of the law's integration, relative to the larger of tensile strength and cohesion.
    #[serde(default = "law_tolerance")]
    pub law_tolerance: f64,
    /// Initial distance of the sides to the law; without it they touch, whatever the meshes say. For `coulomb` only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_gap: Option<InitialGap>,
    /// Share of the fracture energy that is lost at the start, 0 to 1, faces closed: a notch, an old crack. For laws that crack.
    #[serde(default, skip_serializing_if = "Value::is_zero")]
    pub initial_damage: Value,
    /// Initial traction (n, t) [stress] (paper eq. 10); in a formula s runs along chain A with n on its left.
    #[serde(default)]
    pub initial_traction: [Value; 2],
}

/// One name or a list of names.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum OneOrMany {
    /// One name.
    One(String),
    /// Several names.
    Many(Vec<String>),
}

/// Initial distance of the sides.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum InitialGap {
    /// The same everywhere [length]; below zero the sides overlap and press on each other.
    Uniform(f64),
    /// As drawn.
    Drawn(DrawnGap),
}

/// Initial distance as drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum DrawnGap {
    /// The distance of the curves that the meshes draw, projected as the jump is; an overlap presses the sides apart.
    Geometry,
}

/// Coupling of two unmatched sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CouplingKind {
    /// The jump is projected on a grid of the mid-plane; good at every stiffness.
    #[default]
    Projected,
    /// The law acts at points of every segment (paper eq. 14); exact to the paper, fragile when stiff.
    Pointwise,
}

/// Polynomial order of the grid of `projected`. A side with linear edges always makes it linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Grid {
    /// Quadratic between quadratic quadrilaterals and along quadratic curves within a body, else linear: the trace of a T6 mesh does
    /// not bear a quadratic traction.
    #[default]
    Auto,
    /// Linear, two law points per cell.
    Linear,
    /// Quadratic, three law points per cell.
    Quadratic,
}

/// Quadrature along the mid-plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Quadrature {
    /// Gauss points, inside the interval.
    #[default]
    Gauss,
    /// Lobatto points, the ends included.
    Lobatto,
}

impl OneOrMany {
    /// The names in order.
    pub fn names(&self) -> &[String] {
        match self {
            OneOrMany::One(name) => std::slice::from_ref(name),
            OneOrMany::Many(names) => names,
        }
    }
}

impl Interface {
    /// Sides A and B, unless they are found by `between`.
    pub fn sides(&self) -> Option<[&OneOrMany; 2]> {
        self.side_a.as_ref().zip(self.side_b.as_ref()).map(|(a, b)| [a, b])
    }
}

impl Scene {
    /// The entry of `interfaces` that an interface of the model comes from: its own, or that before `~`.
    pub fn entry(&self, name: &str) -> Option<(&str, &Interface)> {
        let key = name.split(JOINED).next().unwrap_or(name);
        let (key, interface) = self.interfaces.get_key_value(key)?;
        let joined = name.contains(JOINED);
        (interface.within.is_some() || interface.between.is_some() == joined).then_some((key, interface))
    }
}

fn law_tolerance() -> f64 {
    LAW_TOLERANCE
}
