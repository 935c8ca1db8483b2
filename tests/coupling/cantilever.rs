//! Claim: on a cantilever of two unmatched layers `projected` transmits the shear without spurious normal traction at
//! every stiffness, where `pointwise` oscillates.
//!
//! ```text
//!   ▐───────────────────┐│     layers 2 m × 0.5 m, E = 1e4 MPa, ν = 0.3, plane strain, Q4
//!   ▐─────── interface ─────┤│ 1 MPa
//!   ▐───────────────────┘▼     n edges along, round(n/4) and at least 2 rows
//! ```
//!
//! Beam theory: τ = 1.5 V/A = −1.5 MPa and t_n = 0 on the mid-line, away from the ends (0.6 < x < 1.4).

use crate::common::*;
use midplane::shape::Shape;

/// RMS of t_n over 1.5 MPa on 0.6 < x < 1.4, mean of t_t there, and the mean end deflection.
fn cantilever(x_a: &[f64], x_b: &[f64], kn: f64, coupling: &str) -> (f64, f64, f64) {
    let rows = |x: &[f64]| (((x.len() - 1) as f64 / 4.0).round() as usize).max(2);
    let flat = |x: f64, y: f64| [x, y];
    let lower = rectangle(x_a, &even(0.0, 0.5, rows(x_a)), Shape::Quadrilateral4, flat);
    let upper = rectangle(x_b, &even(0.5, 1.0, rows(x_b)), Shape::Quadrilateral4, flat);
    let bending = step("bending")
        .fix("lower.left", "xy")
        .fix("upper.left", "xy")
        .traction("lower.right", 0.0, -1.0)
        .traction("upper.right", 0.0, -1.0);
    let scene = Scene::new("strain")
        .subdomains(["lower", "upper"], "rock")
        .material("rock", 1e4, 0.3)
        .interface("joint", faces("lower.top", "upper.bottom").coupling(coupling).law(elastic(kn, kn)))
        .step(bending)
        .probe("end", "upper.right.displacement_y");
    let problem = scene.bind(vec![lower, upper]).unwrap();
    let (states, _) = solve(&problem);
    let points = &problem.model.interfaces[0].coupling.points;
    let inner = points
        .iter()
        .zip(&states[0].snapshot.tractions[0])
        .filter(|(p, _)| p.position[0] > 0.6 && p.position[0] < 1.4);
    let (mut length, mut square, mut shear) = (0.0, 0.0, 0.0);
    for (point, t) in inner {
        length += point.weight;
        square += point.weight * t[0] * t[0];
        shear += point.weight * t[1];
    }
    ((square / length).sqrt() / 1.5, shear / length, states[0].probes(&problem)[0])
}

#[test]
fn projected_has_no_spurious_normal_traction_at_any_stiffness() {
    for (n_a, n_b, limit) in [(24, 40, 0.01), (24, 25, 0.01), (5, 40, 0.06), (40, 5, 0.06)] {
        for exponent in 5..=12 {
            let kn = 10f64.powi(exponent);
            let (rms, shear, _) = cantilever(&even(0.0, 2.0, n_a), &even(0.0, 2.0, n_b), kn, "projected");
            println!("{n_a}/{n_b} K_N = 1e{exponent}: RMS t_n = {rms:.2e}, mean t_t = {shear:.4}");
            assert!(rms <= limit, "{n_a}/{n_b} K_N = 1e{exponent}: {rms}");
            assert!((shear / -1.5 - 1.0).abs() < 0.05, "{n_a}/{n_b} K_N = 1e{exponent}: {shear}");
        }
    }
    // graded against each other: the published figure is 0.006
    let (a, b) = (graded(0.0, 2.0, 30, 8.0), graded(0.0, 2.0, 30, 1.0 / 8.0));
    for kn in [1e7, 1e12] {
        let (rms, ..) = cantilever(&a, &b, kn, "projected");
        println!("graded K_N = {kn:e}: RMS t_n = {rms:.2e}");
        assert!(rms <= 0.01, "{rms}");
    }
}

/// A documented fact, not a wish: the published failure of the pointwise scheme (RMS of t_n over 1.5 MPa), within 20 %.
#[test]
fn pointwise_oscillates_as_published() {
    for (n_a, n_b, kn, published) in [
        (24, 40, 1e6, 0.19),
        (24, 40, 1e7, 1.5),
        (24, 40, 1e12, 6.4),
        (24, 25, 1e7, 3.4),
        (24, 25, 1e12, 960.0),
    ] {
        let (rms, ..) = cantilever(&even(0.0, 2.0, n_a), &even(0.0, 2.0, n_b), kn, "pointwise");
        println!("pointwise {n_a}/{n_b} K_N = {kn:e}: RMS t_n = {rms:.3}, published {published}");
        assert!((rms / published - 1.0).abs() < 0.2, "{n_a}/{n_b} {kn:e}: {rms}, published {published}");
    }
    // and locks: 35 % too stiff at 24/25 and 1e12, where projected is right to 0.1 % (compliance 0.00345)
    let even = |n| even(0.0, 2.0, n);
    let (.., locked) = cantilever(&even(24), &even(25), 1e12, "pointwise");
    let (.., right) = cantilever(&even(24), &even(25), 1e12, "projected");
    println!("end deflection: pointwise {locked:.5}, projected {right:.5}");
    assert!(
        (-locked / 0.00223 - 1.0).abs() < 0.01 && (-right / 0.00345 - 1.0).abs() < 0.002,
        "{locked} {right}"
    );
}
