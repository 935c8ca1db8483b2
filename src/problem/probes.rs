//! Probes bound to nodes and law points.

use super::{BoundInterface, groups};
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::LawPoint;
use crate::error::{Result, name_help};
use crate::law::{self, Local};
use crate::scene::Scene;
use crate::scene::probe::{JointField, Probe};

/// A probe without names.
#[derive(Debug, Clone)]
pub enum BoundProbe {
    /// A field between two law points: Σ weight · value.
    Interface {
        /// Number of the interface.
        interface: usize,
        /// Which field.
        field: JointField,
        /// Law points and their weights.
        points: [(usize, f64); 2],
    },
    /// Resultant of an interface's traction, component n or t.
    Resultant {
        /// Number of the interface.
        interface: usize,
        /// n or t.
        component: usize,
    },
    /// Moment of an interface's traction about its middle.
    Moment {
        /// Number of the interface.
        interface: usize,
    },
    /// Weighted sum of displacements: dofs and weights.
    Displacement(Vec<(usize, f64)>),
    /// Elastic energy.
    EnergyStored,
    /// Dissipated energy.
    EnergyDissipated,
    /// Released energy.
    EnergyReleased,
    /// Work of the viscosity of laws.
    EnergyViscous,
    /// Work of loads and prescribed displacements.
    WorkExternal,
}

/// Values that probes read.
#[derive(Debug, Clone, Copy)]
pub struct ProbeInput<'a> {
    /// Displacements.
    pub u: &'a [f64],
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
}

/// Binds the probes of a scene.
pub(super) fn bind(scene: &Scene, model: &Model) -> Result<Vec<(String, BoundProbe)>> {
    let mut bound = Vec::new();
    for (name, text) in &scene.output.history {
        let path = ["output", "history", name.as_str()];
        let probe =
            Probe::parse(text, scene).map_err(|(what, help)| scene.source.error_at(&path, what, help))?;
        let number = |name: &str| {
            let found = model.interfaces.iter().position(|interface| interface.name == name);
            found.ok_or_else(|| {
                let help = name_help(name, model.interfaces.iter().map(|interface| interface.name.as_str()));
                scene.source.error_at(&path, format!("no interface \"{name}\""), help)
            })
        };
        bound.push((
            name.clone(),
            match probe {
                Probe::Interface { interface, field, fraction } => {
                    let interface = number(&interface)?;
                    BoundProbe::Interface {
                        interface,
                        field,
                        points: around(&model.interfaces[interface], fraction),
                    }
                }
                Probe::Resultant { interface, component } => {
                    BoundProbe::Resultant { interface: number(&interface)?, component }
                }
                Probe::Moment { interface } => BoundProbe::Moment { interface: number(&interface)? },
                Probe::Displacement { group, direction } => {
                    let mean = groups::mean(scene, model, &path, &group)?;
                    let dof = |node: usize| model.components * node + direction.component();
                    BoundProbe::Displacement(
                        mean.into_iter().map(|(node, weight)| (dof(node), weight)).collect(),
                    )
                }
                Probe::EnergyStored => BoundProbe::EnergyStored,
                Probe::EnergyDissipated => BoundProbe::EnergyDissipated,
                Probe::EnergyReleased => BoundProbe::EnergyReleased,
                Probe::EnergyViscous => BoundProbe::EnergyViscous,
                Probe::WorkExternal => BoundProbe::WorkExternal,
            },
        ));
    }
    Ok(bound)
}

/// The two law points around a fraction of the length; beyond the outermost points the value of the nearest.
fn around(interface: &InterfaceOperator, fraction: f64) -> [(usize, f64); 2] {
    let points = &interface.coupling.points;
    let s = fraction * interface.coupling.midplane.length;
    let after = points.partition_point(|point| point.s < s).min(points.len() - 1);
    let before = after.saturating_sub(1);
    let (s0, s1) = (points[before].s, points[after].s);
    let share = if s1 > s0 { ((s - s0) / (s1 - s0)).clamp(0.0, 1.0) } else { 0.0 };
    [(before, 1.0 - share), (after, share)]
}

impl BoundProbe {
    /// The value of the probe.
    pub fn value(&self, model: &Model, input: &ProbeInput) -> f64 {
        match self {
            BoundProbe::Interface { interface, field, points } => {
                let at = |p: usize| match *field {
                    JointField::Jump(c) => input.jumps[*interface][p][c],
                    JointField::Traction(c) => input.tractions[*interface][p][c],
                    JointField::Variable(variable) => {
                        let law = input.interfaces[*interface].laws.at(p);
                        input.states[*interface].get(p).map_or(0.0, |state| law.value(variable, state))
                    }
                };
                points.iter().filter(|(_, weight)| *weight != 0.0).map(|&(p, weight)| weight * at(p)).sum()
            }
            BoundProbe::Resultant { interface, component } => {
                let points = &model.interfaces[*interface].coupling.points;
                let tractions = &input.tractions[*interface];
                points.iter().zip(tractions).map(|(p, t)| model.thickness * p.weight * t[*component]).sum()
            }
            BoundProbe::Moment { interface } => {
                let points = &model.interfaces[*interface].coupling.points;
                let length: f64 = points.iter().map(|point| point.weight).sum();
                let mean = |d: usize| points.iter().map(|p| p.weight * p.position[d]).sum::<f64>() / length;
                let middle = [mean(0), mean(1)];
                let turns = |(p, t): (&LawPoint, &Local)| {
                    let [x, y] = [0, 1].map(|d| p.position[d] - middle[d]);
                    let [fx, fy] = [0, 1].map(|d| t[0] * p.rotation[0][d] + t[1] * p.rotation[1][d]);
                    model.thickness * p.weight * (x * fy - y * fx)
                };
                points.iter().zip(&input.tractions[*interface]).map(turns).sum()
            }
            BoundProbe::Displacement(weights) => {
                weights.iter().map(|&(dof, weight)| weight * input.u[dof]).sum()
            }
            BoundProbe::EnergyStored => input.stored,
            BoundProbe::EnergyDissipated => input.dissipated,
            BoundProbe::EnergyReleased => input.released,
            BoundProbe::EnergyViscous => input.viscous,
            BoundProbe::WorkExternal => input.work,
        }
    }
}
