//! Claim: the results folder holds the files of the last run and whatever is not of this program, and nothing else.

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::squares::{SCENE, changed, midplane, structured, write};

/// The files below a folder but for the meshes, by path.
fn files(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(folder).unwrap().display().to_string();
            if path.is_dir() {
                open.push(path);
            } else if !name.starts_with("mesh/") {
                found.insert(name);
            }
        }
    }
    found
}

#[test]
fn files_of_another_run_go_and_those_of_others_stay() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    write(folder.path(), &structured(3), &structured(5), SCENE);
    std::fs::write(folder.path().join("other.json"), changed(SCENE, "\"joint\": {", "\"bed\": {")).unwrap();
    let run = |scene: &str| {
        for command in [&["run", scene, "-o", "out"][..], &["check", scene, "-o", "out", "--plot"]] {
            let output = midplane(folder.path(), command);
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        }
    };
    run("other.json");
    let alone = files(&out);
    assert!(alone.contains("fields/bed_0001.vtu") && alone.contains("check/bed.vtu"), "{alone:?}");
    // what ParaView, meshio and a person would leave there
    let foreign = [
        (
            "mine.pvd",
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
        ),
        ("notes.txt", "the wall of 1931"),
        (
            "fields/clip_0001.vtu",
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\">\n",
        ),
        ("fields/empty.vtu", ""),
        ("midplane/mine.vtu", "<VTKFile>"),
        ("check/mine.vtu", "<VTKFile>"),
        ("fields/joint.csv", "1,2"),
    ];
    for (name, text) in foreign {
        std::fs::write(out.join(name), text).unwrap();
    }
    run("scene.json");
    run("other.json");
    let mut expected = alone;
    expected.extend(foreign.map(|(name, _)| name.to_string()));
    assert_eq!(files(&out), expected);
}
