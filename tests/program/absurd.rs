//! Claim: counts are checked before they are believed, names before they become files, and texts before they reach a terminal: one
//! short message with its place, at once, whatever stands in a file.

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::common::squares::{SCENE, changed, joined, said, springs, squares, standing};
use serde_json::json;

/// Runs the program in a folder, unless it hangs.
#[track_caller]
fn midplane(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
    let (mut child, begun) = (command.spawn().unwrap(), Instant::now());
    while child.try_wait().unwrap().is_none() {
        if begun.elapsed() > Duration::from_secs(60) {
            child.kill().unwrap();
            panic!("{arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().unwrap()
}

/// Asserts that arguments are refused in a few lines that have these words.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str], words: &str) {
    let output = midplane(folder, arguments);
    let message = said(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(message.contains(words), "{arguments:?} should say {words:?}: {message}");
    assert!(message.len() < 6000, "{} bytes", message.len());
    assert!(!message.chars().any(|c| c.is_control() && c != '\n' && c != '\t'), "{message:?}");
}

#[test]
fn counts_are_checked_before_they_are_believed() {
    let folder = squares(SCENE);
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put("many.json", &changed(SCENE, "\"fix\"", "\"increments\": 1000000000000, \"fix\""));
    refused(folder.path(), &["check", "many.json"], "steps.0.increments: 1000000000000 increments");
    let path = |points: u64| {
        let way = |end: f64| json!({ "control": "displacement", "start": 0, "end": end });
        json!({ "program": [{ "n": way(1e-6), "t": way(0.0), "points": points }] }).to_string()
    };
    put("path.json", &path(1_000_000_000_000_000_000));
    refused(folder.path(), &["law", ".", "joint", "path.json"], "1000000000000000000 points, which take");
    put("path.json", &path(2));
    for count in ["0", "1000001", "99999999999999999999999", "x"] {
        refused(
            folder.path(),
            &["law", ".", "joint", "path.json", "--substeps", count],
            "a number from 1 to 1000000",
        );
        refused(folder.path(), &["run", ".", "--threads", count], "a number from 1 to 4096");
    }
    put("study.json", r#"{ "repeat": 1000000000, "axes": {}, "measures": {} }"#);
    refused(
        folder.path(),
        &["study", "study.json", "--count"],
        "study.json:1 repeat: 1000000000 runs of every point",
    );
    #[cfg(unix)]
    refused(folder.path(), &["check", "/dev/zero"], "it is larger than 64 MB");
}

#[test]
fn a_load_that_cannot_be_resolved_takes_no_time() {
    for pressure in ["1e-320*x", "sin(1e18*x)", "1e300*sin(1e9*x)"] {
        let folder = squares(joined(springs()).step(standing("compression").pressure("upper.top", pressure)));
        let output = midplane(folder.path(), &["check", ".", "-o", "out"]);
        assert!(matches!(output.status.code(), Some(0 | 2)), "{pressure}: {}", said(&output));
    }
}

#[test]
fn names_that_cannot_be_files_everywhere_are_refused() {
    let long = "n".repeat(121);
    for (name, words) in [
        (long.as_str(), "a name of 121 bytes cannot name a file"),
        ("con", "\"con\" is the name of a device on Windows"),
        ("LPT1", "\"LPT1\" is the name of a device on Windows"),
        ("Lower", "differ in case only"),
        ("a/b", "cannot name a file"),
        ("..", "cannot name a file"),
        ("joint ", "cannot name a file"),
    ] {
        let folder = squares(changed(SCENE, "\"joint\": {", &format!("\"{name}\": {{")));
        std::fs::write(
            folder.path().join("scene.json"),
            changed(SCENE, "\"joint\": {", &format!("\"{name}\": {{")),
        )
        .unwrap();
        refused(folder.path(), &["check", "."], words);
    }
}

#[test]
fn texts_that_nobody_can_read_are_told_in_a_few_words() {
    let folder = squares(SCENE);
    let put = |name: &str, text: &[u8]| std::fs::write(folder.path().join(name), text).unwrap();
    let long = "y".repeat(1_000_000);
    put("long.json", changed(SCENE, "\"plane\"", &format!("\"{long}\"")).as_bytes());
    refused(folder.path(), &["check", "long.json"], "unknown key");
    put("wide.json", format!("{{ \"plane\": \"strain\", {} \"x\": 1 }}", " ".repeat(100_000)).as_bytes());
    refused(folder.path(), &["check", "wide.json"], "unknown key \"x\"");
    put("bytes.json", b"{\n \"plane\": \"strain\",\n \"title\": \"\xff\xfe\" }");
    refused(folder.path(), &["check", "bytes.json"], "bytes.json:3: it has bytes that are no UTF-8 text");
    for escape in ["\\u001b[2J\\u001b]0;evil\\u0007", "\\u009b31m", "\\u202egpj.exe"] {
        for place in ["\"plane\": \"strain\"", "\"rock\": {", "\"young\"", "\"lower.top\"", "\"compression\""]
        {
            let inside = place.find('"').map(|at| at + 1).unwrap();
            let to = format!("{}{escape}{}", &place[..inside], &place[inside..]);
            put("escape.json", changed(SCENE, place, &to).as_bytes());
            let output = midplane(folder.path(), &["check", "escape.json", "-o", "out"]);
            let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
            let bad =
                |c: char| c.is_control() && c != '\n' && c != '\t' || ('\u{202a}'..='\u{202e}').contains(&c);
            assert!(!text.contains(bad), "{place}: {text:?}");
        }
    }
    // raw ones are no JSON
    put("raw.json", changed(SCENE, "\"compression\"", "\"com\u{1b}[31mpression\"").as_bytes());
    refused(folder.path(), &["check", "raw.json"], "raw.json:15");
    let output = Command::new(env!("CARGO_BIN_EXE_midplane"))
        .current_dir(folder.path())
        .args(["check", "no\u{1b}[31msuch.json"])
        .output()
        .unwrap();
    assert!(!said(&output).contains('\u{1b}'), "{}", said(&output));
}
