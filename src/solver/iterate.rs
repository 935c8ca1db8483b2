//! Iterates of a search: its settings, where it stands, and why it ended.

use serde::{Deserialize, Serialize};

/// Tolerance, limits and tangent of Newton's method.
#[derive(Debug, Clone, Copy)]
pub struct NewtonSettings {
    /// Largest relative residual of a solution.
    pub tolerance: f64,
    /// Most iterations.
    pub iterations: usize,
    /// Give up if the residual has not halved in so many iterations.
    pub patience: usize,
    /// Stay with the tangent of the intact interfaces: linear convergence only.
    pub initial_tangent: bool,
}

/// A solution, or where Newton stands.
#[derive(Debug)]
pub struct Iterate<M> {
    /// The unknowns of the form.
    pub x: Vec<f64>,
    /// Jumps (n, t, …) at the law points of every active interface.
    pub jumps: Vec<Vec<f64>>,
    /// Tractions alike.
    pub tractions: Vec<Vec<f64>>,
    /// Forces q on the jump coefficients of every active interface.
    pub forces: Vec<Vec<f64>>,
    /// Responses that the law points keep.
    pub memory: Vec<Vec<M>>,
    /// Linear systems solved.
    pub iterations: usize,
    /// Relative residual before every iteration and at the end.
    pub residuals: Vec<f64>,
}

/// Reason for the end of Newton's method without equilibrium.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Unconverged {
    /// In words.
    pub reason: String,
    /// InterfaceOperator and law point that are farthest from equilibrium.
    pub worst: Vec<(usize, usize)>,
    /// Linear systems solved.
    pub iterations: usize,
}

/// Point of a path: unknowns and load factor.
#[derive(Debug, Clone)]
pub struct PathPoint {
    /// The unknowns of the form.
    pub x: Vec<f64>,
    /// Load factor.
    pub load_factor: f64,
}
