//! Supports and loads step by step: what is held, to which displacement, and the forces at both ends of a step.

use std::collections::BTreeMap;

use indexmap::IndexMap;

use super::groups;
use crate::assembly::Model;
use crate::continuum::{cell_coordinates, cell_weights, edge_force};
use crate::error::Result;
use crate::mesh::Group;
use crate::scene::{Direction, Load, Scene, Step};

/// One step, bound.
#[derive(Debug, Clone)]
pub struct Stage {
    /// Name of the step.
    pub name: String,
    /// Number of increments.
    pub increments: usize,
    /// Held dofs.
    pub held: Vec<bool>,
    /// Displacement of every held dof at the end of the step [length]; it is reached from where the dof was.
    pub target: Vec<f64>,
    /// External forces at the start of the step [force].
    pub force_start: Vec<f64>,
    /// External forces at its end; between them they ramp.
    pub force_end: Vec<f64>,
}

/// A group whose reaction is reported, in one direction.
#[derive(Debug, Clone)]
pub struct Reaction {
    /// Name of the group.
    pub group: String,
    /// The direction.
    pub direction: Direction,
    /// Its dofs.
    pub dofs: Vec<usize>,
}

/// Loads in force, by what they act on.
#[derive(Debug, Clone, Default)]
struct Loads {
    groups: IndexMap<String, Load>,
    bodies: IndexMap<String, [f64; 2]>,
    gravity: [f64; 2],
}

/// Binds all steps.
pub(super) fn stages(scene: &Scene, model: &Model) -> Result<(Vec<Stage>, Vec<Reaction>)> {
    let mut held = vec![false; model.dofs()];
    let mut target = vec![0.0; model.dofs()];
    let mut reactions: IndexMap<(String, usize), Reaction> = IndexMap::new();
    let mut loads = Loads::default();
    let mut force = vec![0.0; model.dofs()];
    let mut stages = Vec::new();
    for (index, step) in scene.steps.iter().enumerate() {
        let index = index.to_string();
        for (key, group, direction, _) in prescribed(step) {
            let path = ["steps", &index, key, group];
            let dofs = groups::nodes(scene, model, &path, group)?
                .into_iter()
                .map(|node| model.components * node + direction.component())
                .collect();
            let reaction = Reaction { group: group.into(), direction, dofs };
            reactions.entry((group.to_string(), direction.component())).or_insert(reaction);
        }
        support(scene, model, &index, step, &mut held, &mut target)?;
        for (group, load) in &step.load {
            loads.groups.insert(group.clone(), *load);
        }
        for (body, density) in &step.body_force {
            loads.bodies.insert(body.clone(), *density);
        }
        loads.gravity = step.gravity.unwrap_or(loads.gravity);
        let force_end = assemble(scene, model, &index, &loads)?;
        stages.push(Stage {
            name: step.name.clone(),
            increments: step.increments,
            held: held.clone(),
            target: target.clone(),
            force_start: std::mem::replace(&mut force, force_end.clone()),
            force_end,
        });
    }
    Ok((stages, reactions.into_values().collect()))
}

/// What a step prescribes: (key, group, direction, value).
fn prescribed(step: &Step) -> impl Iterator<Item = (&'static str, &str, Direction, f64)> {
    let fixed = step.fix.iter().flat_map(|(group, directions)| {
        directions.iter().map(move |&direction| ("fix", group.as_str(), direction, 0.0))
    });
    let displaced = step.displace.iter().flat_map(|(group, displace)| {
        displace.components().map(move |(direction, value)| ("displace", group.as_str(), direction, value))
    });
    fixed.chain(displaced)
}

/// Applies a step's supports; two different values for one dof are refused.
fn support(
    scene: &Scene,
    model: &Model,
    index: &str,
    step: &Step,
    held: &mut [bool],
    target: &mut [f64],
) -> Result<()> {
    let mut here: BTreeMap<usize, (&str, f64)> = BTreeMap::new();
    for (key, group, direction, value) in prescribed(step) {
        let path = ["steps", index, key, group];
        for node in groups::nodes(scene, model, &path, group)? {
            let dof = model.components * node + direction.component();
            if let Some((other, before)) = here.insert(dof, (group, value))
                && before != value
            {
                let name = direction.name();
                let what = format!(
                    "\"{group}\" wants displacement_{name} = {value} where \"{other}\" wants {before}"
                );
                return Err(scene.source.refuse(&path, what, "groups that share a point must agree there"));
            }
            (held[dof], target[dof]) = (true, value);
        }
    }
    Ok(())
}

/// Nodal forces of all loads in force.
fn assemble(scene: &Scene, model: &Model, index: &str, loads: &Loads) -> Result<Vec<f64>> {
    let mut force = vec![0.0; model.dofs()];
    for (name, load) in &loads.groups {
        let path = ["steps", index, "load", name];
        match *load {
            Load::Traction(traction) => add_edges(scene, model, &path, name, traction, 0.0, &mut force)?,
            Load::Pressure(pressure) => add_edges(scene, model, &path, name, [0.0; 2], pressure, &mut force)?,
            Load::Force(value) => {
                let (body, group) = groups::find(scene, model, &path, name)?;
                let Some(Group::Points(points)) = group else {
                    let kind = group.map_or("body", Group::kind);
                    let what = format!("a force on \"{name}\", which is a {kind}");
                    return Err(scene.source.refuse(
                        &path,
                        what,
                        "name a physical point, or give a \"traction\"",
                    ));
                };
                for &point in points {
                    for (d, value) in value.into_iter().enumerate() {
                        force[model.components * (model.bodies[body].first_node + point) + d] += value;
                    }
                }
            }
        }
    }
    for body in &model.bodies {
        let own = loads.bodies.get(&body.name).copied().unwrap_or_default();
        let density = [0, 1].map(|d| own[d] + body.density * loads.gravity[d]);
        if density == [0.0; 2] {
            continue;
        }
        for c in 0..body.mesh.cells.len() {
            let weights = cell_weights(body.mesh.cells.shapes[c], &cell_coordinates(&body.mesh, c));
            for (&node, weight) in body.mesh.cells.nodes(c).iter().zip(weights) {
                for (d, density) in density.into_iter().enumerate() {
                    force[model.components * (body.first_node + node) + d] +=
                        model.thickness * weight * density;
                }
            }
        }
    }
    Ok(force)
}

fn add_edges(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    name: &str,
    traction: [f64; 2],
    pressure: f64,
    force: &mut [f64],
) -> Result<()> {
    let (index, edges) = groups::curve(scene, model, path, name)?;
    let body = &model.bodies[index];
    if edges.iter().any(|edge| !edge.boundary) && pressure != 0.0 {
        let what = format!("\"{name}\" runs inside its body");
        return Err(scene.source.refuse(path, what, "a pressure acts on the boundary; give a \"traction\""));
    }
    for edge in edges {
        let quadratic = edge.nodes[2] != edge.nodes[1];
        let x = groups::edge_coordinates(&body.mesh.points, edge);
        let nodal = edge_force(&x, quadratic, traction, pressure, model.thickness);
        for (node, nodal) in edge.nodes.into_iter().zip(nodal).take(if quadratic { 3 } else { 2 }) {
            for (d, nodal) in nodal.into_iter().enumerate() {
                force[model.components * (body.first_node + node) + d] += nodal;
            }
        }
    }
    Ok(())
}
