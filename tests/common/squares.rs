//! Two unit squares on each other under pressure, as a user writes them, and the program run on them.
//!
//! ```text
//!   p p p p p
//!  ┌─────────┐  y = 2     top = −p (2/E + 1/K_N), whatever the meshes
//!  │  upper  │
//!  ├─────────┤  y = 1     interface: lower.top, upper.bottom
//!  │  lower  │
//!  └─────────┘  y = 0     corner: the left end of the bottom
//! ```

use std::fmt::Display;
use std::path::Path;
use std::process::{Command, Output};

use super::{Law, Scene, Step, elastic, faces, geometry, step};

/// A square of triangles; `@` is the height of its bottom.
pub const SQUARE: &str = "DefineConstant[ n = {3, Name \"edges\"} ];
Point(1) = {0, @, 0}; Point(2) = {1, @, 0}; Point(3) = {1, @ + 1, 0}; Point(4) = {0, @ + 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {2, 4} = 3;
Physical Point(\"corner\") = {1};
Physical Curve(\"bottom\") = {1}; Physical Curve(\"top\") = {3};
Physical Surface(\"body\") = {1};
";

/// Commands that make it n × 2 quadrilaterals.
const STRUCTURED: &str = "Transfinite Surface {1}; Recombine Surface {1};\n";

/// The scene as a user writes it.
pub const SCENE: &str = r#"{
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
  } ],
  "output": { "history": { "top": "upper.top.displacement_y" } }
}
"#;

/// The same two squares with any law between them, before their step.
pub fn joined(law: Law) -> Scene {
    Scene::new("strain")
        .body("lower", geometry("lower.geo", "rock"))
        .body("upper", geometry("upper.geo", "rock"))
        .material("rock", 1e4, 0.0)
        .interface("joint", faces("lower.top", "upper.bottom").law(law))
        .probe("top", "upper.top.displacement_y")
}

/// The springs between them.
pub fn springs() -> Law {
    elastic(1e7, 1e7)
}

/// A step in which they stand on rollers.
pub fn standing(name: &str) -> Step {
    step(name).fix("lower.bottom", "y").fix("lower.corner", "x")
}

/// Their step, in increments.
pub fn compression(increments: usize) -> Step {
    standing("compression").increments(increments).pressure("upper.top", 10.0)
}

/// A square of n × 2 quadrilaterals.
pub fn structured(n: usize) -> String {
    format!("{SQUARE}{STRUCTURED}").replace("n = {3", &format!("n = {{{n}"))
}

/// A text with its one change, which must be one.
pub fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "no {from} in\n{text}");
    text.replacen(from, to, 1)
}

/// Writes a scene folder.
pub fn write(folder: &Path, lower: &str, upper: &str, scene: impl Display) {
    std::fs::write(folder.join("lower.geo"), lower.replace('@', "0")).unwrap();
    std::fs::write(folder.join("upper.geo"), upper.replace('@', "1")).unwrap();
    std::fs::write(folder.join("scene.json"), scene.to_string()).unwrap();
}

/// Runs the program in a folder.
pub fn midplane(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

/// Asserts that the top has come down as far as the closed form says, by the last row of the history in `out`.
#[track_caller]
pub fn assert_shortened(folder: &Path, what: &str) {
    let history = std::fs::read_to_string(folder.join("out/history.csv")).unwrap();
    let top: f64 = history.lines().last().unwrap().split(',').nth(5).unwrap().parse().unwrap();
    let exact = -10.0 * (2.0 / 1e4 + 1.0 / 1e7);
    assert!((top / exact - 1.0).abs() < 1e-10, "{what}: {top}, exact {exact}");
}

/// A folder with the two squares and this scene.
pub fn squares(scene: impl Display) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &structured(3), &structured(5), scene);
    folder
}

/// The program's words on standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
