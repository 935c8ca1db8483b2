//! An increment that converged, as it comes from the search.

use super::loading::Ledger;
use crate::law::{self, Local, local};
use crate::solver::NodalSolution;

/// An interface whose jumps are unknowns, after an increment that converged.
#[derive(Debug, Clone)]
pub(in crate::history) struct InterfaceResponse {
    /// Its number.
    pub(in crate::history) interface: usize,
    /// Jump at the law points.
    pub(in crate::history) jumps: Vec<Local>,
    /// Responses of the law at its law points.
    pub(in crate::history) memory: Vec<PointResponse>,
}

impl InterfaceResponse {
    /// From jumps one after the other, so many components each.
    pub(in crate::history) fn new(
        interface: usize,
        components: usize,
        jumps: &[f64],
        memory: Vec<PointResponse>,
    ) -> InterfaceResponse {
        InterfaceResponse { interface, jumps: jumps.chunks_exact(components).map(local).collect(), memory }
    }
}

/// Response of a law point, as far as it is kept.
#[derive(Debug, Clone, Default)]
pub(in crate::history) struct PointResponse {
    pub(in crate::history) state: law::State,
    /// Energy dissipated in the increment per area, and its derivative by the jump.
    pub(in crate::history) dissipation: f64,
    pub(in crate::history) gradient: Local,
    /// Elastic energy lost at once in the increment per area.
    pub(in crate::history) released: f64,
    /// Viscous traction at its end.
    pub(in crate::history) viscous: Local,
    /// Derivative of its damage by the jump.
    pub(in crate::history) damage_gradient: Local,
    /// Pressure that depends on the jumps, taken off the traction.
    pub(in crate::history) pressure: f64,
}

/// An increment that converged.
#[derive(Debug, Clone)]
pub(in crate::history) struct Converged {
    /// Displacements and reactions, if they were recovered.
    pub(in crate::history) solution: Option<NodalSolution>,
    /// Measures in their place otherwise.
    pub(in crate::history) ledger: Option<Ledger>,
    /// Interfaces whose jumps are unknowns.
    pub(in crate::history) interfaces: Vec<InterfaceResponse>,
    /// Viscous work [force × length].
    pub(in crate::history) released: f64,
    /// Bend of the tractions of interfaces that dilate in a viscous step: their mean less Simpson's, √(Σ w |Δt|²).
    pub(in crate::history) bend: f64,
    pub(in crate::history) iterations: usize,
    /// Iterations of a search before that found nothing.
    pub(in crate::history) wasted: usize,
    pub(in crate::history) residuals: Vec<f64>,
}
