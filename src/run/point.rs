//! One law point of a scene driven along a path: the scene's text and the path's, no mesh.

use std::path::Path;

use nalgebra::Vector2;

use crate::error::{At, Error, Result, name_cure};
use crate::law::path::{self, PathError, PathRow};
use crate::law::{Integration, Law, State};
use crate::scene;

/// Rows of a path, and the error that ended it early, if one did.
pub type Driven = (Vec<PathRow>, Option<Error>);

/// Drives the law of `interface` along the program in `path`; without `stepping` the scene's `law_tolerance` rules.
pub fn drive(
    scene: &Path,
    settings: &[String],
    interface: &str,
    path: &Path,
    stepping: Option<Integration>,
) -> Result<Driven> {
    let scene = scene::read(scene, settings)?;
    let Some(joint) = scene.interfaces.get(interface) else {
        let cure = name_cure(interface, scene.interfaces.keys().map(String::as_str));
        return Err(scene.source.refuse(&["interfaces"], format!("no interface \"{interface}\""), cure));
    };
    let mut initial = [0.0; 2];
    for (i, value) in joint.initial_traction.iter().enumerate() {
        let place = ["interfaces", interface, "initial_traction", &i.to_string()];
        let what = format!("{value} depends on the place, and one point has none");
        let cure = "give the numbers at your point by --set";
        initial[i] = value.constant().ok_or_else(|| scene.source.refuse(&place, what, cure))?;
    }
    let start = start(&joint.law, initial)
        .map_err(|law| scene.source.refuse(&["interfaces", interface, law.key], law.what, law.cure))?;
    let stepping = stepping.unwrap_or(Integration::Tolerance(joint.law_tolerance));
    let text = std::fs::read_to_string(path).map_err(Error::io("read", path))?;
    let program: path::LawPath = serde_json::from_str(&text).map_err(|error| {
        let message = error.to_string();
        let what = message.split(" at line ").next().unwrap_or(&message);
        let cure = "a path holds \"program\": segments with \"n\", \"t\" and \"points\"";
        refuse(path, error.line(), "", what, cure)
    })?;
    match path::drive(&joint.law, &program, &start, stepping) {
        Ok(rows) => Ok((rows, None)),
        Err(PathError::Program { key, what, cure }) => Err(refuse(path, 0, &key, &what, &cure)),
        Err(PathError::NoEquilibrium { s, reason, rows }) => {
            let step = path.display().to_string();
            let (increment, kept) = (rows.len(), rows.len().saturating_sub(1));
            let reason = format!("at s = {s:.6}: {reason}");
            Ok((rows, Some(Error::NoEquilibrium { step, increment, reason, kept })))
        }
    }
}

fn start(law: &Law, initial_traction: [f64; 2]) -> std::result::Result<State, crate::law::Inadmissible> {
    law.initial_state(Vector2::from(initial_traction), 0.0)
}

fn refuse(file: &Path, line: usize, key: &str, what: &str, cure: &str) -> Error {
    let at = At { file: file.into(), line, key: key.into(), ..At::default() };
    Error::Text { at: Box::new(at), what: what.into(), cure: cure.into() }
}
