//! An interface and a path of its law: the JSON of both with a line `---` between them, or bytes from which both are made.

#![no_main]

use std::path::Path;

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::{Corpus, fuzz_target};
use midplane::law::Integration;
use midplane::law::path::{LawPath, write_csv};
use midplane::run;
use serde_json::{Value, json};

/// More points are no fault and take their time.
const MOST_POINTS: f64 = 200.0;

/// Powers of ten that parameters and ways are off their usual sizes: farther ones end, but not within ten seconds.
const FARTHEST: i32 = 9;

/// A size times a power of ten, mostly a small one.
fn number(bytes: &mut Unstructured, size: f64) -> Result<f64> {
    let power = match bytes.int_in_range(0..=15)? {
        0..=8 => 0,
        9..=12 => bytes.int_in_range(-3..=3)?,
        13 => return Ok(0.0),
        _ => FARTHEST - bytes.int_in_range(0..=2 * FARTHEST)?,
    };
    Ok(size * f64::from(bytes.int_in_range(1_u8..=20)?) / 10.0 * 10_f64.powi(power))
}

fn any<'a>(bytes: &mut Unstructured, of: &'a [&'a str]) -> Result<&'a str> {
    Ok(*bytes.choose(of)?)
}

/// A law that may be admissible.
fn law(bytes: &mut Unstructured) -> Result<Value> {
    let kind = any(bytes, &["cracking", "cracking", "cohesive", "coulomb", "elastic"])?;
    let sizes: &[(&str, f64)] = match kind {
        "cracking" => &[
            ("tensile_strength", 2.0),
            ("cohesion", 4.0),
            ("tan_friction", 0.8),
            ("fracture_energy_i", 2e-4),
            ("fracture_energy_iia", 2e-3),
            ("dilatancy_stress", 10.0),
        ],
        "cohesive" => &[
            ("tensile_strength", 2.0),
            ("shear_strength", 4.0),
            ("fracture_energy_i", 2e-4),
            ("fracture_energy_ii", 1e-3),
            ("friction_coefficient", 0.8),
        ],
        "coulomb" => &[("friction_coefficient", 0.5), ("cohesion", 1.0), ("dilatancy", 0.1)],
        _ => &[],
    };
    let mut law = json!({ "type": kind, "tangential_stiffness": number(bytes, 1e5)? });
    for (key, size) in sizes {
        law[key] = json!(number(bytes, *size)?);
    }
    if kind != "cracking" && kind != "cohesive" && bytes.arbitrary()? {
        law["closure"] = json!({ "initial_stiffness": number(bytes, 1e4)?, "maximum": number(bytes, 1e-4)? });
    } else {
        law["normal_stiffness"] = json!(number(bytes, 1e5)?);
    }
    match kind {
        "cracking" => {
            law["unloading"] = json!(any(bytes, &["closing", "plastic"])?);
            for key in ["alpha_tensile_strength", "alpha_cohesion", "alpha_tan_friction"] {
                if bytes.ratio(1, 4)? {
                    law[key] = json!(number(bytes, 1.0)? - 1.0);
                }
            }
            if bytes.arbitrary()? {
                law["tan_friction_residual"] = json!(number(bytes, 0.4)?);
            }
        }
        "cohesive" => {
            law["softening"] = json!(any(bytes, &["linear", "bilinear", "exponential"])?);
            if bytes.ratio(1, 8)? {
                law["viscosity"] = json!(number(bytes, 1e-3)?);
            }
        }
        "coulomb" => {
            law["cohesion_lost"] = json!(any(bytes, &["never", "at_slip"])?);
            if bytes.arbitrary()? {
                law["dilatancy_end"] = json!(number(bytes, 1e-3)?);
            }
        }
        _ => {}
    }
    Ok(law)
}

/// The interface and the path that bytes make.
fn made(data: &[u8]) -> Result<[String; 2]> {
    let bytes = &mut Unstructured::new(data);
    let interface = json!({ "side_a": "a.a", "side_b": "b.b", "law": law(bytes)? });
    let mut reached = [("displacement", 0.0); 2];
    let mut program = Vec::new();
    for _ in 0..bytes.int_in_range(1..=6)? {
        let mut ways = Vec::new();
        for way in &mut reached {
            // a segment begins where the last one ended only under the same control
            let control = if program.is_empty() && bytes.ratio(1, 3)? { "stress" } else { way.0 };
            let size = if control == "stress" { 5.0 } else { 1e-3 };
            let sign = if bytes.arbitrary()? { 1.0 } else { -1.0 };
            let end = if bytes.ratio(1, 4)? { way.1 } else { sign * number(bytes, size)? };
            ways.push(json!({ "control": control, "start": way.1, "end": end }));
            *way = (control, end);
        }
        let points = bytes.int_in_range(1..=6)?;
        program.push(json!({ "n": ways[0], "t": ways[1], "points": points }));
    }
    Ok([interface.to_string(), json!({ "program": program }).to_string()])
}

fn drive(interface: &str, path: &str) -> Corpus {
    let scene = format!(
        r#"{{"plane":"strain","subdomains":{{"a":{{"geo":"a.geo","material":"m"}},"b":{{"geo":"b.geo","material":"m"}}}},
        "materials":{{"m":{{"young":1e4,"poisson":0.2}}}},"interfaces":{{"joint":{interface}}},
        "steps":[{{"name":"step","fix":{{"a.a":["x","y"]}}}}]}}"#
    );
    let Ok(scene) = run::parse_scene("no such folder/scene.json".into(), scene, &[]) else {
        return Corpus::Keep;
    };
    let points = serde_json::from_str::<LawPath>(path)
        .map_or(0.0, |path| path.program.iter().map(|segment| segment.points as f64).sum::<f64>());
    if points > MOST_POINTS {
        return Corpus::Reject;
    }
    // a law that is warned of may seek long where its traction snaps
    let warned = !scene.interfaces["joint"].law.kind().warnings().is_empty();
    for integration in [None, Some(Integration::BackwardEuler(1))].into_iter().skip(usize::from(warned)) {
        let driven = run::point::drive_text(&scene, "joint", Path::new("path.json"), path, integration);
        if let Ok((law, rows, _)) = driven {
            assert!(!rows.is_empty());
            assert!(rows.iter().all(|row| row.state.traction.iter().all(|t| t.is_finite())));
            let _ = write_csv(&law, &rows, std::io::sink());
        }
    }
    Corpus::Keep
}

fuzz_target!(|data: &[u8]| -> Corpus {
    match std::str::from_utf8(data).ok().and_then(|text| text.split_once("\n---\n")) {
        Some((interface, path)) => drive(interface, path),
        None => made(data).map_or(Corpus::Reject, |[interface, path]| {
            if std::env::var_os("FUZZ_SHOW").is_some() {
                eprintln!("{interface}\n---\n{path}");
            }
            drive(&interface, &path)
        }),
    }
});
