//! Claim: the error of every preset on every scene of `make trade` stays within 1.5 times the recorded one, finer presets are
//! no worse, `draft`, `normal` and `fine` are within 10, 1 and 0.1 %; presets leave alone what a scene states.

use std::path::Path;
use std::process::Command;

use midplane::scene::{self, Accuracy};
use serde_json::{Value, json};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

#[test]
fn errors_stay_within_one_and_a_half_of_the_recorded_ones() {
    let text = std::fs::read_to_string(Path::new(ROOT).join("docs/trade/presets.json")).unwrap();
    let recorded: Value = serde_json::from_str(&text).unwrap();
    let names: Vec<&str> = Accuracy::ALL.iter().map(|(name, _)| *name).collect();
    for (name, scene) in recorded.as_object().unwrap() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("study.json");
        // the finest of a long scene takes minutes; `make trade` runs it
        let tested = &names[..if scene["long"] == true { 2 } else { 3 }];
        let study = json!({
            "scene": Path::new(ROOT).join(scene["scene"].as_str().unwrap()),
            "set": scene["set"],
            "axes": { "accuracy": { "key": "accuracy", "values": tested } },
            "measures": scene["measures"],
        });
        std::fs::write(&file, study.to_string()).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
        let out = folder.path().join("out");
        let output = command.arg("study").arg(&file).arg("-q").arg("-o").arg(&out).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read_to_string(out.join("study.json")).unwrap();
        let done: Value = serde_json::from_str(&text).unwrap();
        let mut before = f64::INFINITY;
        for ((preset, within), point) in
            tested.iter().zip([0.1, 0.01, 0.001]).zip(done["points"].as_array().unwrap())
        {
            let error = |of: &Value| point["errors"][of.as_str().unwrap()].as_f64().unwrap_or(f64::INFINITY);
            let error = scene["deciding"].as_array().unwrap().iter().map(error).fold(0.0, f64::max);
            let of = scene["errors"][preset].as_f64().unwrap_or(f64::INFINITY);
            println!("{name} {preset}: {error:.2e}, recorded {of:.2e}");
            assert!(error <= 1.5 * of, "{name} {preset}: {error:e}, recorded {of:e}");
            // below it errors hang on where the end of a slip zone falls in its cell
            assert!(error <= before.max(1e-4), "{name} {preset}: {error:e}, the coarser one {before:e}");
            assert!(error <= within, "{name} {preset}: {error:e}");
            before = error;
        }
    }
}

const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "lower": { "geo": "lower.geo", "material": "m", "parameters": { "edges": 10 } },
                  "upper": { "geo": "upper.geo", "material": "m" } },
  "materials": { "m": { "young": 1, "poisson": 0 } },
  "interfaces": { "joint": { "side_a": "lower.top", "side_b": "upper.bottom",
    "law": { "type": "coulomb", "normal_stiffness": 1, "tangential_stiffness": 1, "friction_coefficient": 1 } } },
  "solution": { "iterations": 7 },
  "refinement": ["lower.edges", "upper.edges"],
  "steps": [ { "name": "a", "fix": { "lower.bottom": ["x", "y"] } }, { "name": "b", "increments": 10 } ] }"#;

fn read(text: &str, settings: &[&str]) -> midplane::error::Result<scene::Scene> {
    let file = Path::new(ROOT).join("geo/strip/scene.json");
    let settings: Vec<String> = settings.iter().map(|s| s.to_string()).collect();
    midplane::run::parse_scene(file, text.into(), &settings)
}

/// The strip's upper.geo declares 12 edges and an order, lower.geo an order.
#[test]
fn a_preset_fills_what_the_scene_leaves_open() {
    let plain = read(SCENE, &[]).unwrap();
    for (name, accuracy) in Accuracy::ALL {
        let preset = accuracy.preset();
        let scene = read(SCENE, &[&format!("accuracy={name}")]).unwrap();
        let even = |n: f64| 2.0 * (n * preset.refinement / 2.0).round();
        assert_eq!(scene.subdomains["lower"].parameters["edges"], even(10.0));
        assert_eq!(scene.subdomains["upper"].parameters["edges"], even(12.0));
        for subdomain in scene.subdomains.values() {
            assert_eq!(subdomain.parameters["order"], f64::from(preset.order));
        }
        assert_eq!((scene.solution.tolerance, scene.solution.iterations), (preset.tolerance, 7));
        assert_eq!(scene.interfaces["joint"].law_tolerance, preset.law_tolerance);
        assert_eq!(scene.steps[0].increments, 1);
        assert_eq!(scene.steps[1].increments, (10.0 * preset.increments).ceil() as usize);
    }
    assert_eq!(plain.subdomains["lower"].parameters["edges"], 10.0);
    assert!(!plain.subdomains["upper"].parameters.contains_key("edges"));
}

#[test]
fn what_is_stated_or_set_rules() {
    let stated = SCENE.replace("\"iterations\": 7", "\"tolerance\": 1e-9");
    let scene =
        read(&stated, &["accuracy=draft", "subdomains.upper.parameters.edges=3", "steps.1.increments=2"]);
    let scene = scene.unwrap();
    assert_eq!(scene.solution.tolerance, 1e-9);
    assert_eq!(scene.subdomains["upper"].parameters["edges"], 3.0);
    assert_eq!(scene.steps[1].increments, 2);
}

#[test]
fn a_wrong_preset_or_refinement_is_refused() {
    for (from, to, expected) in [
        (
            "\"refinement\": [\"lower.edges\"",
            "\"accuracy\": \"draught\", \"refinement\": [\"lower.edges\"",
            "unknown value \"draught\"; there is draft, normal, fine",
        ),
        (
            "\"lower.edges\"",
            "\"lwer.edges\"",
            "refinement.0: \"lwer.edges\" is no parameter of a subdomain; write <subdomain>.<parameter>",
        ),
        (
            "\"upper.edges\"]",
            "\"upper.egdes\"], \"accuracy\": \"fine\"",
            "refinement.1: no number to multiply: upper does not declare egdes with one",
        ),
    ] {
        assert!(SCENE.contains(from));
        let message = read(&SCENE.replacen(from, to, 1), &[]).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
    }
}
