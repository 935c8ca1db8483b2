//! An interface and a path of its law: the JSON of both, with a line `---` between them.

#![no_main]

use std::path::Path;

use libfuzzer_sys::{Corpus, fuzz_target};
use midplane::law::Integration;
use midplane::law::path::{LawPath, write_csv};
use midplane::run;

/// More points are no fault and take their time.
const MOST_POINTS: f64 = 500.0;

fuzz_target!(|text: &str| -> Corpus {
    let Some((interface, path)) = text.split_once("\n---\n") else { return Corpus::Reject };
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
    for integration in [None, Some(Integration::BackwardEuler(1))] {
        let driven = run::point::drive_text(&scene, "joint", Path::new("path.json"), path, integration);
        if let Ok((law, rows, _)) = driven {
            assert!(!rows.is_empty());
            assert!(rows.iter().all(|row| row.state.traction.iter().all(|t| t.is_finite())));
            let _ = write_csv(&law, &rows, std::io::sink());
        }
    }
    Corpus::Keep
});
