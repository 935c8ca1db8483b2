//! Claim: `midplane check` says of every interface what it is, warns of what spoils it, and `--plot` writes it to look at.

use crate::common::squares::{SCENE, compression, joined, midplane, springs, structured, write};
use crate::common::{even, even_block, faces, rectangle};
use midplane::error::Code;
use midplane::shape::Shape;
use tempfile::TempDir;

/// A scene folder with three edges against five.
fn squares() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &structured(3), &structured(5), SCENE);
    folder
}

/// 3 edges against 5: 3 + 5 − 1 segments, three grid cells, K_N h/E = 1e7 · ⅓ / 1e4.
#[test]
fn the_table_has_every_number_of_a_interface() {
    let folder = squares();
    let output = midplane(folder.path(), &["check", ".", "-o", "out"]);
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{err}");
    let row = out.lines().find(|line| line.starts_with("joint ")).unwrap_or_else(|| panic!("{out}"));
    let columns: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(columns, ["joint", "3:5", "0.60", "7", "4", "1.000000", "0.0e0", "0.0e0", "0.0°", "3.33e2"]);
    // the group that no key and no probe names is told, in a check only
    let told = "warning: W09 subdomain upper: nothing uses its group corner\n         help: ";
    assert!(err.starts_with(told) && err.lines().count() == 2, "{err}");
    let run = midplane(folder.path(), &["run", ".", "-o", "out"]);
    assert!(run.status.success() && run.stderr.is_empty(), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(!folder.path().join("out/check").exists());
}

#[test]
fn a_plot_holds_chains_feet_segments_grid_and_law_points() {
    let folder = squares();
    let checks = folder.path().join("out/check");
    assert!(midplane(folder.path(), &["check", ".", "-o", "out", "--plot"]).status.success());
    std::fs::rename(checks.join("joint.vtu"), checks.join("mine.vtu")).unwrap(); // nobody else's to remove
    let output = midplane(folder.path(), &["check", ".", "-o", "out", "--plot"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut names: Vec<_> =
        std::fs::read_dir(&checks).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["joint.vtu", "lower.vtu", "manifest", "mine.vtu", "upper.vtu"]);
    let bytes = std::fs::read(checks.join("joint.vtu")).unwrap();
    let head = String::from_utf8_lossy(&bytes);
    let (edges, segments, cells, law_points) = (3 + 5, 7, 3, 2 * 3);
    let lines = edges + segments * (1 + 4) + cells;
    let expected =
        format!("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", 2 * lines + law_points, lines + law_points);
    assert!(head.contains(&expected), "{expected}\n{}", &head[..800]);
    for array in ["normal", "kind", "number", "edge_a", "edge_b"] {
        assert!(head.contains(&format!("Name=\"{array}\"")), "{array}");
    }
    let lower = std::fs::read(checks.join("lower.vtu")).unwrap();
    assert!(String::from_utf8_lossy(&lower).contains("Name=\"quality\""));
}

/// The warnings of two squares on each other, mapped into the plane.
fn warnings(n: [usize; 2], coupling: &str, place: impl Fn(f64, f64) -> [f64; 2] + Copy) -> Vec<String> {
    let joint = faces("lower.top", "upper.bottom").coupling(coupling).law(springs());
    let scene = joined(springs()).interface("joint", joint).step(compression(1));
    let mesh = |n, y| rectangle(&even(0.0, 1.0, n), &even(y, y + 1.0, 2), Shape::Quadrilateral4, place);
    let problem = scene.bind(vec![mesh(n[0], 0.0), mesh(n[1], 1.0)]).unwrap();
    problem.warnings.iter().map(ToString::to_string).collect()
}

#[test]
fn what_spoils_a_interface_is_warned_of_and_nothing_else() {
    let flat = |x: f64, y: f64| [x, y];
    assert!(warnings([3, 5], "projected", flat).is_empty());
    assert!(warnings([4, 4], "pointwise", flat).is_empty(), "matched");
    let found = warnings([3, 5], "pointwise", flat);
    assert!(found.len() == 1 && found[0].contains("oscillates"), "{found:?}");
    // coordinates near x₀ are multiples of ε x₀ or so: 2.2e-16 · 1e6 / 0.2 = 1.1e-9 of the smallest edge
    let far = warnings([3, 5], "projected", |x, y| [x + 1e6, y]);
    assert!(far.len() == 1, "{far:?}");
    assert!(
        far[0].contains("1.0e6 away from the origin, coordinates resolve 1e-9 of its smallest edge"),
        "{far:?}"
    );
    assert!(warnings([3, 5], "projected", |x, y| [x + 1e3, y]).is_empty());
    assert!(warnings([3, 5], "projected", |x, y| [1e6 * (x + 1.0), 1e6 * y]).is_empty(), "large, not far");
    // leaning so that one angle is α, the scaled Jacobian is sin α
    let leaning = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        warnings([3, 5], "projected", move |x, y| [x + cos * y, sin * y])
    };
    assert!(leaning(18.0).is_empty(), "sin 18° = 0.309");
    let bad = leaning(12.0); // sin 12° = 0.208
    assert_eq!(bad.len(), 2, "{bad:?}");
    assert!(
        bad[0].contains("3 of 3 cells of lower beside it have a scaled Jacobian below 0.3, the worst 0.21"),
        "{bad:?}"
    );
    assert!(bad[1].contains("5 of 5 cells of upper"), "{bad:?}");
}

/// Linear elements in plane strain lock towards ν = 0.5; quadratic ones and plane stress do not.
#[test]
fn elements_that_lock_are_warned_of() {
    let bound = |plane: &str, poisson: f64, shape: Shape| {
        let scene =
            joined(springs()).with("plane", plane).material("rock", 1e4, poisson).step(compression(1));
        let mesh = |n, y| even_block([0.0, 1.0], [y, y + 1.0], [n, 2], shape);
        scene.bind(vec![mesh(3, 0.0), mesh(5, 1.0)]).unwrap().warnings
    };
    for shape in [Shape::Triangle3, Shape::Quadrilateral4] {
        let told = bound("strain", 0.495, shape);
        assert!(told.len() == 2 && told.iter().all(|warning| warning.code == Code::Locking), "{told:?}");
    }
    assert!(bound("strain", 0.495, Shape::Triangle6).is_empty());
    assert!(bound("strain", 0.49, Shape::Quadrilateral4).is_empty());
    assert!(bound("stress", 0.495, Shape::Quadrilateral4).is_empty());
}
