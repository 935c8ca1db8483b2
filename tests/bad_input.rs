//! Claim: bad input gives one clear error that names file, line or key and what would have been right; the exit code is
//! 2 and nothing is written.

use std::path::Path;
use std::process::{Command, Output};

const LOWER: &str = "DefineConstant[ n = {3, Name \"edges\"} ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = 3; Transfinite Surface {1}; Recombine Surface {1};
Physical Point(\"corner\") = {1};
Physical Curve(\"bottom\") = {1}; Physical Curve(\"top\") = {3};
Physical Surface(\"body\") = {1};
";

const SCENE: &str = r#"{
  "plane": "strain",
  "subdomains": {
    "lower": { "geo": "lower.geo", "material": "rock" },
    "upper": { "geo": "upper.geo", "material": "rock" }
  },
  "materials": { "rock": { "young": 1e4, "poisson": 0.0 } },
  "interfaces": {
    "joint": {
      "side_a": "lower.top", "side_b": "upper.bottom",
      "law": { "type": "elastic", "normal_stiffness": 1e7, "tangential_stiffness": 1e7 }
    }
  },
  "steps": [ {
    "name": "compression",
    "fix": { "lower.bottom": ["y"], "lower.corner": ["x"] },
    "load": { "upper.top": { "pressure": 10.0 } }
  } ]
}
"#;

/// A scene folder with the two squares on each other; the file `changed` has `from` replaced by `to`.
fn scene(folder: &Path, changed: &str, from: &str, to: &str) {
    let upper = LOWER.replace("{0, 0, 0}", "{0, 1, 0}").replace("{1, 0, 0}", "{1, 1, 0}");
    let upper = upper
        .replace("{1, 1, 0}; Point(4) = {0, 1, 0}", "{1, 2, 0}; Point(4) = {0, 2, 0}")
        .replace("n = {3", "n = {5");
    for (name, text) in [("lower.geo", LOWER), ("upper.geo", &upper), ("scene.json", SCENE)] {
        let text = if name == changed {
            assert!(text.contains(from), "{name} holds no {from}");
            text.replacen(from, to, 1)
        } else {
            text.to_string()
        };
        std::fs::write(folder.join(name), text).unwrap();
    }
}

fn midplane(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

#[test]
fn the_good_scene_runs_also_with_a_curve_reversed() {
    for (changed, from, to) in [
        ("scene.json", "\"plane\"", "\"plane\""),
        ("lower.geo", "\"top\") = {3}", "\"top\") = {-3}"),
        ("upper.geo", "\"bottom\") = {1}", "\"bottom\") = {-1}"),
        ("upper.geo", "Curve Loop(1) = {1, 2, 3, 4}", "Curve Loop(1) = {-4, -3, -2, -1}"),
        (
            "scene.json",
            "\"side_a\": \"lower.top\", \"side_b\": \"upper.bottom\"",
            "\"side_b\": \"lower.top\", \"side_a\": \"upper.bottom\"",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        scene(folder.path(), changed, from, to);
        let output = midplane(
            folder.path(),
            &["run", ".", "-o", "out", "--set", "output.history.top=upper.top.displacement_y"],
        );
        assert!(output.status.success(), "{to}: {}", String::from_utf8_lossy(&output.stderr));
        let history = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let row: Vec<&str> = history.lines().last().unwrap().split(',').collect();
        let top: f64 = row[5].parse().unwrap();
        let exact = -10.0 * 2.0 / 1e4 - 10.0 / 1e7;
        assert!((top / exact - 1.0).abs() < 1e-10, "{to}: {top}");
        // a second run meshes nothing
        let output = midplane(folder.path(), &["run", "scene.json", "-o", "out"]);
        assert_eq!(String::from_utf8_lossy(&output.stdout).matches("reused").count(), 2);
    }
}

#[test]
fn bad_input_gets_one_clear_error_and_leaves_nothing() {
    for (changed, from, to, expected) in [
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
            "scene.json:5 subdomains.upper.parameters.n: invalid type: string \"eight\"; expected f64",
        ),
        ("scene.json", "\"upper.geo\", ", "\"upper.geo\", \"parameters\": { \"m\": 8 }, ", "m"),
        ("scene.json", "\"steps\"", "\"stepz\"", "scene.json:14 stepz: unknown key \"stepz\"; there is"),
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
            "{0, 1, 0}; Point(2) = {1, 1, 0}",
            "{0, 1.1, 0}; Point(2) = {1, 1.1, 0}",
            "do not lie on each other: gap of 1.000e-1",
        ),
        ("upper.geo", "Curve Loop(1)", "Curv Loop(1)", "syntax error"),
        ("upper.geo", "Physical Surface(\"body\") = {1}", "Physical Surface(\"body\") = {7}", "upper.geo"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        scene(folder.path(), changed, from, to);
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

/// The schema that the scenes of the gallery name is the one the program prints.
#[test]
fn the_schema_in_the_gallery_is_current() {
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/scene.schema.json");
    let printed = midplane(Path::new("."), &["schema"]).stdout;
    let stored = std::fs::read(stored).unwrap_or_default();
    assert!(stored == printed, "run: midplane schema > geo/scene.schema.json");
}
