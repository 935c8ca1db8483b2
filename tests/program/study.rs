//! Claim: a study runs every point of its axes, as often and wherever it is asked to, with the answers of single runs; what
//! points share is made once; what fails stays in the table; what is interrupted goes on.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::common::{Scene, coulomb, faces, geometry, step};
use serde_json::{Value, json};

/// The strip in a folder of its own, with a study.
pub(crate) struct Strip(tempfile::TempDir);

impl Strip {
    pub(crate) fn new(study: &Value) -> Strip {
        Strip::of(&study.to_string())
    }

    /// The strip with the text of a study.
    fn of(study: &str) -> Strip {
        let folder = tempfile::tempdir().unwrap();
        let geo = Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/strip");
        for file in ["lower.geo", "upper.geo", "scene.json"] {
            std::fs::copy(geo.join(file), folder.path().join(file)).unwrap();
        }
        std::fs::write(folder.path().join("study.json"), study).unwrap();
        Strip(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn midplane(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_midplane"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .unwrap()
    }

    /// Runs the study, which must succeed; returns what it printed.
    pub(crate) fn study(&self, out: &str, more: &[&str]) -> String {
        let output = self.midplane(&[&["study", "study.json", "-o", out], more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Rows of study.csv by column; none of the cells here holds a quoted comma but the last two.
    pub(crate) fn table(&self, out: &str) -> Vec<HashMap<String, String>> {
        let text = std::fs::read_to_string(self.path(out).join("study.csv")).unwrap();
        let mut lines = text.lines();
        let head: Vec<&str> = lines.next().unwrap().split(',').collect();
        let row = |line: &str| {
            head.iter().map(|h| h.to_string()).zip(line.split(',').map(str::to_string)).collect()
        };
        lines.map(row).collect()
    }
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column}: {:?}", row[column]))
}

/// Claim: a study of limit loads measures the load factor at which nothing holds any more, and counts no such point as failed.
#[test]
fn a_limit_load_is_reached_and_has_not_failed() {
    let strip = Strip::new(&json!({
        "axes": { "mu": { "key": "interfaces.joint.law.friction_coefficient", "values": [0.3, 0.6, 1.2] } },
        "measures": { "limit": { "take": "reached", "reference": 0.3 } },
    }));
    // two blocks that slide on each other
    let scene = Scene::new("strain")
        .body("lower", geometry("lower.geo", "m"))
        .body("upper", geometry("upper.geo", "m"))
        .material("m", 1e4, 0.0)
        .interface("joint", faces("lower.top", "upper.bottom").law(coulomb(1e6, 1e6, 0.5)))
        .step(step("press").fix("lower.bottom", "xy").traction("upper.top", 0, -2))
        .step(step("push").increments(10).traction("upper.left", 3.3333333333333335, 0))
        .with_in("output", "fields", "none");
    scene.write(strip.0.path());
    let said = strip.study("out", &[]);
    assert!(said.contains("3 points, 0 of them failed"), "{said}");
    let rows = strip.table("out");
    for (row, mu) in rows.iter().zip([0.3, 0.6, 1.0]) {
        let (limit, reached) = (number(row, "limit"), number(row, "reached"));
        assert_eq!(limit, reached);
        assert!((limit - mu).abs() < 0.1 && limit <= mu + 1e-9, "{limit} of {mu}: {row:?}");
        assert_eq!(row["status"], if mu < 1.0 { "limit" } else { "done" });
    }
    assert!(number(&rows[0], "limit.error") < 0.2);
}

/// Axes of the two meshes, three by two points.
pub(crate) fn axes() -> Value {
    json!({
        "lower": { "parameter": "lower.edges", "values": [4, 6, 8] },
        "upper": { "parameter": "upper.edges", "range": [5, 9], "count": 2, "whole": true },
    })
}

/// The stored energy beside its exact value.
pub(crate) fn energy() -> Value {
    json!({ "energy": { "take": "last", "of": "energy.stored", "reference": 0.0008920729575 } })
}

/// The study of both.
pub(crate) fn meshes() -> Value {
    json!({ "axes": axes(), "measures": energy() })
}

/// A k × l study of two meshes prepares k + l bodies, and its points have the energies of single runs.
#[test]
fn points_share_what_they_can_and_keep_the_answers_of_single_runs() {
    let strip = Strip::new(&meshes());
    let printed = strip.study("out", &[]);
    assert!(printed.contains("6 points, 0 of them failed"), "{printed}");
    let rows = strip.table("out");
    assert_eq!(rows.len(), 6);
    let count = |what: &str| rows.iter().filter(|row| row["reused"].contains(what)).count();
    // three lower and two upper bodies are new once each
    for what in ["mesh", "stiffness", "factor"] {
        let lower = count(&format!("{what} of lower"));
        assert_eq!([lower, count(&format!("{what} of upper"))], [6 - 3, 6 - 2], "{what}");
    }
    assert_eq!(count("interfaces"), 0);
    for row in &rows {
        let [lower, upper] = ["lower", "upper"]
            .map(|subdomain| format!("subdomains.{subdomain}.parameters.edges={}", row[subdomain]));
        let run = ["run", "scene.json", "-o", "single", "--set", &lower, "--set", &upper];
        assert!(strip.midplane(&run).status.success());
        let history = std::fs::read_to_string(strip.path("single/history.csv")).unwrap();
        let column = history.lines().next().unwrap().split(',').position(|name| name == "stored").unwrap();
        let single: f64 = history.lines().last().unwrap().split(',').nth(column).unwrap().parse().unwrap();
        let energy = number(row, "energy");
        // two ways of elimination: a rounding apart
        assert!((energy - single).abs() <= 1e-12 * single, "{energy:e}, alone {single:e}");
        let error = (energy - 0.0008920729575).abs() / 0.0008920729575;
        assert!((number(row, "energy.error") - error).abs() <= 1e-14);
    }
}

/// Points that differ in the law only share everything before it: meshes, interfaces, stiffness, factors.
#[test]
fn points_that_differ_in_the_law_share_everything_before_it() {
    let stiffness =
        ["normal_stiffness", "tangential_stiffness"].map(|key| format!("interfaces.joint.law.{key}"));
    let strip = Strip::new(&json!({
        "axes": { "k": { "key": stiffness, "log_range": [1e3, 1e7], "count": 5 } },
    }));
    strip.study("out", &["--threads", "1"]);
    let rows = strip.table("out");
    for (k, row) in rows.iter().enumerate() {
        for what in
            ["mesh of lower", "interfaces", "stiffness of upper", "factor of lower", "factor of upper"]
        {
            assert_eq!(row["reused"].contains(what), k > 0, "point {k}, {what}");
        }
        assert_eq!(row["status"], "done");
    }
}

/// The L2 error of the tractions falls by the square of the mesh size or faster, with T3 on both sides.
#[test]
fn a_field_is_compared_with_formulas() {
    let strip = Strip::new(&json!({
        "set": { "subdomains.lower.parameters.order": 1, "subdomains.upper.parameters.order": 1 },
        "axes": { "density": { "values": [
            { "subdomains.lower.parameters.edges": 8, "subdomains.lower.parameters.rows": 6,
              "subdomains.upper.parameters.edges": 12, "subdomains.upper.parameters.rows": 7 },
            { "subdomains.lower.parameters.edges": 16, "subdomains.lower.parameters.rows": 12,
              "subdomains.upper.parameters.edges": 24, "subdomains.upper.parameters.rows": 14 },
        ] } },
        "measures": {
            "traction": { "take": "error", "field": "traction", "of": "joint",
                "exact": ["-2.406874455*cos(pi*x)", "1.170396232*sin(pi*x)"] },
            "jump": { "take": "error", "field": "jump", "of": "joint",
                "exact": ["-2.406874455/2e4*cos(pi*x)", "1.170396232/1e4*sin(pi*x)"] },
            "rigid": { "take": "error", "field": "displacement", "of": "lower", "exact": [1, 0] },
        },
    }));
    strip.study("out", &[]);
    let text = std::fs::read_to_string(strip.path("out/study.json")).unwrap();
    let study: serde_json::Value = serde_json::from_str(&text).unwrap();
    let error = |k: usize, name: &str| study["points"][k]["errors"][name].as_f64().unwrap();
    for name in ["traction", "jump"] {
        let [coarse, fine] = [error(0, name), error(1, name)];
        assert!(coarse < 0.05 && coarse / fine > 3.0, "{name}: {coarse:e} {fine:e}");
    }
    // ∫|u − e_x|²/∫|e_x|² for displacements below a thousandth
    assert!((error(0, "rigid") - 1.0).abs() < 1e-3);
}

/// The limit of ever finer runs is the exact energy to within its own uncertainty.
#[test]
fn the_finest_runs_stand_for_an_exact_answer() {
    let refined = |n: usize| {
        json!({
            "subdomains.lower.parameters.edges": 8 * n,
            "subdomains.lower.parameters.rows": 6 * n,
            "subdomains.lower.parameters.order": 1,
            "subdomains.upper.parameters.edges": 12 * n,
            "subdomains.upper.parameters.rows": 7 * n,
            "subdomains.upper.parameters.order": 1,
        })
    };
    let runs = [1, 2, 4].map(refined);
    let strip = Strip::new(&json!({
        "axes": { "lower": { "parameter": "lower.edges", "values": [4] } },
        "measures": { "energy": { "take": "last", "of": "energy.stored" } },
        "reference": { "runs": runs },
    }));
    strip.study("out", &[]);
    let text = std::fs::read_to_string(strip.path("out/study.json")).unwrap();
    let study: serde_json::Value = serde_json::from_str(&text).unwrap();
    let of = |key: &str| study["references"]["energy"][key].as_f64().unwrap();
    let (exact, off) = (0.0008920729575, of("value") - 0.0008920729575);
    assert!(off.abs() < of("uncertainty") && off.abs() < 1e-4 * exact, "{off:e} ± {:e}", of("uncertainty"));
    assert!((of("order") - 2.0).abs() < 0.1, "order {}", of("order"));
    assert_eq!(study["reference_runs"].as_array().unwrap().len(), 3);
}

/// Point by point, as a cluster would, or side by side: the same numbers; and nothing is run twice.
#[test]
fn single_points_and_an_interrupted_study_are_picked_up() {
    let strip = Strip::new(&meshes());
    assert_eq!(
        String::from_utf8_lossy(&strip.midplane(&["study", "study.json", "--count"]).stdout).trim(),
        "6"
    );
    for k in ["5", "0", "3"] {
        strip.study("cluster", &["--point", k]);
    }
    let printed = strip.study("cluster", &["--jobs", "2"]);
    assert!(printed.contains("3 of 6 points are there") && !printed.contains("point 5"), "{printed}");
    strip.study("whole", &[]);
    let [a, b] = ["cluster", "whole"].map(|out| strip.table(out));
    for (a, b) in a.iter().zip(&b) {
        let [a, b] = [a, b].map(|row| number(row, "energy"));
        assert!((a - b).abs() <= 1e-12 * b, "{a:e} {b:e}");
    }
    // what decides a point has changed: all are run again
    let scene = std::fs::read_to_string(strip.path("scene.json")).unwrap();
    std::fs::write(strip.path("scene.json"), scene.replace("\"young\": 4.0e3", "\"young\": 5.0e3")).unwrap();
    assert!(!strip.study("whole", &[]).contains("points are there"));
    assert!(number(&strip.table("whole")[0], "energy.error") > 0.05);
    // and now none
    assert!(strip.study("whole", &[]).contains("6 of 6 points are there"));
}

/// A point without equilibrium or with a mesh that cannot be made is in the table, infinitely wrong.
#[test]
fn failed_points_stay_in_the_table() {
    let strip = Strip::new(&json!({
        "axes": { "height": { "parameter": "lower.height", "values": [0.8, 0] } },
        "measures": energy(),
    }));
    assert!(strip.study("out", &[]).contains("2 points, 1 of them failed"));
    let text = std::fs::read_to_string(strip.path("out/study.csv")).unwrap();
    let last = text.lines().last().unwrap();
    assert!(last.contains(",refused,") && last.contains(",inf,"), "{last}");
}

/// A process of its own: the time from outside, every repeat, and its memory.
#[test]
fn points_have_processes_of_their_own() {
    let strip = Strip::new(&json!({
        "axes": { "edges": { "parameter": "lower.edges", "values": [4, 6] } },
        "measures": energy(),
        "process": "own",
        "repeat": 3,
    }));
    strip.study("out", &[]);
    for row in strip.table("out") {
        assert_eq!((row["status"].as_str(), row["runs"].as_str()), ("done", "3"));
        assert!(number(&row, "peak_memory_bytes") > 1e6);
        assert!(number(&row, "seconds_min") <= number(&row, "seconds_median"));
        assert!(!row["reused"].contains("factor"), "{}", row["reused"]);
    }
}

#[test]
fn bad_input_is_refused_with_place_and_help() {
    for (study, expected) in [
        ("{", "study.json:1: EOF while parsing an object"),
        (r#"{ "axis": {} }"#, "unknown key \"axis\"; there is $schema, title, scene, set, axes"),
        (r#"{ "scene": "no.json" }"#, "study.json:1 scene: there is no "),
        (r#"{ "repeat": 0 }"#, "repeat: 0 runs of every point"),
        (
            r#"{ "set": { "planes": "stress" } }"#,
            "--set planes=\"stress\": unknown key \"planes\"; did you mean \"plane\"? There is ",
        ),
        (r#"{ "axes": { "a": { "key": "thickness", "values": [1, -1] } } }"#, "thickness"),
        (
            r#"{ "measures": { "tip": { "take": "last", "of": "uper.displacement_y" } } }"#,
            "measures.tip.of: no interface or subdomain \"uper\"; there is joint, lower, upper, energy, work. Did you mean \"upper\"?",
        ),
        (
            r#"{ "measures": { "t": { "take": "error", "field": "traction", "of": "jiont", "exact": [0, 0] } } }"#,
            "measures.t.of: no \"jiont\"; there is joint. Did you mean \"joint\"?",
        ),
        (r#"{ "measures": { "t": { "take": "last", "off": "x" } } }"#, "measures.t: unknown key \"off\""),
        (r#"{ "reference": { "runs": [], "ratio": 1 } }"#, "reference.ratio: a ratio of 1"),
    ] {
        let strip = Strip::of(study);
        let output = strip.midplane(&["study", "study.json"]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{study}: {message}");
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert!(!strip.path("results").exists(), "{study}");
    }
    let strip = Strip::new(&json!({ "axes": axes() }));
    let output = strip.midplane(&["study", "study.json", "--point", "6"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&output.stderr).contains("the study has 6 points; they count from 0 to 5")
    );
}

#[test]
fn the_stored_schema_is_that_of_the_program() {
    let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/study.schema.json");
    let stored = std::fs::read_to_string(stored).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_midplane")).args(["schema", "study"]).output().unwrap();
    assert!(
        stored == String::from_utf8_lossy(&output.stdout),
        "run: midplane schema study > geo/study.schema.json"
    );
}

/// A program that states a version and meshes as gmsh does.
fn mesher(strip: &Strip, version: &str) -> String {
    let (draft, program) = (strip.path("draft"), strip.path(&format!("gmsh-{version}")));
    let text =
        format!("#!/bin/sh\nif [ \"$1\" = --version ]; then echo {version}; exit 0; fi\nexec gmsh \"$@\"\n");
    std::fs::write(&draft, text).unwrap();
    // written by another process: while a program is open for writing here, no thread may start it
    assert!(Command::new("install").args(["-m", "755"]).args([&draft, &program]).status().unwrap().success());
    program.display().to_string()
}

/// An outcome stands as long as its mesh would: what the .geo includes and the mesher's version decide it too.
#[test]
fn outcomes_are_as_old_as_their_meshes() {
    let strip = Strip::new(&json!({
        "axes": { "edges": { "parameter": "lower.edges", "values": [4, 6] } },
        "measures": energy(),
    }));
    let [one, other] = ["4.8.4", "9.9.9"].map(|version| mesher(&strip, version));
    let there = |gmsh: &str| strip.study("out", &["--gmsh", gmsh]).contains("2 of 2 points are there");
    assert!(!there(&one) && there(&one));
    assert!(!there(&other) && there(&other), "another version meshes anew");
    let geo = std::fs::read_to_string(strip.path("upper.geo")).unwrap();
    std::fs::write(strip.path("upper.geo"), format!("Include \"note.geo\";\n{geo}")).unwrap();
    std::fs::write(strip.path("note.geo"), "// one\n").unwrap();
    assert!(!there(&other) && there(&other));
    std::fs::write(strip.path("note.geo"), "// two\n").unwrap();
    assert!(!there(&other) && there(&other), "an included file has changed");
    // what comes from elsewhere may be another thing every time
    std::fs::write(strip.path("upper.geo"), format!("SystemCall \"true\";\n{geo}")).unwrap();
    assert!(!there(&other) && !there(&other));
}

#[test]
fn an_equals_sign_in_a_measure_is_refused_with_the_way_out() {
    let of = "upper.a=b.displacement_y";
    let strip = Strip::new(&json!({ "measures": { "u": { "take": "last", "of": of } } }));
    let output = strip.midplane(&["study", "study.json", "-o", "out"]);
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains(
            "measures.u.of: \"=\" in the measure \"u\" of \"upper.a=b.displacement_y\"; give it a column"
        ),
        "{message}"
    );
}
