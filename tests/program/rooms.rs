//! Claim: a room imports only rooms above it in the table, nothing inside a room runs in circles, a type has one name of its
//! own, every file opens with a line that says what it is, and every file of tests with a claim that its program names.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The rooms from top to bottom: each may import those before it.
const ROOMS: [&str; 18] = [
    "error",
    "files",
    "sparse",
    "shape",
    "water",
    "law",
    "scene",
    "mesh",
    "coupling",
    "continuum",
    "assembly",
    "solver",
    "problem",
    "output",
    "history",
    "run",
    "study",
    "cli",
];

/// The sources by their path below `src`, without the tests at their ends, which may look further.
fn sources() -> BTreeMap<PathBuf, String> {
    fn collect(folder: &Path, below: &Path, found: &mut BTreeMap<PathBuf, String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = below.join(path.file_name().unwrap());
            if path.is_dir() {
                collect(&path, &name, found);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                found.insert(name, text.split("#[cfg(test)]").next().unwrap().to_string());
            }
        }
    }
    let mut found = BTreeMap::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), Path::new(""), &mut found);
    found
}

/// The characters of a name at the start of a text.
fn name(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
    &text[..end]
}

#[test]
fn imports_go_one_way() {
    let mut seen = BTreeSet::new();
    for (path, text) in sources() {
        let room = path.iter().next().unwrap().to_string_lossy();
        let room = room.trim_end_matches(".rs").to_string();
        let Some(rank) = ROOMS.iter().position(|r| *r == room) else {
            let known = ["lib", "main"].contains(&room.as_str());
            assert!(known, "{} is in no room of the table", path.display());
            continue;
        };
        seen.insert(room);
        for (at, _) in text.match_indices("crate::") {
            let other = name(&text[at + 7..]);
            let place = ROOMS.iter().position(|r| *r == other);
            let place = place.unwrap_or_else(|| {
                panic!(
                    "{} imports crate::{other}, which is no room (one `use` per room, please)",
                    path.display()
                )
            });
            assert!(place <= rank, "{} imports {other}, which is below it", path.display());
        }
    }
    for room in ROOMS {
        assert!(seen.contains(room), "the room {room} is empty");
    }
}

#[test]
fn every_file_opens_with_what_it_is() {
    for (path, text) in sources() {
        assert!(text.starts_with("//! "), "{}", path.display());
    }
}

/// Files whose business is the plane: shapes, lines of interfaces, elements, and a law's way with one tangent.
const KERNELS: [&str; 4] = ["shape/", "coupling/line/", "continuum/", "law/coulomb/"];

/// Lines that write the plane into types or loops: pairs of numbers in public types, and a literal number of components.
fn plane(text: &str) -> Vec<String> {
    let pair = |line: &&str| {
        let line = line.trim_start();
        let variant = line.starts_with(char::is_uppercase) && (line.contains('(') || line.contains('{'));
        let public = line.starts_with("pub ") && !line.contains("fn ");
        (public || variant) && line.contains("[f64; 2]")
    };
    let signature = |line: &&str| {
        let line = line.trim_start();
        line.starts_with("pub fn ") && line.contains("[f64; 2]")
    };
    let literal = |line: &&str| {
        let forms = [
            "components: 2",
            "chunks_exact(2)",
            "chunks_exact_mut(2)",
            "2 * node +",
            "2 * dof",
            "2 * p +",
            "dofs / 2",
        ];
        forms.iter().any(|form| line.contains(form))
    };
    let found = text.lines().filter(|line| pair(line) || signature(line) || literal(line));
    found.map(|line| line.trim().to_string()).collect()
}

#[test]
fn the_plane_is_data_outside_kernels() {
    for (path, text) in sources() {
        let path = path.to_string_lossy();
        if KERNELS.iter().any(|kernel| path.starts_with(kernel)) {
            continue;
        }
        let found = plane(&text);
        assert!(
            found.is_empty(),
            "{path} has the plane in {found:?}; `Ends` are intervals, `Local` is (n, t, s)"
        );
    }
}

#[test]
fn the_plane_is_found() {
    for line in [
        "    pub at: [f64; 2],",
        "    Uniform([f64; 2]),",
        "pub type Pair = Vec<[f64; 2]>;",
        "    pub fn at(&self, x: [f64; 2]) -> f64 {",
        "        components: 2,",
        "let jumps = jumps.chunks_exact(2);",
        "let dof = 2 * node + d;",
    ] {
        assert_eq!(plane(line), [line.trim()]);
    }
    let allowed =
        "    pub at: [f64; 3],\n    ends: [f64; 2],\n    pub s: Ends,\n    let c = 2 * nodes.len();";
    assert!(plane(allowed).is_empty());
}

/// The modules of the crate: their names from the root, and their files.
struct Modules {
    texts: BTreeMap<PathBuf, String>,
    files: BTreeMap<Vec<String>, PathBuf>,
}

impl Modules {
    fn new() -> Modules {
        let texts = sources();
        let files = texts.keys().map(|file| (module(file), file.clone())).collect();
        Modules { texts, files }
    }

    /// The file of a path of names from the root: that of the module, or of the one that an item is taken from.
    fn file(&self, path: &[String]) -> Option<PathBuf> {
        if let Some(file) = self.files.get(path) {
            return Some(file.clone());
        }
        let (item, parent) = path.split_last()?;
        let file = self.files.get(parent)?;
        // an item that a module hands on is its child's
        for (from, _) in imports(&self.texts[file], &["use ", "pub use ", "pub(super) use "], parent) {
            if from.last() == Some(item) && from.len() > parent.len() + 1 && from.starts_with(parent) {
                return self.file(&from);
            }
        }
        Some(file.clone())
    }
}

/// The module of a file.
fn module(file: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        file.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if names.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
        names.pop();
    }
    names
}

/// Every path that a text imports by one of these words, from the root, and whether it is handed on.
fn imports(text: &str, words: &[&str], own: &[String]) -> Vec<(Vec<String>, bool)> {
    let mut found = Vec::new();
    let statements = text.split(';').map(|statement| {
        let lines = statement.lines().filter(|line| !line.trim_start().starts_with("//"));
        lines.collect::<Vec<_>>().join(" ").trim().to_string()
    });
    for statement in statements {
        let Some(word) = words.iter().find(|word| statement.starts_with(**word)) else { continue };
        let mut flat = Vec::new();
        flatten(&statement[word.len()..].replace(' ', ""), "", &mut flat);
        for path in flat {
            let mut names: Vec<String> = path.split("::").map(str::to_string).collect();
            let base: Vec<String> = match names[0].as_str() {
                "crate" => Vec::new(),
                "super" => {
                    let ups = names.iter().take_while(|name| *name == "super").count();
                    names.drain(..ups - 1);
                    own[..own.len().saturating_sub(ups)].to_vec()
                }
                "self" => own.to_vec(),
                _ => {
                    names.insert(0, String::new());
                    own.to_vec()
                }
            };
            names.remove(0);
            names.retain(|name| name != "self" && name != "*");
            found.push(([base, names].concat(), word.starts_with("pub")));
        }
    }
    found
}

/// `a::{b, c::d}` as `a::b` and `a::c::d`.
fn flatten(text: &str, before: &str, found: &mut Vec<String>) {
    let Some(open) = text.find('{') else {
        found.push(format!("{before}{text}"));
        return;
    };
    let (head, inner) = (format!("{before}{}", &text[..open]), &text[open + 1..text.rfind('}').unwrap()]);
    let (mut depth, mut start) = (0, 0);
    for (at, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                flatten(&inner[start..at], &head, found);
                start = at + 1;
            }
            _ => {}
        }
    }
    if start < inner.len() {
        flatten(&inner[start..], &head, found);
    }
}

/// Methods of inherent `impl` blocks by type: name, and the file.
fn methods(texts: &BTreeMap<PathBuf, String>) -> BTreeMap<(String, String), Vec<(String, PathBuf)>> {
    let mut found: BTreeMap<(String, String), Vec<(String, PathBuf)>> = BTreeMap::new();
    for (file, text) in texts {
        let room = file.iter().next().unwrap().to_string_lossy().into_owned();
        let mut of: Option<String> = None;
        for line in text.lines() {
            if line.starts_with("impl") && !line.contains(" for ") {
                let rest = line.strip_prefix("impl").unwrap();
                let rest = if rest.starts_with('<') {
                    &rest[rest.find("> ").map_or(0, |at| at + 2)..]
                } else {
                    rest
                };
                of = Some(name(rest.trim_start()).to_string());
            } else if line.starts_with('}') {
                of = None;
            } else if let (Some(of), Some(at)) = (&of, line.find("fn "))
                && line.starts_with("    ")
                && !line.starts_with("     ")
            {
                let method = name(&line[at + 3..]).to_string();
                found.entry((room.clone(), of.clone())).or_default().push((method, file.clone()));
            }
        }
    }
    found
}

#[test]
fn nothing_inside_a_room_runs_in_circles() {
    let modules = Modules::new();
    let mut arrows: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    let mut add = |from: &Path, to: PathBuf| {
        if to != from {
            arrows.entry(from.into()).or_default().insert(to);
        }
    };
    for (file, text) in &modules.texts {
        let own = module(file);
        for (path, handed_on) in imports(text, &["use ", "pub use ", "pub(super) use "], &own) {
            // the face of a room hands on what its children have
            if !(handed_on && file.ends_with("mod.rs"))
                && path.first() == own.first()
                && let Some(to) = modules.file(&path)
            {
                add(file, to);
            }
        }
    }
    // methods of one type that stand in several files tie those that call them to those that have them
    for ((room, _), methods) in methods(&modules.texts) {
        let files: BTreeSet<&PathBuf> = methods.iter().map(|(_, file)| file).collect();
        for from in &files {
            let text = &modules.texts[*from];
            for (method, to) in &methods {
                let here = methods.iter().any(|(other, file)| other == method && file == *from);
                if to != *from && !here && text.contains(&format!("self.{method}(")) {
                    assert!(to.starts_with(&room));
                    add(from, to.clone());
                }
            }
        }
    }
    if let Some(circle) = circle(&arrows) {
        panic!("a circle: {circle:?}");
    }
}

/// Files that import each other in a loop, if there are any.
fn circle(arrows: &BTreeMap<PathBuf, BTreeSet<PathBuf>>) -> Option<Vec<PathBuf>> {
    fn visit(
        at: &Path,
        arrows: &BTreeMap<PathBuf, BTreeSet<PathBuf>>,
        way: &mut Vec<PathBuf>,
        done: &mut BTreeSet<PathBuf>,
    ) -> Option<Vec<PathBuf>> {
        if let Some(start) = way.iter().position(|file| file == at) {
            return Some(way[start..].to_vec());
        }
        if done.contains(at) {
            return None;
        }
        way.push(at.into());
        for to in arrows.get(at).into_iter().flatten() {
            if let Some(circle) = visit(to, arrows, way, done) {
                return Some(circle);
            }
        }
        way.pop();
        done.insert(at.into());
        None
    }
    let mut done = BTreeSet::new();
    arrows.keys().find_map(|file| visit(file, arrows, &mut Vec::new(), &mut done))
}

#[test]
fn a_circle_is_found() {
    let text = "//! x\nuse super::{b::{B, C}, d};\nuse crate::law::Law;\npub use e::F;\n";
    let own = ["room".to_string(), "a".to_string()];
    let found = imports(text, &["use ", "pub use "], &own);
    let path = |text: &str| text.split("::").map(str::to_string).collect::<Vec<_>>();
    let expected = [
        ("room::b::B", false),
        ("room::b::C", false),
        ("room::d", false),
        ("law::Law", false),
        ("room::a::e::F", true),
    ];
    assert_eq!(found, expected.map(|(text, handed_on)| (path(text), handed_on)));
    let arrows =
        [("a", "b"), ("b", "c"), ("c", "b")].map(|(from, to)| (from.into(), BTreeSet::from([to.into()])));
    assert_eq!(circle(&arrows.into_iter().collect()), Some(vec!["b".into(), "c".into()]));
}

#[test]
fn a_type_has_a_name_of_its_own() {
    let mut owners: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for (file, text) in sources() {
        // associated types of traits are indented
        for line in text.lines().filter(|line| !line.starts_with(' ')) {
            let line = line.strip_prefix("pub").map_or(line, |rest| {
                let rest = if rest.starts_with('(') { &rest[rest.find(')').unwrap() + 1..] } else { rest };
                rest.trim_start()
            });
            if let Some(rest) =
                ["struct ", "enum ", "trait ", "type "].iter().find_map(|kind| line.strip_prefix(kind))
            {
                owners.entry(name(rest).into()).or_default().push(file.clone());
            }
        }
    }
    owners.retain(|_, files| files.len() > 1);
    assert!(owners.is_empty(), "{owners:#?}");
}

/// Programs of tests: the name, its files by name and text, and the contents at its head.
fn programs() -> Vec<(String, BTreeMap<String, String>, String)> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let stem = |path: &Path| path.file_stem().unwrap().to_string_lossy().into_owned();
    let paths = |folder: &Path| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let own = |folder: &Path| {
        let files = paths(folder).filter(|path| path.extension().is_some_and(|kind| kind == "rs"));
        files.filter(|path| stem(path) != "main").map(|path| (stem(&path), read(&path))).collect()
    };
    // the crates below tests are no programs of this one
    let folders =
        paths(&tests).filter(|path| path.join("main.rs").is_file() && !path.join("Cargo.toml").is_file());
    folders.map(|folder| (stem(&folder), own(&folder), read(&folder.join("main.rs")))).collect()
}

/// Faults of a file of tests: it has no claim at its head, or the contents of its program do not name it.
fn unclaimed(name: &str, text: &str, contents: &str) -> Vec<&'static str> {
    let claims = text.starts_with("//! Claim: ") || text.starts_with("//! Claim (");
    let named = contents.lines().any(|line| line.starts_with(&format!("//! - `{name}`: ")));
    let faults = [(!claims, "opens with no claim"), (!named, "is not in the contents of its main.rs")];
    faults.into_iter().filter(|(is, _)| *is).map(|(_, fault)| fault).collect()
}

#[test]
fn every_file_of_tests_opens_with_a_claim_that_its_program_names() {
    let programs = programs();
    assert_eq!(programs.len(), 4);
    for (program, files, contents) in programs {
        for (name, text) in files {
            let faults = unclaimed(&name, &text, &contents);
            assert!(faults.is_empty(), "tests/{program}/{name}.rs {}", faults.join(" and "));
        }
    }
    let contents = "//! - `gap`: faces carry nothing until they meet\n";
    assert!(unclaimed("gap", "//! Claim: faces with a gap carry nothing", contents).is_empty());
    assert_eq!(unclaimed("gaps", "//! Faces with a gap", contents).len(), 2);
}

#[test]
fn every_file_of_tests_is_run() {
    for (program, files, contents) in programs() {
        for (name, _) in files {
            let runs = contents.contains(&format!("\nmod {name};\n"));
            assert!(runs, "tests/{program}/main.rs has no `mod {name};`");
        }
    }
}

/// Mentions of a type of law by name.
fn named_laws(text: &str) -> Vec<&str> {
    let kinds = ["Law::Elastic", "Law::Coulomb", "Law::Cracking", "Elastic(", "Coulomb(", "Cracking("];
    text.lines().filter(|line| kinds.iter().any(|kind| line.contains(kind))).collect()
}

/// Claim: a law is known by its own file and the list of laws; no other room asks which one it has.
#[test]
fn no_room_asks_which_law_it_has() {
    for (path, text) in sources() {
        let named = named_laws(&text);
        assert!(
            named.is_empty(),
            "{} names {named:?}: `PointLaw` has a question to ask instead",
            path.display()
        );
    }
    assert_eq!(named_laws("if matches!(law, Law::Elastic(_)) {\n}").len(), 1);
}
