//! Claim: a geometry from a stranger starts nothing, writes nothing outside the results folder, reads nothing outside the folder of
//! its scene, ends within the limits, and sends no control character to the terminal; what is refused says why.
//!
//! Every `.geo` in tests/hostile says what it must not do, and words that the refusal must have.

#![cfg(target_os = "linux")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use crate::common::squares::{SCENE, structured, write};

const SECRET: &str = "TOP-SECRET-4711";

/// A scene in a folder beside another that is none of its business.
struct Stage {
    root: tempfile::TempDir,
}

impl Stage {
    fn new(geo: &[u8]) -> Stage {
        let root = tempfile::tempdir().unwrap();
        let path = |name: &str| root.path().join(name);
        for folder in ["scene/inside", "outside/home"] {
            std::fs::create_dir_all(path(folder)).unwrap();
        }
        write(&path("scene"), &structured(3), &structured(5), SCENE);
        let square = std::fs::read(path("scene/lower.geo")).unwrap();
        let mut text = Vec::new();
        // bytes that are no text stay as they are
        for line in geo.split_inclusive(|byte| *byte == b'\n') {
            match std::str::from_utf8(line) {
                Ok("//@SQUARE@\n") => text.extend(&square),
                Ok(line) => {
                    let line = line.replace("@OUTSIDE@", &path("outside").display().to_string());
                    let line = line.replace("@SCENE@", &path("scene").display().to_string());
                    text.extend(line.replace("@LONG@", &"y".repeat(1_000_000)).into_bytes());
                }
                Err(_) => text.extend(line),
            }
        }
        std::fs::write(path("scene/lower.geo"), text).unwrap();
        let command = format!("SystemCall \"touch {}/mark\";\n", path("outside").display());
        std::fs::write(path("scene/inside/command.geo"), &command).unwrap();
        if geo.windows(13).any(|word| word == b"lower.geo.opt") {
            std::fs::write(path("scene/lower.geo.opt"), format!("Mesh.Algorithm = 6;\n{command}")).unwrap();
        }
        std::fs::write(path("outside/secret.geo"), format!("Error(\"{SECRET}\");\n{SECRET}\n")).unwrap();
        std::fs::write(path("outside/secret.step"), format!("{SECRET}\n")).unwrap();
        std::fs::write(path("outside/victim.txt"), "mine\n").unwrap();
        std::os::unix::fs::symlink(path("outside/secret.geo"), path("scene/link.geo")).unwrap();
        Stage { root }
    }

    fn run(&self, more: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_midplane"))
            .current_dir(self.root.path().join("scene"))
            .args(["run", ".", "-o", "../out", "--gmsh-limit", "5", "--gmsh-memory", "1"])
            .args(more)
            .env("SECRET_KEY", SECRET)
            .env("HOME", self.root.path().join("outside/home"))
            .output()
            .unwrap()
    }

    /// Everything but the results, with what is in it.
    fn all(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        contents(self.root.path()).into_iter().filter(|(path, _)| !path.starts_with("out")).collect()
    }
}

/// The files and folders below a folder.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = path.strip_prefix(folder).unwrap().to_path_buf();
            if path.is_dir() && !path.is_symlink() {
                found.insert(name, Vec::new());
                open.push(path);
            } else {
                found.insert(name, std::fs::read(&path).unwrap_or_default());
            }
        }
    }
    found
}

/// Processes that hang on to a folder.
fn left_in(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir("/proc").unwrap().flatten() {
        let Ok(here) = std::fs::read_link(entry.path().join("cwd")) else { continue };
        if here.starts_with(folder) {
            let line = std::fs::read(entry.path().join("cmdline")).unwrap_or_default();
            found.push(String::from_utf8_lossy(&line).replace('\0', " "));
        }
    }
    found
}

/// The fault of what a geometry has done, if there is one.
fn fault(name: &str, geo: &[u8]) -> Option<String> {
    let stage = Stage::new(geo);
    let (before, begun) = (stage.all(), Instant::now());
    let output = stage.run(&[]);
    let took = begun.elapsed();
    let said = [&output.stdout[..], &output.stderr].concat();
    let text = String::from_utf8_lossy(&said).into_owned();
    let head = String::from_utf8_lossy(geo).into_owned();
    let wanted = head.lines().find_map(|line| line.strip_prefix("// says: "));
    println!("{name:<26} {:?} {:>5.1} s  {}", output.status.code(), took.as_secs_f64(), first_error(&output));
    let after = stage.all();
    if before != after {
        let other = after.keys().chain(before.keys()).filter(|path| before.get(*path) != after.get(*path));
        return Some(format!("it has changed {:?}", other.collect::<Vec<_>>()));
    }
    let left = left_in(stage.root.path());
    if !left.is_empty() {
        return Some(format!("it has left {left:?}"));
    }
    let results = contents(&stage.root.path().join("out"));
    let tells = |bytes: &[u8]| String::from_utf8_lossy(bytes).contains(SECRET);
    if tells(&said) || results.values().any(|bytes| tells(bytes)) {
        return Some(format!("it tells the secret: {text}"));
    }
    if let Some(c) = text.chars().find(|c| c.is_control() && !"\n\t".contains(*c)) {
        return Some(format!("it sends {c:?} to the terminal"));
    }
    if text.len() > 20_000 {
        return Some(format!("{} bytes are printed", text.len()));
    }
    if took > Duration::from_secs(15) {
        return Some(format!("it takes {took:?}"));
    }
    match (output.status.code(), wanted) {
        (Some(2 | 4), Some(words)) if !text.contains(words) => {
            Some(format!("it does not say {words:?}: {text}"))
        }
        (Some(2 | 4), _) if !text.contains("error: ") => Some(format!("it does not say why: {text}")),
        (Some(0), Some(words)) => Some(format!("it is not refused with {words:?}")),
        (Some(0 | 2 | 4), _) => None,
        (other, _) => Some(format!("exit code {other:?}: {text}")),
    }
}

fn first_error(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let line = text.lines().find(|line| line.starts_with("error: ")).unwrap_or("").to_string();
    line.chars().take(150).collect()
}

#[test]
fn every_hostile_geometry_is_contained_and_says_why() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile");
    let mut geos: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    geos.sort();
    assert!(geos.len() >= 40, "{} geometries", geos.len());
    let faults: Vec<String> = geos
        .iter()
        .filter_map(|geo| {
            let name = geo.file_stem().unwrap().to_string_lossy().into_owned();
            fault(&name, &std::fs::read(geo).unwrap()).map(|fault| format!("{name}: {fault}"))
        })
        .collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

/// Without confinement they do what they say: what keeps them from it is seen to be missing.
#[test]
fn a_geometry_that_is_trusted_does_what_it_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/hostile");
    for name in [
        "print",
        "save_over_scene",
        "printf_append",
        "create_dir",
        "view_save",
        "system_call",
        "merged_command",
    ] {
        let stage = Stage::new(&std::fs::read(folder.join(format!("{name}.geo"))).unwrap());
        let before = stage.all();
        stage.run(&["--trust-geo"]);
        let mut after = stage.all();
        after.retain(|path, _| !path.display().to_string().contains(".fltk")); // gmsh itself, at home
        assert!(before != after, "{name} does nothing");
    }
    for name in ["include_outside", "include_computed", "merge_outside", "get_env"] {
        let stage = Stage::new(&std::fs::read(folder.join(format!("{name}.geo"))).unwrap());
        let output = stage.run(&["--trust-geo"]);
        let text = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(text.contains(SECRET), "{name} tells nothing: {text}");
    }
}

#[test]
fn ordinary_geometries_work_as_before() {
    let square = structured(3).replace('@', "0");
    // what a good geometry does: files inside the folder, OpenCASCADE, a size field, prints
    for more in [
        "Include \"inside/sizes.geo\";",
        "Merge \"inside/sizes.geo\";",
        "Printf(\"edges %g\", 3);",
        "SetFactory(\"OpenCASCADE\");",
    ] {
        let stage = Stage::new(format!("{more}\n{square}").as_bytes());
        std::fs::write(stage.root.path().join("scene/inside/sizes.geo"), "h = 1;\n").unwrap();
        let output = stage.run(&[]);
        assert!(output.status.success(), "{more}: {}", String::from_utf8_lossy(&output.stderr));
    }
    // a folder outside, listed; and a geometry that is trusted
    let secret = "Include \"@OUTSIDE@/sizes.geo\";\n//@SQUARE@\n";
    let stage = Stage::new(secret.as_bytes());
    std::fs::write(stage.root.path().join("outside/sizes.geo"), "h = 1;\n").unwrap();
    assert_eq!(stage.run(&[]).status.code(), Some(2));
    for more in [&["--geo-path", "../outside"][..], &["--trust-geo"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
        command.current_dir(stage.root.path().join("scene")).args(["run", ".", "-o", "../out"]).args(more);
        let output = command.output().unwrap();
        assert!(output.status.success(), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}
