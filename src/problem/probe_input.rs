//! Values that probes read, and fields of them at law points.

use super::{BoundInterface, WaterFields};
use crate::law::{self, Local, N};
use crate::scene::probe::JointField;

/// Values that probes read.
#[derive(Debug, Clone, Copy)]
pub struct ProbeInput<'a> {
    /// Displacements.
    pub u: &'a [f64],
    /// Reactions.
    pub reactions: &'a [f64],
    /// Jump at the law points of every interface.
    pub jumps: &'a [Vec<Local>],
    /// Traction at the law points of every interface.
    pub tractions: &'a [Vec<Local>],
    /// The interfaces, bound.
    pub interfaces: &'a [BoundInterface],
    /// State of the law points of every interface; empty for an elastic one.
    pub states: &'a [Vec<law::State>],
    /// Elastic energy.
    pub stored: f64,
    /// Dissipated energy.
    pub dissipated: f64,
    /// Released energy.
    pub released: f64,
    /// Work of the viscosity of laws.
    pub viscous: f64,
    /// External work.
    pub work: f64,
    /// Water in the interfaces.
    pub water: &'a WaterFields,
    /// Work of the pressures in interfaces.
    pub water_work: f64,
    /// Load factor in the step.
    pub load_factor: f64,
}

impl ProbeInput<'_> {
    /// A field at a law point.
    pub(super) fn field(&self, interface: usize, point: usize, field: JointField) -> f64 {
        let pressure = || value_at(&self.water.pressures, interface, point);
        match field {
            JointField::Jump(c) => self.jumps[interface][point][c],
            JointField::Traction(c) => self.tractions[interface][point][c],
            JointField::TotalTraction(N) => self.tractions[interface][point][N] - pressure(),
            JointField::TotalTraction(c) => self.tractions[interface][point][c],
            JointField::Pressure => pressure(),
            JointField::Aperture => value_at(&self.water.apertures, interface, point),
            JointField::Variable(variable) => {
                let law = self.interfaces[interface].laws.at(point);
                self.states[interface].get(point).map_or(0.0, |state| law.value(variable, state))
            }
        }
    }

    /// True where the faces are apart and carry nothing.
    pub(super) fn is_open(&self, interface: usize, point: usize) -> bool {
        let state = self.states[interface].get(point);
        let jump_plastic = state.map_or(Local::zeros(), |state| state.jump_plastic);
        law::is_open(&self.jumps[interface][point], &jump_plastic, &self.tractions[interface][point])
    }

    /// True where a law that has a damage has some.
    pub(super) fn is_cracked(&self, interface: usize, point: usize) -> bool {
        let law = self.interfaces[interface].laws.at(point);
        let damage = self.states[interface].get(point).and_then(|state| law.damage(state));
        damage.is_some_and(|damage| damage > 0.0)
    }
}

/// Value at a law point of an interface; zero where there is none.
fn value_at(values: &[Vec<f64>], interface: usize, point: usize) -> f64 {
    values.get(interface).and_then(|own| own.get(point)).copied().unwrap_or(0.0)
}
