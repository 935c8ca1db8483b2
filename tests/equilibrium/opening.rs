//! Claim: an interface that opens and slides at once passes through the mode where σ stays at zero on a mesh as it does at a point,
//! in any increments and without cycling.
//!
//! The bodies are so stiff that every law point has the prescribed jump to 1e-6.

use crate::common::*;
use midplane::shape::Shape;

/// Fraction of the way to (1e-4, 1e-4), σ, τ [MPa], by an independent program (`law_closed_forms.rs`).
const AT_45_DEGREES: [(f64, f64, f64); 4] = [
    (0.2, 0.6367454859, 2.579310358),
    (0.5, 0.0, 2.153330201),
    (0.7, 0.0, 1.264514196),
    (0.9, 0.0, 0.3182020031),
];

fn scene(young: f64, fraction: f64, increments: usize, strategy: &str) -> Scene {
    let end = fraction * 1e-4;
    let law = cracking(1e6, 1e6, [3.0, 4.0, 0.8785], [2e-4, 2e-3]).with("tan_friction_residual", 0.6);
    let open = step("open").increments(increments).fix("lower.bottom", "xy");
    Scene::new("stress")
        .subdomains(["lower", "upper"], "m")
        .material("m", young, 0.0)
        .interface("joint", faces("lower.top", "upper.bottom").with("law_tolerance", 1e-6).law(law))
        .solution("strategy", strategy)
        .step(open.displace("upper.top", "x", end).displace("upper.top", "y", end))
}

fn subdomains() -> Vec<midplane::mesh::Mesh> {
    let subdomain =
        |edges: usize, y: f64| even_block([0.0, 0.1], [y, y + 0.05], [edges, 2], Shape::Quadrilateral4);
    vec![subdomain(5, -0.05), subdomain(7, 0.0)]
}

#[test]
fn sigma_stays_at_zero_on_stiff_subdomains_as_at_a_point() {
    for strategy in ["condensed", "plain"] {
        for (fraction, sigma, tau) in AT_45_DEGREES {
            for increments in [1, 9, 90] {
                let what = format!("{strategy}, {increments} increments to {fraction}");
                let scene = scene(1e12, fraction, increments, strategy).solution("path_tolerance", 1);
                let march = try_solve(&scene.bind(subdomains()).unwrap());
                let totals = march.end.unwrap();
                assert!(totals.snaps.is_empty(), "{what}: snaps");
                // rounding of stiff bodies may cost one increment a second try
                let hard = march.iterations.iter().filter(|&&n| n > 8).count();
                assert!(hard <= 1, "{what}: {:?}", march.iterations);
                let state = &march.states[increments - 1];
                for (traction, law) in state.snapshot.tractions[0].iter().zip(&state.snapshot.states[0]) {
                    close(traction[0], sigma, 1e-5, 1.0, &what);
                    close(traction[1].abs(), tau, 1e-5, 1.0, &what);
                    assert_eq!(law.status == 3, sigma == 0.0, "{what}");
                }
            }
        }
    }
}

#[test]
fn soft_subdomains_pass_through_it_in_any_increments() {
    // points reach σ = 0 one after the other, and none is cut
    let end = |increments: usize| {
        let scene = scene(1e4, 1.0, increments, "condensed");
        let march = try_solve(&scene.bind(subdomains()).unwrap());
        let totals = march.end.unwrap();
        assert!(totals.snaps.is_empty(), "{increments} increments");
        let passed = march.states.iter().any(|state| state.snapshot.states[0].iter().any(|s| s.status == 3));
        assert!(passed || increments == 1);
        march.states[march.states.len() - 1].dissipated
    };
    let fine = end(400);
    // every increment is a straight way of the jumps: the error falls with the square of its length
    for (increments, error) in [(1, 1e-2), (10, 5e-3), (40, 5e-4), (100, 1e-4)] {
        let dissipated = end(increments);
        println!("{increments} increments: dissipated {:e} off", dissipated / fine - 1.0);
        close(dissipated, fine, error, fine, "dissipated energy");
    }
}
