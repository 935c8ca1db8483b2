//! Names of a scene: those that become files, and those of groups.

use wildmatch::WildMatch;

use super::{Scene, split_group};
use crate::error::{Result, name_help};

/// A name that becomes a file name: letters, digits, `_`, `-`, and spaces between them.
pub(super) fn check_name(scene: &Scene, path: &[&str], name: &str) -> Result<()> {
    let good = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c));
    if good && !name.starts_with('-') && name.trim() == name {
        return Ok(());
    }
    let what = format!("\"{name}\" cannot name a file");
    Err(scene.source.error_at(path, what, "use letters, digits, _, - and spaces between them"))
}

/// True for a pattern: `*` is any text, `?` any character.
pub fn is_pattern(name: &str) -> bool {
    name.contains(['*', '?'])
}

/// The subdomain of a group must exist, or some that fit its pattern; whether they have that group is known when their meshes
/// are.
pub(super) fn check_group(scene: &Scene, path: &[&str], group: &str) -> Result<()> {
    let subdomain = split_group(group).0;
    if is_pattern(subdomain) {
        return matching(scene, path, subdomain).map(|_| ());
    }
    if scene.subdomains.contains_key(subdomain) {
        return Ok(());
    }
    let help = name_help(subdomain, scene.subdomains.keys().map(String::as_str));
    Err(scene.source.error_at(path, format!("no subdomain \"{subdomain}\""), help))
}

/// Numbers of the subdomains whose names fit a pattern, of which there must be one.
pub(super) fn matching(scene: &Scene, path: &[&str], pattern: &str) -> Result<Vec<usize>> {
    let matcher = WildMatch::new(pattern);
    let names = scene.subdomains.keys().enumerate();
    let found: Vec<usize> = names.filter(|(_, name)| matcher.matches(name)).map(|(b, _)| b).collect();
    if found.is_empty() {
        let what = format!("no subdomain is called like \"{pattern}\"");
        let help = name_help(pattern, scene.subdomains.keys().map(String::as_str));
        return Err(scene.source.error_at(path, what, help));
    }
    Ok(found)
}
