//! Claim: `midplane law` drives one point of a scene's law from the scene's text alone; CSV on standard output.

use std::process::{Command, Output};

use crate::common::{Scene, elastic, faces, step};
use serde_json::json;

fn law(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).arg("law").args(arguments).output().unwrap()
}

fn rows(output: &Output) -> Vec<Vec<String>> {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_string).collect()).collect()
}

/// The paper's Example 2 at −5 MPa, energies in N/mm: peak √((c₀ − σt)² − (c₀ − χ₀t)²), and τ at 1 mm from an independent
/// integration.
#[test]
fn example_2_is_driven_from_the_scene_of_the_gallery() {
    for (integration, tolerance) in
        [(&["--tolerance", "1e-6"][..], 1e-5), (&["--substeps", "10"], 1e-2), (&[], 1e-3)]
    {
        let arguments = [&["geo/shear/scene.json", "joint", "geo/shear/path.json"], integration].concat();
        let rows = rows(&law(&arguments));
        let header = "s,jump_n,jump_t,traction_n,traction_t,fracture_work,opening,bridge_stiffness,slip_open,\
                      jump_n_plastic,jump_t_plastic,tensile_strength,cohesion,tan_friction,status,condition";
        assert_eq!(rows[0].join(","), header);
        assert_eq!(rows.len(), 1 + 1 + 2 + 400); // header, start, points
        let last = &rows[403];
        let number = |i: usize| last[i].parse::<f64>().unwrap();
        assert_eq!((number(0), number(2), number(14)), (2.0, 1e-3, 2.0));
        assert!((number(3) + 5.0).abs() < 1e-9);
        assert!((number(4) - 5.06373649).abs() < tolerance, "{integration:?}: {}", last[4]);
        let highest = rows[1..].iter().map(|row| row[4].parse::<f64>().unwrap()).fold(0.0, f64::max);
        let peak = ((4.0 + 5.0 * 0.8785_f64).powi(2) - (4.0 - 3.0 * 0.8785_f64).powi(2)).sqrt();
        assert!(highest <= peak + 1e-9 && highest > 0.99 * peak, "{highest}, peak {peak}");
    }
}

#[test]
fn bad_input_is_refused_with_its_place() {
    for (arguments, expected) in [
        (
            &["geo/shear/scene.json", "jiont", "geo/shear/path.json"][..],
            "no interface \"jiont\"; there is joint. Did you mean \"joint\"?",
        ),
        (&["geo/shear/scene.json", "joint", "geo/shear/scene.json"], "geo/shear/scene.json:"),
        (&["geo/shear/scene.json", "joint", "nowhere.json"], "nowhere.json: there is no such file"),
        (
            &[
                "geo/shear/scene.json",
                "joint",
                "geo/shear/path.json",
                "--set",
                "interfaces.joint.law.normal_stiffness=4e4",
            ],
            "normal_stiffness",
        ),
        (&["geo/shear/scene.json", "joint", "geo/shear/path.json", "--tolerance", "2"], "between 0 and 1"),
    ] {
        let output = law(arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message.contains(expected) && output.stdout.is_empty(),
            "{message}\n  should contain\n{expected}"
        );
    }
}

/// Claim: a number in a scene is read as the nearest double: the text that Rust writes for it gives it back.
#[test]
fn numbers_of_a_scene_are_read_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("path.json");
    let unit = json!({ "control": "displacement", "start": 0, "end": 1 });
    let program = json!({ "program": [{ "n": unit, "t": unit, "points": 1 }] });
    std::fs::write(&path, program.to_string()).unwrap();
    for k in [2.209278197011611e-16, 3.0977600523181534e-6, 94279652.81195137, 4.334703999811721e-19] {
        let scene = Scene::new("strain")
            .subdomains(["a", "b"], "rock")
            .material("rock", 1.0, 0.0)
            .interface("joint", faces("a.top", "b.bottom").law(elastic("K", 1)))
            .step(step("none"));
        let text = scene.to_string().replace("\"K\"", &format!("{k:?}"));
        let file = folder.path().join("scene.json");
        std::fs::write(&file, text).unwrap();
        let rows = rows(&law(&[file.to_str().unwrap(), "joint", path.to_str().unwrap()]));
        assert_eq!(rows[2][3].parse::<f64>().unwrap(), k);
    }
}
