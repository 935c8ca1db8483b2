//! Claim: what is drawn apart or into each other carries what it should: layers and rings with an interference, rings with a
//! clearance whose chords do not match, and a disc on a block as Hertz has it.
//!
//! ```text
//! layers  p = δ / (H/E + 1/K_N)                              rings  p (u₁ + u₂ + 1/K_N) = δ,
//! u₁ = b/E ((a² + b²)/(b² − a²) − ν)                         u₂ = b/E ((b² + c²)/(c² − b²) + ν)
//! disc    p = p₀ √(1 − x²/b²),  b² = 4 F R/(π E*),  p₀ = 2 F/(π b),  E* = E/(2 (1 − ν²))
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::{Value, json};

const E: f64 = 1e4;
const NU: f64 = 0.2;
const KN: f64 = 1e7;

/// Two bodies of one material with a frictionless joint.
fn scene(plane: &str, [a, b]: [&str; 2], gap: impl Into<Value>, fit: Step) -> Scene {
    Scene::new(plane)
        .subdomains(["a", "b"], "m")
        .material("m", E, NU)
        .interface("joint", faces(a, b).with("initial_gap", gap).law(coulomb(KN, 1e5, 0)))
        .step(fit)
}

/// Position and normal traction at all law points of the interface.
fn pressures<'a>(problem: &'a Problem, state: &'a ModelState) -> impl Iterator<Item = ([f64; 2], f64)> + 'a {
    let points = problem.model.interfaces[0].coupling.points.iter();
    points.zip(&state.snapshot.tractions[0]).map(|(point, t)| ([point.position[0], point.position[1]], t[0]))
}

#[test]
fn layers_that_overlap_press_on_each_other() {
    let overlap = 1e-4;
    let block = |n: usize, y: f64| even_block([0.0, 1.0], [y, y + 0.5], [n, 3], Shape::Quadrilateral4);
    // strained in plane strain and free at the sides: E/(1 − ν²)
    let exact = -overlap / (1.0 * (1.0 - NU * NU) / E + 1.0 / KN);
    for (gap, y) in [(json!("geometry"), -overlap), (json!(-1e-4), 0.0)] {
        let fit =
            step("fit").fix("a.bottom", "y").fix("b.top", "y").fix("a.corner", "x").fix("b.corner", "x");
        let scene = scene("strain", ["a.top", "b.bottom"], gap.clone(), fit);
        let problem = scene.bind(vec![block(4, -0.5), block(6, y)]).unwrap();
        let (states, totals) = solve(&problem);
        for (_, traction) in pressures(&problem, &states[states.len() - 1]) {
            close(traction, exact, 1e-3 * overlap.max(1e-4) + 2e-4, exact, &gap.to_string());
        }
        assert!(totals.energy_balance.abs() < 1e-9, "{gap}: {}", totals.energy_balance);
        assert!(totals.warnings(1e-3).is_empty(), "{gap}");
    }
}

/// A quarter of a ring between two radii.
fn ring(inner: f64, outer: f64, [across, around]: [usize; 2], shape: Shape) -> Mesh {
    let place = |r: f64, angle: f64| [r * angle.cos(), r * angle.sin()];
    rectangle(&even(inner, outer, across), &even(0.0, FRAC_PI_2, around), shape, place)
}

/// Pressure of two rings of this clearance at radius 1, by Lamé.
fn lame(clearance: f64, inside: f64) -> f64 {
    let (a, b, c) = (0.5_f64, 1.0_f64, 2.0_f64);
    let u1 = b / E * ((a * a + b * b) / (b * b - a * a) - NU);
    let u2 = b / E * ((b * b + c * c) / (c * c - b * b) + NU);
    // pressure inside the inner ring opens it by 2 p a² b/(E (b² − a²))
    let opened = inside * 2.0 * a * a * b / (E * (b * b - a * a));
    (clearance - opened) / (u1 + u2 + 1.0 / KN)
}

#[test]
fn rings_with_a_clearance_or_an_interference() {
    for (clearance, inside) in [(-1e-3, 0.0), (1e-3, 30.0)] {
        for edges in [[24, 17], [17, 24], [48, 35]] {
            let [n, m] = edges;
            let meshes = vec![
                ring(0.5, 1.0, [10, n], Shape::Quadrilateral4),
                ring(1.0 + clearance, 2.0, [10, m], Shape::Quadrilateral4),
            ];
            let fit = step("fit")
                .pressure("a.left", inside)
                .fix("a.bottom", "y")
                .fix("b.bottom", "y")
                .fix("a.top", "x")
                .fix("b.top", "x");
            let scene = scene("stress", ["a.right", "b.left"], "geometry", fit);
            let problem = scene.bind(meshes).unwrap();
            let (states, _) = solve(&problem);
            let exact = lame(clearance, inside);
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for (_, traction) in pressures(&problem, &states[states.len() - 1]) {
                (low, high) = (low.min(traction), high.max(traction));
            }
            println!("{clearance} {edges:?}: {low} … {high}, exact {exact}");
            close(low, exact, 0.005, exact, "lowest");
            close(high, exact, 0.005, exact, "highest");
        }
    }
}

#[test]
fn a_disc_on_a_block_as_hertz_has_it() {
    // half of both, symmetric about x = 0; eight edges of the disc over half the contact
    let (radius, half) = (1.0_f64, 0.05_f64);
    let h = half / 8.0;
    let from_contact = |fine: usize, h: f64, end: f64, ratio: f64| {
        let mut xs = even(0.0, fine as f64 * h, fine);
        let (mut step, mut x) = (h, fine as f64 * h);
        while x < end {
            step *= ratio;
            x += step;
            xs.push(x.min(end));
        }
        xs
    };
    let place = |x: f64, t: f64| {
        let bottom = radius - (radius * radius - x * x).sqrt();
        [x, bottom + (1.0 - bottom) * t]
    };
    let disc = rectangle(
        &from_contact(16, h, 0.35, 1.25),
        &from_contact(6, h, 1.0, 1.25),
        Shape::Quadrilateral4,
        place,
    );
    let block = rectangle(
        &from_contact(21, 0.7 * h, 2.0, 1.25),
        &from_contact(8, 0.7 * h, 2.0, 1.25).iter().rev().map(|y| -y).collect::<Vec<_>>(),
        Shape::Quadrilateral4,
        |x, y| [x, y],
    );
    let fit = step("fit").increments(4).fix("a.left", "x").fix("b.left", "x").fix("b.bottom", "y");
    let fit = fit.displace("a.top", "y", -5.5e-3);
    let scene = scene("strain", ["a.bottom", "b.top"], "geometry", fit).probe("force", "joint.resultant_n");
    let problem = scene.bind(vec![disc, block]).unwrap();
    let (states, _) = solve(&problem);
    let last = &states[states.len() - 1];
    let force = 2.0 * last.probes(&problem)[0].abs();
    let modulus = E / (2.0 * (1.0 - NU * NU));
    let b = (4.0 * force * radius / (PI * modulus)).sqrt();
    let highest = 2.0 * force / (PI * b);
    println!("b = {b}, p0 = {highest}");
    assert!((b / half - 1.0).abs() < 0.05, "eight edges over half the contact: {b}");
    for ([x, _], traction) in pressures(&problem, last) {
        let exact = -highest * (1.0 - (x / b).powi(2)).max(0.0).sqrt();
        if x < 1.2 * b {
            println!("{:.3} {:.4} {:.4}", x / b, traction / highest, (traction - exact) / highest);
        }
        if x <= b {
            close(traction, exact, 0.05, highest, &format!("pressure at {:.3} b", x / b));
        }
    }
}
