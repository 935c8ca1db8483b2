//! Claim: initial stress loads nothing by itself. Ground under its weight stays where it is, joints carry what the ground does,
//! what is built then moves it as if nothing had been there, and what is out of balance is told.
//!
//! ```text
//!     q ↓↓↓↓↓↓↓        σ_v = −q − γ (y₀ − y) layer by layer,  σ_h = σ_zz = K₀ σ_v
//!     ═ layer 3 ═      every layer has its own density, mesh and joint
//!     ═ layer 2 ═      free settlement, were the weight put on:  γ H²/2E
//!     ═ layer 1 ═
//! ```

use crate::common::*;
use midplane::error::{Code, Result};
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;
use serde_json::json;

const E: f64 = 2e4;
const G: f64 = 9.81;
const WIDTH: f64 = 3.0;
/// Height and density of every layer, from below.
const LAYERS: [(f64, f64); 3] = [(1.0, 2.2), (1.5, 2.6), (0.7, 1.8)];
const TOP: f64 = 15.0;
const K0: f64 = 0.5;

fn rock() -> Law {
    cracking(1e7, 1e7, [300.0, 500.0, 0.7], [10.0, 100.0])
}

fn friction() -> Law {
    coulomb(1e7, 1e6, 0.6)
}

fn springs() -> Law {
    elastic(1e7, 1e6)
}

/// Vertical pressure at the top of every layer.
fn overburdens() -> [f64; 3] {
    let above = |k: usize| LAYERS[k + 1..].iter().map(|(h, rho)| h * rho * G).sum::<f64>();
    [0, 1, 2].map(|k| TOP + above(k))
}

fn meshes() -> Vec<Mesh> {
    let mut y = 0.0;
    let shapes = [Shape::Quadrilateral8, Shape::Triangle3, Shape::Quadrilateral4];
    let layer = |((height, _), (n, shape)): ((f64, f64), (usize, Shape))| {
        let mesh = even_block([0.0, WIDTH], [y, y + height], [n, 2], shape);
        y += height;
        mesh
    };
    LAYERS.into_iter().zip([4, 7, 5].into_iter().zip(shapes)).map(layer).collect()
}

fn ground(
    laws: [Law; 2],
    overburdens: [f64; 3],
    initial: bool,
    steps: impl IntoIterator<Item = Step>,
) -> Result<Problem> {
    let (mut scene, mut y) = (Scene::new("strain"), 0.0);
    for (k, ((height, density), q)) in LAYERS.into_iter().zip(overburdens).enumerate() {
        y += height;
        let (layer, rock) = (format!("l{k}"), format!("m{k}"));
        let stress = json!({ "gravity": [0, -G], "surface": y, "overburden": q, "k0": K0 });
        let body = mesh(&rock, &rock);
        let body = if initial { body.with("initial_stress", stress) } else { body };
        scene = scene.body(&layer, body).material(&rock, E, 0.3).density(&rock, density);
    }
    for (k, law) in laws.into_iter().enumerate() {
        let faces = faces(format!("l{k}.top"), format!("l{}.bottom", k + 1));
        scene = scene.interface(&format!("j{k}"), faces.law(law));
    }
    scene.steps(steps).probe("up", "l2.top.displacement_y").bind(meshes())
}

/// The weight and a pressure on top, between walls.
fn weight(pressure: f64) -> Step {
    let held = step("ground").fix("l0.bottom", "xy").gravity(0, -G).pressure("l2.top", pressure);
    let walls = ["l0.left", "l0.right", "l1.left", "l1.right", "l2.left", "l2.right"];
    walls.into_iter().fold(held, |step, wall| step.fix(wall, "x"))
}

/// Settlement of the top, were the weight put on.
fn settlement() -> f64 {
    let whole: f64 = LAYERS.iter().map(|(height, _)| height).sum();
    2.2 * G * whole * whole / (2.0 * E)
}

#[test]
fn layered_ground_stays_where_it_is() {
    for laws in [[rock(), friction()], [friction(), springs()], [springs(), springs()]] {
        for increments in [1, 4] {
            let weight = weight(TOP).increments(increments);
            let problem = ground(laws.clone(), overburdens(), true, [weight]).unwrap();
            assert!(problem.warnings.is_empty(), "{:?}", problem.warnings);
            let (states, _) = solve(&problem);
            let mut y = 0.0;
            let last = states.last().unwrap();
            let most = last.snapshot.u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
            assert!(most <= 1e-12 * settlement(), "{most:e} of {:e}", settlement());
            for (b, ((height, density), q)) in LAYERS.into_iter().zip(overburdens()).enumerate() {
                y += height;
                let mesh = &problem.model.subdomains[b].mesh;
                for (x, s) in mesh.points.iter().zip(&last.snapshot.stresses[b].nodes) {
                    let vertical = -q - density * G * (y - x[1]);
                    // constant in every T3: smoothed at nodes
                    let tolerance = if b == 1 { 0.2 } else { 1e-12 };
                    for (got, exact) in s.iter().zip([K0 * vertical, vertical, K0 * vertical, 0.0]) {
                        close(*got, exact, tolerance, 100.0, &format!("stress of layer {b} at {x:?}"));
                    }
                }
            }
            for k in 0..2 {
                for t in &last.snapshot.tractions[k] {
                    close(t[0], -overburdens()[k], 1e-12, 100.0, "t_n");
                    close(t[1], 0.0, 1e-12, 100.0, "t_t");
                }
            }
            let energy = 1e-10 * TOP * settlement() * WIDTH;
            assert!([last.work, last.stored, last.dissipated].iter().all(|e| e.abs() <= energy));
        }
    }
}

/// In a linear scene what comes later moves everything as if nothing had been there before.
#[test]
fn what_is_built_then_moves_it_as_ever() {
    let moved = |initial: bool| {
        let steps = [weight(TOP), step("built").increments(3).pressure("l2.top", 40)];
        solve(&ground([springs(), springs()], overburdens(), initial, steps).unwrap()).0
    };
    let (with, without) = (moved(true), moved(false));
    let (before, after) = (&without[0].snapshot.u, &without.last().unwrap().snapshot.u);
    for (u, (after, before)) in with.last().unwrap().snapshot.u.iter().zip(after.iter().zip(before)) {
        close(*u, after - before, 1e-11, settlement(), "displacement since the ground");
    }
    let last = with.last().unwrap();
    assert!(last.energy_balance().abs() < 1e-11, "{}", last.energy_balance());
    // ½ (2 p₀ + Δp) Δu of the pressure and γ u of the weight
    assert!(last.work > 0.0 && last.stored > 0.0);
}

#[test]
fn what_does_not_fit_is_told() {
    let told = |problem: &Problem| problem.warnings.iter().map(ToString::to_string).collect::<Vec<_>>();
    // without the pressure on top: q L of the weight
    let problem = ground([rock(), friction()], overburdens(), true, [weight(0.0)]).unwrap();
    let weight_of_all: f64 = LAYERS.iter().map(|(height, density)| height * density * G * WIDTH).sum();
    let share = format!("{:.3e} % of the weight", 100.0 * TOP * WIDTH / weight_of_all);
    assert!(
        told(&problem).iter().any(|text| text.starts_with("W25") && text.contains(&share)),
        "{:?}",
        told(&problem)
    );
    // a layer that knows nothing of what lies on it
    let [low, middle, top] = overburdens();
    let off = [low, middle - 5.0, top];
    let problem = ground([rock(), friction()], off, true, [weight(TOP)]).unwrap();
    let differ =
        |text: &String| text.contains("interface j1") && text.contains("sides differ by 5.000e0 at (");
    assert!(told(&problem).iter().any(differ), "{:?}", told(&problem));
}

/// A constant stress across a joint that slopes, held by tractions all around: the signs of both components.
#[test]
fn a_sloping_joint_carries_the_stress_of_the_ground() {
    let [xx, yy, xy] = [-1.0, -3.0, 0.4];
    let stress = json!({ "xx": xx, "yy": format!("{yy} + 0*x"), "zz": -2, "xy": xy });
    let body = |name: &str| mesh(name, "rock").with("initial_stress", stress.clone());
    let hold = step("hold")
        .fix("a.bottom", "xy")
        .traction("a.left", -xx, -xy)
        .traction("b.left", -xx, -xy)
        .traction("a.right", xx, xy)
        .traction("b.right", xx, xy)
        .traction("b.top", xy, yy);
    let scene = Scene::new("strain")
        .body("a", body("a"))
        .body("b", body("b"))
        .material("rock", 1e4, 0.2)
        .interface("joint", faces("a.top", "b.bottom").law(rock()))
        .step(hold);
    let slope = |x: f64, y: f64| [x, y + 0.4 * x * (1.0 - (y - 1.0).abs())];
    let lower = rectangle(&even(0.0, 2.0, 4), &even(0.0, 1.0, 3), Shape::Quadrilateral4, slope);
    let upper = rectangle(&even(0.0, 2.0, 5), &even(1.0, 2.0, 3), Shape::Triangle3, slope);
    let problem = scene.bind(vec![lower, upper]).unwrap();
    assert!(
        problem
            .warnings
            .iter()
            .all(|warning| ![Code::InitialStress, Code::NotAtRest].contains(&warning.code))
    );
    let (states, _) = solve(&problem);
    let last = states.last().unwrap();
    assert!(last.snapshot.u.iter().all(|u| u.abs() < 1e-14), "it moves");
    let (c, s) = (1.0 / 0.4_f64.hypot(1.0), 0.4 / 0.4_f64.hypot(1.0));
    let (n, t) = ([-s, c], [c, s]);
    let on = [xx * n[0] + xy * n[1], xy * n[0] + yy * n[1]];
    for traction in &last.snapshot.tractions[0] {
        close(traction[0], on[0] * n[0] + on[1] * n[1], 1e-12, 3.0, "t_n");
        close(traction[1].abs(), (on[0] * t[0] + on[1] * t[1]).abs(), 1e-12, 3.0, "|t_t|");
    }
    for s in last.snapshot.stresses.iter().flat_map(|of| &of.cells) {
        for (got, exact) in s.iter().zip([xx, yy, -2.0, xy]) {
            close(*got, exact, 1e-12, 3.0, "stress");
        }
    }
}
