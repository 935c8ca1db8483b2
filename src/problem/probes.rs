//! Probes bound to nodes and law points.

use super::groups;
use crate::assembly::{Joint, Model};
use crate::error::{Result, name_cure};
use crate::law;
use crate::scene::Scene;
use crate::scene::probe::{JointField, Probe};

/// A probe without names.
#[derive(Debug, Clone)]
pub enum BoundProbe {
    /// A field between two law points: Σ weight · value.
    Joint {
        /// Number of the joint.
        joint: usize,
        /// Which field.
        field: JointField,
        /// Law points and their weights.
        points: [(usize, f64); 2],
    },
    /// Resultant of a joint's traction, component n or t.
    Resultant {
        /// Number of the joint.
        joint: usize,
        /// n or t.
        component: usize,
    },
    /// Weighted sum of displacements: dofs and weights.
    Displacement(Vec<(usize, f64)>),
    /// Elastic energy.
    EnergyStored,
    /// Dissipated energy.
    EnergyDissipated,
    /// Released energy.
    EnergyReleased,
    /// Work of loads and prescribed displacements.
    WorkExternal,
}

/// What probes look at.
#[derive(Debug, Clone, Copy)]
pub struct ProbeInput<'a> {
    /// Displacements.
    pub u: &'a [f64],
    /// Jump (n, t) at the law points of every joint.
    pub jumps: &'a [Vec<[f64; 2]>],
    /// Traction (n, t) at the law points of every joint.
    pub tractions: &'a [Vec<[f64; 2]>],
    /// State of the law points of every joint; empty for an elastic one.
    pub states: &'a [Vec<law::State>],
    /// Elastic energy.
    pub stored: f64,
    /// Dissipated energy.
    pub dissipated: f64,
    /// Released energy.
    pub released: f64,
    /// External work.
    pub work: f64,
}

/// Binds the probes of a scene.
pub(super) fn bind(scene: &Scene, model: &Model) -> Result<Vec<(String, BoundProbe)>> {
    let mut bound = Vec::new();
    for (name, text) in &scene.output.history {
        let path = ["output", "history", name.as_str()];
        let probe =
            Probe::parse(text, scene).map_err(|(what, cure)| scene.source.refuse(&path, what, cure))?;
        let joint = |interface: &str| {
            let found = model.joints.iter().position(|joint| joint.name == interface);
            found.ok_or_else(|| {
                let cure = name_cure(interface, model.joints.iter().map(|joint| joint.name.as_str()));
                scene.source.refuse(&path, format!("no interface \"{interface}\""), cure)
            })
        };
        bound.push((
            name.clone(),
            match probe {
                Probe::Joint { interface, field, fraction } => {
                    let joint = joint(&interface)?;
                    BoundProbe::Joint { joint, field, points: around(&model.joints[joint], fraction) }
                }
                Probe::Resultant { interface, component } => {
                    BoundProbe::Resultant { joint: joint(&interface)?, component }
                }
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
                Probe::WorkExternal => BoundProbe::WorkExternal,
            },
        ));
    }
    Ok(bound)
}

/// The two law points around a fraction of the length; beyond the outermost points the value of the nearest.
fn around(joint: &Joint, fraction: f64) -> [(usize, f64); 2] {
    let points = &joint.coupling.points;
    let s = fraction * joint.coupling.midplane.length;
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
            BoundProbe::Joint { joint, field, points } => {
                let at = |p: usize| match *field {
                    JointField::Jump(c) => input.jumps[*joint][p][c],
                    JointField::Traction(c) => input.tractions[*joint][p][c],
                    JointField::FractureWork => {
                        input.states[*joint].get(p).map_or(0.0, |state| state.fracture_work)
                    }
                };
                points.iter().filter(|(_, weight)| *weight != 0.0).map(|&(p, weight)| weight * at(p)).sum()
            }
            BoundProbe::Resultant { joint, component } => {
                let points = &model.joints[*joint].coupling.points;
                let tractions = &input.tractions[*joint];
                points.iter().zip(tractions).map(|(p, t)| model.thickness * p.weight * t[*component]).sum()
            }
            BoundProbe::Displacement(weights) => {
                weights.iter().map(|&(dof, weight)| weight * input.u[dof]).sum()
            }
            BoundProbe::EnergyStored => input.stored,
            BoundProbe::EnergyDissipated => input.dissipated,
            BoundProbe::EnergyReleased => input.released,
            BoundProbe::WorkExternal => input.work,
        }
    }
}
