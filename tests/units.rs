//! Claim: the two scenes of docs/UNITS.md, in MN and m and in N and mm, are the same column under its own weight.

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
