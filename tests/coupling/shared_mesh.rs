//! Claim: one conforming mesh of several physical surfaces opens into subdomains with their own copies of the common
//! nodes; every curve restricted to a subdomain is its boundary, with the subdomain on its left.
//!
//! ```text
//!   ┌─────┬───────┐     surfaces "west" and "east" of one .geo, curve "middle" between them
//!   │west │ east  │
//!   └─────┴───────┘     0 ≤ x ≤ 1 ≤ 3, 0 ≤ y ≤ 1
//! ```

use std::path::Path;
use std::process::{Command, Output};

use crate::common::mesh_text::{area, edges, keeps_its_promises};
use crate::common::{Scene, even, geometry, rectangle, step};
use midplane::mesh::{Group, Mesh};
use midplane::shape::Shape;

/// A strip of 2 × 3 cells whose first column is "west" and the rest "east", with the curve between as "middle".
fn strip(shape: Shape) -> Mesh {
    let mut mesh = rectangle(&[0.0, 1.0, 3.0], &even(0.0, 1.0, 3), shape, |x, y| [x, y]);
    let x = |c: usize| {
        let nodes = mesh.cells.nodes(c);
        nodes.iter().map(|&node| mesh.points[node][0]).sum::<f64>() / nodes.len() as f64
    };
    let (west, east): (Vec<usize>, Vec<usize>) = (0..mesh.cells.len()).partition(|&c| x(c) < 1.0);
    let middle = mesh.part(&west).unwrap().boundary().unwrap();
    // the boundary of the western part, in numbers of the whole
    let number = |p: [f64; 3]| mesh.points.iter().position(|q| *q == p).unwrap();
    let part = mesh.part(&west).unwrap();
    let middle =
        middle.into_iter().filter(|edge| edge.nodes().iter().all(|&node| part.points[node][0] == 1.0));
    let middle = middle.map(|edge| {
        let mut facet = edge.renumbered(|node| number(part.points[node]));
        (facet.cell, facet.boundary) = (west[edge.cell], false);
        facet
    });
    let middle = middle.collect();
    mesh.groups.insert("middle".into(), Group::Edges(middle));
    mesh.groups.insert("west".into(), Group::Cells(west));
    mesh.groups.insert("east".into(), Group::Cells(east));
    mesh
}

#[test]
fn a_part_has_its_own_nodes_and_its_own_side_of_a_common_curve() {
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8] {
        let whole = strip(shape);
        let mut points = 0;
        for (name, size, upwards) in [("west", 1.0, true), ("east", 2.0, false)] {
            let Group::Cells(cells) = &whole.groups[name] else { panic!("no surface") };
            let part = whole.part(cells).unwrap();
            keeps_its_promises(&part);
            assert!((area(&part) - size).abs() < 1e-14, "{shape:?} {name}");
            let middle = edges(&part, "middle");
            assert_eq!(middle.len(), 3);
            for edge in middle {
                let places: Vec<[f64; 3]> = edge.nodes().iter().map(|&node| part.points[node]).collect();
                let [start, end] = [places[0], places[1]];
                assert!(edge.boundary && places.iter().all(|place| place[0] == 1.0));
                // with the body on the left the eastern boundary runs up and the western one down
                assert_eq!(end[1] > start[1], upwards, "{shape:?} {name}");
                assert_eq!(edge.shape.is_quadratic(), shape.is_quadratic());
            }
            assert_eq!(part.groups.contains_key("left"), name == "west");
            assert_eq!(part.groups.contains_key("right"), name == "east");
            assert_eq!(part.groups.contains_key("corner"), name == "west");
            assert!(matches!(&part.groups[name], Group::Cells(own) if own.len() == part.cells.len()));
            points += part.points.len();
        }
        let common = if shape.is_quadratic() { 7 } else { 4 };
        assert_eq!(points, whole.points.len() + common, "{shape:?}: nodes of the common curve are doubled");
    }
}

const GEO: &str = "DefineConstant[ n = 4 ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {3, 0, 0};
Point(4) = {0, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {3, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
Transfinite Curve{1 : 7} = n + 1;
Physical Surface(\"west\") = {1}; Physical Surface(\"east\") = {2};
Physical Curve(\"left\") = {6}; Physical Curve(\"right\") = {3}; Physical Curve(\"middle\") = {7};
Physical Curve(\"bottom\") = {1, 2}; Physical Point(\"foot\") = {2};
";

const SCENE: &str = r#"{
  "plane": "stress",
  "subdomains": {
    "west": { "geo": "blocks.geo", "surface": "west", "material": "rock" },
    "east": { "geo": "blocks.geo", "surface": "east", "material": "rock" }
  },
  "materials": { "rock": { "young": 1e4, "poisson": 0.3 } },
  "interfaces": {
    "joint": {
      "side_a": "west.middle", "side_b": "east.middle",
      "law": { "type": "elastic", "normal_stiffness": 1e5, "tangential_stiffness": 1e5 }
    }
  },
  "steps": [ {
    "name": "tension",
    "fix": { "west.left": ["x"], "west.bottom": ["y"], "east.bottom": ["y"] },
    "load": { "east.right": { "traction": [5.0, 0.0] } }
  } ],
  "output": { "history": {
    "left_of_it": "west.middle.displacement_x", "right_of_it": "east.middle.displacement_x",
    "foot": "east.foot.displacement_x", "end": "east.right.displacement_x", "t": "joint.traction_n@0.5"
  } }
}
"#;

fn midplane(folder: &Path, scene: &str, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("blocks.geo"), GEO).unwrap();
    std::fs::write(folder.join("scene.json"), scene).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

/// u = σ x/E, and 5 MPa / K_N more on the other side of the interface.
#[test]
fn a_conforming_mesh_opens_into_a_matched_interface_and_is_meshed_once() {
    let by_name = SCENE.to_string();
    let between = SCENE
        .replace(r#""side_a": "west.middle", "side_b": "east.middle""#, r#""between": ["w*", "e*"]"#)
        .replace("joint.traction", "joint~west~east.traction");
    for scene in [by_name, between] {
        let folder = tempfile::tempdir().unwrap();
        let output = midplane(folder.path(), &scene, &["run", ".", "-o", "out"]);
        let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{err}");
        assert!(err.is_empty(), "{err}");
        assert_eq!((out.matches("meshed ").count(), out.matches("blocks ").count()), (1, 1), "{out}");
        assert_eq!(std::fs::read_dir(folder.path().join("out/mesh")).unwrap().count(), 2, "and its checksum");
        assert!(out.contains("4:4 edges, 4 segments"), "{out}");
        let history = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let row: Vec<f64> =
            history.lines().last().unwrap().split(',').skip(5).take(5).map(|v| v.parse().unwrap()).collect();
        let (strain, opening) = (5.0 / 1e4, 5.0 / 1e5);
        for (got, exact) in
            row.iter().zip([strain, strain + opening, strain + opening, 3.0 * strain + opening, 5.0])
        {
            assert!((got / exact - 1.0).abs() < 1e-10, "{row:?}");
        }
        let name = if scene.contains("between") { "joint~west~east" } else { "joint" };
        assert!(folder.path().join(format!("out/fields/{name}_0001.vtu")).is_file());
        assert!(folder.path().join(format!("out/midplane/{name}.vtu")).is_file());
    }
}

#[test]
fn surfaces_that_do_not_fit_are_refused_by_name() {
    for (from, to, expected) in [
        (
            r#""surface": "east""#,
            r#""surface": "eats""#,
            "scene.json:5 subdomains.east.surface: no surface \"eats\" in blocks.geo; there is west, east. Did you mean",
        ),
        (
            r#""surface": "east""#,
            r#""surface": "middle""#,
            "subdomains.east.surface: \"middle\" of blocks.geo is a curve, not a surface; there is west, east",
        ),
        (
            r#""surface": "east""#,
            r#""surface": "west""#,
            "subdomains.east.surface: \"west\" is the surface \"west\" of blocks.geo already; give each its own",
        ),
        (
            r#""surface": "east", "#,
            "",
            "scene.json:5 subdomains.east: \"west\" and \"east\" are the same bodies of blocks.geo; give each its own",
        ),
        (
            r#""west.left": ["x"]"#,
            r#""west.right": ["x"]"#,
            "steps.0.fix.west.right: no group \"right\" on surface \"west\" of blocks.geo; there is foot, left, middle, bottom, west",
        ),
    ] {
        assert!(SCENE.contains(from), "{from}");
        let folder = tempfile::tempdir().unwrap();
        let output = midplane(folder.path(), &SCENE.replacen(from, to, 1), &["check", ".", "-o", "out"]);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn a_surface_that_nobody_takes_is_told_and_one_that_two_take_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let west = geometry("blocks.geo", "rock").with("surface", "west");
    let alone = Scene::new("stress").body("west", west).material("rock", 1e4, 0.3);
    let alone = alone.step(step("rest").fix("west", "xy")).to_string();
    let output = midplane(folder.path(), &alone, &["check", ".", "-o", "out"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    assert!(
        message.contains("blocks-") && message.contains("no subdomain takes surface \"east\""),
        "{message}"
    );

    let overlapping = GEO.replace("Physical Point", "Physical Surface(\"both\") = {1, 2}; Physical Point");
    std::fs::write(folder.path().join("both.geo"), overlapping).unwrap();
    let scene =
        SCENE.replace("blocks.geo", "both.geo").replace(r#""surface": "east""#, r#""surface": "both""#);
    let output = midplane(folder.path(), &scene, &["check", ".", "-o", "other"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("subdomains.east.surface: \"both\" and \"west\" share cells, near ("),
        "{message}"
    );
}
