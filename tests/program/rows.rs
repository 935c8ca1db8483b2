//! Claim: history.csv, the .pvd and summary.json tell the same rows from the unloaded state on, also of a run that is stopped or
//! finds no equilibrium; a signal ends a run with what has converged, the mesher with it.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::squares::{compression, joined, midplane, springs, standing, structured, write};
use crate::common::{Scene, Step, coulomb};

/// Increments of history.csv, and the load factor of each.
fn rows(out: &Path) -> Vec<(usize, f64)> {
    let text = std::fs::read_to_string(out.join("history.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        (cells[1].parse().unwrap(), cells[2].parse().unwrap())
    };
    text.lines().skip(1).map(row).collect()
}

/// Times of the .pvd, each once.
fn times(collection: &Path) -> Vec<usize> {
    let text = std::fs::read_to_string(collection).unwrap();
    let time = |line: &str| line.split('"').nth(1).unwrap().parse().unwrap();
    let mut times: Vec<usize> = text.lines().filter(|line| line.starts_with("<DataSet")).map(time).collect();
    times.dedup();
    times
}

/// Asserts that all tell the same rows, and returns their number and why the run stopped.
#[track_caller]
fn agree(out: &Path, name: &str) -> (usize, String) {
    let rows = rows(out);
    let count: Vec<usize> = (0..rows.len()).collect();
    assert_eq!(rows.iter().map(|row| row.0).collect::<Vec<_>>(), count);
    assert_eq!(rows[0].1, 0.0, "the unloaded state");
    assert_eq!(times(&out.join(format!("{name}.pvd"))), count);
    let text = std::fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["solution"]["rows"], rows.len());
    assert_eq!(summary["solution"]["fields"], rows.len());
    assert_eq!(summary["solution"]["increments"], rows.len() - 1);
    (rows.len(), summary["stopped"].as_str().unwrap_or("").into())
}

/// A folder with the squares in several increments.
fn squares(scene: &Scene) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &structured(3), &structured(5), scene);
    let name = folder.path().join("squares.json");
    std::fs::rename(folder.path().join("scene.json"), name).unwrap();
    folder
}

fn increments(n: usize) -> Scene {
    joined(springs()).step(compression(n))
}

/// The squares with a joint that can carry `friction` of the pressure in shear.
fn slides(friction: f64, push: Step) -> Scene {
    joined(coulomb(1e5, 1e5, friction)).step(push)
}

/// They are pushed sideways by half of the pressure.
fn push() -> Step {
    standing("compression").traction("upper.top", 5.0, -10.0)
}

fn name(folder: &tempfile::TempDir) -> String {
    format!("{}_squares", folder.path().file_name().unwrap().to_string_lossy())
}

#[test]
fn a_run_and_its_files_have_the_same_rows() {
    let folder = squares(&increments(4));
    let output = midplane(folder.path(), &["run", "squares.json", "-o", "out"]);
    assert!(output.status.success());
    assert_eq!(agree(&folder.path().join("out"), &name(&folder)), (5, String::new()));
}

#[test]
fn so_do_those_of_a_run_without_an_equilibrium() {
    // nothing holds it from the first increment on, and from the third of five
    for (scene, kept) in [(slides(0.4, push()), 1), (slides(0.25, push().increments(5)), 1)] {
        let folder = squares(&scene);
        for fields in ["every", "step", "last"] {
            let set = format!("output.fields={fields}");
            let output = midplane(folder.path(), &["run", "squares.json", "-o", "out", "--set", &set]);
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(3), "{said}");
            let out = folder.path().join("out");
            let count = rows(&out).len();
            assert!(count >= kept, "{count} rows");
            let times = times(&out.join(format!("{}.pvd", name(&folder))));
            match fields {
                "every" => assert!(agree(&out, &name(&folder)).1.contains("no equilibrium")),
                // the last of them is there, whatever is stored
                _ => assert_eq!(times.last(), Some(&(count - 1)), "{fields}: {times:?}"),
            }
        }
    }
}

/// The program in a folder, with what it says.
fn start(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Waits until something is so, a minute at most.
fn wait_for(what: &str, is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

#[test]
fn a_signal_ends_a_run_with_what_has_converged() {
    for (sent, code, said) in [
        ("-INT", 130, "stopped by Ctrl-C"),
        ("-TERM", 143, "stopped by SIGTERM"),
        ("-HUP", 129, "stopped by SIGHUP"),
    ] {
        let folder = squares(&increments(20_000));
        let out = folder.path().join("out");
        let child = start(folder.path(), &["run", "squares.json", "-o", "out"]);
        wait_for("no rows", || out.join("history.csv").is_file() && rows(&out).len() > 5);
        signal(&child, sent);
        let ended = child.wait_with_output().unwrap();
        let message = String::from_utf8_lossy(&ended.stderr);
        assert_eq!(ended.status.code(), Some(code), "{message}");
        let (count, stopped) = agree(&out, &name(&folder));
        assert!(count < 20_000, "it had ended by itself");
        let kept = format!("{said}; kept {} increments in out, --resume goes on from there", count - 1);
        assert_eq!(stopped, kept);
        assert!(message.contains(&stopped), "{message}");
    }
}

#[test]
fn signals_that_come_together_are_one_wish() {
    // `timeout` sends two, and so does Linux when the threads of a parent die one after the other; equal ones may be fetched as one
    let folder = squares(&increments(20_000));
    let out = folder.path().join("out");
    let child = start(folder.path(), &["run", "squares.json", "-o", "out"]);
    wait_for("no rows", || out.join("history.csv").is_file() && rows(&out).len() > 5);
    let all = format!("for s in TERM INT HUP TERM INT HUP; do kill -$s {}; done", child.id());
    assert!(Command::new("sh").args(["-c", &all]).stderr(Stdio::null()).status().is_ok());
    let ended = child.wait_with_output().unwrap();
    let (count, stopped) = agree(&out, &name(&folder));
    let by = match ended.status.code() {
        Some(129) => "SIGHUP",
        Some(130) => "Ctrl-C",
        Some(143) => "SIGTERM",
        other => panic!("{other:?}"),
    };
    assert_eq!(
        stopped,
        format!("stopped by {by}; kept {} increments in out, --resume goes on from there", count - 1)
    );
}

#[test]
fn an_increment_under_way_is_left_at_once() {
    // one increment of thousands of parts: viscous steps on a path that snaps, under a tolerance that wants them small
    let [x, y] = ["2.9*load_factor", "-10 + 9*sin(30000*load_factor)^2"];
    let push = standing("compression").traction("upper.top", x, y);
    let folder = squares(&slides(0.3, push).solution("path_tolerance", 1e-12));
    let out = folder.path().join("out");
    let child = start(folder.path(), &["run", "squares.json", "-o", "out"]);
    wait_for("no rows", || out.join("history.csv").is_file());
    std::thread::sleep(Duration::from_millis(200));
    signal(&child, "-INT");
    let ended = child.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130), "{}", String::from_utf8_lossy(&ended.stderr));
    // the last equilibrium has a row of its own, and the increment was not finished
    let (count, _) = agree(&out, &name(&folder));
    assert_eq!(count, 2);
    let reached = rows(&out)[1].1;
    assert!(0.0 < reached && reached < 1.0, "{reached}");
}

#[cfg(unix)]
#[test]
fn the_mesher_ends_with_the_run() {
    use std::os::unix::fs::PermissionsExt;
    let folder = squares(&increments(1));
    let fake = folder.path().join("slow_gmsh");
    std::fs::write(
        &fake,
        "#!/bin/sh\nif [ \"$1\" = --version ]; then echo 4.8.4; exit; fi\nsleep 600 &\necho $$ $! > pid\nwait\n",
    )
    .unwrap();
    std::fs::set_permissions(&fake, std::fs::Permissions::from_mode(0o755)).unwrap();
    let arguments = ["run", "squares.json", "-o", "out", "--trust-geo", "--gmsh", "./slow_gmsh"];
    let child = start(folder.path(), &arguments); // which writes where it is
    let pid = || std::fs::read_to_string(folder.path().join("pid")).unwrap_or_default().trim().to_string();
    wait_for("the mesher has not begun", || pid().contains(' '));
    signal(&child, "-TERM");
    let ended = child.wait_with_output().unwrap();
    let message = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(143), "{message}");
    assert!(message.contains("stopped by SIGTERM; nothing was written"), "{message}");
    assert!(!folder.path().join("out").exists());
    let goes_on = |id: &str| {
        let text = std::fs::read_to_string(format!("/proc/{id}/stat")).unwrap_or_default();
        !text.is_empty() && !text.contains(") Z ") // one that has ended may wait for its parent
    };
    wait_for("the mesher or its child goes on", || !pid().split_whitespace().any(goes_on));
}
