//! An interface, bound: its law with all that the law starts from.

use super::curve::PlannedInterface;
use super::prestress::StressAt;
use super::{Gaps, InitialTraction, PointLaws, initial, stiffness};
use crate::assembly::{InterfaceOperator, Model};
use crate::error::Result;
use crate::law::{self, Integration};
use crate::scene::Scene;

/// An interface, bound.
#[derive(Debug, Clone)]
pub struct BoundInterface {
    /// Its laws.
    pub laws: PointLaws,
    /// Initial tractions.
    pub initial: InitialTraction,
    /// States of the law points before the first increment; empty for an elastic interface, which has no history.
    pub states: Vec<law::State>,
    /// Control of the law's integration.
    pub integration: Integration,
    /// True for an elastic interface that is too stiff for differences of displacements.
    pub stiff: bool,
}

impl BoundInterface {
    /// Binds the statement of an interface on its geometry.
    pub(super) fn new(
        scene: &Scene,
        model: &Model,
        operator: &InterfaceOperator,
        plan: &PlannedInterface,
        laws: PointLaws,
        stresses: &[Option<StressAt>],
    ) -> Result<BoundInterface> {
        let stated = plan.stated;
        let gaps = Gaps::new(stated.initial_gap, operator);
        let initial = InitialTraction::bind(scene, plan.entry, stated, operator, stresses)?;
        let states = initial::states(scene, plan.entry, stated, &laws, &initial, &gaps, operator)?;
        Ok(BoundInterface {
            initial,
            states,
            integration: Integration::Tolerance(stated.law_tolerance),
            stiff: stiffness::is_stiff(scene, stated, model, operator, &laws),
            laws,
        })
    }
}
