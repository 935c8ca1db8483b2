//! Supports and loads step by step: what is held, to which displacement, and which loads are in force.

use std::collections::BTreeMap;
use std::sync::Arc;

use indexmap::IndexMap;

use super::load::BoundLoad;
use super::quantity::Quantity;
use super::stage::{Moving, Stage};
use super::{along, groups};
use crate::assembly::Model;
use crate::error::Result;
use crate::mesh::Group;
use crate::scene::{Direction, Place, Scene, Step, Value, Variable};

/// Two groups agree about a shared point if their displacements differ by less. Of the larger group's largest.
const AGREE: f64 = 1e-12;

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

/// Loads in force, by key and what they act on.
type Loads = IndexMap<(&'static str, String), Arc<BoundLoad>>;

/// Supports in force.
struct Supports {
    held: Vec<bool>,
    target: Vec<f64>,
}

/// Binds all steps.
pub(super) fn stages(scene: &Scene, model: &Model) -> Result<(Vec<Stage>, Vec<Reaction>)> {
    let mut supports = Supports { held: vec![false; model.dofs()], target: vec![0.0; model.dofs()] };
    let mut reactions: IndexMap<(String, usize), Reaction> = IndexMap::new();
    let mut loads = Loads::new();
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
        let moving = support(scene, model, &index, step, &mut supports)?;
        let given = given(scene, model, &index, step)?;
        let changing: Loads =
            given.clone().into_iter().filter(|(_, load)| load.follows_load_factor()).collect();
        // what is replaced by a formula in load_factor ends at once; all else ramps
        let force_start = if changing.is_empty() {
            force
        } else {
            total(model, loads.iter().filter(|(key, _)| !changing.contains_key(*key)))?
        };
        loads.extend(given);
        let force_end = total(model, loads.iter().filter(|(key, _)| !changing.contains_key(*key)))?;
        force = force_end.clone();
        for load in changing.values() {
            load.add(model, 1.0, &mut force)?;
        }
        let stage = Stage {
            name: step.name.clone(),
            increments: step.increments,
            held: supports.held.clone(),
            target: supports.target.clone(),
            moving,
            force_start,
            force_end,
            changing: changing.into_values().collect(),
        };
        stage.check(model)?;
        stages.push(stage);
    }
    Ok((stages, reactions.into_values().collect()))
}

/// Nodal forces of loads at the end of their step.
fn total<'a>(
    model: &Model,
    loads: impl Iterator<Item = (&'a (&'static str, String), &'a Arc<BoundLoad>)>,
) -> Result<Vec<f64>> {
    let mut force = vec![0.0; model.dofs()];
    for (_, load) in loads {
        load.add(model, 1.0, &mut force)?;
    }
    Ok(force)
}

/// The loads that a step names.
fn given(scene: &Scene, model: &Model, index: &str, step: &Step) -> Result<Loads> {
    let mut given = Loads::new();
    for (group, load) in &step.load {
        let bound = BoundLoad::on_group(scene, model, index, group, load)?;
        given.insert(("load", group.clone()), Arc::new(bound));
    }
    for (b, body) in model.bodies.iter().enumerate() {
        if let Some(values) = step.body_force.get(&body.name) {
            let path = ["steps", index, "body_force", &body.name];
            let bound = BoundLoad::on_body(scene, &path, b, 1.0, values)?;
            given.insert(("body_force", body.name.clone()), Arc::new(bound));
        }
        if let Some(values) = &step.gravity {
            let bound = BoundLoad::on_body(scene, &["steps", index, "gravity"], b, body.density, values)?;
            given.insert(("gravity", body.name.clone()), Arc::new(bound));
        }
    }
    Ok(given)
}

/// What a step prescribes: (key, group, direction, value), no value for zero.
fn prescribed(step: &Step) -> impl Iterator<Item = (&'static str, &str, Direction, Option<&Value>)> {
    let fixed = step.fix.iter().flat_map(|(group, directions)| {
        directions.iter().map(move |&direction| ("fix", group.as_str(), direction, None))
    });
    let displaced = step.displace.iter().flat_map(|(group, displace)| {
        displace
            .components()
            .map(move |(direction, value)| ("displace", group.as_str(), direction, Some(value)))
    });
    fixed.chain(displaced)
}

/// Applies a step's supports; two different values for one dof are refused. Returns what follows load_factor.
fn support(
    scene: &Scene,
    model: &Model,
    index: &str,
    step: &Step,
    supports: &mut Supports,
) -> Result<Vec<Moving>> {
    // group, its largest displacement, and that of the dof, at the end and half-way
    let mut here: BTreeMap<usize, (&str, f64, [f64; 2])> = BTreeMap::new();
    let mut moving: BTreeMap<usize, Moving> = BTreeMap::new();
    for (key, group, direction, value) in prescribed(step) {
        let path = ["steps", index, key, group];
        let quantity = match value {
            Some(value) => Quantity::new(scene, &[&path[..], &[direction.name()]].concat(), value),
            None => Quantity::number(0.0),
        };
        let follows = quantity.uses(Variable::LoadFactor);
        let quantity = Arc::new(quantity);
        let mut places = places(scene, model, &path, group, &quantity)?;
        let mut values = Vec::with_capacity(places.len());
        for (_, place) in &mut places {
            let half = quantity.at(&Place { load_factor: 0.5, ..*place });
            place.load_factor = 1.0;
            let end = quantity.at(place)?;
            values.push([end, if follows { half.unwrap_or(f64::NAN) } else { f64::NAN }]);
        }
        let scale = values.iter().map(|[end, _]| end.abs()).fold(0.0, f64::max);
        for ((node, place), value) in places.into_iter().zip(values) {
            let dof = model.components * node + direction.component();
            let before = here.insert(dof, (group, scale, value));
            if let Some((other, other_scale, before)) = before {
                let limit = AGREE * scale.max(other_scale);
                // half-way only two formulas in load_factor can be compared
                if let Some(i) = (0..2).find(|&i| (before[i] - value[i]).abs() > limit) {
                    let name = direction.name();
                    let (wanted, wants) = (value[i], before[i]);
                    let what = format!(
                        "\"{group}\" wants displacement_{name} = {wanted} where \"{other}\" wants {wants}"
                    );
                    let cure = "groups that share a point must agree there";
                    return Err(scene.source.refuse(&path, what, cure));
                }
            }
            (supports.held[dof], supports.target[dof]) = (true, value[0]);
            if follows {
                moving.insert(dof, Moving { dof, place, value: quantity.clone() });
            }
        }
    }
    Ok(moving.into_values().collect())
}

/// Model nodes of a group with their places; s along curves only if the quantity asks for it.
fn places(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    name: &str,
    quantity: &Quantity,
) -> Result<Vec<(usize, Place)>> {
    let nodes = groups::nodes(scene, model, path, name)?;
    let (index, group) = groups::find(scene, model, path, name)?;
    let body = &model.bodies[index];
    let points = &body.mesh.points;
    let mut s = vec![0.0; nodes.len()];
    match group {
        Some(Group::Edges(edges)) if quantity.uses(Variable::S) => {
            let fractions = along::fractions(points, edges).map_err(|why| quantity.refuse_s(&why))?;
            for (edge, ends) in edges.iter().zip(fractions) {
                let x = groups::edge_coordinates(points, edge);
                let middle = along::at(ends, &x, true, 0.0);
                // of a linear edge the third node is the second again
                let of_edge =
                    [ends[0], ends[1], if edge.nodes[2] == edge.nodes[1] { ends[1] } else { middle }];
                for (node, of_node) in edge.nodes.into_iter().zip(of_edge) {
                    if let Ok(i) = nodes.binary_search(&(body.first_node + node)) {
                        s[i] = of_node;
                    }
                }
            }
        }
        Some(Group::Points(_) | Group::Edges(_)) => {}
        other if quantity.uses(Variable::S) => {
            let kind = other.map_or("body", Group::kind);
            return Err(quantity.refuse_s(&format!("\"{name}\" is a {kind}")));
        }
        _ => {}
    }
    let place = |(node, s): (usize, f64)| {
        let [x, y] = points[node - body.first_node];
        (node, Place { x, y, s, load_factor: 1.0 })
    };
    Ok(nodes.into_iter().zip(s).map(place).collect())
}
