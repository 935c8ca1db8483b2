//! Claim: two layers under a uniform pressure carry it uniformly and shorten as one column, whatever their meshes
//! (paper Example 1; the sizes and the pressure are not in its text and chosen here).
//!
//! ```text
//!        p p p p p
//!       ┌─┬──┬──┬─┐   n_b edges, height h₂
//!       ├─┴─┬┴──┴─┤   interface, K_N = K_T
//!       └───┴─────┘   n_a edges, height h₁
//!       △ △ △ △ △
//! ```
//!
//! σ_yy = −p everywhere, t_n = −p, t_t = 0. Plane strain: ε_y = −p(1 − ν²)/E, ε_x = p ν(1 + ν)/E;
//! u_top = −p (1 − ν²)/E (h₁ + h₂) − p/K_N.

use crate::common::table::Table;
use crate::common::*;
use midplane::shape::Shape;

const P: f64 = 10.0;
const E: f64 = 1e4;
const SHAPES: [Shape; 4] = [Shape::Triangle3, Shape::Quadrilateral4, Shape::Triangle6, Shape::Quadrilateral8];
const PAIRS: [(usize, usize); 4] = [(5, 8), (7, 12), (1, 37), (9, 9)];

struct Case {
    shape: Shape,
    coupling: &'static str,
    quadrature: &'static str,
    pair: (usize, usize),
    degrees: f64,
    swapped: bool,
}

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for shape in SHAPES {
        for (coupling, quadrature) in
            [("projected", "gauss"), ("pointwise", "gauss"), ("pointwise", "lobatto")]
        {
            for pair in PAIRS {
                for (degrees, swapped) in [(0.0, false), (30.0, false), (0.0, true), (30.0, true)] {
                    cases.push(Case { shape, coupling, quadrature, pair, degrees, swapped });
                }
            }
        }
    }
    cases
}

/// With ν = 0 the layers do not spread, so that the bottom may be held in both directions at any angle.
#[test]
fn paper_example_1_is_uniform_to_round_off() {
    let mut table = Table::new(
        "case01",
        "Case 1: uniform compression (paper Example 1)",
        "Largest relative error over the meshes 5:8, 7:12, 1:37, 9:9, straight and turned by 30°, A and B exchanged or not.",
        &["element", "coupling", "quadrature", "t_n, t_t", "stress", "u_top"],
    );
    let mut worst: indexmap::IndexMap<[&str; 3], [f64; 3]> = indexmap::IndexMap::new();
    let (h1, h2, w, kn) = (0.1, 0.1, 0.2, 1e7);
    let u_top = -P * (h1 + h2) / E - P / kn;
    assert!((u_top - -0.000201_f64).abs() < 1e-18); // the listed value of the case
    for case in cases() {
        let Case { shape, coupling, quadrature, pair, degrees, swapped } = case;
        let name = format!("{} {coupling} {quadrature} {pair:?} {degrees}° swapped {swapped}", shape.label());
        let place = rotation(degrees);
        let lower = rectangle(&even(0.0, w, pair.0), &even(0.0, h1, 3), shape, place);
        let upper = rectangle(&even(0.0, w, pair.1), &even(h1, h1 + h2, 4), shape, place);
        let (a, b) = if swapped { ("upper.bottom", "lower.top") } else { ("lower.top", "upper.bottom") };
        let scene = Scene::new("strain")
            .subdomains(["lower", "upper"], "rock")
            .material("rock", E, 0.0)
            .interface(
                "joint",
                faces(a, b).coupling(coupling).with("quadrature", quadrature).law(elastic(kn, kn)),
            )
            .step(step("compression").fix("lower.bottom", "xy").pressure("upper.top", P));
        let problem = scene.bind(vec![lower, upper]).unwrap();
        let (states, _) = solve(&problem);
        let state = &states[0];
        let errors = worst.entry([shape.label(), coupling, quadrature]).or_default();
        for (t, r) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
            close(t[0], -P, 1e-10, P, &name);
            close(t[1], 0.0, 1e-10, P, &name);
            errors[0] = errors[0].max((t[0] / -P - 1.0).abs()).max(t[1].abs() / P);
            close(r[0], -P / kn, 1e-10, P / kn, &name);
        }
        // in the axes of the column: σ = −p n ⊗ n
        let [nx, ny] = rotation(degrees)(0.0, 1.0);
        let exact = [-P * nx * nx, -P * ny * ny, 0.0, -P * nx * ny];
        for stresses in &state.snapshot.stresses {
            for stress in stresses.cells.iter().chain(&stresses.nodes) {
                for k in 0..4 {
                    close(stress[k], exact[k], 1e-10, P, &name);
                    errors[1] = errors[1].max((stress[k] - exact[k]).abs() / P);
                }
            }
        }
        for node in group(&problem, 1, "top") {
            let u = displacement(&problem, state, 1, node);
            close(u[0], u_top * nx, 1e-10, u_top, &name);
            close(u[1], u_top * ny, 1e-10, u_top, &name);
            errors[2] = errors[2].max((u[0] - u_top * nx).hypot(u[1] - u_top * ny) / u_top.abs());
        }
        let energy = 0.5 * P * w * -u_top; // bulk 2e-4 and interface 1e-6
        close(state.stored, energy, 1e-9, energy, &name);
        close(state.work, energy, 1e-9, energy, &name);
    }
    for (case, errors) in worst {
        table.row(
            &case.map(String::from).into_iter().chain(errors.map(|e| format!("{e:.1e}"))).collect::<Vec<_>>(),
        );
    }
    table.finish();
}

/// ν = 0.25, soft interface, rollers: the layers spread alike, so K_T plays no role (case "soft").
#[test]
fn layers_that_spread_alike_slide_nowhere() {
    let (h1, h2, w, nu, kn, kt) = (0.1, 0.06, 0.2, 0.25, 2.5e5, 1e5);
    for (plane, e_y, e_x) in
        [("strain", -P * (1.0 - nu * nu) / E, P * nu * (1.0 + nu) / E), ("stress", -P / E, P * nu / E)]
    {
        for shape in SHAPES {
            for pair in PAIRS {
                let lower = even_block([0.0, w], [0.0, h1], [pair.0, 3], shape);
                let upper = even_block([0.0, w], [h1, h1 + h2], [pair.1, 2], shape);
                let compression = step("compression").fix("lower.bottom", "y").fix("lower.corner", "x");
                let scene = Scene::new(plane)
                    .with("thickness", 0.5)
                    .subdomains(["lower", "upper"], "rock")
                    .material("rock", E, nu)
                    .interface("joint", faces("lower.top", "upper.bottom").law(elastic(kn, kt)))
                    .step(compression.traction("upper.top", 0.0, -P))
                    .probes([
                        ("t", "joint.traction_n@0.3"),
                        ("r", "joint.jump_n@1"),
                        ("f", "joint.resultant_n"),
                        ("top", "upper.top.displacement_y"),
                        ("right", "upper.right.displacement_x"),
                        ("stored", "energy.stored"),
                        ("dissipated", "energy.dissipated"),
                        ("work", "work.external"),
                    ]);
                let problem = scene.bind(vec![lower, upper]).unwrap();
                let (states, totals) = solve(&problem);
                let name = format!("{plane} {} {pair:?}", shape.label());
                let u_top = e_y * (h1 + h2) - P / kn;
                let energy = 0.5 * 0.5 * P * w * -u_top;
                let probes = states[0].probes(&problem);
                let exact =
                    [-P, -P / kn, -P * w * 0.5, u_top, e_x * w, energy, 0.0, energy, P * w * 0.5, 0.0];
                for (i, (got, exact)) in probes.iter().zip(exact).enumerate() {
                    let scale = if exact == 0.0 { P } else { exact };
                    close(*got, exact, 1e-10, scale, &format!("{name}, probe {i}"));
                }
                for stress in &states[0].snapshot.stresses[1].cells {
                    let zz = if plane == "strain" { -P * nu } else { 0.0 };
                    close(stress[2], zz, 1e-10, P, &name);
                }
                assert_eq!((totals.factorisations, totals.increments), (1, 1));
                assert!(totals.residual < 1e-14);
            }
        }
    }
    // the listed values of the case
    assert!((-P * (1.0 - nu * nu) / E * (h1 + h2) - P / kn - -0.00019_f64).abs() < 1e-18);
    assert!((P * nu * (1.0 + nu) / E * w - 6.25e-5_f64).abs() < 1e-18);
}
