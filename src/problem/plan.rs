//! Interfaces to be: every interface of the scene with the edges of its two sides.

use std::collections::HashMap;

use super::between;
use super::curve::{Joining, PlannedInterface, side};
use crate::assembly::Model;
use crate::error::Result;
use crate::scene::Scene;

/// All interfaces in the order of the scene; those of one `between` in the order of the subdomains.
pub(super) fn plans<'a>(scene: &'a Scene, model: &Model) -> Result<Vec<PlannedInterface<'a>>> {
    let mut named: HashMap<&str, PlannedInterface> = HashMap::new();
    for (entry, stated) in &scene.interfaces {
        if let [Some(a), Some(b)] = Joining::of(stated).sides {
            let sides = [side(scene, model, entry, "side_a", a)?, side(scene, model, entry, "side_b", b)?];
            named.insert(entry, PlannedInterface { name: entry.clone(), entry, stated, sides });
        }
    }
    let mut taken = between::JoinedEdges::default();
    named.values().for_each(|plan| taken.add(&plan.sides));
    let mut plans = Vec::new();
    for (entry, stated) in &scene.interfaces {
        match Joining::of(stated).between {
            Some(patterns) => plans.extend(between::pairs(scene, model, (entry, stated), patterns, &taken)?),
            None => plans.extend(named.remove(entry.as_str())),
        }
    }
    Ok(plans)
}
