//! An interface, bound: its law with all that the law starts from.

use super::curve::PlannedInterface;
use super::ground::StressAt;
use super::pressure_names::depends_on_jumps;
use super::{Gaps, InitialTraction, PointLaws, initial, stiffness};
use crate::assembly::{InterfaceOperator, Model};
use crate::error::Result;
use crate::law::{self, Integration, Local};
use crate::scene::{Scene, StepStage};

/// Presence of the parts that an interface joins.
#[derive(Debug, Clone, Copy, PartialEq)]
enum JoinedParts {
    /// Always there.
    Stay,
    /// There at first.
    Go,
    /// Absent at first.
    Absent,
}

impl JoinedParts {
    fn of(scene: &Scene, operator: &InterfaceOperator) -> Result<JoinedParts> {
        let stages = scene.stages()?;
        let changes =
            |stage: &StepStage, b: usize| stage.activated.contains(&b) || stage.removed.contains(&b);
        if !operator.subdomains.iter().any(|&b| stages.iter().any(|stage| changes(stage, b))) {
            return Ok(JoinedParts::Stay);
        }
        let there = scene.there_at_first()?;
        Ok(if operator.subdomains.iter().all(|&b| there[b]) { JoinedParts::Go } else { JoinedParts::Absent })
    }
}

/// An interface, bound.
#[derive(Debug, Clone)]
pub struct BoundInterface {
    /// Its laws.
    pub laws: PointLaws,
    /// Initial tractions.
    pub initial: InitialTraction,
    /// States of the law points before the first increment; empty for an elastic interface, which has no history, unless the
    /// pressure in it depends on its jumps.
    pub states: Vec<law::State>,
    /// Control of the law's integration.
    pub integration: Integration,
    /// True for an elastic interface that is too stiff for differences of displacements.
    pub stiff: bool,
    /// True if the pressure in it depends on its jumps in some step.
    pub coupled_pressure: bool,
    /// States of the law points when a part of it comes; none if its parts are always there.
    pub anew: Option<Vec<law::State>>,
}

impl BoundInterface {
    /// True if it is D r + t₀ whatever happens: it has no states.
    pub fn is_linear(&self) -> bool {
        self.states.is_empty()
    }

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
        let parts = JoinedParts::of(scene, operator)?;
        let initial = match parts {
            JoinedParts::Absent => InitialTraction::Uniform(Local::zeros()),
            _ => InitialTraction::bind(scene, plan.entry, stated, operator, stresses)?,
        };
        let states = |initial: &InitialTraction| {
            initial::states(scene, plan.entry, stated, &laws, initial, &gaps, operator)
        };
        let coupled_pressure = depends_on_jumps(scene, &operator.name);
        let has_states = !laws.kind().is_linear() || parts != JoinedParts::Stay || coupled_pressure;
        let anew = match parts {
            JoinedParts::Stay => None,
            _ => Some(states(&InitialTraction::Uniform(Local::zeros()))?),
        };
        Ok(BoundInterface {
            states: if has_states { states(&initial)? } else { Vec::new() },
            initial,
            coupled_pressure,
            anew,
            integration: Integration::Tolerance(stated.law_tolerance),
            stiff: stiffness::is_stiff(scene, stated, model, operator, &laws),
            laws,
        })
    }
}
