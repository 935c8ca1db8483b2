//! Parts that come and go at the start of a step.
//!
//! ```text
//! goes    f ← f − Gᵀ (t − p n) on its neighbours, held and let go over the step; what it stored goes with it (`released`)
//! comes   r₀ = G u, its own u = 0: laws start anew and count jumps from there
//! ```

use super::held::{HeldForces, absent};
use super::state::ModelState;
use super::water::water_at;
use crate::law::Local;
use crate::problem::{BoundStep, Problem};

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
        self.snapshot.water = water_at(problem, &self.snapshot, self.at);
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
            let mut tractions: Vec<f64> = self.snapshot.tractions[k].iter().flat_map(leading).collect();
            if let Some(pressures) = self.snapshot.water.pressures.get(k) {
                let mut water = vec![0.0; tractions.len()];
                for (p, pressure) in pressures.iter().enumerate() {
                    tractions[model.components * p] -= pressure;
                    water[model.components * p] = -pressure;
                }
                if !problem.interfaces[k].coupled_pressure {
                    interface.add_force(&water, &mut self.force); // it was a load
                }
            }
            interface.add_force(&tractions, &mut force);
        }
        force.iter_mut().for_each(|force| *force = -*force);
        let own = model.dofs_of(b);
        for of in [&mut force, &mut self.snapshot.u, &mut self.force, &mut self.reactions] {
            of[own.clone()].fill(0.0);
        }
        self.held.iter_mut().for_each(|held| held.forget(own.clone()));
        self.force.iter_mut().zip(&force).for_each(|(all, own)| *all += own);
        self.held.push(HeldForces::new(b, force));
    }
}
