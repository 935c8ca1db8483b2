//! Interfaces between Newton's method, a form of the equilibrium, and the laws.

use faer::Mat;

use super::{LinearMeasure, NodalSolution, Ramp};
use crate::assembly::{InterfaceOperator, InterfaceTangent};

/// Response at the law points.
pub trait Respond: Sync + Copy {
    /// The part of a response that a point keeps.
    type Memory: Send;

    /// Fills the traction (components) and its derivative by the jump (components², by rows) at a jump (n, t, …) of a law
    /// point; on failure the reason.
    fn respond(
        &self,
        interface: usize,
        point: usize,
        jump: &[f64],
        traction: &mut [f64],
        stiffness: &mut [f64],
    ) -> Result<Self::Memory, String>;

    /// Pressures between the sides of the active interfaces where these depend on the jumps (n, t, …), given what the law points
    /// keep, and their derivative by the load factor if it is asked for; none without any.
    fn pressures(
        &self,
        _active: &[usize],
        _jumps: &[Vec<f64>],
        _memory: &mut [Vec<Self::Memory>],
        _by_load_factor: bool,
    ) -> Result<Option<Pressures>, String> {
        Ok(None)
    }

    /// The same at another load factor of the step.
    fn at(self, load_factor: f64) -> Self;

    /// Energy dissipated per area since the last accepted increment, and its derivative by the jump.
    fn dissipation<'m>(&self, memory: &'m Self::Memory) -> (f64, &'m [f64]);

    /// Fills the derivative of a law point before anything has cracked or slipped.
    fn initial_stiffness(&self, interface: usize, point: usize, stiffness: &mut [f64]);
}

/// Pressures at the law points of every active interface; empty for those without.
#[derive(Debug, Clone, Default)]
pub struct Pressures {
    /// The pressures [stress].
    pub values: Vec<Vec<f64>>,
    /// Their derivatives by the jump (n, t, …) at the same point.
    pub slopes: Vec<Vec<f64>>,
    /// Their derivatives by the normal jumps at other points.
    pub beyond: Vec<PressureSlopes>,
    /// Their derivatives by the load factor, if asked for.
    pub by_load_factor: Option<Vec<Vec<f64>>>,
}

/// Derivatives of pressures by normal jumps.
#[derive(Debug, Clone)]
pub struct PressureSlopes {
    /// Place in the list of active interfaces, and law point, of every row and column.
    pub points: Vec<(usize, usize)>,
    /// The derivatives [stress / length].
    pub matrix: Mat<f64>,
}

/// A residual below this part of the most that was carried is rounding.
const NOTHING: f64 = 1e-13;

/// Forces that residuals are compared with, beside those of the moment [force].
#[derive(Debug, Clone, Copy, Default)]
pub struct ForceScale {
    /// Least scale of a residual.
    pub least: f64,
    /// The most that was carried.
    pub most: f64,
}

impl ForceScale {
    /// Size of a misfit relative to the forces in the model, both squared.
    pub(super) fn error(&self, misfit: f64, scale: f64) -> f64 {
        match misfit.sqrt() <= NOTHING * self.most {
            true if misfit == 0.0 => 0.0,
            true => misfit.sqrt() / self.most,
            false => (misfit / scale.max(self.least * self.least)).sqrt(),
        }
    }
}

/// One way to write the equilibrium.
pub trait Form: Sync {
    /// All interfaces.
    fn interfaces(&self) -> &[InterfaceOperator];
    /// Numbers of the interfaces whose laws respond.
    fn active(&self) -> &[usize];
    /// b of R(x) = A(x) − b for external forces and prescribed displacements (read where held); affine in both.
    fn target(&self, force: &[f64], prescribed: &[f64]) -> Vec<f64>;
    /// Prepares what loads that are affine in the load factor allow; false if that is nothing, as of a form that does not say
    /// otherwise. Then `prepared` has the target at a load factor, and `measured` what was asked for, without recovering
    /// displacements.
    fn prepare(&mut self, _ramp: Option<&Ramp>, _measures: &[LinearMeasure]) -> bool {
        false
    }
    /// b at a load factor of the prepared loads.
    fn prepared(&self, _load_factor: f64) -> Vec<f64> {
        Vec::new()
    }
    /// The measures of a solution at a load factor of the prepared loads.
    fn measured(&self, _load_factor: f64, _x: &[f64], _forces: &[Vec<f64>]) -> Vec<f64> {
        Vec::new()
    }
    /// Jump coefficients of every active interface.
    fn coefficients(&self, x: &[f64]) -> Vec<Vec<f64>>;
    /// R(x) for the forces q of every active interface on its jump coefficients.
    fn residual(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> Vec<f64>;
    /// Sets the forces that residuals are compared with: where interfaces end without any, there is nothing else.
    fn compare_with(&mut self, scale: ForceScale);
    /// Size of a residual, as a force, relative to the forces in the model.
    fn error(&self, residual: &[f64], x: &[f64], forces: &[Vec<f64>], target: &[f64]) -> f64;
    /// Residual that rounding alone may leave, measured like `error`.
    fn rounding(&self, x: &[f64], forces: &[Vec<f64>], target: &[f64], tangents: &[InterfaceTangent]) -> f64;
    /// Takes a derivative of the forces by the jump coefficients of all active interfaces beyond their tangents, or none, for
    /// the next factor. Forms that do not say otherwise know none.
    fn couple(&mut self, _beyond: Option<Mat<f64>>) {}
    /// Factors the Jacobian for the tangents of every active interface; false if it is singular.
    fn factor(&mut self, tangents: &[InterfaceTangent]) -> bool;
    /// J⁻¹ b in place.
    fn solve(&self, b: &mut [f64]);
    /// Residual by the displacements of a solution; empty where it is known exactly.
    fn defect(&self, x: &[f64], u: &[f64]) -> Vec<f64>;
    /// Σ c · a over the active interfaces, for weights on their jump coefficients, as weights on x.
    fn weights(&self, of_coefficients: &[Vec<f64>]) -> Vec<f64>;
    /// Displacements and reactions of a solution.
    fn recover(&self, x: &[f64], forces: &[Vec<f64>], force: &[f64], prescribed: &[f64]) -> NodalSolution;
}
