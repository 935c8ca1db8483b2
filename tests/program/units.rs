//! Claim: no number in the program has a unit. The two scenes of docs/UNITS.md, in MN and m and in N and mm, are the same column under its own
//! weight; a box that cracks is found on the same way, part by part and iteration by iteration, whatever the units of stress and length are.

use crate::common::squares::midplane;

/// Texts between lines of three backquotes that name this language.
fn blocks<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let open = format!("```{language}\n");
    text.split(open.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap()).collect()
}

#[test]
fn one_column_in_two_sets_of_units() {
    let document = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/UNITS.md");
    let text = std::fs::read_to_string(document).unwrap();
    let (geometry, scenes) = (blocks(&text, "text"), blocks(&text, "json"));
    assert_eq!((geometry.len(), scenes.len()), (1, 2));
    // ρ g H²/2E + ρ g H/2K and ρ g H/2, in SI
    let (weight, height, young, stiffness) = (2400.0 * 9.81, 10.0, 3e10, 1e11);
    let down = weight * height * height / (2.0 * young) + weight * height / (2.0 * stiffness);
    let stress = weight * height / 2.0;
    for (scene, length) in scenes.into_iter().zip([1.0, 1e3]) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("half.geo"), geometry[0]).unwrap();
        std::fs::write(folder.path().join("scene.json"), scene).unwrap();
        let output = midplane(folder.path(), &["run", ".", "-o", "out"]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let history = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let row: Vec<f64> =
            history.lines().last().unwrap().split(',').skip(5).map(|cell| cell.parse().unwrap()).collect();
        // quadratic elements have the parabola of the displacements at their ends
        assert!((row[0] / (-down * length) - 1.0).abs() < 1e-10, "{}, {}", row[0], -down * length);
        assert!((row[1] / (-stress / 1e6) - 1.0).abs() < 1e-10, "{}, {}", row[1], -stress / 1e6);
    }
}

/// The histories of geo/shear_box/cracking.json, coarse, with stresses and lengths in units so many times smaller: names, rows, and
/// what it took to find them.
fn box_in(stress: f64, length: f64) -> (Vec<String>, Vec<Vec<f64>>, Vec<u64>) {
    let folder = tempfile::tempdir().unwrap();
    let mut settings = vec![
        "/steps/1/increments=10".to_string(),
        "output.fields=none".to_string(),
        format!("materials.rock.young={:e}", 1e4 * stress),
        format!("/steps/0/load/upper.top/pressure={:e}", 2.0 * stress),
        format!("/steps/1/displace/upper.left/x={:e}", 1e-3 * length),
        format!("/steps/1/displace/upper.right/x={:e}", 1e-3 * length),
    ];
    for (key, value) in [
        ("normal_stiffness", 1e6 * stress / length),
        ("tangential_stiffness", 1e6 * stress / length),
        ("tensile_strength", 3.0 * stress),
        ("cohesion", 4.0 * stress),
        ("fracture_energy_i", 2e-4 * stress * length),
        ("fracture_energy_iia", 2e-3 * stress * length),
        ("dilatancy_stress", 1.5 * stress),
    ] {
        settings.push(format!("interfaces.joint.law.{key}={value:e}"));
    }
    for (part, edges) in [("lower", 10), ("upper", 7)] {
        for (key, value) in
            [("edges", edges as f64), ("rows", 4.0), ("width", length), ("height", 0.5 * length)]
        {
            settings.push(format!("subdomains.{part}.parameters.{key}={value:e}"));
        }
    }
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/geo/shear_box/cracking.json");
    let mut arguments = vec!["run", scene, "-q", "-o", "out"];
    arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
    let output = midplane(folder.path(), &arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let history = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let mut lines = history.lines().map(|line| line.split(',').map(str::to_string).collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let rows = lines.map(|row| row.iter().skip(1).map(|cell| cell.parse().unwrap()).collect()).collect();
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let effort = ["parts", "rejected", "iterations", "factorisations"];
    let effort = effort.map(|key| summary["solution"][key].as_u64().unwrap()).to_vec();
    (names, rows, effort)
}

/// Powers of two change no digit of a stress; of a length they change the last one that a mesh file has.
#[test]
fn a_box_that_cracks_is_found_on_the_same_way_in_all_units() {
    let (names, rows, effort) = box_in(1.0, 1.0);
    assert!(effort[0] > 12 && rows.last().unwrap().iter().all(|value| value.is_finite()));
    for (stress, length, digits) in [
        (2f64.powi(20), 1.0, 0.0),
        (2f64.powi(-30), 1.0, 0.0),
        (1.0, 2f64.powi(10), 1e-9),
        (1.0, 2f64.powi(-13), 1e-9),
    ] {
        let (_, other_rows, other_effort) = box_in(stress, length);
        assert_eq!(
            other_effort, effort,
            "stress {stress}, length {length}: parts, rejected, iterations, factors"
        );
        for (column, name) in names.iter().enumerate().skip(1) {
            let unit = match name.as_str() {
                "displacement" | "jump_t" | "settlement" => length,
                "traction_n" | "traction_t" => stress,
                "shear" | "fracture_work" => stress * length,
                "stored" | "dissipated" | "released" | "work" => stress * length * length,
                name if name.starts_with("reaction:") => stress * length,
                _ => 1.0,
            };
            let of = |rows: &[Vec<f64>]| rows.iter().map(|row| row[column - 1]).collect::<Vec<_>>();
            let (one, other) = (of(&rows), of(&other_rows));
            let size = one.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
            // what is zero but for rounding, and what is a rounding itself, need not agree beyond it
            let size = if ["residual", "energy_balance"].contains(&name.as_str()) { 1e3 } else { size };
            for (one, other) in one.iter().zip(&other) {
                let off = (other / unit - one).abs();
                assert!(off <= digits * size, "stress {stress}, length {length}, {name}: {other:e}, {one:e}");
            }
        }
    }
}
