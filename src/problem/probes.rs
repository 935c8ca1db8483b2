//! Probes bound to nodes and law points.

use std::sync::Arc;

use wildmatch::WildMatch;

use super::flow_lines::spans;
use super::joint_probes::joint_value;
use super::probe_input::ProbeInput;
use super::{groups, supports};
use crate::assembly::{InterfaceOperator, Model};
use crate::error::{Result, name_help};
use crate::scene::expression::Expression;
use crate::scene::probe::{JointField, JointQuantity, Probe};
use crate::scene::{Column, Scene, is_pattern};

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
        points: Vec<(usize, f64)>,
    },
    /// A quantity of whole interfaces.
    Joints {
        /// Numbers of the interfaces.
        interfaces: Vec<usize>,
        /// The quantity.
        quantity: JointQuantity,
    },
    /// Sum of reactions, by dof.
    Reaction(Vec<usize>),
    /// A formula over the columns before it.
    Formula(Arc<Expression>),
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

/// Binds the probes of a scene.
pub(super) fn bind(scene: &Scene, model: &Model) -> Result<Vec<(String, BoundProbe)>> {
    let mut bound = Vec::new();
    let mut before: Vec<&str> = Vec::new();
    for (name, column) in &scene.output.history {
        let path = ["output", "history", name.as_str()];
        let refused = |(what, help): (String, String)| scene.source.error_at(&path, what, help);
        let probe = match column {
            Column::Probe(text) => Probe::parse(text, scene).map_err(refused)?,
            Column::Formula(text) => {
                let formula = Expression::over(text, &before);
                let formula = formula.map_err(|fault| refused((fault.what, fault.help)))?;
                bound.push((name.clone(), BoundProbe::Formula(Arc::new(formula))));
                before.push(name);
                continue;
            }
        };
        before.push(name);
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
                Probe::Joint { interface, quantity } => {
                    let interfaces = match is_pattern(&interface) {
                        true => fitting(scene, model, &path, &interface)?,
                        false => vec![number(&interface)?],
                    };
                    BoundProbe::Joints { interfaces, quantity }
                }
                Probe::Reaction { group, direction } => {
                    BoundProbe::Reaction(supports::dofs(scene, model, &path, &group, direction)?)
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
                Probe::EnergyViscous => BoundProbe::EnergyViscous,
                Probe::WorkExternal => BoundProbe::WorkExternal,
                Probe::WorkWater => BoundProbe::WorkWater,
            },
        ));
    }
    Ok(bound)
}

/// Numbers of the interfaces that fit a pattern, of which there must be one.
fn fitting(scene: &Scene, model: &Model, path: &[&str], pattern: &str) -> Result<Vec<usize>> {
    let matcher = WildMatch::new(pattern);
    let all = model.interfaces.iter().enumerate();
    let found: Vec<usize> = all.filter(|(_, own)| matcher.matches(&own.name)).map(|(k, _)| k).collect();
    if found.is_empty() {
        let help = name_help(pattern, model.interfaces.iter().map(|own| own.name.as_str()));
        let what = format!("no interface is called like \"{pattern}\"");
        return Err(scene.source.error_at(path, what, help));
    }
    Ok(found)
}

/// The two law points around a fraction of the length; beyond the outermost ones the polynomial through the points of the interval
/// there.
fn around(interface: &InterfaceOperator, fraction: f64) -> Vec<(usize, f64)> {
    let points = &interface.coupling.points;
    let s = fraction * interface.coupling.midplane.length;
    let each = points.len() / spans(interface).len();
    let last = points.len() - 1;
    let outer = match s {
        s if s < points[0].s => Some(0..each),
        s if s > points[last].s => Some(last + 1 - each..last + 1),
        _ => None,
    };
    if let Some(outer) = outer {
        let weight = |p: usize| {
            let others = outer.clone().filter(|other| *other != p);
            others.map(|other| (s - points[other].s) / (points[p].s - points[other].s)).product::<f64>()
        };
        return outer.clone().map(|p| (p, weight(p))).collect();
    }
    let after = points.partition_point(|point| point.s < s).min(points.len() - 1);
    let before = after.saturating_sub(1);
    let (s0, s1) = (points[before].s, points[after].s);
    let share = if s1 > s0 { ((s - s0) / (s1 - s0)).clamp(0.0, 1.0) } else { 0.0 };
    vec![(before, 1.0 - share), (after, share)]
}

impl BoundProbe {
    /// True if an increment without displacements measures it.
    pub fn is_measured(&self) -> bool {
        matches!(self, BoundProbe::Displacement(_) | BoundProbe::Reaction(_))
    }

    /// The value of the probe after those of the columns before it.
    pub fn value(&self, model: &Model, input: &ProbeInput, columns: &[f64]) -> f64 {
        match self {
            BoundProbe::Interface { interface, field, points } => {
                let at = |p: usize| input.field(*interface, p, *field);
                points.iter().filter(|(_, weight)| *weight != 0.0).map(|&(p, weight)| weight * at(p)).sum()
            }
            BoundProbe::Joints { interfaces, quantity } => joint_value(model, input, interfaces, *quantity),
            BoundProbe::Reaction(dofs) => dofs.iter().map(|&dof| input.reactions[dof]).sum(),
            BoundProbe::Formula(formula) => formula.of_columns(columns, input.load_factor),
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
