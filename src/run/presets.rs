//! Presets: one word for the knobs that trade speed for accuracy. What a scene states stays; `--set` has the last word.
//!
//! ```text
//!   refinement   parameters listed in the scene's `refinement` × factor; whole numbers stay whole, even ones even
//!   order        the parameter `order` of every .geo that declares it
//!   coupling, tolerance, law_tolerance, path_tolerance      where the scene states none
//!   increments   × factor, for steps that have several
//! ```

use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use crate::error::{Error, Result};
use crate::mesh;
use crate::scene::{self, Accuracy, Scene, Source};

/// Reads a scene file, or the `scene.json` of a folder, applies its preset and `--set` settings and checks it.
pub fn read_scene(path: &Path, settings: &[String]) -> Result<Scene> {
    scene::read(path, settings, apply)
}

/// Reads a scene from its text; `file` is for messages and for the files it names.
pub fn parse_scene(file: PathBuf, text: String, settings: &[String]) -> Result<Scene> {
    scene::parse(file, text, settings, apply)
}

/// Changes the text of a scene to a preset. What is not as it should be is left to the validation.
fn apply(scene: &mut Value, source: &Source, accuracy: Accuracy) -> Result<()> {
    let preset = accuracy.preset();
    refine(scene, source, preset.refinement)?;
    set_order(scene, source, preset.order)?;
    let default = |value: Option<&mut Value>, key: &str, to: Value| {
        if let Some(object) = value.and_then(Value::as_object_mut) {
            object.entry(key).or_insert(to);
        }
    };
    let interfaces = scene.get_mut("interfaces").and_then(Value::as_object_mut);
    for interface in interfaces.into_iter().flat_map(|all| all.values_mut()) {
        default(Some(interface), "coupling", json!(preset.coupling));
        default(Some(interface), "law_tolerance", json!(preset.law_tolerance));
    }
    default(Some(scene), "solution", json!({}));
    default(scene.get_mut("solution"), "tolerance", json!(preset.tolerance));
    default(scene.get_mut("solution"), "path_tolerance", json!(preset.path_tolerance));
    for step in scene.get_mut("steps").and_then(Value::as_array_mut).into_iter().flatten() {
        if let Some(several) = step.get("increments").and_then(Value::as_u64).filter(|n| *n > 1) {
            step["increments"] = json!((several as f64 * preset.increments).ceil() as u64);
        }
    }
    Ok(())
}

/// A run that ends early under a preset says so: a coarser mesh or looser tolerances may be why.
pub(super) fn suspected(end: Error, accuracy: Option<Accuracy>) -> Error {
    let Some(accuracy) = accuracy else { return end };
    let name = Accuracy::ALL.iter().find(|(_, preset)| *preset == accuracy).map_or("", |(name, _)| name);
    let finer = match accuracy {
        Accuracy::Draft => "\"normal\", \"fine\" or none",
        Accuracy::Normal => "\"fine\" or none",
        Accuracy::Fine => "none, or a finer mesh,",
    };
    match end {
        Error::NoEquilibrium { step, increment, reason, kept } => {
            let reason =
                format!("{reason}; the preset \"{name}\" may be why, with {finer} it may go further");
            Error::NoEquilibrium { step, increment, reason, kept }
        }
        other => other,
    }
}

fn refine(scene: &mut Value, source: &Source, factor: f64) -> Result<()> {
    let listed: Vec<String> = scene["refinement"]
        .as_array()
        .map_or_else(Vec::new, |list| list.iter().filter_map(Value::as_str).map(str::to_string).collect());
    for (i, name) in listed.iter().enumerate() {
        let Some((owner, parameter)) = name.split_once('.') else { continue };
        let Some(subdomain) = subdomain(scene, owner) else { continue };
        let stated = subdomain.get("parameters").and_then(|all| all.get(parameter)).and_then(Value::as_f64);
        let value = match stated {
            Some(value) => value,
            None => declared(subdomain, source, parameter)?.flatten().ok_or_else(|| {
                let what = format!("no number to multiply: {owner} does not declare {parameter} with one");
                let help = format!(
                    "write DefineConstant[ {parameter} = 8 ] in its .geo, or set it in \"parameters\""
                );
                source.error_at(&["refinement", &i.to_string()], what, help)
            })?,
        };
        set_parameter(subdomain, parameter, scaled(value, factor));
    }
    Ok(())
}

fn set_order(scene: &mut Value, source: &Source, order: u8) -> Result<()> {
    let subdomains = scene.get_mut("subdomains").and_then(Value::as_object_mut);
    for subdomain in subdomains.into_iter().flat_map(|all| all.values_mut()).filter_map(Value::as_object_mut)
    {
        let stated = subdomain.get("parameters").is_some_and(|all| all.get("order").is_some());
        if !stated && declared(subdomain, source, "order")?.is_some() {
            set_parameter(subdomain, "order", order.into());
        }
    }
    Ok(())
}

fn subdomain<'a>(scene: &'a mut Value, name: &str) -> Option<&'a mut Map<String, Value>> {
    scene.get_mut("subdomains")?.get_mut(name)?.as_object_mut()
}

fn set_parameter(subdomain: &mut Map<String, Value>, name: &str, value: f64) {
    if let Some(all) = subdomain.entry("parameters").or_insert_with(|| json!({})).as_object_mut() {
        all.insert(name.into(), json!(value));
    }
}

/// The number of a parameter that the `.geo` of a subdomain declares, if it declares it; a file that is not there is the
/// business of the mesher.
fn declared(subdomain: &Map<String, Value>, source: &Source, name: &str) -> Result<Option<Option<f64>>> {
    let Some(geo) = subdomain.get("geo").and_then(Value::as_str) else { return Ok(None) };
    let geo = source.folder().join(geo);
    if !geo.is_file() {
        return Ok(None);
    }
    let parameters = mesh::parameters(&geo)?;
    Ok(parameters.into_iter().find(|(declared, _)| declared == name).map(|(_, value)| value))
}

/// value × factor; whole numbers stay whole and at least 1, even ones even and at least 2.
fn scaled(value: f64, factor: f64) -> f64 {
    let unit = match value {
        _ if value.fract() != 0.0 => return value * factor,
        _ if value % 2.0 == 0.0 => 2.0,
        _ => 1.0,
    };
    (value * factor / unit).round().max(1.0) * unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_stay_whole_and_even_ones_even() {
        for (value, factor, expected) in [
            (8.0, 0.5, 4.0),
            (12.0, 0.25, 4.0),
            (7.0, 0.5, 4.0),
            (1.0, 0.1, 1.0),
            (2.0, 0.1, 2.0),
            (0.3, 0.5, 0.15),
        ] {
            assert_eq!(scaled(value, factor), expected, "{value} x {factor}");
        }
    }
}
