//! One law point of a scene driven along a path: the scene's text and the path's, no mesh.

use std::path::Path;

use super::presets::read_scene;
use crate::error::{At, Error, Result, name_help};
use crate::law::path::{self, PathError, PathRow};
use crate::law::{Integration, Law, Local};
use crate::scene::{Scene, Variable, text_of};

/// The law, rows of a path, and the error that ended it early, if one did.
pub type Driven = (Law, Vec<PathRow>, Option<Error>);

/// Drives the law of an interface along the program in `path`; without `stepping` the scene's `law_tolerance` rules.
pub fn drive(
    scene: &Path,
    settings: &[String],
    name: &str,
    path: &Path,
    integration: Option<Integration>,
) -> Result<Driven> {
    let scene = read_scene(scene, settings)?;
    let text = text_of(path, "give the file of a path")?;
    drive_text(&scene, name, path, &text, integration)
}

/// The same for a scene that is read and the text of a path; `path` is for messages.
pub fn drive_text(
    scene: &Scene,
    name: &str,
    path: &Path,
    text: &str,
    integration: Option<Integration>,
) -> Result<Driven> {
    let Some(interface) = scene.interfaces.get(name) else {
        let help = name_help(name, scene.interfaces.keys().map(String::as_str));
        return Err(scene.source.error_at(&["interfaces"], format!("no interface \"{name}\""), help));
    };
    let mut initial = Local::zeros();
    for (i, value) in interface.initial_traction.iter().enumerate() {
        let place = ["interfaces", name, "initial_traction", &i.to_string()];
        let what = format!("{value} depends on the place, and one point has none");
        let help = "give the numbers at your point by --set";
        initial[i] = value.constant().ok_or_else(|| scene.source.error_at(&place, what, help))?;
    }
    if let Some((key, text)) = [Variable::X, Variable::Y, Variable::Z, Variable::S]
        .into_iter()
        .find_map(|variable| interface.law.using(variable))
    {
        let path: Vec<&str> = ["interfaces", name, "law"].into_iter().chain(key.split('.')).collect();
        let what = format!("{text} depends on the place, and one point has none");
        return Err(scene.source.error_at(&path, what, "give the number at your point by --set"));
    }
    let damage = interface.initial_damage.constant().ok_or_else(|| {
        let what = format!("{} depends on the place, and one point has none", interface.initial_damage);
        let path = ["interfaces", name, "initial_damage"];
        scene.source.error_at(&path, what, "give the number at your point by --set")
    })?;
    let law = interface.law.kind();
    let start = (law.initial_state(initial, 0.0))
        .and_then(|start| law.damaged(start, damage))
        .map_err(|law| scene.source.error_at(&["interfaces", name, law.key], law.what, law.help))?;
    let integration = integration.unwrap_or(Integration::Tolerance(interface.law_tolerance));
    let program: path::LawPath = serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        let what = message.split(" at line ").next().unwrap_or(&message);
        let help = "a path holds \"program\": segments with \"n\", \"t\" and \"points\"";
        error_at(path, error.line(), "", what, help)
    })?;
    match path::drive(law, &program, &start, integration) {
        Ok(rows) => Ok((law.clone(), rows, None)),
        Err(PathError::Program { key, what, help }) => Err(error_at(path, 0, &key, &what, &help)),
        Err(PathError::NoEquilibrium { s, reason, rows }) => {
            let step = path.display().to_string();
            let (increment, kept) = (rows.len(), rows.len().saturating_sub(1));
            let reason = format!("at s = {s:.6}: {reason}");
            Ok((law.clone(), rows, Some(Error::NoEquilibrium { step, increment, reason, kept })))
        }
    }
}

fn error_at(file: &Path, line: usize, key: &str, what: &str, help: &str) -> Error {
    let at = At { file: file.into(), line, key: key.into(), ..At::default() };
    Error::Text { at: Box::new(at), what: what.into(), help: help.into() }
}
