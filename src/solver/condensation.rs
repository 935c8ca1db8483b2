//! The continuum condensed on its joints: every body's interior eliminated once, the joints' dofs left in a dense S.
//!
//! ```text
//!   S = Σ (C − Bₚ Aₚ⁻¹ Bₚᵀ)      p: body, A: its interior, C: the dofs on joints, symmetric, singular for floating bodies
//! ```
//!
//! Springs and supports on the joints act on S alone, so that they never touch the sparse factors.

use faer::{Mat, MatMut};

use super::{Cut, NotPositiveDefinite, Parts, TooLarge, nested_dissection};
use crate::assembly::{Model, Pattern, Symmetric};

/// Sparse pattern, matrix and plan of the bodies alone.
#[derive(Debug)]
pub struct Continuum {
    /// Pattern of all bodies.
    pub pattern: Pattern,
    /// K.
    pub stiffness: Symmetric,
    /// Interiors as parts, the joints' dofs as border.
    pub parts: Parts,
    /// Place of every dof in the border.
    pub places: Vec<Option<u32>>,
}

/// The interiors' factors under one set of supports, and S.
#[derive(Debug)]
pub struct Condensation {
    held: Vec<bool>,
    /// Values of L of every interior.
    values: Vec<Vec<f64>>,
    /// Lower triangle of S.
    pub(super) schur: Mat<f64>,
}

impl Continuum {
    /// Assembles the bodies of a model and plans their condensation.
    pub fn new(model: &Model) -> Result<Continuum, TooLarge> {
        let pattern = model.continuum_pattern();
        let stiffness = model.continuum(&pattern);
        let order = nested_dissection(&pattern, &model.coordinates());
        let mut joined = vec![false; model.nodes()];
        for joint in &model.joints {
            for i in 0..joint.size() {
                joint.row(i).0.iter().for_each(|&dof| joined[dof / model.components] = true);
            }
        }
        let bodies: Vec<_> = (0..model.bodies.len())
            .map(|b| model.dofs_of(b))
            .map(|dofs| dofs.start / model.components..dofs.end / model.components)
            .collect();
        let cut = Cut::along_joints(&pattern, &order, &bodies, &joined);
        let parts = Parts::new(&pattern, cut)?;
        let places = parts.places(model.dofs());
        Ok(Continuum { pattern, stiffness, parts, places })
    }

    /// True if two sets of supports differ on joints only, so that one condensation serves both.
    pub fn serves(&self, condensation: &Condensation, held: &[bool]) -> bool {
        let inside = self.places.iter().zip(condensation.held.iter().zip(held));
        inside.filter(|(place, _)| place.is_none()).all(|(_, (a, b))| a == b)
    }

    /// Eliminates the interiors under the supports that are not on joints.
    pub fn condense(&self, held: &[bool]) -> Result<Condensation, NotPositiveDefinite> {
        let inside: Vec<bool> =
            held.iter().zip(&self.places).map(|(&held, place)| held && place.is_none()).collect();
        let mut matrix = self.stiffness.clone();
        matrix.hold(&self.pattern, &inside);
        let (values, schur) = self.parts.eliminate(&matrix, true)?;
        Ok(Condensation { held: inside, values, schur })
    }

    /// What the border needs of several right-hand sides.
    pub(super) fn on_border(&self, condensation: &Condensation, b: &[Vec<f64>]) -> Mat<f64> {
        self.parts.on_border(&condensation.values, b)
    }

    /// Solves with a condensation in place; `border` solves on the joints' dofs.
    pub(super) fn solve(
        &self,
        condensation: &Condensation,
        b: &mut [Vec<f64>],
        border: impl FnOnce(MatMut<f64>),
    ) {
        self.parts.solve(&condensation.values, b, border);
    }
}
