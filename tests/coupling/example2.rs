//! Claim: the paper's Example 2 is uniform. Two layers are pressed together, then the nodes of the upper side of the interface
//! are moved along those of the lower side, which are held: every law point carries the curve of one point, and the bodies
//! carry the pressure alone, whatever the meshes, the elements and the coupling.
//!
//! The paper prints 0.2 and 2 MPa·m, with which nothing softens within a millimetre (reading A); N/mm (reading B) is taken
//! by the scene. τ at the peak and after 1 mm from the closed form: du = dW / (τ − |σ| t₀) behind the peak
//! √((c₀ − σ t₀)² − (c₀ − χ₀ t₀)²).

use crate::common::*;
use midplane::law::{Integration, Law, Local, State as LawState};
use midplane::shape::Shape;

const K: f64 = 1e7;
const SLIP: f64 = 1e-3;
const INCREMENTS: usize = 50;

fn scene(sigma: f64, scale: f64, coupling: &str, strategy: &str, tolerance: f64) -> Scene {
    let joint = faces("lower.top", "upper.bottom").coupling(coupling).with("law_tolerance", tolerance);
    let compression = step("compression").fix("lower.bottom", "y").fix("lower.corner", "x");
    let shear = step("shear").increments(INCREMENTS).displace("upper.bottom", "x", SLIP);
    Scene::new("strain")
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.0)
        .interface("joint", joint.law(cracking(K, K, [3.0, 4.0, 0.8785], [0.2 * scale, 2.0 * scale])))
        .solution("strategy", strategy)
        .solution("path_tolerance", 1)
        .step(compression.pressure("upper.top", -sigma))
        .step(shear.displace("lower.top", "x", 0))
}

fn layers(shape: Shape, pair: (usize, usize)) -> Vec<midplane::mesh::Mesh> {
    let layer = |n: usize, y: f64| even_block([0.0, 0.2], [y, y + 0.1], [n, 2], shape);
    vec![layer(pair.0, -0.1), layer(pair.1, 0.0)]
}

/// Tractions of one point that follows the same jumps.
fn point_curve(law: &Law, sigma: f64, tolerance: f64) -> Vec<Local> {
    let mut state = LawState::default();
    let slips = (0..=INCREMENTS).map(|i| SLIP * i as f64 / INCREMENTS as f64);
    slips
        .map(|slip| {
            let jump = Local::new(sigma / K, slip, 0.0); // no dilatancy: σ stays
            state = law.respond(jump, &state, Integration::Tolerance(tolerance)).unwrap().state;
            state.traction
        })
        .collect()
}

#[test]
fn every_law_point_carries_the_curve_of_one() {
    let sigma = -5.0;
    for shape in [Shape::Triangle3, Shape::Quadrilateral4, Shape::Quadrilateral8] {
        for pair in [(5, 8), (7, 12), (9, 9)] {
            for (coupling, strategy) in
                [("projected", "condensed"), ("pointwise", "condensed"), ("projected", "plain")]
            {
                let what = format!("{shape:?} {pair:?} {coupling} {strategy}");
                let problem = scene(sigma, 1e-3, coupling, strategy, 1e-4).bind(layers(shape, pair)).unwrap();
                let curve = point_curve(problem.interfaces[0].laws.kind(), sigma, 1e-4);
                let march = try_solve(&problem);
                let totals = march.end.unwrap();
                assert_eq!(march.states.len(), INCREMENTS + 1, "{what}");
                assert_eq!(totals.factorisations, if strategy == "plain" { 2 } else { 1 }, "{what}");
                // the free problem is linear: one iteration finds it
                assert!(march.iterations.iter().all(|&n| n == 1), "{what}: {:?}", march.iterations);
                let peak = curve.iter().map(|t| t.y).fold(0.0, f64::max);
                for (state, exact) in march.states.iter().zip(&curve) {
                    for traction in &state.snapshot.tractions[0] {
                        close(traction.x, exact.x, 1e-8, sigma, &what);
                        close(traction.y, exact.y, 1e-8, peak, &what);
                    }
                    for cell in state.snapshot.stresses.iter().flat_map(|stresses| &stresses.cells) {
                        for (got, exact) in cell.iter().zip([0.0, sigma, 0.0, 0.0]) {
                            close(*got, exact, 1e-8, sigma, &what);
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn both_readings_of_the_energies_end_where_the_closed_form_does() {
    // σ, τ after 1 mm with energies in MPa·m, in N/mm
    for (sigma, as_printed, newton_per_mm) in
        [(-1.0, 4.66330681, 1.70566019), (-5.0, 8.26570796, 5.06373649), (-20.0, 21.51605658, 18.15232515)]
    {
        for (scale, exact) in [(1.0, as_printed), (1e-3, newton_per_mm)] {
            let scene = scene(sigma, scale, "projected", "auto", 1e-8);
            let problem = scene.bind(layers(Shape::Quadrilateral4, (5, 8))).unwrap();
            let (states, _) = solve(&problem);
            for traction in &states[INCREMENTS].snapshot.tractions[0] {
                close(traction.y, exact, 1e-7, exact, &format!("σ = {sigma}, energies times {scale}"));
                close(traction.x, sigma, 1e-9, sigma, "σ");
            }
        }
    }
}
