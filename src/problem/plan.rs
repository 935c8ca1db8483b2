//! Interfaces to be: every interface of the scene with the edges of its two sides.

use std::collections::HashMap;

use super::between;
use super::curve::{Joining, PlannedInterface, side};
use crate::assembly::Model;
use crate::error::Result;
use crate::scene::Scene;

/// Nodes at which interfaces of more than two bodies meet at any of the times, or a fracture within a body another interface.
pub(super) fn junctions(model: &Model, plans: &[PlannedInterface], times: &[Vec<bool>]) -> Vec<bool> {
    if plans.len() < 2 {
        return Vec::new();
    }
    let mut found = vec![false; model.nodes()];
    for there in times {
        let is_there =
            |plan: &&PlannedInterface| plan.sides.iter().flatten().all(|curve| there[curve.subdomain]);
        let plans: Vec<&PlannedInterface> = plans.iter().filter(is_there).collect();
        found.iter_mut().zip(junctions_at(model, &plans)).for_each(|(found, at)| *found |= at);
    }
    found
}

fn junctions_at(model: &Model, plans: &[&PlannedInterface]) -> Vec<bool> {
    let mut bodies: HashMap<usize, Vec<usize>> = HashMap::new();
    let mut within: HashMap<usize, [bool; 2]> = HashMap::new(); // on an opened curve, and on another interface
    for plan in plans {
        let pair: Vec<usize> = plan.sides.iter().flatten().map(|curve| curve.subdomain).collect();
        for curve in plan.sides.iter().flatten() {
            let first = model.subdomains[curve.subdomain].first_node;
            for node in curve.edges.iter().flat_map(|edge| edge.nodes()) {
                within.entry(first + node).or_default()[usize::from(plan.stated.within.is_none())] = true;
                let met = bodies.entry(first + node).or_default();
                met.extend(pair.iter().filter(|body| !met.contains(body)).copied().collect::<Vec<_>>());
            }
        }
    }
    let mut found = vec![false; model.nodes()];
    bodies.iter().filter(|(_, met)| met.len() > 2).for_each(|(&node, _)| found[node] = true);
    // where a fracture reaches another interface, three parts meet though two of them are of one body
    within.iter().filter(|(_, both)| **both == [true; 2]).for_each(|(&node, _)| found[node] = true);
    found
}

/// All interfaces in the order of the scene; those of one `between` in the order of the subdomains. `opened`: those within bodies.
pub(super) fn plans<'a>(
    scene: &'a Scene,
    model: &Model,
    mut opened: Vec<PlannedInterface<'a>>,
) -> Result<Vec<PlannedInterface<'a>>> {
    let mut named: HashMap<&str, PlannedInterface> = HashMap::new();
    for (entry, stated) in &scene.interfaces {
        if let [Some(a), Some(b)] = Joining::of(stated).sides {
            let sides = [side(scene, model, entry, "side_a", a)?, side(scene, model, entry, "side_b", b)?];
            named.insert(entry, PlannedInterface { name: entry.clone(), entry, stated, sides });
        }
    }
    let mut taken = between::JoinedEdges::default();
    named.values().chain(&opened).for_each(|plan| taken.add(&plan.sides));
    let mut plans = Vec::new();
    for (entry, stated) in &scene.interfaces {
        match Joining::of(stated).between {
            Some(patterns) => plans.extend(between::pairs(scene, model, (entry, stated), patterns, &taken)?),
            None => plans.extend(named.remove(entry.as_str())),
        }
        plans.extend(opened.extract_if(.., |plan| plan.entry == entry));
    }
    Ok(plans)
}
