//! One law point of a scene driven along a path: the scene's text and the path's, no mesh.

use std::path::Path;

use super::presets::read_scene;
use crate::error::{At, Error, Result, name_help};
use crate::law::path::{self, PathError, PathRow};
use crate::law::{Integration, Law, Local, State};

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
    let start = start(&interface.law, initial)
        .map_err(|law| scene.source.error_at(&["interfaces", name, law.key], law.what, law.help))?;
    let integration = integration.unwrap_or(Integration::Tolerance(interface.law_tolerance));
    let text = std::fs::read_to_string(path).map_err(Error::io("read", path))?;
    let program: path::LawPath = serde_json::from_str(&text).map_err(|error| {
        let message = error.to_string();
        let what = message.split(" at line ").next().unwrap_or(&message);
        let help = "a path holds \"program\": segments with \"n\", \"t\" and \"points\"";
        error_at(path, error.line(), "", what, help)
    })?;
    match path::drive(&interface.law, &program, &start, integration) {
        Ok(rows) => Ok((interface.law, rows, None)),
        Err(PathError::Program { key, what, help }) => Err(error_at(path, 0, &key, &what, &help)),
        Err(PathError::NoEquilibrium { s, reason, rows }) => {
            let step = path.display().to_string();
            let (increment, kept) = (rows.len(), rows.len().saturating_sub(1));
            let reason = format!("at s = {s:.6}: {reason}");
            Ok((interface.law, rows, Some(Error::NoEquilibrium { step, increment, reason, kept })))
        }
    }
}

fn start(law: &Law, initial_traction: Local) -> std::result::Result<State, crate::law::Inadmissible> {
    law.initial_state(initial_traction, 0.0)
}

fn error_at(file: &Path, line: usize, key: &str, what: &str, help: &str) -> Error {
    let at = At { file: file.into(), line, key: key.into(), ..At::default() };
    Error::Text { at: Box::new(at), what: what.into(), help: help.into() }
}
