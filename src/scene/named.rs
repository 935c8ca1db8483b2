//! Names of a scene: those that become files, and those of groups.

use wildmatch::WildMatch;

use super::{Scene, split_group};
use crate::error::{Result, name_help};

/// The longest name of a file: with its number and the ending it has room on every system [bytes].
const LONGEST: usize = 120;
/// Names that are no files on Windows.
const RESERVED: [&str; 22] = [
    "con", "prn", "aux", "nul", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8", "com9",
    "lpt1", "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9",
];

/// A name that becomes a file name: letters, digits, `_`, `-`, and spaces between them.
pub(super) fn check_name(scene: &Scene, path: &[&str], name: &str) -> Result<()> {
    if name.len() > LONGEST {
        let what = format!("a name of {} bytes cannot name a file", name.len());
        return Err(scene.source.error_at(path, what, format!("take {LONGEST} at most")));
    }
    if RESERVED.iter().any(|reserved| name.eq_ignore_ascii_case(reserved)) {
        let what = format!("\"{name}\" is the name of a device on Windows, and cannot name a file there");
        return Err(scene.source.error_at(path, what, "take another name"));
    }
    let all = scene.subdomains.keys().chain(scene.interfaces.keys());
    let lower = |name: &str| name.to_lowercase();
    if let Some(other) = all.into_iter().find(|other| *other != name && lower(other) == lower(name)) {
        let what =
            format!("\"{name}\" and \"{other}\" differ in case only, and would be one file on some systems");
        return Err(scene.source.error_at(path, what, "rename one of them"));
    }
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
