//! Claim: a double cantilever beam opens as a plane model of quadratic elements that was converged over three meshes says,
//! on matched arms and on unmatched ones; on coarse meshes it runs through local snap-backs to the
//! end, however large the increments.
//!
//! ```text
//!    ↑ d        a₀ = 30 mm
//!   ┌┴──────────────────────────────┐ h = 1.5 mm      G_I = 0.3 N/mm, χ₀ = 20 MPa
//!   └┬────────────── · bonded · · · ┘                 E = 70 GPa, ν = 0.3, plane stress
//!    ↓                     100 mm
//! ```

use std::path::Path;
use std::process::Command;

use crate::common::step;

/// Peak load [MN], its opening [m] and the compliance before anything cracks [m/MN], of the plane model.
const PEAK: f64 = 2.243647156e-3;
const OPENING: f64 = 2.922298141e-3;
const COMPLIANCE: f64 = 1.025385167;

struct Run {
    opening: Vec<f64>,
    force: Vec<f64>,
    stored: Vec<f64>,
    dissipated: Vec<f64>,
    turns: usize,
    snaps: usize,
}

/// Claim: one increment to the end is found whatever the mesh: slender arms leave displacements few digits, and what these say
/// is corrected as far as their rounding lets it.
#[test]
fn one_increment_is_enough_on_any_mesh() {
    for (edges, opening) in
        [(15, "5e-3"), (18, "5e-3"), (20, "6e-3"), (21, "6e-3"), (24, "5e-3"), (24, "6e-3")]
    {
        let run = run_to(opening, "load", edges, edges, 1);
        assert_eq!(run.opening.len(), 1, "{edges} {opening}");
    }
}

/// The scene of the gallery with so many edges along the interface, opened to 4 mm.
fn run(lower: usize, upper: usize, increments: usize) -> Run {
    run_to("4e-3", "auto", lower, upper, increments)
}

fn run_to(opening: &str, control: &str, lower: usize, upper: usize, increments: usize) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
    command.arg("run").arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/dcb"));
    for setting in [
        format!("subdomains.lower.parameters.edges={lower}"),
        format!("subdomains.upper.parameters.edges={upper}"),
        format!("/steps/0/increments={increments}"),
        format!("/steps/0/displace/upper.load/y={opening}"),
        format!("/steps/0/control={control}"),
    ] {
        command.arg("--set").arg(setting);
    }
    let output = command.arg("-o").arg(folder.path().join("out")).output().unwrap();
    assert!(output.status.success(), "{lower}:{upper}: {}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let at = names.iter().position(|&column| column == name).unwrap();
        text.lines().skip(2).map(|row| row.split(',').nth(at).unwrap().parse().unwrap()).collect()
    };
    let summary = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    Run {
        opening: column("opening"),
        force: column("reaction:upper.load:y"),
        stored: column("stored"),
        dissipated: column("dissipated"),
        turns: summary["solution"]["turns"].as_array().unwrap().len(),
        snaps: summary["solution"]["snaps"].as_array().unwrap().len(),
    }
}

impl Run {
    /// Opening and load at the top of the parabola through the highest three increments.
    fn peak(&self) -> [f64; 2] {
        let (d, p) = (&self.opening, &self.force);
        let i = (1..p.len() - 1).max_by(|&i, &j| p[i].total_cmp(&p[j])).unwrap();
        let (before, after) = ((p[i] - p[i - 1]) / (d[i] - d[i - 1]), (p[i + 1] - p[i]) / (d[i + 1] - d[i]));
        let curvature = (after - before) / (d[i + 1] - d[i - 1]);
        let slope = before + curvature * (d[i] - d[i - 1]);
        [d[i] - 0.5 * slope / curvature, p[i] - 0.25 * slope * slope / curvature]
    }

    /// ∫ P dd by trapezia.
    fn work(&self) -> f64 {
        let mut work = 0.5 * self.opening[0] * self.force[0];
        for i in 1..self.force.len() {
            work += 0.5 * (self.force[i] + self.force[i - 1]) * (self.opening[i] - self.opening[i - 1]);
        }
        work
    }
}

fn close(value: f64, exact: f64, tolerance: f64, what: &str) {
    assert!((value - exact).abs() <= tolerance * exact, "{what}: {value}, expected {exact}");
}

#[test]
fn it_opens_as_the_converged_plane_model_on_unmatched_arms_too() {
    // the process zone is 4 mm long, which is 8 edges of the coarser side
    let runs = [(140, 140), (210, 140)].map(|(lower, upper)| run(lower, upper, 40));
    for (run, what) in runs.iter().zip(["matched", "unmatched"]) {
        let [opening, load] = run.peak();
        println!("{what}: peak {load:e} at {opening:e}, {} increments", run.force.len());
        close(load, PEAK, 0.01, what);
        close(opening, OPENING, 0.02, what);
        close(run.opening[0] / run.force[0], COMPLIANCE, 0.005, what);
        // the work of the load is stored or spent on the crack
        let last = run.force.len() - 1;
        let rest = run.work() - run.stored[last];
        println!(
            "{what}: work {:e}, stored {:e}, dissipated {:e}",
            run.work(),
            run.stored[last],
            run.dissipated[last]
        );
        close(rest, run.dissipated[last], 0.01, what);
    }
    let [[d0, p0], [d1, p1]] = [runs[0].peak(), runs[1].peak()];
    close(d1, d0, 0.005, "opening on unmatched arms");
    close(p1, p0, 0.005, "peak on unmatched arms");
}

#[test]
fn coarse_arms_run_through_local_snap_backs_to_the_end() {
    // one to two edges per process zone, matched and not
    for (lower, upper) in [(14, 14), (18, 18), (18, 14), (28, 28)] {
        let run = run_to("6e-3", "auto", lower, upper, 60);
        let last = run.opening.len() - 1;
        println!("{lower}:{upper}: {} increments, {} turns, {} snaps", last + 1, run.turns, run.snaps);
        assert_eq!(run.opening[last], 6e-3);
        assert!(run.turns > 0);
        assert!(run.opening.windows(2).any(|pair| pair[1] < pair[0]), "nothing snaps back");
    }
}

#[test]
fn far_too_large_increments_end_where_small_ones_do() {
    let end = |control: &str, increments: usize| {
        let run = run_to("6e-3", control, 18, 18, increments);
        let last = run.opening.len() - 1;
        [run.force[last], run.dissipated[last]]
    };
    // by load with snaps, and along the path, to the tolerance of 1e-3 of the way
    let [force, dissipated] = end("load", 400);
    for (control, increments) in [("load", 1), ("load", 5), ("load", 20), ("auto", 60)] {
        let [f, d] = end(control, increments);
        println!("{control}, {increments}: {:e} and {:e} off", f / force - 1.0, d / dissipated - 1.0);
        close(f, force, 1e-3, "load at the end");
        close(d, dissipated, 1e-3, "dissipated energy");
    }
}

/// Claim: under a force that grows the run ends at the limit load, whatever the increments: the last equilibrium lies within a twentieth of
/// one below it, near that of the converged model (2.2436e-3 MN).
#[test]
fn the_limit_load_does_not_hang_on_the_increments() {
    const FORCE: f64 = 3e-3;
    let limit = |increments: usize| {
        let folder = tempfile::tempdir().unwrap();
        let held = step("load").fix("lower.load", "xy").fix("upper.load", "x");
        let step = format!("steps.0={}", held.increments(increments).force("upper.load", 0, FORCE));
        let mut command = Command::new(env!("CARGO_BIN_EXE_midplane"));
        command.arg("run").arg(concat!(env!("CARGO_MANIFEST_DIR"), "/geo/dcb")).arg("-q");
        for setting in [
            "subdomains.lower.parameters.edges=70",
            "subdomains.upper.parameters.edges=47",
            "output.fields=none",
            &step,
        ] {
            command.arg("--set").arg(setting);
        }
        let output = command.arg("-o").arg(folder.path().join("out")).output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let reached: f64 = text.lines().last().unwrap().split(',').nth(2).unwrap().parse().unwrap();
        FORCE * reached
    };
    let [five, eight] = [5, 8].map(limit);
    println!("5 increments: {five:e}, 8: {eight:e}");
    assert!((five - eight).abs() < 0.05 * FORCE * (1.0 / 5.0 + 1.0 / 8.0), "{five:e} {eight:e}");
    // edges of 1 mm carry a zone of 5 mm
    assert!((eight / 2.2436e-3 - 1.0).abs() < 0.03, "{eight:e}");
}
