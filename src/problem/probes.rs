//! Probes bound to nodes and law points.

use super::{BoundInterface, WaterFields, groups};
use crate::assembly::{InterfaceOperator, Model};
use crate::coupling::LawPoint;
use crate::error::{Result, name_help};
use crate::law::{self, Local, N};
use crate::scene::Scene;
use crate::scene::probe::{JointField, Probe, RatePlace};

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
    /// Resultant of an interface's traction and pressure, component n.
    TotalResultant {
        /// Number of the interface.
        interface: usize,
    },
    /// Resultant of an interface's pressure.
    Uplift {
        /// Number of the interface.
        interface: usize,
    },
    /// Rate of flow at an end, or what the drains take.
    Rate {
        /// Number of the interface.
        interface: usize,
        /// At which place.
        place: RatePlace,
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
    /// Work of the pressures in interfaces.
    WorkWater,
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
    /// Water in the interfaces.
    pub water: &'a WaterFields,
    /// Work of the pressures in interfaces.
    pub water_work: f64,
}

impl ProbeInput<'_> {
    /// Pressure at a law point.
    fn pressure(&self, interface: usize, point: usize) -> f64 {
        value_at(&self.water.pressures, interface, point)
    }
}

/// Value at a law point of an interface; zero where there is none.
fn value_at(values: &[Vec<f64>], interface: usize, point: usize) -> f64 {
    values.get(interface).and_then(|own| own.get(point)).copied().unwrap_or(0.0)
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
                Probe::TotalResultant { interface } => {
                    BoundProbe::TotalResultant { interface: number(&interface)? }
                }
                Probe::Uplift { interface } => BoundProbe::Uplift { interface: number(&interface)? },
                Probe::Rate { interface, place } => {
                    BoundProbe::Rate { interface: number(&interface)?, place }
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
                Probe::WorkWater => BoundProbe::WorkWater,
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
                    JointField::TotalTraction(c) => {
                        let pressure = if c == N { input.pressure(*interface, p) } else { 0.0 };
                        input.tractions[*interface][p][c] - pressure
                    }
                    JointField::Pressure => input.pressure(*interface, p),
                    JointField::Aperture => value_at(&input.water.apertures, *interface, p),
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
            BoundProbe::TotalResultant { interface } => {
                let points = model.interfaces[*interface].coupling.points.iter().enumerate();
                let total = |p: usize| input.tractions[*interface][p][N] - input.pressure(*interface, p);
                points.map(|(p, point)| model.thickness * point.weight * total(p)).sum()
            }
            BoundProbe::Uplift { interface } => {
                let points = model.interfaces[*interface].coupling.points.iter().enumerate();
                let at = |(p, point): (usize, &LawPoint)| point.weight * input.pressure(*interface, p);
                model.thickness * points.map(at).sum::<f64>()
            }
            BoundProbe::Rate { interface, place } => {
                let rates = input.water.ends.get(*interface).copied().unwrap_or_default();
                match place {
                    RatePlace::Start => rates.start,
                    RatePlace::End => rates.end,
                    RatePlace::Drains => rates.drains,
                }
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
            BoundProbe::WorkWater => input.water_work,
        }
    }
}
