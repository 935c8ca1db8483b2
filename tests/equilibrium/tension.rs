//! Claim: two bars in series with a cohesive interface follow the exact path under tension (stable branch, and jump where it
//! snaps back), and the work done until they part is the fracture energy.
//!
//! ```text
//! u(σ) = σ (L/E + 1/K_N) − (G_I/χ₀) ln(σ/χ₀)     W = G_I (1 − σ/χ₀)     snap-back if (L/E + 1/K_N) χ₀² / G_I > 1
//! ```

use crate::common::table::Table;
use crate::common::*;
use midplane::shape::Shape;

const E: f64 = 1e4;
const KN: f64 = 1e6;
const CHI: f64 = 3.0;
const GI: f64 = 2e-4;
const WIDTH: f64 = 0.02;

/// Two bars, the upper end pulled by `end`.
fn scene(end: f64, increments: usize, coupling: &str, law_tolerance: f64) -> Scene {
    let joint = faces("lower.top", "upper.bottom").coupling(coupling).with("law_tolerance", law_tolerance);
    let pull = step("pull").increments(increments).fix("lower.bottom", "y").fix("lower.corner", "x");
    Scene::new("stress")
        .subdomains(["lower", "upper"], "m")
        .material("m", E, 0.0)
        .interface("joint", joint.law(cracking(KN, KN, [CHI, 4.0, 0.8785], [GI, 2e-3])))
        .step(pull.fix("upper.corner", "x").displace("upper.top", "y", end))
}

fn bars(length: f64, shape: Shape, pair: (usize, usize)) -> Vec<midplane::mesh::Mesh> {
    let bar = |n: usize, y: f64| even_block([0.0, WIDTH], [y, y + length / 2.0], [n, 3], shape);
    vec![bar(pair.0, -length / 2.0), bar(pair.1, 0.0)]
}

/// End displacement at a stress behind the peak.
fn exact(length: f64, s: f64) -> f64 {
    s * (length / E + 1.0 / KN) - GI / CHI * (s / CHI).ln()
}

#[test]
fn the_stable_branch_is_followed_and_costs_the_fracture_energy() {
    let (length, end) = (0.05, 6e-4);
    let peak = CHI * (length / E + 1.0 / KN);
    for (shape, pair, coupling) in [
        (Shape::Quadrilateral4, (1, 1), "projected"),
        (Shape::Quadrilateral4, (3, 2), "projected"),
        (Shape::Quadrilateral4, (3, 2), "pointwise"),
        (Shape::Triangle3, (3, 2), "projected"),
        (Shape::Quadrilateral8, (1, 1), "projected"),
    ] {
        let what = format!("{shape:?} {pair:?} {coupling}");
        let problem = scene(end, 60, coupling, 1e-9).bind(bars(length, shape, pair)).unwrap();
        let (states, totals) = solve(&problem);
        assert!(totals.energy_balance < 5e-3, "{what}: balance {:e}", totals.energy_balance);
        let mut cracked = 0;
        for (i, state) in states.iter().enumerate() {
            let u = end * (i + 1) as f64 / states.len() as f64;
            for (s, t) in state.snapshot.tractions[0].iter().map(|v| (&v[0], &v[1])) {
                let on_path = if u <= peak { u / peak * CHI } else { *s };
                close(*s, on_path, 1e-9, CHI, &what);
                if u > peak {
                    close(u, exact(length, *s), 1e-6, peak, &what);
                    cracked += 1;
                }
                close(*t, 0.0, 1e-9, CHI, &what);
            }
        }
        assert!(cracked > 50);
        // W = G_I (1 − σ/χ₀), of which the ties across the crack keep ½ σ o; the rest of the work is stored too
        let last = &states[states.len() - 1];
        let s = last.snapshot.tractions[0][0][0];
        assert!(s < 0.01 * CHI);
        let opening = -GI / CHI * (s / CHI).ln();
        close(last.dissipated / WIDTH, GI * (1.0 - s / CHI) - 0.5 * s * opening, 1e-6, GI, &what);
        // by the trapezoidal rule over the increments
        close(last.work / WIDTH, GI * (1.0 - s / CHI) + 0.5 * s * s * peak / CHI, 5e-3, GI, &what);
    }
}

/// Residuals down to the first below the tolerance of 1e-12, of the increment with the most iterations; what follows
/// corrects the rounding of the condensation.
fn hardest(states: &[midplane::history::ModelState]) -> &[f64] {
    let found = |state: &midplane::history::ModelState| {
        let below = state.residuals.iter().position(|&r| r <= 1e-12);
        below.map_or(state.residuals.len(), |k| k + 1)
    };
    let hardest = states.iter().max_by_key(|state| found(state)).unwrap();
    &hardest.residuals[..found(hardest)]
}

/// Order of convergence from the last residuals above rounding.
fn order(residuals: &[f64]) -> f64 {
    let above: Vec<f64> = residuals.iter().copied().take_while(|&r| r > 1e-13).collect();
    let [.., a, b, c] = above[..] else { return f64::NAN };
    (c / b).ln() / (b / a).ln()
}

#[test]
fn newton_converges_quadratically_with_the_consistent_tangent_only() {
    let mut table = Table::new(
        "newton_tension",
        "Newton's method: a cracking joint under tension",
        "Relative residual before every iteration of the hardest of 12 increments; order from the last three above 1e-13.",
        &["form", "tangent", "residuals", "order"],
    );
    for strategy in ["condensed", "plain"] {
        for tangent in ["consistent", "initial"] {
            let scene = scene(6e-4, 12, "projected", 1e-4)
                .solution("strategy", strategy)
                .solution("tangent", tangent)
                .solution("iterations", 400)
                .solution("tolerance", 1e-12)
                .solution("path_tolerance", 1);
            let problem = scene.bind(bars(0.05, Shape::Quadrilateral4, (3, 2))).unwrap();
            let (states, _) = solve(&problem);
            let residuals = hardest(&states);
            let order = order(residuals);
            let shown: Vec<String> = residuals.iter().take(9).map(|r| format!("{r:.0e}")).collect();
            let more =
                if residuals.len() > 9 { format!(" … {} in all", residuals.len()) } else { String::new() };
            table.row(&[strategy.into(), tangent.into(), shown.join(" ") + &more, format!("{order:.2}")]);
            if tangent == "consistent" {
                assert!((order - 2.0).abs() < 0.15, "{strategy}: {residuals:?}");
                assert!(residuals.len() <= 9, "{strategy}: {residuals:?}");
            } else {
                assert!(order < 1.2 && residuals.len() > 20, "{strategy}: {residuals:?}");
            }
        }
    }
    table.finish();
}

#[test]
fn a_bar_that_snaps_back_snaps_to_the_far_branch() {
    let length = 1.0;
    let peak = CHI * (length / E + 1.0 / KN);
    // the listed stress after the jump at the peak's displacement
    let below = 0.03352028576;
    close(exact(length, below), peak, 1e-9, peak, "listed");
    let scene = scene(1.2 * peak, 12, "projected", 1e-9);
    let problem = scene.bind(bars(length, Shape::Quadrilateral4, (1, 1))).unwrap();
    let march = try_solve(&problem);
    for (state, load) in march.states.iter().zip(&march.load_factors) {
        let (u, s) = (1.2 * peak * load, state.snapshot.tractions[0][0][0]);
        let exact_u = if u <= peak * (1.0 + 1e-9) { s / CHI * peak } else { exact(length, s) };
        close(u, exact_u, 1e-6, peak, "on the path");
    }
    let totals = march.end.unwrap();
    assert_eq!(totals.snaps.len(), 1);
    assert!(march.states[11].snapshot.tractions[0][0][0] < below);
}
