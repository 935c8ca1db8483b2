//! Claim: a run that was killed, stopped or ended without an equilibrium goes on with `--resume` and leaves the files of one that
//! was not interrupted, byte by byte; a checkpoint of another scene or mesh is refused with what differs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::common::squares::{changed, compression, joined, midplane, said, squares};
use crate::common::{Law, Scene, Step, coulomb, step};
use serde_json::json;

/// Two squares that a crack parts, before they are pressed, sheared along a path, and let go.
fn cracked(law: Law, fields: &str) -> Scene {
    joined(law).with_in("output", "fields", fields)
}

fn rock() -> Law {
    crate::common::cracking(1e6, 1e6, [3.0, 4.0, 0.8785], [2e-3, 2e-2]).with("cohesion", 4)
}

fn press(increments: usize) -> Step {
    step("press").increments(increments).fix("lower.bottom", "xy").pressure("upper.top", 2.0)
}

fn shear(control: &str) -> Step {
    step("shear").increments(8).control(control).displace("upper.top", "x", 2e-3)
}

fn back(increments: usize) -> Step {
    step("back").increments(increments).displace("upper.top", "x", 0)
}

fn cracking(fields: &str, control: &str) -> Scene {
    cracked(rock(), fields).steps([press(2), shear(control), back(3)])
}

fn run(folder: &Path, out: &str, more: &[&str]) -> Output {
    midplane(folder, &[&["run", "scene.json", "-o", out], more].concat())
}

/// The files of a run but for its checkpoints, with their bytes; of the summary what is not of the process.
fn contents(out: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![out.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            let name = path.strip_prefix(out).unwrap().to_path_buf();
            if path.is_dir() {
                open.push(path);
            } else if name == Path::new("manifest") {
                // ends of steps are kept as often as time allows
                let text = std::fs::read_to_string(&path).unwrap();
                let lines = text.lines().filter(|line| !line.starts_with("checkpoint/"));
                found.insert(name, lines.collect::<Vec<_>>().join("\n").into_bytes());
            } else if name.starts_with("checkpoint") {
                continue;
            } else if name == Path::new("summary.json") {
                let text = std::fs::read_to_string(&path).unwrap();
                let mut summary: serde_json::Value = serde_json::from_str(&text).unwrap();
                for key in ["time", "peak_memory_bytes", "resumed"] {
                    summary.as_object_mut().unwrap().remove(key).unwrap();
                }
                summary["solution"].as_object_mut().unwrap().remove("factorisations").unwrap(); // once more
                found.insert(name, summary.to_string().into_bytes());
            } else {
                found.insert(name, std::fs::read(&path).unwrap());
            }
        }
    }
    found
}

#[track_caller]
fn same(a: &Path, b: &Path) {
    let (a, b) = (contents(a), contents(b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    for (name, bytes) in a {
        assert!(bytes == b[&name], "{}", name.display());
    }
}

/// Goes through the first increments in a process of its own and kills it when there are so many rows.
fn killed(folder: &Path, out: &str, rows: usize, more: &[&str]) {
    let history = folder.join(out).join("history.csv");
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(["run", "scene.json", "-o", out]).args(more);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let begun = std::time::Instant::now();
    while std::fs::read_to_string(&history).map_or(0, |text| text.lines().count()) <= rows {
        assert!(begun.elapsed().as_secs() < 60, "no rows");
        if child.try_wait().unwrap().is_some() {
            return; // it was faster
        }
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn a_killed_run_goes_on() {
    for (fields, control) in [("every", "load"), ("step", "auto"), ("last", "load"), ("none", "auto")] {
        let folder = squares(cracking(fields, control));
        assert!(run(folder.path(), "alone", &[]).status.success());
        for (often, rows) in [("1", 2), ("1", 9), ("2", 5), ("60s", 4), ("never", 6)] {
            let out = format!("out_{often}_{rows}");
            killed(folder.path(), &out, rows, &["--checkpoint", often]);
            let output = run(folder.path(), &out, &["--resume"]);
            assert!(output.status.success(), "{fields} {often}: {}", said(&output));
            same(&folder.path().join("alone"), &folder.path().join(&out));
            // once more there is nothing to do
            assert!(run(folder.path(), &out, &["--resume"]).status.success());
            same(&folder.path().join("alone"), &folder.path().join(&out));
        }
    }
}

#[test]
fn a_run_goes_on_with_more_steps_and_with_other_steps_to_come() {
    for fields in ["every", "step", "last", "none"] {
        let scene = cracking(fields, "load");
        let more = scene.clone().step(step("more").increments(4).displace("upper.top", "x", -1e-3));
        // a part of the scene that was done stays, the last step is another
        let begun = cracked(rock(), fields).steps([press(2), shear("load")]);
        let other = begun.clone().step(back(5));
        for (name, changed, after) in [("more", &more, 13), ("other", &other, 10), ("shorter", &begun, 10)] {
            let folder = squares(&scene);
            assert!(run(folder.path(), "out", &[]).status.success());
            changed.write(folder.path());
            let output = run(folder.path(), "out", &["--resume"]);
            assert!(output.status.success(), "{fields} {name}: {}", said(&output));
            let told = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(told.contains(&format!("goes on after increment {after}")), "{fields} {name}: {told}");
            assert!(run(folder.path(), "alone", &[]).status.success());
            same(&folder.path().join("alone"), &folder.path().join("out"));
        }
    }
}

#[test]
fn a_run_without_an_equilibrium_goes_on_when_its_step_is_another() {
    // friction carries 2.5 in shear; the second step asks for more
    let scene = |x: f64| {
        let compression = compression(1).fix("lower.bottom", "xy");
        let push = step("push").increments(4).traction("upper.top", x, -10);
        joined(coulomb(1e7, 1e7, 0.25)).step(compression).step(push)
    };
    let folder = squares(scene(5.0));
    let failed = run(folder.path(), "out", &[]);
    assert_eq!(failed.status.code(), Some(3), "{}", said(&failed));
    let first = contents(&folder.path().join("out"));
    let again = run(folder.path(), "out", &["--resume"]);
    assert_eq!(again.status.code(), Some(3), "{}", said(&again));
    assert_eq!(said(&failed), said(&again));
    assert_eq!(first, contents(&folder.path().join("out")));
    scene(2.0).write(folder.path());
    let output = run(folder.path(), "out", &["--resume"]);
    assert!(output.status.success(), "{}", said(&output));
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(told.contains("goes on after increment 1\n"), "{told}");
    assert!(told.contains("not later:   out/checkpoint/latest: is of another scene: steps.1.load"), "{told}");
    assert!(run(folder.path(), "alone", &[]).status.success());
    same(&folder.path().join("alone"), &folder.path().join("out"));
}

#[test]
fn a_checkpoint_of_another_scene_or_mesh_is_refused_with_what_differs() {
    let scene = cracking("every", "load");
    let folder = squares(&scene);
    killed(folder.path(), "out", 6, &["--checkpoint", "1"]);
    let before = contents(&folder.path().join("out"));
    let refused = |told: &str| {
        let output = run(folder.path(), "out", &["--resume"]);
        assert_eq!(output.status.code(), Some(2), "{told}: {}", said(&output));
        assert!(said(&output).contains(told), "{told}: {}", said(&output));
        assert!(said(&output).contains("or run without --resume to begin anew"), "{}", said(&output));
        let mut after = contents(&folder.path().join("out"));
        after.retain(|name, _| before.contains_key(name)); // new meshes may be there
        let is_hidden = |name: &Path| name.file_name().unwrap().to_string_lossy().starts_with('.');
        let before: BTreeMap<_, _> =
            before.clone().into_iter().filter(|(name, _)| !is_hidden(name)).collect();
        let other: Vec<_> = before.iter().filter(|(name, bytes)| after.get(*name) != Some(bytes)).collect();
        assert!(other.is_empty(), "{:?}", other.iter().map(|(name, _)| name).collect::<Vec<_>>());
    };
    let steps = [press(2), shear("load"), back(3)];
    for (other, told) in [
        (
            scene.clone().material("rock", 2e4, 0.0),
            "another scene: materials.rock.young is 20000.0, it was 10000.0",
        ),
        (
            cracked(rock(), "every").steps([press(3), shear("load"), back(3)]),
            "another scene: steps.0.increments is 3, it was 2",
        ),
        (
            cracked(rock().with("cohesion", 5), "every").steps(steps),
            "interfaces.joint.law.cohesion is 5, it was 4",
        ),
        (
            scene.clone().with(
                "output",
                json!({ "fields": "every", "history": { "other": "upper.top.displacement_y" } }),
            ),
            "output.history.top is not there",
        ),
    ] {
        other.write(folder.path());
        refused(told);
    }
    scene.write(folder.path());
    let geo = std::fs::read_to_string(folder.path().join("upper.geo")).unwrap();
    std::fs::write(folder.path().join("upper.geo"), changed(&geo, "n = {5", "n = {6")).unwrap();
    refused("is of another mesh of upper");
    std::fs::write(folder.path().join("upper.geo"), geo).unwrap();
    // rows that somebody has changed, and checkpoints that are damaged
    let history = folder.path().join("out/history.csv");
    let rows = std::fs::read_to_string(&history).unwrap();
    std::fs::write(&history, rows.replacen("press", "PRESS", 1)).unwrap();
    let output = run(folder.path(), "out", &["--resume"]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("is of other rows than those beside it"), "{}", said(&output));
    std::fs::write(&history, rows).unwrap();
    for entry in std::fs::read_dir(folder.path().join("out/checkpoint")).unwrap() {
        let path = entry.unwrap().path();
        let mut bytes = std::fs::read(&path).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        std::fs::write(&path, bytes).unwrap();
    }
    let output = run(folder.path(), "out", &["--resume"]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("is damaged: its checksum is another"), "{}", said(&output));
    // without --resume it begins anew
    std::fs::remove_dir_all(folder.path().join("out/mesh")).unwrap(); // that of the other geometry among them
    assert!(run(folder.path(), "out", &[]).status.success());
    assert!(run(folder.path(), "alone", &[]).status.success());
    same(&folder.path().join("alone"), &folder.path().join("out"));
}

#[test]
fn a_damaged_checkpoint_gives_way_to_the_one_before() {
    let folder = squares(cracking("every", "load"));
    assert!(run(folder.path(), "alone", &[]).status.success());
    killed(folder.path(), "out", 8, &["--checkpoint", "1"]);
    let latest = folder.path().join("out/checkpoint/latest");
    let bytes = std::fs::read(&latest).unwrap();
    std::fs::write(&latest, &bytes[..bytes.len() / 2]).unwrap();
    let output = run(folder.path(), "out", &["--resume"]);
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        told.contains("goes on after increment 2\n") && told.contains("is damaged"),
        "{told}{}",
        said(&output)
    );
    same(&folder.path().join("alone"), &folder.path().join("out"));
}
