//! Claim: what a user may do to physical groups and meshes works end to end, or one error names the groups and exits 2.

use crate::common::squares;
use std::path::Path;
use std::process::Output;

use crate::common::squares::{SCENE, SQUARE, assert_shortened, changed, write};

fn midplane(folder: &Path, upper: &str, scene: &str, command: &str) -> Output {
    write(folder, SQUARE, upper, scene);
    squares::midplane(folder, &[command, ".", "-o", "out"])
}

/// The one error of a changed geometry and scene.
fn refusal(upper: &str, scene: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = midplane(folder.path(), upper, scene, "run");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(!folder.path().join("out").exists(), "{message}");
    message
}

#[test]
fn b30_groups_that_contradict_each_other_are_refused_naming_both() {
    let upper = |from: &str, to: &str| changed(SQUARE, from, to);
    let scene = |from: &str, to: &str| changed(SCENE, from, to);
    for (case, geo, scene, expected) in [
        (
            "one name in two dimensions, where both could be meant",
            upper("\"corner\"", "\"body\""),
            scene("\"lower.corner\": [\"x\"]", "\"lower.corner\": [\"x\"], \"upper.body\": [\"x\"]"),
            vec!["steps.0.fix.upper.body: \"upper.body\" is the name of a point and of a surface; give each"],
        ),
        (
            "one name twice",
            upper("Physical Surface", "Physical Curve(\"top\") = {1}; Physical Surface"),
            SCENE.into(),
            vec!["upper.geo: gmsh ended with exit code 1", "Could not modify physical line"],
        ),
        (
            "one number for two names",
            upper(
                "Physical Surface",
                "Physical Curve(\"ceiling\", 2) = {3}; Physical Curve(\"floor\", 2) = {1}; Physical Surface",
            ),
            SCENE.into(),
            vec!["upper.geo: gmsh ended with exit code 1", "Could not modify physical line"],
        ),
        (
            "a missing group",
            upper("\"top\"", "\"roof\""),
            SCENE.into(),
            vec!["upper.top", "no group \"top\" in upper.geo; there is corner, bottom, roof, body"],
        ),
        ("an empty group", upper("\"top\") = {3}", "\"top\") = {}"), SCENE.into(), vec!["upper.geo", "top"]),
        (
            "a group of a curve that is not there",
            upper("\"top\") = {3}", "\"top\") = {9}"),
            SCENE.into(),
            vec!["upper.geo", "\"top\""],
        ),
        (
            "a curve in two groups of one side",
            upper("Physical Surface", "Physical Curve(\"seat\") = {1}; Physical Surface"),
            scene("\"upper.bottom\"", "[\"upper.bottom\", \"upper.seat\"]"),
            vec!["interfaces.joint.side_b: \"upper.bottom\" and \"upper.seat\" hold the same edge, at ("],
        ),
        (
            "a curve in two groups of two interfaces",
            upper("Physical Surface", "Physical Curve(\"seat\") = {1}; Physical Surface"),
            scene(
                "\"interfaces\": {",
                r#""interfaces": { "other": { "side_a": "upper.seat", "side_b": "lower.top", "law": { "type": "elastic", "normal_stiffness": 1, "tangential_stiffness": 1 } },"#,
            ),
            vec![
                "interfaces.joint: other and joint both join ",
                "every place of a side belongs to one interface",
            ],
        ),
    ] {
        let message = refusal(&geo, &scene);
        for expected in expected {
            assert!(message.contains(expected), "{case}: {message}\n  should contain\n{expected}");
        }
    }
    // what is in two groups for two purposes is fine, and what nothing uses is told by a check
    let folder = tempfile::tempdir().unwrap();
    let twice = upper("Physical Surface", "Physical Curve(\"roof\") = {3}; Physical Surface");
    let output = midplane(folder.path(), &twice, SCENE, "check");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    assert!(
        message.contains("warning: W09 subdomain upper: nothing uses its group corner, roof"),
        "{message}"
    );
}

#[test]
fn b28_sides_of_one_subdomain_that_do_not_face_each_other_are_refused_by_name() {
    let message = refusal(SQUARE, &SCENE.replace("\"lower.top\"", "\"upper.top\""));
    assert!(
        message.contains("interface joint: upper.top and upper.bottom do not lie on each other"),
        "{message}"
    );
    let message = refusal(SQUARE, &SCENE.replace("\"lower.top\"", "\"upper.bottom\""));
    assert!(message.contains("\"upper.bottom\" is on both sides"), "{message}");
    let sides = "\"side_a\": \"lower.top\", \"side_b\": \"upper.bottom\"";
    // and patterns never pair a body with itself
    let message = refusal(SQUARE, &SCENE.replace(sides, "\"between\": [\"upper\", \"up*\"]"));
    assert!(message.contains("no subdomain like \"upper\" touches another like \"up*\""), "{message}");
}

/// Two squares under 10 MPa shorten by 10 · 2/E + 10/K_N, whatever gmsh makes of the upper one.
#[test]
fn b37_every_kind_of_plane_mesh_carries_a_uniform_stress() {
    let mixed = SQUARE
        .replace(
            "Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};",
            "Point(5) = {0.4, @, 0}; Point(6) = {0.4, @ + 1, 0};
Line(5) = {5, 6}; Line(7) = {1, 5}; Line(8) = {5, 2}; Line(9) = {3, 6}; Line(10) = {6, 4};
Curve Loop(1) = {7, 5, 10, 4}; Curve Loop(2) = {8, 2, 9, -5}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Recombine Surface {2};",
        )
        .replace("Transfinite Curve {1, 3} = n + 1;", "Transfinite Curve {7 : 10} = 3;")
        .replace("\"bottom\") = {1}", "\"bottom\") = {7, 8}")
        .replace("\"top\") = {3}", "\"top\") = {9, 10}")
        .replace("\"body\") = {1}", "\"body\") = {1, 2}");
    let with = |base: &str, options: &str| format!("{base}{options}\n");
    for (case, upper) in [
        ("T3", with(SQUARE, "")),
        ("recombined", with(SQUARE, "Recombine Surface {1};")),
        ("T6", with(SQUARE, "Mesh.ElementOrder = 2;")),
        ("Q8", with(SQUARE, "Recombine Surface {1}; Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;")),
        ("Q9", with(SQUARE, "Recombine Surface {1}; Mesh.ElementOrder = 2;")),
        ("mixed T3 and Q4", with(&mixed, "")),
        ("mixed T6 and Q8", with(&mixed, "Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;")),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let output = midplane(folder.path(), &upper, SCENE, "run");
        assert!(output.status.success(), "{case}: {}", String::from_utf8_lossy(&output.stderr));
        assert_shortened(folder.path(), case);
    }
}

#[test]
fn b37_a_mesh_off_its_plane_is_refused() {
    let lifted = SQUARE.replace("Point(3) = {1, @ + 1, 0}", "Point(3) = {1, @ + 1, 0.01}");
    let message = refusal(&lifted, SCENE);
    assert!(
        message.contains("upper.geo: node ") && message.contains(" is off the plane, |z| = "),
        "{message}"
    );
    // rounding of a rotated drawing is no third dimension
    let folder = tempfile::tempdir().unwrap();
    let rounded = SQUARE.replace("Point(3) = {1, @ + 1, 0}", "Point(3) = {1, @ + 1, 1e-12}");
    assert!(midplane(folder.path(), &rounded, SCENE, "check").status.success());
}
