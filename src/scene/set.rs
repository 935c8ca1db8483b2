//! `--set KEY=VALUE`: one value of the scene replaced from the command line.
//!
//! KEY is a path with dots, `steps.0.load.upper.top.pressure`, or a JSON pointer, `/steps/0/load/upper.top/pressure`.
//! Keys that hold dots themselves are found because the longest key that exists wins. VALUE is JSON, or else a string.

use std::collections::HashMap;
use std::path::Path;

use serde_json::{Map, Value};

use super::named::is_pattern;
use super::{JOINED, split_group};
use crate::error::{At, Error, Result, name_help};

/// Keys whose names a setting cannot add to.
const NAMED: [&str; 3] = ["subdomains", "materials", "interfaces"];

/// Applies one `KEY=VALUE` to a scene.
pub(super) fn apply(scene: &mut Value, setting: &str, file: &Path) -> Result<()> {
    let error_at = |what: String, help: &str| Error::Text {
        at: Box::new(At { file: file.into(), key: format!("--set {setting}"), ..At::default() }),
        what,
        help: help.into(),
    };
    let (key, value) = setting
        .split_once('=')
        .ok_or_else(|| error_at("no \"=\"".into(), "write --set KEY=VALUE, such as --set thickness=0.1"))?;
    let value = serde_json::from_str(value).unwrap_or_else(|_| Value::String(value.into()));
    let mut parts: Vec<String> = match key.strip_prefix('/') {
        Some(pointer) => pointer.split('/').map(|part| part.replace("~1", "/").replace("~0", "~")).collect(),
        None => key.split('.').map(str::to_string).collect(),
    };
    if parts.iter().any(String::is_empty) {
        return Err(error_at("an empty part in the key".into(), "write a key such as steps.0.increments"));
    }
    let names = |key: &str| -> Vec<String> {
        let named = scene.get(key).and_then(Value::as_object);
        named.map_or_else(Vec::new, |map| map.keys().cloned().collect())
    };
    let known: HashMap<&str, Vec<String>> = NAMED.into_iter().map(|key| (key, names(key))).collect();
    let mut done: Vec<String> = Vec::new();
    let mut at = scene;
    while !parts.is_empty() {
        at = match at {
            Value::Object(object) => {
                let taken = (1..=parts.len())
                    .rev()
                    .find(|&n| object.contains_key(&parts[..n].join(".")))
                    .unwrap_or(1);
                let name: String = parts.drain(..taken).collect::<Vec<_>>().join(".");
                if !object.contains_key(&name)
                    && let Some((what, help)) = unknown(&known, &done, &name)
                {
                    return Err(error_at(what, &help));
                }
                done.push(name.clone());
                let empty = if parts.is_empty() { Value::Null } else { Value::Object(Map::new()) };
                object.entry(name).or_insert(empty)
            }
            Value::Array(list) => {
                let part = parts.remove(0);
                done.push(part.clone());
                let length = list.len();
                part.parse::<usize>().ok().and_then(|i| list.get_mut(i)).ok_or_else(|| {
                    error_at(
                        format!("no entry {part}"),
                        &format!("the list has entries 0 to {}", length.max(1) - 1),
                    )
                })?
            }
            other => {
                let what = format!("\"{}\" goes below the value {other}", parts.join("."));
                return Err(error_at(what, "shorten the key"));
            }
        };
    }
    *at = value;
    Ok(())
}

/// An error of what a setting has made or changed tells the setting: the file does not have it.
pub(super) fn blamed(error: Error, settings: &[String]) -> Error {
    let Error::Text { at, what, help } = error else { return error };
    let key_of = |setting: &str| {
        let key = setting.split_once('=').map_or("", |(key, _)| key);
        key.strip_prefix('/').map_or_else(|| key.to_string(), |key| key.replace('/', "."))
    };
    let own = settings.iter().rev().find(|setting| {
        let key = key_of(setting);
        !at.key.is_empty() && (key == at.key || key.starts_with(&format!("{}.", at.key)) && !at.stated)
    });
    match own {
        Some(setting) => {
            let within = if key_of(setting) == at.key { String::new() } else { format!(" ({})", at.key) };
            let key = format!("--set {setting}{within}");
            Error::Text { at: Box::new(At { file: at.file, key, ..At::default() }), what, help }
        }
        None => Error::Text { at, what, help },
    }
}

/// The refusal of a name that is not there and cannot be made at a path, with what there is: parts, materials and interfaces are stated in the file,
/// and what a step acts on belongs to one of them.
fn unknown(known: &HashMap<&str, Vec<String>>, path: &[String], name: &str) -> Option<(String, String)> {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    let of = |keys: &[&str]| -> Vec<String> { keys.iter().flat_map(|key| known[key].clone()).collect() };
    let (kind, there) = match path[..] {
        ["subdomains"] => ("subdomain", of(&["subdomains"])),
        ["materials"] => ("material", of(&["materials"])),
        ["interfaces"] => ("interface", of(&["interfaces"])),
        ["steps", _, "fix" | "displace" | "hold" | "release" | "body_force" | "temperature" | "strain"] => {
            ("subdomain", of(&["subdomains"]))
        }
        ["steps", _, "load"] => ("subdomain or interface", of(&["subdomains", "interfaces"])),
        _ => return None,
    };
    let own = split_group(name).0;
    let is_there = is_pattern(own)
        || there.iter().any(|known| own == *known || own.starts_with(&format!("{known}{JOINED}")));
    (!is_there).then(|| (format!("no {kind} \"{own}\""), name_help(own, there.iter().map(String::as_str))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_misspelt_name_is_told_and_not_made() {
        let scene = json!({"subdomains": {"lower": {}, "upper": {}}, "materials": {"rock": {"young": 1.0}},
            "interfaces": {"joint": {}}, "steps": [{"load": {"upper.top": {"pressure": 1.0}}}]});
        for (setting, told) in [
            ("materials.rok.young=2", "no material \"rok\"; there is rock. Did you mean \"rock\"?"),
            (
                "subdomains.lowr.parameters.n=2",
                "no subdomain \"lowr\"; there is lower, upper. Did you mean \"lower\"?",
            ),
            ("interfaces.join.law.type=elastic", "Did you mean \"joint\"?"),
            (
                "steps.0.load.uper.top.pressure=2",
                "no subdomain or interface \"uper\"; there is lower, upper, joint. Did you mean \"upper\"?",
            ),
        ] {
            let mut changed = scene.clone();
            let message = apply(&mut changed, setting, Path::new("s.json")).unwrap_err().to_string();
            assert!(message.contains(told), "{message}");
            assert_eq!(changed, scene);
        }
        for good in [
            "steps.0.load.joint.pressure=1",
            "/steps/0/load/lower.top/pressure=1",
            "output.history.t=energy.stored",
        ] {
            apply(&mut scene.clone(), good, Path::new("s.json")).unwrap();
        }
    }

    #[test]
    fn dotted_keys_and_pointers_reach_the_same_value() {
        let scene = json!({"steps": [{"load": {"upper.top": {"pressure": 1.0}}}]});
        for key in ["steps.0.load.upper.top.pressure", "/steps/0/load/upper.top/pressure"] {
            let mut changed = scene.clone();
            apply(&mut changed, &format!("{key}=2.5"), Path::new("s.json")).unwrap();
            assert_eq!(changed["steps"][0]["load"]["upper.top"]["pressure"], json!(2.5));
        }
    }

    #[test]
    fn missing_parents_are_made_and_wrong_keys_are_refused() {
        let mut scene = json!({"subdomains": {"lower": {}}, "steps": []});
        apply(&mut scene, "subdomains.lower.parameters.n=12", Path::new("s.json")).unwrap();
        assert_eq!(scene["subdomains"]["lower"]["parameters"]["n"], json!(12));
        for wrong in ["thickness", "steps.3.name=x", "subdomains.lower.parameters.n.m=1", "a..b=1"] {
            assert!(apply(&mut scene, wrong, Path::new("s.json")).is_err(), "{wrong}");
        }
    }
}
