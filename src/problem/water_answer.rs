//! Water in the interfaces at a moment: what it is asked with, and what it answers.

use serde::{Deserialize, Serialize};

use crate::law::Local;
use crate::water::JumpSlopes;

/// Jump and damage of a law point, and the slope of the damage by the jump.
#[derive(Debug, Clone, Copy, Default)]
pub struct WaterPoint {
    /// Jump (n, t, s) as the law counts it [length].
    pub jump: Local,
    /// Damage, 0 to 1.
    pub damage: f64,
    /// ∂damage/∂jump [1 / length].
    pub damage_gradient: Local,
}

/// Water in the interfaces; empty where there is none, and for those without.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct WaterFields {
    /// Pressure at the law points of every interface, positive [stress].
    pub pressures: Vec<Vec<f64>>,
    /// Rate of flow alike, for a unit thickness, positive along the interface [length² / time].
    pub rates: Vec<Vec<f64>>,
    /// Hydraulic aperture alike [length].
    pub apertures: Vec<Vec<f64>>,
    /// Rates at the ends of every interface, zero without flow.
    pub ends: Vec<EndRates>,
}

/// Rates of flow of an interface for a unit thickness [length² / time].
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct EndRates {
    /// In at s = 0.
    pub start: f64,
    /// Out at s = 1.
    pub end: f64,
    /// Out through its drains.
    pub drains: f64,
}

/// Pressures in the interfaces, with their derivatives.
#[derive(Debug, Clone, Default)]
pub struct WaterAnswer {
    /// Pressures and rates.
    pub fields: WaterFields,
    /// ∂p/∂jump at the same point of every interface, of those that depend on it.
    pub slopes: Vec<Vec<Local>>,
    /// ∂p/∂r_n at other points of flows.
    pub flow_slopes: Vec<FlowSlopes>,
}

/// Flow along an interface in words.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowAlong {
    /// Name of the interface.
    pub interface: String,
    /// Places of its ends, s = 0 and s = 1.
    pub ends: [[f64; 3]; 2],
    /// Conditions there: "given", "joined" or "wall".
    pub conditions: [&'static str; 2],
    /// Nodes between its ends: drains, and joints that end on it.
    pub between: usize,
}

/// Derivatives of the pressures of flow by the normal jumps.
#[derive(Debug, Clone)]
pub struct FlowSlopes {
    /// Interface and law point of every row and column.
    pub points: Vec<(usize, usize)>,
    /// The derivatives [stress / length].
    pub slopes: JumpSlopes,
}
