//! Claim: bad input gives one clear error that names file, line or key and what would have been right; the exit code is
//! 2 and nothing is written.

use std::path::Path;

use serde_json::json;

use crate::common::squares::{SCENE, assert_shortened, changed, midplane, structured, write};

/// A scene folder with the two squares on each other; the file `name` has `from` replaced by `to`.
fn scene(folder: &Path, name: &str, from: &str, to: &str) {
    let text = |of: &str, text: &str| if of == name { changed(text, from, to) } else { text.to_string() };
    let (lower, upper) = (text("lower.geo", &structured(3)), text("upper.geo", &structured(5)));
    write(folder, &lower, &upper, text("scene.json", SCENE));
}

#[test]
fn the_good_scene_runs_also_with_a_curve_reversed() {
    for (name, from, to) in [
        ("scene.json", "\"plane\"", "\"plane\""),
        ("lower.geo", "\"top\") = {3}", "\"top\") = {-3}"),
        ("upper.geo", "\"bottom\") = {1}", "\"bottom\") = {-1}"),
        ("upper.geo", "Curve Loop(1) = {1 : 4}", "Curve Loop(1) = {-4, -3, -2, -1}"),
        (
            "scene.json",
            "\"side_a\": \"lower.top\", \"side_b\": \"upper.bottom\"",
            "\"side_b\": \"lower.top\", \"side_a\": \"upper.bottom\"",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        scene(folder.path(), name, from, to);
        let output = midplane(folder.path(), &["run", ".", "-o", "out"]);
        assert!(output.status.success(), "{to}: {}", String::from_utf8_lossy(&output.stderr));
        assert_shortened(folder.path(), to);
        // a second run meshes nothing
        let output = midplane(folder.path(), &["run", "scene.json", "-o", "out"]);
        assert_eq!(String::from_utf8_lossy(&output.stdout).matches("reused").count(), 2);
    }
}

#[test]
fn bad_input_gets_one_clear_error_and_leaves_nothing() {
    for (name, from, to, expected) in [
        (
            "scene.json",
            "upper.bottom",
            "upper.botom",
            "scene.json:10 interfaces.joint.side_b: no group \"botom\" in upper.geo; there is corner, bottom, top, body. Did you mean \"bottom\"?",
        ),
        (
            "scene.json",
            "upper.geo",
            "uper.geo",
            "scene.json:5 subdomains.upper.geo: there is no file ./uper.geo",
        ),
        (
            "scene.json",
            "\"upper.geo\", ",
            "\"upper.geo\", \"parameters\": { \"n\": \"eight\" }, ",
            "scene.json:5 subdomains.upper.parameters.n: it is the text \"eight\"; it takes a number",
        ),
        ("scene.json", "\"upper.geo\", ", "\"upper.geo\", \"parameters\": { \"m\": 8 }, ", "m"),
        (
            "scene.json",
            "\"steps\"",
            "\"stepz\"",
            "scene.json:14 stepz: unknown key \"stepz\"; did you mean \"steps\"? There is",
        ),
        ("scene.json", "\"pressure\": 10.0", "\"pressure\": }", "scene.json:17"),
        (
            "scene.json",
            "\"lower.corner\": [\"x\"]",
            "\"lower.corner\": [\"z\"]",
            "unknown value \"z\"; there is x, y",
        ),
        ("scene.json", "\"lower.corner\": [\"x\"]", "\"lower.body\": []", "no direction"),
        ("scene.json", ", \"lower.corner\": [\"x\"]", "", "can move freely: translation along"),
        (
            "scene.json",
            "\"upper.top\"",
            "\"upper.body\"",
            "\"upper.body\" is a surface, not a curve; its curves are bottom, top",
        ),
        ("scene.json", "{ \"pressure\": 10.0 }", "{ \"force\": [1.0, 0.0] }", "name a physical point"),
        (
            "upper.geo",
            "Physical Curve(\"bottom\") = {1};",
            "",
            "no group \"bottom\" in upper.geo; there is corner, top, body",
        ),
        (
            "upper.geo",
            "Physical Curve(\"bottom\") = {1}",
            "Physical Curve(\"bottom\") = {4}",
            "interface joint: lower.top and upper.bottom",
        ),
        (
            "upper.geo",
            "{0, @, 0}; Point(2) = {1, @, 0}",
            "{0, @ + 0.1, 0}; Point(2) = {1, @ + 0.1, 0}",
            "do not lie on each other: gap of 1.000e-1",
        ),
        ("upper.geo", "Curve Loop(1)", "Curv Loop(1)", "syntax error"),
        ("upper.geo", "Physical Surface(\"body\") = {1}", "Physical Surface(\"body\") = {7}", "upper.geo"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        scene(folder.path(), name, from, to);
        for command in ["run", "check"] {
            let output = midplane(folder.path(), &[command, ".", "-o", "out"]);
            let message = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{to}: {message}");
            assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
            assert_eq!(message.matches("error:").count(), 1, "{message}");
            assert!(!folder.path().join("out").exists(), "{to}: something was written");
        }
    }
}

#[test]
fn a_refused_run_leaves_the_last_results_alone() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), "scene.json", "strain", "strain");
    assert!(midplane(folder.path(), &["run", ".", "-o", "out"]).status.success());
    let before = std::fs::read(folder.path().join("out/history.csv")).unwrap();
    let output =
        midplane(folder.path(), &["run", ".", "-o", "out", "--set", "interfaces.joint.side_b=upper.botom"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(before, std::fs::read(folder.path().join("out/history.csv")).unwrap());
    assert!(folder.path().join("out/fields/joint_0001.vtu").exists());
}

#[test]
fn the_environment_has_an_exit_code_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    scene(folder.path(), "scene.json", "strain", "strain");
    let output = midplane(folder.path(), &["run", ".", "-o", "out", "--gmsh", "no-such-gmsh"]);
    assert_eq!(output.status.code(), Some(4), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stderr).contains("no-such-gmsh"));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn help_schema_and_completions_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, expected) in [
        (&["--help"][..], "Exit codes"),
        (&["run", "--help"], "--set"),
        (&["schema"], "\"$schema\""),
        (&["completions", "bash"], "midplane"),
        (&["--version"], "midplane 0."),
    ] {
        let output = midplane(folder.path(), arguments);
        assert!(output.status.success());
        assert!(String::from_utf8_lossy(&output.stdout).contains(expected), "{arguments:?}");
    }
    assert_eq!(midplane(folder.path(), &["fly"]).status.code(), Some(2));
}

#[test]
fn schemas_and_manual_pages_are_written_where_they_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    for (arguments, file, printed) in [
        (&["schema", "--write"][..], "scene.schema.json", &["schema"][..]),
        (&["schema", "study", "--write"], "study.schema.json", &["schema", "study"]),
        (&["schema", "--write", "own.json"], "own.json", &["schema"]),
    ] {
        let output = midplane(folder.path(), arguments);
        assert!(output.status.success() && output.stdout.is_empty(), "{arguments:?}");
        assert!(read(file) == midplane(folder.path(), printed).stdout, "{file}");
    }
    assert!(midplane(folder.path(), &["manual", "man"]).status.success());
    assert!(String::from_utf8_lossy(&read("man/midplane-run.1")).contains("Mesh what is stale"));
}

/// Editors show what stands beside a reference only where the reference is in an `allOf`.
#[test]
fn descriptions_of_keys_are_those_of_the_keys() {
    fn look(value: &serde_json::Value, seen: &mut usize) {
        if let Some(object) = value.as_object() {
            assert!(!(object.contains_key("$ref") && object.contains_key("description")), "{value}");
            *seen += usize::from(object.contains_key("allOf"));
            object.values().for_each(|value| look(value, seen));
        }
        value.as_array().into_iter().flatten().for_each(|value| look(value, seen));
    }
    for of in ["scene", "study"] {
        let printed = midplane(Path::new("."), &["schema", of]).stdout;
        let mut seen = 0;
        look(&serde_json::from_slice(&printed).unwrap(), &mut seen);
        assert!(seen > 0, "{of}");
    }
}

/// The schema that the scenes of the gallery name is the one the program prints.
#[test]
fn the_schema_in_the_gallery_is_current() {
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/scene.schema.json");
    let printed = midplane(Path::new("."), &["schema"]).stdout;
    let stored = std::fs::read(stored).unwrap_or_default();
    assert!(stored == printed, "run: midplane schema > geo/scene.schema.json");
}

/// Every value of a scene replaced by values of other kinds.
#[test]
fn nothing_speaks_of_the_language_that_it_is_written_in() {
    fn places(value: &serde_json::Value, at: String, all: &mut Vec<String>) {
        let below = |key: &str| format!("{at}/{}", key.replace('~', "~0").replace('/', "~1"));
        match value {
            serde_json::Value::Object(map) => map.iter().for_each(|(key, v)| places(v, below(key), all)),
            serde_json::Value::Array(list) => {
                list.iter().enumerate().for_each(|(k, v)| places(v, below(&k.to_string()), all));
            }
            _ => {}
        }
        all.push(at);
    }
    let scene: serde_json::Value = serde_json::from_str(SCENE).unwrap();
    let mut all = Vec::new();
    places(&scene, String::new(), &mut all);
    let bad = [
        json!(null),
        json!(true),
        json!(-1),
        json!(1e308),
        json!("x"),
        json!([]),
        json!({}),
        json!([1, 2]),
        json!({ "a": 1 }),
        json!("\u{1b}[31m"),
    ];
    let mut refused = 0;
    for place in &all {
        for value in &bad {
            let mut other = scene.clone();
            *other.pointer_mut(place).unwrap() = value.clone();
            let read = midplane::run::parse_scene("scene.json".into(), other.to_string(), &[]);
            let Err(error) = read else { continue };
            let message = error.to_string();
            refused += 1;
            let words = message.split(|c: char| !c.is_alphabetic());
            let foreign =
                ["untagged", "enum", "variant", "struct", "tuple", "sequence", "map", "serde", "Some"];
            for word in words {
                assert!(!foreign.contains(&word), "{place} = {value}: {message}");
            }
        }
    }
    assert!(refused > 150, "{refused}");
}
