//! Pressures in interfaces as steps state them: by name or pattern, kept until they are replaced.

use std::sync::Arc;

use super::load::BoundLoad;
use super::pressure_names::names;
use super::quantity::Quantity;
use crate::assembly::Model;
use crate::error::{Result, name_help};
use crate::law::State;
use crate::scene::{Flow, Load, Pressure, Scene, Step, Variable};

use super::BoundInterface;

/// A pressure in an interface.
#[derive(Debug, Clone)]
pub(super) enum Stated<'a> {
    /// Imposed.
    Imposed(Quantity),
    /// The pressure of flow; the key of the load, for messages.
    Flow(&'a Flow, String),
}

/// The pressures that a step states, interface by interface.
pub(super) fn stated<'a>(
    scene: &'a Scene,
    model: &Model,
    interfaces: &[BoundInterface],
    index: &str,
    step: &'a Step,
) -> Result<Vec<Option<Stated<'a>>>> {
    let mut found: Vec<Option<(&str, Stated)>> = vec![None; model.interfaces.len()];
    for (key, load) in &step.load {
        let Load::Pressure(pressure) = load else { continue };
        if !scene.names_interfaces(key) {
            continue;
        }
        let path = ["steps", index, "load", key.as_str()];
        let matching = model.interfaces.iter().enumerate().filter(|(_, own)| names(scene, key, &own.name));
        let matching: Vec<usize> = matching.map(|(k, _)| k).collect();
        if matching.is_empty() {
            let all = model.interfaces.iter().map(|interface| interface.name.as_str());
            let what = format!("no interface is called like \"{key}\"");
            return Err(scene.source.error_at(&path, what, name_help(key, all)));
        }
        for k in matching {
            let name = &model.interfaces[k].name;
            if let Some((other, _)) = &found[k] {
                let what = format!("\"{other}\" and \"{key}\" both give {name} a pressure");
                return Err(scene.source.error_at(&path, what, "keep one of them"));
            }
            let stated = match pressure {
                Pressure::Imposed(value) => {
                    let path = [&path[..], &["pressure"]].concat();
                    let knows =
                        interfaces[k].laws.all().iter().all(|law| law.damage(&State::default()).is_some());
                    if value.uses(Variable::Damage) && !knows {
                        let what = format!("damage in {value}, but the law of {name} has none");
                        let help = "\"cracking\" and \"cohesive\" have one; write it with opening";
                        return Err(scene.source.error_at(&path, what, help));
                    }
                    Stated::Imposed(Quantity::new(scene, &path, value))
                }
                Pressure::Flow(flow) => Stated::Flow(flow, key.clone()),
            };
            found[k] = Some((key, stated));
        }
    }
    Ok(found.into_iter().map(|own| own.map(|(_, stated)| stated)).collect())
}

/// Pressures that are loads of their own: numbers and formulas that do not depend on jumps, of interfaces where none does.
pub(super) fn loads<'a>(
    model: &'a Model,
    interfaces: &'a [BoundInterface],
    stated: &'a [Option<Stated>],
) -> impl Iterator<Item = (String, Arc<BoundLoad>)> + 'a {
    stated.iter().enumerate().filter_map(|(k, stated)| match stated {
        Some(Stated::Imposed(quantity)) if !interfaces[k].coupled_pressure => {
            let load = BoundLoad::in_interface(model, k, quantity.clone());
            Some((model.interfaces[k].name.clone(), Arc::new(load)))
        }
        _ => None,
    })
}
