//! Claim: work, stored, dissipated and released energy are measured each where they happen. What is left of them is an error of
//! second order in the increments, below the tolerance that is asked for, and a snap releases what the closed form says.
//!
//! ```text
//! u(σ) = σ C − (G_I/χ) ln(σ/χ)     ∫ σ du = ½ C σ² − (G_I/χ) σ     stored ½ C σ²     dissipated G_I (1 − σ/χ)
//! ```

use std::path::Path;
use std::process::Command;

/// The rows of a scene's history by column, and its summary.
struct Ran {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
    summary: serde_json::Value,
}

impl Ran {
    fn last(&self, name: &str) -> f64 {
        let at = self.names.iter().position(|column| column == name).unwrap();
        self.rows[self.rows.len() - 1][at]
    }

    /// Largest magnitude of the energy balance.
    fn balance(&self) -> f64 {
        let at = self.names.len() - 1;
        self.rows.iter().map(|row| row[at].abs()).fold(0.0, f64::max)
    }
}

fn run(scene: &str, settings: &[String]) -> Ran {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.arg("run").arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("geo").join(scene)).arg("-q");
    for setting in settings {
        command.arg("--set").arg(setting);
    }
    let output =
        command.args(["--set", "output.fields=none", "-o"]).arg(folder.path().join("out")).output().unwrap();
    assert!(output.status.success(), "{scene} {settings:?}: {}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let names = text.lines().next().unwrap().split(',').map(str::to_string).collect();
    let row = |line: &str| line.split(',').map(|value| value.parse().unwrap_or(f64::NAN)).collect();
    let rows = text.lines().skip(1).map(row).collect();
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    Ran { names, rows, summary: serde_json::from_str(&summary).unwrap() }
}

fn set(settings: &[(&str, &str)]) -> Vec<String> {
    settings.iter().map(|(key, value)| format!("{key}={value}")).collect()
}

#[test]
fn a_snap_releases_what_the_closed_form_says() {
    // geo/bar: E = 1e4, L = 1, K_N = 1e6, χ = 3, G_I = 2e-4, pulled to u = 3.2e-4
    let (compliance, chi, gi, u) = (1.0 / 1e4 + 1e-6, 3.0, 2e-4, 3.2e-4);
    let (mut low, mut high) = (1e-9, gi / (chi * compliance));
    while high - low > 1e-15 {
        let s: f64 = 0.5 * (low + high);
        *(if s * compliance - gi / chi * (s / chi).ln() > u { &mut low } else { &mut high }) = s;
    }
    let s = low;
    // the far branch begins at the peak's displacement
    let (mut low, mut high) = (1e-9, gi / (chi * compliance));
    while high - low > 1e-15 {
        let s: f64 = 0.5 * (low + high);
        *(if s * compliance - gi / chi * (s / chi).ln() > chi * compliance { &mut low } else { &mut high }) =
            s;
    }
    let area = |s: f64| 0.5 * compliance * s * s - gi / chi * s;
    let work = 0.5 * compliance * chi * chi + area(s) - area(low);
    let kept = -0.5 * s * gi / chi * (s / chi).ln(); // by the ties across the crack, ½ σ o
    let dissipated = gi * (1.0 - s / chi) - kept;
    let released = work - 0.5 * compliance * s * s - kept - dissipated;
    for increments in ["1", "7", "40", "400"] {
        let settings = [("/steps/0/control", "load"), ("/steps/0/increments", increments)];
        let ran = run("bar", &set(&settings));
        let width = ran.last("dissipated") / dissipated; // one width for all
        let got = ran.summary["solution"]["released"].as_f64().unwrap() / width;
        println!(
            "{increments}: width {width}, work {:e} of {work:e}, released {got:e} of {released:e}",
            ran.last("work") / width
        );
        assert!((got / released - 1.0).abs() < 1e-3, "{increments}: released {got:e}, {released:e}");
        assert!((ran.last("work") / width / work - 1.0).abs() < 1e-3, "{increments}: work");
        assert!((ran.last("stress") - s).abs() < 1e-6 * chi, "{increments}: stress");
        assert_eq!(ran.summary["solution"]["snaps"].as_array().unwrap().len(), 1);
        assert_eq!(ran.summary["solution"]["snaps"][0]["interface"], "joint");
    }
}

/// Keys and values.
type NewtonSettings = &'static [(&'static str, &'static str)];

/// Scenes whose balance is looked at: name, number of the step, coarser meshes.
const SCENES: [(&str, &str, NewtonSettings); 5] = [
    ("tension", "1", &[]),
    (
        "shear_box/cracking.json",
        "1",
        &[
            ("subdomains.lower.parameters.edges", "24"),
            ("subdomains.lower.parameters.rows", "12"),
            ("subdomains.upper.parameters.edges", "16"),
            ("subdomains.upper.parameters.rows", "8"),
        ],
    ),
    (
        "shear_box",
        "1",
        &[
            ("subdomains.lower.parameters.edges", "24"),
            ("subdomains.lower.parameters.rows", "12"),
            ("subdomains.upper.parameters.edges", "16"),
            ("subdomains.upper.parameters.rows", "8"),
        ],
    ),
    ("friction_block", "1", &[]),
    ("pull_bar", "1", &[]),
];

#[test]
fn what_is_left_falls_with_the_square_of_the_increments() {
    for ((scene, step, meshes), least) in SCENES.iter().zip([1.9, 1.9, 1.8, 1.8, 1.8]) {
        let balance = |increments: &str| {
            let increments_of = format!("/steps/{step}/increments");
            let mut settings = vec![(increments_of.as_str(), increments), ("solution.path_tolerance", "1")];
            settings.extend_from_slice(meshes);
            run(scene, &set(&settings)).balance()
        };
        let balances: Vec<f64> = ["25", "50", "100", "200", "400", "800"].map(balance).to_vec();
        let rate = (balances[0] / balances[5]).log2() / 5.0;
        println!("{scene}: {balances:?}, mean rate {rate:.2}");
        assert!(rate >= least, "{scene}: {balances:?}, mean rate {rate}");
    }
}

#[test]
fn what_is_left_stays_below_the_tolerance() {
    for (scene, step, meshes) in SCENES {
        for (text, tolerance) in [("1e-2", 1e-2), ("1e-3", 1e-3), ("1e-4", 1e-4)] {
            let increments = format!("/steps/{step}/increments");
            let mut settings = vec![(increments.as_str(), "5"), ("solution.path_tolerance", text)];
            settings.extend_from_slice(meshes);
            let ran = run(scene, &set(&settings));
            println!(
                "{scene}, tolerance {text}: balance {:e}, {} iterations",
                ran.balance(),
                ran.summary["solution"]["iterations"]
            );
            assert!(ran.balance() < 5.0 * tolerance, "{scene}, {text}: {:e}", ran.balance());
        }
    }
}

#[test]
fn an_elastic_interface_stores_half_the_work_of_its_traction() {
    // 10 MPa on 0.2 m over 0.2 m of E = 1e4 and an interface of 1e7 MPa/m
    let stored = "/output/history/stored=energy.stored".to_string();
    let exact = 0.5 * 10.0 * 0.2 * 10.0 * (0.2 / 1e4 + 1.0 / 1e7);
    let ran = run("compression", &[stored]);
    assert!((ran.last("stored") / exact - 1.0).abs() < 1e-9, "{} and {exact}", ran.last("stored"));
    assert!(ran.balance() < 1e-12, "{}", ran.balance());
}
