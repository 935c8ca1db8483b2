//! Claim: temperature and strains of a body's own strain it without stress where it is free, and stress it by −C ε* where it is
//! held, in plane stress and plane strain, with the energies that go with it.
//!
//! ```text
//! between walls, free sideways   σ_x = −E α ΔT (plane stress),  −E α ΔT/(1 − ν) (plane strain)
//! bimetal                        κ = 6 (α₂ − α₁) ΔT (1 + m)² / (h (3 (1 + m)² + (1 + m n) (m² + 1/(m n))))   Timoshenko 1925
//!                                m = h₁/h₂, n = E₁/E₂, h = h₁ + h₂; the strip bends towards the one that grows less
//! ```

use crate::common::*;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::shape::Shape;
use serde_json::json;

const E: f64 = 3e4;
const NU: f64 = 0.25;
const ALPHA: f64 = 1e-5;
const WARMER: f64 = 40.0;

/// The scene of a bar of 2 m × 0.4 m.
fn steel(plane: &str) -> Scene {
    Scene::new(plane).subdomain("bar", "steel").material("steel", E, NU).expansion("steel", ALPHA)
}

fn bar(shape: Shape) -> Vec<Mesh> {
    vec![even_block([0.0, 2.0], [0.0, 0.4], [5, 2], shape)]
}

/// Between walls.
fn held(plane: &str, warm: Step, fields: &str) -> Vec<ModelState> {
    let warm = warm.fix("bar.left", "x").fix("bar.right", "x").fix("bar.bottom", "y");
    let scene = steel(plane).with("thickness", 0.5).step(warm).with_in("output", "fields", fields);
    solve(&scene.bind(bar(Shape::Quadrilateral8)).unwrap()).0
}

#[test]
fn a_heated_bar_between_walls() {
    let own = ALPHA * WARMER;
    let warm = [
        (true, step("warm").temperature("bar", WARMER)),
        (false, step("warm").strain("bar", vec![own, own, own, 0.0])),
    ];
    for (by_temperature, warm) in warm {
        for (plane, exact, zz) in [
            ("stress", -E * ALPHA * WARMER, 0.0),
            ("strain", -E * ALPHA * WARMER / (1.0 - NU), -E * ALPHA * WARMER / (1.0 - NU)),
        ] {
            for (fields, increments) in [("every", 1), ("last", 8)] {
                let states = held(plane, warm.clone().increments(increments), fields);
                let last = states.last().unwrap();
                for s in last.snapshot.stresses[0].cells.iter().chain(&last.snapshot.stresses[0].nodes) {
                    for (got, exact) in s.iter().zip([exact, 0.0, zz, 0.0]) {
                        close(*got, exact, 1e-10, E * ALPHA * WARMER, &format!("{plane} stress"));
                    }
                }
                // ½ σ (−ε*) in the directions that are held, and nothing else works
                let held = if plane == "stress" { 1.0 } else { 2.0 };
                let stored = 0.5 * -exact * ALPHA * WARMER * held * (2.0 * 0.4 * 0.5);
                close(last.stored, stored, 1e-10, stored, "stored");
                close(last.work, stored, 1e-10, stored, "work of what warms it");
                assert!(last.energy_balance().abs() < 1e-10);
                let temperatures = &last.snapshot.stresses[0].temperatures;
                if by_temperature {
                    assert!(temperatures.as_ref().unwrap().iter().all(|t| *t == WARMER));
                }
                let strains = last.snapshot.stresses[0].strains.as_ref().unwrap();
                assert!(strains.iter().all(|e| (e[2] - ALPHA * WARMER).abs() < 1e-18));
            }
        }
    }
}

/// It cools again without a trace, and a free bar only grows.
#[test]
fn what_warms_may_cool_and_what_is_free_grows() {
    let warm = step("warm").increments(2).fix("bar.left", "x").fix("bar.bottom", "y");
    let scene = steel("strain")
        .step(warm.temperature("bar", "20*x"))
        .step(step("wait").increments(2))
        .step(step("cool").increments(3).temperature("bar", 0));
    let problem = scene.bind(bar(Shape::Quadrilateral8)).unwrap();
    let states = solve(&problem).0;
    let tip = |state: &ModelState| {
        let top = group(&problem, 0, "right");
        displacement(&problem, state, 0, top[0])[0]
    };
    assert!(tip(&states[1]) > 0.0);
    assert_eq!(tip(&states[1]), tip(&states[3]));
    let last = states.last().unwrap();
    assert!(last.snapshot.u.iter().all(|u| u.abs() < 1e-17), "it is back");
    for state in &states {
        assert!(state.energy_balance().abs() < 1e-11, "{}", state.energy_balance());
    }
    close(last.work, 0.0, 1e-11, states[1].work, "all work came back");
    close(last.stored, 0.0, 1e-11, states[1].stored, "nothing is stored");
}

#[test]
fn a_bimetal_bends_as_timoshenko_says() {
    let ([h1, h2], [e1, e2], [a1, a2], warmer) = ([0.6, 0.4], [2e5, 7e4], [1.2e-5, 2.3e-5], 50.0);
    let length = 30.0 * (h1 + h2);
    let warm = step("warm").fix("low.foot", "xy").fix("low.sill", "x");
    let scene = Scene::new("stress")
        .subdomain("low", "steel")
        .subdomain("high", "brass")
        .material("steel", e1, 0.0)
        .expansion("steel", a1)
        .material("brass", e2, 0.0)
        .expansion("brass", a2)
        .interface("bond", faces("low.top", "high.bottom").law(elastic(1e20, 1e20)))
        .step(warm.temperature("low", warmer).temperature("high", warmer));
    let strip =
        |n: usize, y: f64, h: f64| even_block([0.0, length], [y, y + h], [n, 2], Shape::Quadrilateral8);
    let mut low = strip(90, 0.0, h1);
    let near = |mesh: &midplane::mesh::Mesh, x: f64, y: f64| {
        let far = |p: &[f64; 3]| (p[0] - x).hypot(p[1] - y);
        let points = mesh.points.iter().enumerate();
        points.min_by(|a, b| far(a.1).total_cmp(&far(b.1))).unwrap().0
    };
    for (name, y) in [("foot", 0.0), ("sill", h1)] {
        let node = near(&low, 0.5 * length, y);
        low.groups.insert(name.into(), midplane::mesh::Group::Points(vec![node]));
    }
    let problem = scene.bind(vec![low, strip(120, h1, h2)]).unwrap();
    let states = solve(&problem).0;
    let last = states.last().unwrap();
    let (m, n) = (h1 / h2, e1 / e2);
    let fraction = 3.0 * (1.0 + m).powi(2) + (1.0 + m * n) * (m * m + 1.0 / (m * n));
    let exact = 6.0 * (a2 - a1) * warmer * (1.0 + m).powi(2) / ((h1 + h2) * fraction);
    // v = −κ x²/2 along the foot: three points of the middle third
    let mesh = &problem.model.subdomains[0].mesh;
    let v = |x: f64| displacement(&problem, last, 0, near(mesh, x, 0.0))[1];
    for half in [length / 30.0, length / 10.0, length / 6.0] {
        let [left, middle, right] = [-half, 0.0, half].map(|x| v(0.5 * length + x));
        close(-(left - 2.0 * middle + right) / (half * half), exact, 1e-10, exact, "curvature");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let refused = |scene: Scene, warm: Step| {
        let scene = scene.step(warm.fix("bar", "xy"));
        scene.bind(bar(Shape::Quadrilateral4)).unwrap_err().to_string()
    };
    let rigid = || Scene::new("stress").subdomain("bar", "steel").material("steel", E, NU);
    let warm = || step("warm");
    let message = refused(rigid(), warm().temperature("bar", 10));
    assert!(message.contains("steps.0.temperature.bar") && message.contains("expansion is 0"), "{message}");
    let message = refused(steel("stress"), warm().temperature("rod", 10));
    assert!(message.contains("no subdomain \"rod\""), "{message}");
    let message = refused(steel("stress"), warm().temperature("bar", "10*load_factor"));
    assert!(message.contains("load_factor") && message.contains("ramped"), "{message}");
    let message = refused(rigid(), warm().strain("bar", json!(["1/(x - x)", 0, 0, 0])));
    assert!(message.contains("steps.0.strain.bar.0"), "{message}");
}
