//! Groups that the scene names nowhere: a misspelt or forgotten one is among them.

use std::collections::HashSet;

use serde_json::Value;
use wildmatch::WildMatch;

use crate::assembly::Model;
use crate::error::{Code, Warning};
use crate::scene::{Scene, is_pattern};

/// One line for every subdomain with groups that nothing in the scene names. Surfaces do not count: every mesh has one.
pub fn unused_groups(scene: &Scene, model: &Model) -> Vec<Warning> {
    let mut texts = HashSet::new();
    // whatever part of a scene names groups does so by its keys and texts
    collect(&serde_json::to_value(scene).unwrap_or_default(), &mut texts);
    let patterns: Vec<WildMatch> =
        texts.iter().filter(|text| is_pattern(text)).map(|text| WildMatch::new(text)).collect();
    let used = |name: &str| {
        let within = format!("{name}.");
        texts.contains(name)
            || texts.iter().any(|text| text.starts_with(&within))
            || patterns.iter().any(|pattern| pattern.matches(name) || pattern.matches(&within))
    };
    let lines = model.subdomains.iter().map(|subdomain| {
        let groups = subdomain.mesh.groups.iter().filter(|(_, group)| group.kind() != "surface");
        // those who share the mesh share its groups
        let sharing = || model.subdomains.iter().filter(|other| other.mesh.file == subdomain.mesh.file);
        let used = |name: &str| sharing().any(|other| used(&format!("{}.{name}", other.name)));
        let unused = groups.map(|(name, _)| name).filter(|name| !used(name));
        (&subdomain.name, unused.map(String::as_str).collect::<Vec<&str>>())
    });
    let told = lines.filter(|(_, unused)| !unused.is_empty());
    told.map(|(subdomain, unused)| {
        let what = format!("subdomain {subdomain}: nothing uses its group {}", unused.join(", "));
        Warning::new(Code::UnusedGroups, what, "fine if it is meant; else look for a misspelt name")
    })
    .collect()
}

fn collect(value: &Value, texts: &mut HashSet<String>) {
    match value {
        Value::String(text) => {
            texts.insert(text.clone());
        }
        Value::Array(list) => list.iter().for_each(|value| collect(value, texts)),
        Value::Object(object) => {
            for (key, value) in object {
                texts.insert(key.clone());
                collect(value, texts);
            }
        }
        _ => {}
    }
}
