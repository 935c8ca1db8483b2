//! Forces of parts that have gone, and the parts that are there.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::assembly::InterfaceOperator;
use crate::output::Presence;
use crate::problem::{BoundStep, Problem};
use crate::scene::{LeftShare, StepStage};

/// Forces that a part exerted on its neighbours before it went, by dof [force].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct HeldForces {
    subdomain: usize,
    force: Vec<f64>,
}

impl HeldForces {
    /// Forces of a part on its neighbours, by dof.
    pub(super) fn new(subdomain: usize, force: Vec<f64>) -> HeldForces {
        HeldForces { subdomain, force }
    }

    /// Leaves some dofs out.
    pub(super) fn forget(&mut self, dofs: Range<usize>) {
        self.force[dofs].fill(0.0);
    }

    /// Share that is left at a load factor of a step.
    pub(super) fn left(&self, stage: &StepStage, load_factor: f64) -> f64 {
        let of = stage.left.iter().find(|share| share.subdomain == self.subdomain);
        of.map_or(
            0.0,
            |LeftShare { from, to, .. }| {
                if load_factor == 1.0 { *to } else { from + load_factor * (to - from) }
            },
        )
    }

    /// Adds what is left of all at a load factor of a step.
    pub(super) fn add(held: &[HeldForces], step: &BoundStep, load_factor: f64, force: &mut [f64]) {
        let Some(stage) = &step.stage else { return };
        for own in held {
            let left = own.left(stage, load_factor);
            force.iter_mut().zip(&own.force).for_each(|(force, own)| *force += left * own);
        }
    }
}

/// Parts that are there before the first step.
pub(super) fn presence_at_first(problem: &Problem) -> Presence {
    let Some(stage) = problem.steps.first().and_then(|step| step.stage.as_ref()) else {
        return Presence::default();
    };
    let before = |b: usize| (stage.present[b] && !stage.activated.contains(&b)) || stage.removed.contains(&b);
    let parts: Vec<bool> = (0..stage.present.len()).map(before).collect();
    let absent = absent(problem, &parts);
    let origins = vec![Vec::new(); absent.len()];
    Presence { parts, absent, origins }
}

/// True for interfaces of which a part is not there.
pub(super) fn absent(problem: &Problem, parts: &[bool]) -> Vec<bool> {
    let there = |interface: &InterfaceOperator| interface.subdomains.iter().all(|&b| parts[b]);
    problem.model.interfaces.iter().map(|interface| !there(interface)).collect()
}
