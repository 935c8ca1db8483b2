//! Claim: a results folder belongs to one run at a time. What a run has not written there stays, what an earlier run has written
//! stays until the first row of the next is complete, and what a killed run was writing goes.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use crate::common::coulomb;
use crate::common::squares::{
    SCENE, changed, compression, joined, midplane, said, springs, squares, standing,
};

fn increments(n: usize) -> String {
    joined(springs()).step(compression(n)).to_string()
}

/// The files of a folder with their bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                found.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    found
}

/// A run that takes long, with rows on disk.
fn long_run(folder: &Path, out: &str) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(["run", "long.json", "-o", out, "--set", "output.fields=none"]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = std::time::Instant::now();
    while !folder.join(out).join("history.csv").is_file() {
        assert!(begun.elapsed().as_secs() < 60, "no rows");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    child
}

#[test]
fn a_second_run_is_refused_and_takes_nothing_away() {
    let folder = squares(SCENE);
    std::fs::write(folder.path().join("long.json"), increments(1_000_000)).unwrap();
    let mut child = long_run(folder.path(), "results/out");
    let out = folder.path().join("results/out");
    for command in ["run", "mesh", "check"] {
        let refused = midplane(folder.path(), &[command, ".", "-o", "results/out"]);
        assert_eq!(refused.status.code(), Some(4), "{}", said(&refused));
        let holder = format!("another run is at work there, process {} on ", child.id());
        assert!(said(&refused).contains(&holder), "{}", said(&refused));
        assert!(said(&refused).contains("midplane run long.json -o results/out"), "{}", said(&refused));
    }
    let rows = std::fs::read_to_string(out.join("history.csv")).unwrap().lines().count();
    std::thread::sleep(std::time::Duration::from_millis(300));
    let more = std::fs::read_to_string(out.join("history.csv")).unwrap().lines().count();
    assert!(rows > 1 && more > rows, "{rows} rows, then {more}");
    child.kill().unwrap();
    child.wait().unwrap();
    // a lock that nobody holds any more is no lock
    let next = midplane(folder.path(), &["run", ".", "-o", "results/out"]);
    assert!(next.status.success(), "{}", said(&next));
    let left: Vec<String> = contents(&out).into_keys().filter(|name| name.contains(".midplane-")).collect();
    assert!(left.is_empty(), "{left:?}");
    assert!(!out.join("long.pvd").exists());
}

#[test]
fn files_of_others_are_told_and_stay() {
    for (name, told) in [
        ("history.csv", "history.csv is in the way"),
        ("fields/lower_0007.vtu", "fields/lower_0007.vtu is in the way"),
        ("midplane/joint.vtu", "midplane/joint.vtu is in the way"),
        ("summary.json", "summary.json is in the way"),
        ("manifest", "manifest is not a list of results"),
    ] {
        let folder = squares(SCENE);
        let file = folder.path().join("out").join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(&file, "mine\n").unwrap();
        let refused = midplane(folder.path(), &["run", ".", "-o", "out"]);
        assert_eq!(refused.status.code(), Some(4), "{name}: {}", said(&refused));
        assert!(said(&refused).contains(told), "{name}: {}", said(&refused));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine\n");
    }
}

#[cfg(unix)]
#[test]
fn a_link_within_the_folder_is_told_and_what_it_leads_to_stays() {
    let folder = squares(SCENE);
    for out in ["other", "out"] {
        assert!(midplane(folder.path(), &["run", ".", "-o", out]).status.success());
    }
    let other = contents(&folder.path().join("other"));
    std::fs::remove_dir_all(folder.path().join("out/fields")).unwrap();
    std::os::unix::fs::symlink("../other/fields", folder.path().join("out/fields")).unwrap();
    let refused = midplane(folder.path(), &["run", ".", "-o", "out"]);
    assert_eq!(refused.status.code(), Some(4), "{}", said(&refused));
    assert!(said(&refused).contains("fields is a link to another folder"), "{}", said(&refused));
    assert_eq!(contents(&folder.path().join("other")), other);
    std::fs::create_dir(folder.path().join("mine")).unwrap();
    std::fs::write(folder.path().join("mine/manifest"), "midplane results of other\nnotes.txt\n").unwrap();
    std::fs::write(folder.path().join("mine/notes.txt"), "mine").unwrap();
    std::os::unix::fs::symlink("../mine", folder.path().join("other/check")).unwrap();
    let refused = midplane(folder.path(), &["check", ".", "-o", "other", "--plot"]);
    assert_eq!(refused.status.code(), Some(4), "{}", said(&refused));
    assert_eq!(std::fs::read_to_string(folder.path().join("mine/notes.txt")).unwrap(), "mine");
    // the results folder itself may be one
    std::os::unix::fs::symlink("other", folder.path().join("link")).unwrap();
    assert!(midplane(folder.path(), &["run", ".", "-o", "link"]).status.success());
}

#[test]
fn a_run_that_fails_leaves_good_results() {
    // as much shear as friction cannot carry: no equilibrium in the first increment
    let push = standing("compression").traction("upper.top", 5.0, -10.0);
    let slides = joined(coulomb(1e7, 1e7, 0.25)).step(push).to_string();
    let scenes = [
        (changed(SCENE, "\"young\": 1e4", "\"young\": -1e4"), 2),
        (changed(SCENE, "\"lower.top\"", "\"lower.tip\""), 2),
        (changed(SCENE, "\"lower.bottom\": [\"y\"], ", ""), 2),
        (slides, 3),
    ];
    let folder = squares(SCENE);
    let out = folder.path().join("out");
    assert!(midplane(folder.path(), &["run", ".", "-o", "out"]).status.success());
    let good = contents(&out);
    for (scene, code) in scenes {
        std::fs::write(folder.path().join("scene.json"), scene).unwrap();
        let failed = midplane(folder.path(), &["run", ".", "-o", "out"]);
        assert_eq!(failed.status.code(), Some(code), "{}", said(&failed));
        assert!(
            said(&failed).contains("note: the results of an earlier run in out stay"),
            "{}",
            said(&failed)
        );
        assert_eq!(contents(&out), good);
    }
}

#[test]
fn what_a_killed_run_was_writing_goes_and_what_it_was_putting_in_place_is_put_there() {
    let folder = squares(SCENE);
    let run = |out: &str, n: usize| {
        let set = format!("steps.0.increments={n}");
        let output = midplane(folder.path(), &["run", ".", "-o", out, "--set", &set]);
        assert!(output.status.success(), "{}", said(&output));
    };
    let path = |name: &str| folder.path().join(name);
    run("out", 2);
    let good = contents(&path("out"));
    for name in
        ["out/.midplane-writing-a1", "out/fields/.midplane-writing-b2", "out/.midplane-copy-history.csv"]
    {
        std::fs::write(path(name), "half").unwrap();
    }
    for name in ["out/.midplane-next/fields", "out/mesh/.midplane-gmsh-x"] {
        std::fs::create_dir_all(path(name)).unwrap();
        std::fs::write(path(name).join("half.vtu"), "half").unwrap();
    }
    assert!(midplane(folder.path(), &["mesh", ".", "-o", "out"]).status.success());
    assert_eq!(contents(&path("out")), good);
    // killed after its first row was complete, before, between, and after the earlier results were removed
    run("new", 1);
    std::fs::remove_dir_all(path("new/mesh")).unwrap();
    let mut expected = contents(&path("new"));
    expected.extend(good.into_iter().filter(|(name, _)| name.starts_with("mesh/")));
    for already in [&[][..], &["manifest"], &["manifest", "fields/lower_0000.vtu", "history.csv"]] {
        std::fs::remove_dir_all(path("out")).unwrap();
        run("out", 2);
        let ready = path("out/.midplane-ready");
        for (name, bytes) in contents(&path("new")) {
            let target = ready.join(&name);
            std::fs::create_dir_all(target.parent().unwrap()).unwrap();
            std::fs::write(target, bytes).unwrap();
        }
        if !already.is_empty() {
            for name in
                contents(&path("out")).into_keys().filter(|n| !n.starts_with("mesh/") && !n.starts_with('.'))
            {
                std::fs::remove_file(path("out").join(name)).unwrap();
            }
        }
        for name in already {
            std::fs::create_dir_all(path("out").join(name).parent().unwrap()).unwrap();
            std::fs::rename(ready.join(name), path("out").join(name)).unwrap();
        }
        assert!(midplane(folder.path(), &["mesh", ".", "-o", "out"]).status.success());
        assert_eq!(contents(&path("out")), expected, "{already:?}");
    }
}

#[test]
fn a_study_keeps_its_folder_and_takes_no_other_file_for_its_tables() {
    let folder = squares(SCENE);
    let study = serde_json::json!({
        "scene": "scene.json",
        "axes": { "young": { "values": [{ "materials.rock.young": 1e4 }] } },
        "measures": { "energy": { "take": "last", "of": "energy.stored" } },
    })
    .to_string();
    std::fs::write(folder.path().join("study.json"), &study).unwrap();
    let refused = midplane(folder.path(), &["study", "study.json", "-o", "."]);
    assert_eq!(refused.status.code(), Some(4), "{}", said(&refused));
    assert!(said(&refused).contains("study.json is in the way"), "{}", said(&refused));
    assert_eq!(std::fs::read_to_string(folder.path().join("study.json")).unwrap(), study);
    for _ in 0..2 {
        let done = midplane(folder.path(), &["study", "study.json", "-o", "out"]);
        assert!(done.status.success(), "{}", said(&done));
    }
    let names: Vec<String> = contents(&folder.path().join("out")).into_keys().collect();
    assert!(
        !names.iter().any(|name| name.contains(".midplane-") || name.contains("checkpoint")),
        "{names:?}"
    );
}
