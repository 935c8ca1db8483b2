//! Claim: whoever reads what the program prints, or does not, has no say in what it does: it never panics, and it ends as it would.

#![cfg(unix)]

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::squares::{SCENE, changed, compression, joined, springs, structured, write};
use serde_json::json;

/// Ends of standard output and error.
#[derive(Debug, Clone, Copy, PartialEq)]
enum End {
    Open,
    Closed,
    /// A device on which nothing can be written.
    Full,
    /// Nobody reads any more.
    Broken,
    /// Somebody reads a little now and then.
    Slow,
}

/// Runs the program with these ends; returns its exit code and what was read at each end.
fn ended(folder: &Path, arguments: &[&str], ends: [End; 2]) -> (Option<i32>, [String; 2]) {
    let closes = ["1>&-", "2>&-"].into_iter().zip(ends).filter(|(_, end)| *end == End::Closed);
    let closes: Vec<&str> = closes.map(|(close, _)| close).collect();
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", &format!("exec \"$0\" \"$@\" {}", closes.join(" "))]);
    command.arg(env!("CARGO_BIN_EXE_midplane")).args(arguments).stdin(Stdio::null());
    let mut readers = Vec::new();
    let mut end = |end: End| match end {
        End::Closed => Stdio::null(),
        End::Full => Stdio::from(File::options().write(true).open("/dev/full").unwrap()),
        End::Broken => Stdio::from(std::io::pipe().unwrap().1),
        End::Open | End::Slow => {
            let (reader, writer) = std::io::pipe().unwrap();
            readers.push((end == End::Slow, reader));
            Stdio::from(writer)
        }
    };
    command.stdout(end(ends[0]));
    command.stderr(end(ends[1]));
    let mut child = command.spawn().unwrap();
    drop(command); // it holds the other ends of the pipes
    let readers: Vec<_> = readers
        .into_iter()
        .map(|(slow, mut reader)| {
            std::thread::spawn(move || {
                let (mut text, mut piece) = (Vec::new(), [0; 2048]);
                loop {
                    if slow {
                        std::thread::sleep(Duration::from_millis(20));
                    }
                    match reader.read(&mut piece).unwrap() {
                        0 => return String::from_utf8_lossy(&text).into_owned(),
                        n => text.extend(&piece[..n]),
                    }
                }
            })
        })
        .collect();
    let status = child.wait().unwrap();
    let mut read = readers.into_iter().map(|reader| reader.join().unwrap());
    let texts = ends.map(|end| match end {
        End::Open | End::Slow => read.next().unwrap(),
        _ => String::new(),
    });
    (status.code(), texts)
}

#[test]
fn every_command_ends_as_it_would() {
    let folder = tempfile::tempdir().unwrap();
    let scene = joined(springs()).step(compression(20));
    write(folder.path(), &structured(3), &structured(5), &scene);
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    put("bad.json", &changed(SCENE, "\"young\"", "\"yuong\""));
    let way = |end: f64| json!({ "control": "displacement", "start": 0, "end": end });
    let path = json!({ "program": [{ "n": way(1e-6), "t": way(0.0), "points": 400 }] });
    put("path.json", &path.to_string());
    let study = json!({
        "scene": "scene.json",
        "axes": { "young": { "values": [{ "materials.rock.young": 1e4 }, { "materials.rock.young": 2e4 }] } },
        "measures": { "energy": { "take": "last", "of": "energy.stored" } },
    });
    put("study.json", &study.to_string());
    let commands: [(&[&str], bool); 9] = [
        (&["run", ".", "-o", "out"], false),
        (&["run", "bad.json", "-o", "out"], false),
        (&["mesh", ".", "-o", "out"], false),
        (&["check", ".", "-o", "out", "--plot"], false),
        (&["study", "study.json", "-o", "study"], false),
        (&["law", ".", "joint", "path.json"], true),
        (&["schema"], true),
        (&["completions", "bash"], true),
        (&["study", "study.json", "--count"], true),
    ];
    for (arguments, is_data) in commands {
        ended(folder.path(), arguments, [End::Open, End::Open]); // a mesh or a point may be reused from here on
        let (code, texts) = ended(folder.path(), arguments, [End::Open, End::Open]);
        assert_eq!(
            code,
            Some(if arguments.contains(&"bad.json") { 2 } else { 0 }),
            "{arguments:?}: {}",
            texts[1]
        );
        for end in [End::Closed, End::Full, End::Broken, End::Slow] {
            for ends in [[end, End::Open], [End::Open, end], [end, end]] {
                let (other, read) = ended(folder.path(), arguments, ends);
                let what = format!("{arguments:?} {ends:?}: {}", read[1]);
                assert!(!read[1].contains("panicked"), "{what}");
                // data that cannot be written are missed
                let expected = if is_data && ends[0] == End::Full { Some(4) } else { code };
                assert_eq!(other, expected, "{what}");
                let whole = |k: usize| matches!(ends[k], End::Open | End::Slow) && expected == code;
                if whole(0) && is_data {
                    assert_eq!(read[0], texts[0], "{what}");
                }
                if whole(0) && !texts[0].is_empty() {
                    assert_eq!(read[0].lines().count(), texts[0].lines().count(), "{what}");
                }
                if whole(1) {
                    assert_eq!(read[1], texts[1], "{what}");
                }
            }
        }
    }
    let rows = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    assert_eq!(rows.lines().count(), 22);
}

#[test]
fn a_run_does_not_wait_for_its_reader() {
    let folder = tempfile::tempdir().unwrap();
    let scene = joined(springs()).step(compression(4000)).with_in("output", "fields", "none");
    write(folder.path(), &structured(3), &structured(5), &scene);
    let (mut reader, writer) = std::io::pipe().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder.path()).args(["run", ".", "-o", "out"]).stdout(writer).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    drop(command);
    // lines of 4000 increments are more than a pipe holds: nothing is read before the results are there
    let (begun, summary) = (Instant::now(), folder.path().join("out/summary.json"));
    while !summary.is_file() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the run waits");
        std::thread::sleep(Duration::from_millis(10));
    }
    let mut text = String::new();
    reader.read_to_string(&mut text).unwrap();
    assert!(child.wait().unwrap().success());
    assert_eq!(text.lines().filter(|line| line.starts_with("compression ")).count(), 4000);
    assert!(text.lines().last().unwrap().starts_with("wrote"), "{}", &text[text.len() - 200..]);
}
