//! Step by step: supports, and loads in force.

use std::collections::HashMap;
use std::sync::Arc;

use indexmap::IndexMap;

use super::ground::StressAt;
use super::load::BoundLoad;
use super::pressures::{self, Stated};
use super::prestress::AllInForce;
use super::step::BoundStep;
use super::supports::{Supports, dofs, hold_and_release, named, prescribed, support};
use super::water_in_force::WaterInForce;
use super::{BoundInterface, groups, in_situ};
use crate::assembly::Model;
use crate::error::{Result, Warning};
use crate::scene::{Control, Direction, Load, Scene, Step};

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

/// Binds all steps; and tells whether the first one holds what is there before it.
pub(super) fn steps(
    scene: &Scene,
    model: &Model,
    interfaces: &[BoundInterface],
    stresses: &[Option<StressAt>],
) -> Result<(Vec<BoundStep>, Vec<Reaction>, Option<Warning>)> {
    let mut supports = Supports::none(model.dofs());
    let mut reactions: IndexMap<(String, usize), Reaction> = IndexMap::new();
    let mut loads = Loads::new();
    let mut water = WaterInForce::new(model);
    let mut force = vec![0.0; model.dofs()];
    let mut steps = Vec::new();
    let (mut in_force, mut unbalanced) = (AllInForce::new(scene, model, stresses)?, None);
    let stages = scene.stages()?;
    for (number, step) in scene.steps.iter().enumerate() {
        let index = number.to_string();
        let stage = stages.get(number);
        let all = |parts: &[usize]| stage.is_none_or(|stage| parts.iter().all(|b| stage.present[*b]));
        let stay = |parts: &[usize]| {
            all(parts) && stage.is_none_or(|stage| !parts.iter().any(|b| stage.activated.contains(b)))
        };
        let is_there = |load: &BoundLoad| all(load.subdomains());
        let stays = |load: &BoundLoad| stay(load.subdomains());
        let constrained =
            named("hold", &step.hold).map(|(key, group, direction)| (key, group, direction, None));
        for (key, group, direction, _) in prescribed(step).chain(constrained) {
            let dofs = dofs(scene, model, &["steps", &index, key, group], group, direction)?;
            let reaction = Reaction { group: group.into(), direction, dofs };
            reactions.entry((group.to_string(), direction.component())).or_insert(reaction);
        }
        let (moving, here) = support(scene, model, &index, step, &mut supports)?;
        let released = hold_and_release(scene, model, &index, step, here, &mut supports)?;
        let stated = pressures::stated(scene, model, interfaces, &index, step)?;
        let given = given(scene, model, interfaces, (&index, step), &stated)?;
        let changing: Loads = given
            .clone()
            .into_iter()
            .filter(|(_, load)| load.follows_load_factor() && is_there(load))
            .collect();
        // what is replaced by a formula in load_factor ends at once; all else ramps
        let ramps = |key: &(&'static str, String)| !changing.contains_key(key);
        let mut force_start = if changing.is_empty() && stage.is_none() {
            force
        } else {
            total(model, loads.iter().filter(|(key, load)| ramps(key) && stays(load)))?
        };
        loads.extend(given);
        let force_end = total(model, loads.iter().filter(|(key, load)| ramps(key) && is_there(load)))?;
        force = force_end.clone();
        for load in changing.values() {
            load.add(model, 1.0, &mut force)?;
        }
        let there = [&stay as &dyn Fn(&[usize]) -> bool, &all];
        let water = water.step(scene, model, number, &stated, there)?.map(Arc::new);
        let prestress = in_force.step(scene, model, &index, step, stage)?;
        let initially = (number == 0).then(|| in_situ::holding(model, interfaces, &prestress)).flatten();
        if let Some(holding) = initially.filter(|_| stresses.iter().any(Option::is_some)) {
            let gravity = loads.iter().filter(|((key, _), load)| *key == "gravity" && is_there(load));
            let weight = resultant(model, &total(model, gravity)?);
            unbalanced = in_situ::imbalance(scene, &holding, &force, &supports.constrained, weight);
            // everything is held as it is at load factor 0
            let mut formulas = vec![0.0; model.dofs()];
            changing.values().try_for_each(|load| load.add(model, 0.0, &mut formulas))?;
            for (dof, start) in force_start.iter_mut().enumerate() {
                *start = if supports.constrained[dof] { force[dof] } else { holding[dof] } - formulas[dof];
            }
        }
        let mut own = Supports {
            constrained: supports.constrained.clone(),
            prescribed: supports.prescribed.clone(),
            frozen: supports.frozen.clone(),
        };
        stage.iter().for_each(|stage| own.take_away(model, stage));
        let Supports { constrained, prescribed, frozen } = own;
        let step = BoundStep {
            number,
            stage: stage.cloned(),
            prestress,
            name: step.name.clone(),
            increments: step.increments,
            control: step.control,
            constrained,
            released,
            prescribed,
            frozen,
            moving,
            force_start,
            force_end,
            changing: changing.into_values().collect(),
            water,
        };
        step.check(model)?;
        let at_control = ["steps", &index, "control"];
        if step.control != Control::Load && step.water_follows_load_factor() {
            let what = "the path of equilibria cannot be followed while a pressure in an interface holds load_factor";
            let help = "state the pressure at the end of the step, without load_factor: it goes there in proportion from what \
                        it was; or set \"control\": \"load\"";
            return Err(scene.source.error_at(&at_control, what, help));
        }
        if step.control != Control::Load && !step.is_affine() {
            let what = "the path of equilibria cannot be followed while a formula bends with load_factor";
            let help = "let loads grow in proportion, such as \"60 + 20*load_factor\", in several steps where they bend \
                        (a load without load_factor goes from where the step before left it to what it states); or set \
                        \"control\": \"load\"";
            return Err(scene.source.error_at(&at_control, what, help));
        }
        steps.push(step);
    }
    Ok((steps, reactions.into_values().collect(), unbalanced))
}

/// Size of the sum of nodal forces.
fn resultant(model: &Model, force: &[f64]) -> f64 {
    let along = |d: usize| force.iter().skip(d).step_by(model.components).sum::<f64>();
    (0..model.components).map(|d| along(d).powi(2)).sum::<f64>().sqrt()
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

/// The loads that a step names, pressures of interfaces among them that do not depend on jumps.
pub(super) fn given(
    scene: &Scene,
    model: &Model,
    interfaces: &[BoundInterface],
    (index, step): (&str, &Step),
    stated: &[Option<Stated>],
) -> Result<Loads> {
    let mut given: Loads =
        pressures::loads(model, interfaces, stated).map(|(name, load)| (("load", name), load)).collect();
    let mut by_key: HashMap<String, &str> = HashMap::new();
    for (key, load) in step.load.iter().filter(|(key, _)| !scene.names_interfaces(key)) {
        let path = ["steps", index, "load", key];
        let kind = if matches!(load, Load::Force(_)) { "point" } else { "curve" };
        for group in groups::matching(scene, model, &path, key, Some(kind))? {
            if let Some(other) = by_key.insert(group.clone(), key) {
                let what = format!("\"{other}\" and \"{key}\" both load {group}");
                return Err(scene.source.error_at(&path, what, "keep one of them"));
            }
            let bound = BoundLoad::on_group(scene, model, index, (key, &group), load)?;
            given.insert(("load", group), Arc::new(bound));
        }
    }
    for (b, subdomain) in model.subdomains.iter().enumerate() {
        if let Some(values) = step.body_force.get(&subdomain.name) {
            let path = ["steps", index, "body_force", &subdomain.name];
            let bound = BoundLoad::on_subdomain(scene, &path, b, 1.0, values)?;
            given.insert(("body_force", subdomain.name.clone()), Arc::new(bound));
        }
        if let Some(values) = step.gravity.as_ref().and_then(|gravity| gravity.of(&subdomain.name)) {
            let path = ["steps", index, "gravity"];
            let bound = BoundLoad::on_subdomain(scene, &path, b, subdomain.density, values)?;
            given.insert(("gravity", subdomain.name.clone()), Arc::new(bound));
        }
    }
    Ok(given)
}
