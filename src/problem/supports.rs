//! Supports of a step: what is held, to which displacement, and what is released.

use std::collections::BTreeMap;
use std::sync::Arc;

use indexmap::IndexMap;

use super::quantity::Quantity;
use super::step::Moving;
use super::{along, groups};
use crate::assembly::Model;
use crate::coupling::Support;
use crate::error::Result;
use crate::mesh::Group;
use crate::scene::{Direction, FormulaPlace, Scene, Step, StepStage, Value, Variable};

/// Two groups agree about a shared point if their displacements differ by less. Of the larger group's largest.
const AGREE: f64 = 1e-12;

/// Supports in force.
pub(super) struct Supports {
    pub(super) constrained: Vec<bool>,
    pub(super) prescribed: Vec<f64>,
    /// Held where it is, by `hold`.
    pub(super) frozen: Vec<bool>,
}

impl Supports {
    /// Keeps parts that are not there at rest where nothing is: on their interfaces, all of them if they have none.
    pub(super) fn take_away(&mut self, model: &Model, stage: &StepStage) {
        let joined = model.joined();
        for b in (0..model.subdomains.len()).filter(|&b| !stage.present[b]) {
            let dofs = model.dofs_of(b);
            self.prescribed[dofs.clone()].fill(0.0);
            self.frozen[dofs.clone()].fill(false);
            let on_interface = |dof: usize| joined[dof / model.components];
            let any = dofs.clone().any(on_interface);
            dofs.filter(|&dof| !any || on_interface(dof)).for_each(|dof| self.constrained[dof] = true);
        }
    }

    /// None, of so many dofs.
    pub(super) fn none(n: usize) -> Supports {
        Supports { constrained: vec![false; n], prescribed: vec![0.0; n], frozen: vec![false; n] }
    }
}

/// A direction of a group that a step fixes, displaces, holds or releases.
#[derive(Debug, Clone, Copy)]
pub struct Duty<'a> {
    step: usize,
    key: &'static str,
    group: &'a str,
    direction: Direction,
}

/// All of them, in the order of the steps: with the joinings they decide the interfaces.
pub fn duties(scene: &Scene) -> Vec<Duty<'_>> {
    let mut all = Vec::new();
    for (step, stated) in scene.steps.iter().enumerate() {
        let moved = named("hold", &stated.hold).chain(named("release", &stated.release));
        let fixed = prescribed(stated).map(|(key, group, direction, _)| (key, group, direction));
        all.extend(fixed.chain(moved).map(|(key, group, direction)| Duty { step, key, group, direction }));
    }
    all
}

/// Support of every dof over all steps.
pub(super) fn over_all_steps(scene: &Scene, model: &Model) -> Result<Vec<Support>> {
    let mut all = vec![Support::Free; model.dofs()];
    for Duty { step, key, group, direction } in duties(scene) {
        let path = ["steps", &step.to_string(), key, group];
        for dof in dofs(scene, model, &path, group, direction)? {
            if key != "release" {
                all[dof] = Support::Held;
            }
        }
    }
    Ok(all)
}

/// Displacements prescribed by a step: (key, group, direction, value), no value for zero.
pub(super) fn prescribed(
    step: &Step,
) -> impl Iterator<Item = (&'static str, &str, Direction, Option<&Value>)> {
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

/// Directions by group under one key.
pub(super) fn named<'a>(
    key: &'static str,
    groups: &'a IndexMap<String, Vec<Direction>>,
) -> impl Iterator<Item = (&'static str, &'a str, Direction)> {
    let of = move |(group, directions): (&'a String, &'a Vec<Direction>)| {
        directions.iter().map(move |&direction| (key, group.as_str(), direction))
    };
    groups.iter().flat_map(of)
}

/// Dofs of a group in one direction.
pub(super) fn dofs(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    group: &str,
    direction: Direction,
) -> Result<Vec<usize>> {
    let nodes = groups::nodes(scene, model, path, group)?;
    Ok(nodes.into_iter().map(|node| model.components * node + direction.component()).collect())
}

/// Applies `hold` and `release` after the supports of the same step, whose dofs are `taken`. Returns the dofs that are
/// freed.
pub(super) fn hold_and_release(
    scene: &Scene,
    model: &Model,
    index: &str,
    step: &Step,
    mut taken: BTreeMap<usize, String>,
    supports: &mut Supports,
) -> Result<Vec<usize>> {
    let mut released = Vec::new();
    for (key, group, direction) in named("hold", &step.hold).chain(named("release", &step.release)) {
        let path = ["steps", index, key, group];
        let (name, mut found) = (direction.name(), false);
        for dof in dofs(scene, model, &path, group, direction)? {
            if let Some(other) = taken.get(&dof).filter(|other| **other != format!("{key} {group}")) {
                let what = format!("{key} of \"{group}\" in {name} meets {other} at the same node");
                return Err(scene.source.error_at(
                    &path,
                    what,
                    "give each direction of a node one duty in a step",
                ));
            }
            if key == "hold" {
                (supports.constrained[dof], supports.frozen[dof], found) = (true, true, true);
            } else if supports.constrained[dof] {
                (supports.constrained[dof], supports.frozen[dof], found) = (false, false, true);
                released.push(dof);
            }
            taken.insert(dof, format!("{key} {group}"));
        }
        if !found {
            let what = format!("nothing holds \"{group}\" in {name}");
            return Err(scene.source.error_at(
                &path,
                what,
                "release what an earlier step fixes, displaces or holds",
            ));
        }
    }
    released.sort_unstable();
    Ok(released)
}

/// Applies a step's supports; two different values for one dof are refused. Returns what follows load_factor, and the
/// dofs with what prescribes them.
pub(super) fn support(
    scene: &Scene,
    model: &Model,
    index: &str,
    step: &Step,
    supports: &mut Supports,
) -> Result<(Vec<Moving>, BTreeMap<usize, String>)> {
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
            let half = quantity.at(&FormulaPlace { load_factor: 0.5, ..*place });
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
                    let help = "groups that share a point must agree there";
                    return Err(scene.source.error_at(&path, what, help));
                }
            }
            (supports.constrained[dof], supports.prescribed[dof], supports.frozen[dof]) =
                (true, value[0], false);
            if follows {
                moving.insert(dof, Moving { dof, place, value: quantity.clone() });
            }
        }
    }
    let taken =
        here.into_iter().map(|(dof, (group, ..))| (dof, format!("the prescribed \"{group}\""))).collect();
    Ok((moving.into_values().collect(), taken))
}

/// Model nodes of a group, or of those of a pattern, with their places; s along curves only if the quantity asks for it.
fn places(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    name: &str,
    quantity: &Quantity,
) -> Result<Vec<(usize, FormulaPlace)>> {
    let mut all = Vec::new();
    for name in groups::matching(scene, model, path, name, None)? {
        all.extend(places_of_one(scene, model, path, &name, quantity)?);
    }
    Ok(all)
}

fn places_of_one(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    name: &str,
    quantity: &Quantity,
) -> Result<Vec<(usize, FormulaPlace)>> {
    let nodes = groups::nodes(scene, model, path, name)?;
    let (index, group) = groups::find(scene, model, path, name)?;
    let subdomain = &model.subdomains[index];
    let points = &subdomain.mesh.points;
    let mut s = vec![0.0; nodes.len()];
    match group {
        Some(Group::Edges(edges)) if quantity.uses(Variable::S) => {
            let fractions = along::fractions(points, edges).map_err(|why| quantity.error_at_s(&why))?;
            for (edge, ends) in edges.iter().zip(fractions) {
                let x = groups::edge_coordinates(points, edge);
                let inner =
                    edge.shape.line_places().iter().skip(2).map(|&xi| along::at(ends, &x, edge.shape, xi));
                let of_edge = ends.into_iter().chain(inner);
                for (node, of_node) in edge.nodes().iter().copied().zip(of_edge) {
                    if let Ok(i) = nodes.binary_search(&(subdomain.first_node + node)) {
                        s[i] = of_node;
                    }
                }
            }
        }
        Some(Group::Points(_) | Group::Edges(_)) => {}
        other if quantity.uses(Variable::S) => {
            let kind = other.map_or("body", Group::kind);
            return Err(quantity.error_at_s(&format!("\"{name}\" is a {kind}")));
        }
        _ => {}
    }
    let place = |(node, s): (usize, f64)| {
        let [x, y, z] = points[node - subdomain.first_node];
        (node, FormulaPlace { x, y, z, s, load_factor: 1.0, ..FormulaPlace::default() })
    };
    Ok(nodes.into_iter().zip(s).map(place).collect())
}
