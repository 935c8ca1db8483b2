//! The scene and meshes that a checkpoint belongs to, and what differs from those of the run that wants to go on from it.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::places::CheckpointPlace;
use crate::error::Error;
use crate::problem::Problem;
use crate::scene::Scene;

/// Scene, meshes and version of a checkpoint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Identity {
    version: String,
    /// The scene as it was read, presets and settings applied.
    scene: Value,
    /// Subdomains with the digests of their meshes.
    meshes: Vec<(String, String)>,
    /// Columns of the history, and arrays that later steps may bring into fields.
    columns: Vec<String>,
    arrays: Vec<String>,
}

impl Identity {
    /// The identity of a run, before its first increment.
    pub(super) fn new(scene: &Scene, problem: &Problem) -> Identity {
        let mut scene = serde_json::to_value(scene).unwrap_or_default();
        if let Some(keys) = scene.as_object_mut() {
            ["$schema", "title"].into_iter().for_each(|key| drop(keys.remove(key)));
        }
        let interfaces = problem.model.interfaces.iter().enumerate();
        let water = interfaces.flat_map(|(k, interface)| {
            let [water, flow] = problem.water_in(k);
            let told = |what: &str| format!("{what} in {}", interface.name);
            [water.then(|| told("pressure")), flow.then(|| told("flow"))].into_iter().flatten()
        });
        let comes_and_goes = problem.steps.iter().any(|step| step.stage.is_some());
        let parts = comes_and_goes.then(|| "parts that come and go".to_string());
        Identity {
            version: env!("CARGO_PKG_VERSION").into(),
            scene,
            meshes: meshes(problem),
            columns: problem.columns(),
            arrays: water.chain(parts).chain(problem.variables().map(|v| v.name.to_string())).collect(),
        }
    }

    /// The difference from a run that wants to go on from a checkpoint at this place, if there is one.
    pub(super) fn difference(&self, now: &Identity, place: &CheckpointPlace) -> Option<String> {
        if self.version != now.version {
            return Some(format!("is of version {}, and this is {}", self.version, now.version));
        }
        let scenes = [&self.scene, &now.scene].map(|scene| before_next(scene, place));
        if let Some(difference) = difference("", &scenes[0], &scenes[1]) {
            return Some(format!("is of another scene: {difference}"));
        }
        let mesh = self.meshes.iter().zip(&now.meshes).find(|(then, now)| then != now);
        if let Some(((name, _), _)) = mesh {
            return Some(format!("is of another mesh of {name}"));
        }
        let more = |then: &[String], now: &[String]| now.iter().find(|name| !then.contains(name)).cloned();
        if let Some(name) = more(&self.columns, &now.columns) {
            return Some(format!("is of a history without the column {name}"));
        }
        if let Some(name) = more(&self.arrays, &now.arrays) {
            return Some(format!("is of a run without {name}"));
        }
        let lost = self.columns != now.columns || self.arrays != now.arrays;
        lost.then(|| "is of a run with more columns or arrays".into())
    }

    /// The error of a run that cannot go on from a checkpoint.
    pub(super) fn refused(file: &Path, what: String) -> Error {
        let help = "change it back, or run without --resume to begin anew".into();
        Error::Checkpoint { file: file.into(), what, help }
    }
}

/// A scene without the steps that may change: those after the checkpoint.
fn before_next(scene: &Value, place: &CheckpointPlace) -> Value {
    let mut scene = scene.clone();
    if let Some(steps) = scene.get_mut("steps").and_then(Value::as_array_mut) {
        steps.truncate(place.step + usize::from(!place.between));
    }
    scene
}

/// SHA-256 of all points and cells, subdomain by subdomain.
fn meshes(problem: &Problem) -> Vec<(String, String)> {
    let digest = |mesh: &crate::mesh::Mesh| -> String {
        let mut hash = Sha256::new();
        let mut bytes = Vec::new();
        mesh.points.iter().flatten().for_each(|x| bytes.extend(x.to_bits().to_le_bytes()));
        mesh.cells
            .offsets
            .iter()
            .chain(&mesh.cells.nodes)
            .for_each(|n| bytes.extend((*n as u64).to_le_bytes()));
        hash.update(&bytes);
        hash.finalize().iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    };
    problem.model.subdomains.iter().map(|part| (part.name.clone(), digest(&part.mesh))).collect()
}

/// The first place at which two documents differ: `materials.rock.young is 2e4, it was 1e4`.
fn difference(place: &str, then: &Value, now: &Value) -> Option<String> {
    let below = |key: &str| if place.is_empty() { key.to_string() } else { format!("{place}.{key}") };
    match (then, now) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys().filter(|key| !a.contains_key(*key)));
            let same_order = a.keys().eq(b.keys());
            let found = keys.filter_map(|key| match (a.get(key), b.get(key)) {
                (Some(a), Some(b)) => difference(&below(key), a, b),
                (Some(a), None) => Some(format!("{} is not there, it was {}", below(key), short(a))),
                (None, Some(b)) => Some(format!("{} is {}, it was not there", below(key), short(b))),
                (None, None) => None,
            });
            let first = found.into_iter().next();
            first.or_else(|| (!same_order).then(|| format!("the order of {place} is another")))
        }
        (Value::Array(a), Value::Array(b)) => {
            let pairs = a.iter().zip(b).enumerate();
            let found = pairs.filter_map(|(k, (a, b))| difference(&below(&k.to_string()), a, b)).next();
            found.or_else(|| {
                (a.len() != b.len()).then(|| format!("{place} has {} entries, it had {}", b.len(), a.len()))
            })
        }
        (a, b) if a == b => None,
        (a, b) => Some(format!("{place} is {}, it was {}", short(b), short(a))),
    }
}

/// A value in a few words.
fn short(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() <= 60 {
        text
    } else {
        format!("{}…", text.chars().take(59).collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_was_done_must_be_the_same_and_what_is_to_come_may_differ() {
        let one = Identity {
            version: "1".into(),
            scene: json!({ "plane": "strain", "steps": ["a", "b", "c"] }),
            meshes: vec![("lower".into(), "12".into())],
            columns: vec!["top".into()],
            arrays: vec!["damage".into()],
        };
        let place = CheckpointPlace { increment: 7, step: 1, between: true };
        let within = CheckpointPlace { between: false, ..place };
        type Change = fn(&mut Identity);
        let changes: [(Change, &CheckpointPlace, Option<&str>); 9] = [
            (|_| (), &within, None),
            (|now| now.version = "2".into(), &place, Some("is of version 1, and this is 2")),
            (|now| now.scene["steps"][1] = json!("x"), &place, None),
            (
                |now| now.scene["steps"][1] = json!("x"),
                &within,
                Some("is of another scene: steps.1 is \"x\", it was \"b\""),
            ),
            (|now| now.scene["steps"][2] = json!("x"), &within, None),
            (
                |now| now.scene["plane"] = json!("stress"),
                &place,
                Some("is of another scene: plane is \"stress\", it was \"strain\""),
            ),
            (|now| now.meshes[0].1 = "13".into(), &place, Some("is of another mesh of lower")),
            (|now| now.columns.push("flow".into()), &place, Some("is of a history without the column flow")),
            (|now| now.arrays.clear(), &place, Some("is of a run with more columns or arrays")),
        ];
        for (change, place, told) in changes {
            let mut now = one.clone();
            change(&mut now);
            assert_eq!(one.difference(&now, place).as_deref(), told);
        }
    }

    #[test]
    fn the_first_difference_is_told() {
        let scene = json!({ "materials": { "rock": { "young": 1e4 } }, "steps": [1, 2] });
        assert_eq!(difference("", &scene, &scene), None);
        for (path, value, told) in [
            ("/materials/rock/young", json!(2e4), "materials.rock.young is 20000.0, it was 10000.0"),
            ("/materials/rock", json!({}), "materials.rock.young is not there, it was 10000.0"),
            ("/steps/1", json!("x"), "steps.1 is \"x\", it was 2"),
            ("/steps", json!([1, 2, 3]), "steps has 3 entries, it had 2"),
        ] {
            let mut other = scene.clone();
            *other.pointer_mut(path).unwrap() = value;
            assert_eq!(difference("", &scene, &other).unwrap(), told);
        }
    }
}
