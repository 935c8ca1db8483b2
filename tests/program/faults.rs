//! Claim: faults that users met stay mended. Every folder of tests/faults with an `expected.json` is run by the program
//! and gives the exit code, the warnings, the words and the numbers that the file states.
//!
//! `expected.json`:
//!
//! ```text
//! exit       exit code
//! arguments  of the program; ["run", "scene.json", "-o", "out"] if absent
//! warning    the code that is warned of, or a list of codes; absent: nothing is warned of
//! words      a text, or a list of texts, in what the program prints
//! numbers    {"column": {"value": v, "tolerance": relative, "of": "formula"}} in the last row of out/history.csv, or of
//!            another table: "out/study.csv:column:row" (rows from 0)
//! earlier    runs before: [{"arguments": […], "files": {"name": "its text"}}], the files being written first
//! files      {"name": "its text"}, written before the run
//! absent     files that must not be there afterwards
//! counts     {"folder:extension": how many files} afterwards
//! gmsh       the script of a program that stands in for gmsh
//! waits      the reason why the folder is not run yet
//! ```

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// The folders below `folder` that state their outcome.
fn cases(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            cases(&path, found);
        }
    }
    if folder.join("expected.json").is_file() {
        found.push(folder.to_path_buf());
    }
}

/// One text or a list of texts.
fn texts(value: Option<&Value>) -> Vec<String> {
    let text = |value: &Value| value.as_str().expect("a text").to_string();
    match value {
        None | Some(Value::Null) => Vec::new(),
        Some(Value::Array(list)) => list.iter().map(text).collect(),
        Some(one) => vec![text(one)],
    }
}

/// A copy of the files of a folder, without those of the folders in it.
fn copy(from: &Path) -> tempfile::TempDir {
    let to = tempfile::tempdir().unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            std::fs::write(to.path().join(path.file_name().unwrap()), std::fs::read(&path).unwrap()).unwrap();
        }
    }
    to
}

/// Runs the program as `run` says; returns its exit code and what it printed.
fn run(folder: &Path, run: &Value, gmsh: bool) -> (Option<i32>, String) {
    for (name, text) in run["files"].as_object().into_iter().flatten() {
        std::fs::write(folder.join(name), text.as_str().expect("a text")).unwrap();
    }
    let mut arguments = texts(run.get("arguments"));
    if arguments.is_empty() {
        arguments = ["run", "scene.json", "-o", "out"].map(String::from).to_vec();
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments);
    if gmsh {
        command.args(["--gmsh", "./stand-in"]);
    }
    let output = command.output().unwrap();
    let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (output.status.code(), printed.concat())
}

/// A program that stands in for gmsh, written by another process: nothing may start what is open for writing here.
fn stand_in(folder: &Path, script: &str) {
    let draft = folder.join("draft");
    let text = format!("#!/bin/sh\nif [ \"$1\" = --version ]; then echo 4.8.4; exit 0; fi\n{script}\n");
    std::fs::write(&draft, text).unwrap();
    let program = folder.join("stand-in");
    assert!(Command::new("install").args(["-m", "755"]).args([&draft, &program]).status().unwrap().success());
}

/// The codes of all warnings in a text, each once.
fn warned(printed: &str) -> Vec<String> {
    let codes = printed.lines().filter_map(|line| line.strip_prefix("warning: W"));
    let mut codes: Vec<String> = codes.map(|rest| format!("W{}", &rest[..2])).collect();
    codes.sort();
    codes.dedup();
    codes
}

/// A number of a table: "column" of the last row of the history, or "file:column:row".
fn number(folder: &Path, place: &str) -> f64 {
    let parts: Vec<&str> = place.split(':').collect();
    let (file, column, row) = match parts.as_slice() {
        [file, column, row] => (*file, *column, row.parse::<usize>().ok()),
        _ => ("out/history.csv", place, None),
    };
    let text = std::fs::read_to_string(folder.join(file)).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let at = lines[0].split(',').position(|name| name == column);
    let at = at.unwrap_or_else(|| panic!("no column {column} in {}", lines[0]));
    let row = row.map_or(lines.len() - 1, |row| row + 1);
    lines[row].split(',').nth(at).unwrap().parse().unwrap()
}

/// Differences from the expected.
fn faults(case: &Path, expected: &Value) -> Vec<String> {
    let mut faults = Vec::new();
    let folder = copy(case);
    let script = expected.get("gmsh").and_then(Value::as_str);
    script.into_iter().for_each(|script| stand_in(folder.path(), script));
    for earlier in expected["earlier"].as_array().into_iter().flatten() {
        let (code, printed) = run(folder.path(), earlier, script.is_some());
        if code != Some(0) {
            faults.push(format!("an earlier run ends with {code:?}:\n{printed}"));
        }
    }
    let (code, printed) = run(folder.path(), expected, script.is_some());
    if code.map(i64::from) != expected["exit"].as_i64() {
        faults.push(format!("exit code {code:?} instead of {}", expected["exit"]));
    }
    let (mut codes, given) = (texts(expected.get("warning")), warned(&printed));
    codes.sort();
    if codes != given {
        faults.push(format!("warnings {given:?} instead of {codes:?}"));
    }
    for words in texts(expected.get("words")) {
        if !printed.contains(&words) {
            faults.push(format!("nothing says \"{words}\""));
        }
    }
    for (place, wanted) in expected["numbers"].as_object().into_iter().flatten() {
        let (value, tolerance) = (wanted["value"].as_f64().unwrap(), wanted["tolerance"].as_f64().unwrap());
        let found = if code == Some(0) { number(folder.path(), place) } else { f64::NAN };
        let scale = if value == 0.0 { 1.0 } else { value.abs() };
        let near = (found - value).abs() <= tolerance * scale;
        if !near {
            faults.push(format!("{place} is {found:e} instead of {value:e}"));
        }
    }
    for file in texts(expected.get("absent")) {
        if folder.path().join(&file).exists() {
            faults.push(format!("{file} is there"));
        }
    }
    for (place, wanted) in expected["counts"].as_object().into_iter().flatten() {
        let (sub, extension) = place.split_once(':').expect("folder:extension");
        let entries = std::fs::read_dir(folder.path().join(sub)).into_iter().flatten().flatten();
        let count = entries.filter(|entry| entry.path().extension().is_some_and(|e| e == extension)).count();
        if Some(count as u64) != wanted.as_u64() {
            faults.push(format!("{count} files in {place} instead of {wanted}"));
        }
    }
    if !faults.is_empty() {
        faults.push(format!("it printed:\n{printed}"));
    }
    faults
}

#[test]
fn every_fault_stays_mended() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/faults");
    let mut found = Vec::new();
    cases(&root, &mut found);
    found.sort();
    assert!(!found.is_empty());
    let (mut failed, mut waiting) = (Vec::new(), Vec::new());
    for case in &found {
        let name = case.strip_prefix(&root).unwrap().display().to_string();
        let text = std::fs::read_to_string(case.join("expected.json")).unwrap();
        let expected: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        if let Some(why) = expected.get("waits").and_then(Value::as_str) {
            waiting.push(format!("{name} waits: {why}"));
            continue;
        }
        failed.extend(faults(case, &expected).into_iter().map(|fault| format!("{name}: {fault}")));
    }
    println!("{} folders, waiting: {}", found.len(), waiting.join("; "));
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn a_wrong_expectation_is_noticed() {
    // the table can fail: every key of a case that holds, made wrong, is found
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/faults/options_in_the_geo");
    let text = std::fs::read_to_string(case.join("expected.json")).unwrap();
    let right: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(faults(&case, &right), Vec::<String>::new());
    for (key, wrong) in [
        ("exit", serde_json::json!(2)),
        ("warning", serde_json::json!("W99")),
        ("words", serde_json::json!("nobody says this")),
        ("numbers", serde_json::json!({"tn": {"value": -10.001, "tolerance": 1e-6}})),
        ("counts", serde_json::json!({"out:pvd": 2})),
        ("absent", serde_json::json!("out/history.csv")),
    ] {
        let mut expected = right.clone();
        expected[key] = wrong;
        assert!(!faults(&case, &expected).is_empty(), "{key}");
    }
}
