//! Step by step: supports, and loads in force.

use std::sync::Arc;

use indexmap::IndexMap;

use super::load::BoundLoad;
use super::step::BoundStep;
use super::supports::{Supports, dofs, hold_and_release, named, prescribed, support};
use crate::assembly::Model;
use crate::error::Result;
use crate::scene::{Control, Direction, Scene, Step};

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

impl Reaction {
    /// Its column, `reaction:<group>:<direction>`.
    pub fn name(&self) -> String {
        format!("reaction:{}:{}", self.group, self.direction.name())
    }
}

/// Loads in force, by key and what they act on.
pub(super) type Loads = IndexMap<(&'static str, String), Arc<BoundLoad>>;

/// Binds all steps.
pub(super) fn steps(scene: &Scene, model: &Model) -> Result<(Vec<BoundStep>, Vec<Reaction>)> {
    let mut supports = Supports::none(model.dofs());
    let mut reactions: IndexMap<(String, usize), Reaction> = IndexMap::new();
    let mut loads = Loads::new();
    let mut force = vec![0.0; model.dofs()];
    let mut steps = Vec::new();
    for (index, step) in scene.steps.iter().enumerate() {
        let index = index.to_string();
        let constrained =
            named("hold", &step.hold).map(|(key, group, direction)| (key, group, direction, None));
        for (key, group, direction, _) in prescribed(step).chain(constrained) {
            let dofs = dofs(scene, model, &["steps", &index, key, group], group, direction)?;
            let reaction = Reaction { group: group.into(), direction, dofs };
            reactions.entry((group.to_string(), direction.component())).or_insert(reaction);
        }
        let (moving, here) = support(scene, model, &index, step, &mut supports)?;
        let released = hold_and_release(scene, model, &index, step, here, &mut supports)?;
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
        let step = BoundStep {
            name: step.name.clone(),
            increments: step.increments,
            control: step.control,
            constrained: supports.constrained.clone(),
            released,
            prescribed: supports.prescribed.clone(),
            frozen: supports.frozen.clone(),
            moving,
            force_start,
            force_end,
            changing: changing.into_values().collect(),
        };
        step.check(model)?;
        if step.control != Control::Load && step.follows_load_factor() {
            let what = "the path of equilibria cannot be followed while a formula holds load_factor";
            let help = "ramp loads and displacements, or set \"control\": \"load\"";
            return Err(scene.source.error_at(&["steps", &index, "control"], what, help));
        }
        steps.push(step);
    }
    Ok((steps, reactions.into_values().collect()))
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
pub(super) fn given(scene: &Scene, model: &Model, index: &str, step: &Step) -> Result<Loads> {
    let mut given = Loads::new();
    for (group, load) in &step.load {
        let bound = BoundLoad::on_group(scene, model, index, group, load)?;
        given.insert(("load", group.clone()), Arc::new(bound));
    }
    for (b, subdomain) in model.subdomains.iter().enumerate() {
        if let Some(values) = step.body_force.get(&subdomain.name) {
            let path = ["steps", index, "body_force", &subdomain.name];
            let bound = BoundLoad::on_subdomain(scene, &path, b, 1.0, values)?;
            given.insert(("body_force", subdomain.name.clone()), Arc::new(bound));
        }
        if let Some(values) = &step.gravity {
            let bound =
                BoundLoad::on_subdomain(scene, &["steps", index, "gravity"], b, subdomain.density, values)?;
            given.insert(("gravity", subdomain.name.clone()), Arc::new(bound));
        }
    }
    Ok(given)
}
