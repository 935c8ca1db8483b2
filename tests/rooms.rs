//! Claim: a room imports only rooms above it in the table, and every file opens with what it is.

use std::path::Path;

/// The rooms from top to bottom: each may import those before it.
const ROOMS: [&str; 16] = [
    "error",
    "sparse",
    "shape",
    "law",
    "mesh",
    "scene",
    "coupling",
    "continuum",
    "assembly",
    "solver",
    "problem",
    "output",
    "history",
    "run",
    "study",
    "cli",
];

fn sources(folder: &Path, visit: &mut dyn FnMut(&Path, &str)) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            sources(&path, visit);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            visit(&path, &text);
        }
    }
}

#[test]
fn imports_go_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = Vec::new();
    sources(&src, &mut |path, text| {
        let below = path.strip_prefix(&src).unwrap();
        let room = below.iter().next().unwrap().to_string_lossy();
        let room = room.trim_end_matches(".rs").to_string();
        let Some(rank) = ROOMS.iter().position(|r| *r == room) else {
            assert!(
                ["lib", "main"].contains(&room.as_str()),
                "{} is in no room of the table",
                path.display()
            );
            return;
        };
        seen.push(room);
        // tests at the end of a file may look further
        let text = text.split("#[cfg(test)]").next().unwrap();
        for (at, _) in text.match_indices("crate::") {
            let name: String =
                text[at + 7..].chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            if let Some(other) = ROOMS.iter().position(|r| *r == name) {
                assert!(other <= rank, "{} imports {name}, which is below it", path.display());
            } else {
                panic!(
                    "{} imports crate::{name}, which is no room (one `use` per room, please)",
                    path.display()
                );
            }
        }
    });
    for room in ROOMS {
        assert!(seen.iter().any(|s| s == room), "the room {room} is empty");
    }
}

#[test]
fn every_file_opens_with_what_it_is() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    sources(&src, &mut |path, text| assert!(text.starts_with("//! "), "{}", path.display()));
}
