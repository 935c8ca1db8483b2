//! Parts that come and go at the start of a step.
//!
//! ```text
//! goes    f ← f − Gᵀ t on its neighbours, held and let go over the step; what it stored goes with it (`released`)
//! comes   r₀ = G u, its own u = 0: laws start anew and count jumps from there
//! ```

use serde::{Deserialize, Serialize};

use super::state::ModelState;
use crate::law::Local;
use crate::output::Presence;
use crate::problem::{BoundStep, Problem};
use crate::scene::Stage;

/// Forces that a part exerted on its neighbours before it went, by dof [force].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct HeldForces {
    subdomain: usize,
    force: Vec<f64>,
}

impl HeldForces {
    /// Share that is left at a load factor of a step.
    fn left(&self, stage: &Stage, load_factor: f64) -> f64 {
        let of = stage.left.iter().find(|(subdomain, _)| *subdomain == self.subdomain);
        of.map_or(
            0.0,
            |(_, [from, to])| if load_factor == 1.0 { *to } else { from + load_factor * (to - from) },
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
fn absent(problem: &Problem, parts: &[bool]) -> Vec<bool> {
    let there =
        |interface: &crate::assembly::InterfaceOperator| interface.subdomains.iter().all(|&b| parts[b]);
    problem.model.interfaces.iter().map(|interface| !there(interface)).collect()
}

impl ModelState {
    /// Parts go and come as a step starts.
    pub(super) fn enter(&mut self, problem: &Problem, step: &BoundStep) {
        let Some(stage) = &step.stage else { return };
        // forces that were let go wholly are no more
        self.held.retain(|own| own.left(stage, 0.0) > 0.0);
        if stage.removed.is_empty()
            && stage.activated.is_empty()
            && self.snapshot.presence.parts == stage.present
        {
            return;
        }
        stage.removed.iter().for_each(|&b| self.take_away(problem, b));
        let after = absent(problem, &stage.present);
        for (k, interface) in problem.model.interfaces.iter().enumerate() {
            let came = self.snapshot.presence.absent[k] && !after[k];
            let went = !self.snapshot.presence.absent[k] && after[k];
            let Some(anew) = problem.interfaces[k].anew.as_ref().filter(|_| came || went) else { continue };
            let components = problem.model.components;
            let raw = interface.jumps(&self.snapshot.u);
            let origins: Vec<Local> = raw.chunks_exact(components).map(crate::law::local).collect();
            self.snapshot.presence.origins[k] = origins;
            self.snapshot.states[k].clone_from(anew);
            self.snapshot.jumps[k].fill(Local::zeros());
        }
        self.snapshot.presence.absent = after;
        self.snapshot.presence.parts.clone_from(&stage.present);
        let stored = self.stored;
        self.at = (step.number, 0.0);
        self.recover(problem);
        self.released += stored - self.stored;
    }

    /// Takes a part away: its forces on its neighbours are held, its own displacements, loads and reactions are no more.
    fn take_away(&mut self, problem: &Problem, b: usize) {
        let model = &problem.model;
        let mut force = vec![0.0; model.dofs()];
        for (k, interface) in model.interfaces.iter().enumerate() {
            if !interface.subdomains.contains(&b) || self.snapshot.presence.is_absent(k) {
                continue;
            }
            let leading = |t: &Local| <[f64; 3]>::from(*t).into_iter().take(model.components);
            let tractions: Vec<f64> = self.snapshot.tractions[k].iter().flat_map(leading).collect();
            interface.add_force(&tractions, &mut force);
        }
        force.iter_mut().for_each(|force| *force = -*force);
        let own = model.dofs_of(b);
        for of in [&mut force, &mut self.snapshot.u, &mut self.force, &mut self.reactions] {
            of[own.clone()].fill(0.0);
        }
        self.held.iter_mut().for_each(|held| held.force[own.clone()].fill(0.0));
        self.force.iter_mut().zip(&force).for_each(|(all, own)| *all += own);
        self.held.push(HeldForces { subdomain: b, force });
    }
}
