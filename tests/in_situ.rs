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

const E: f64 = 2e4;
const G: f64 = 9.81;
const WIDTH: f64 = 3.0;
/// Height and density of every layer, from below.
const LAYERS: [(f64, f64); 3] = [(1.0, 2.2), (1.5, 2.6), (0.7, 1.8)];
const TOP: f64 = 15.0;
const K0: f64 = 0.5;

const CRACKING: &str = r#""type": "cracking", "normal_stiffness": 1e7, "tangential_stiffness": 1e7, "tensile_strength": 300,
    "cohesion": 500, "tan_friction": 0.7, "fracture_energy_i": 10, "fracture_energy_iia": 100, "dilatancy_stress": 0"#;
const COULOMB: &str =
    r#""type": "coulomb", "normal_stiffness": 1e7, "tangential_stiffness": 1e6, "friction_coefficient": 0.6"#;
const ELASTIC: &str = r#""type": "elastic", "normal_stiffness": 1e7, "tangential_stiffness": 1e6"#;

/// Vertical pressure at the top of every layer.
fn overburdens() -> [f64; 3] {
    let above = |k: usize| LAYERS[k + 1..].iter().map(|(h, rho)| h * rho * G).sum::<f64>();
    [0, 1, 2].map(|k| TOP + above(k))
}

fn meshes() -> Vec<Mesh> {
    let mut y = 0.0;
    let shapes = [Shape::Quadrilateral8, Shape::Triangle3, Shape::Quadrilateral4];
    let layer = |((height, _), (n, shape)): ((f64, f64), (usize, Shape))| {
        let mesh = rectangle(&even(0.0, WIDTH, n), &even(y, y + height, 2), shape, |x, y| [x, y]);
        y += height;
        mesh
    };
    LAYERS.into_iter().zip([4, 7, 5].into_iter().zip(shapes)).map(layer).collect()
}

fn ground(laws: [&str; 2], overburdens: [f64; 3], initial: bool, steps: &str) -> Result<Problem> {
    let (mut subdomains, mut materials, mut y) = (Vec::new(), Vec::new(), 0.0);
    for (k, ((height, density), q)) in LAYERS.into_iter().zip(overburdens).enumerate() {
        y += height;
        let stress = format!(
            r#", "initial_stress": {{ "gravity": [0, -{G}], "surface": {y}, "overburden": {q}, "k0": {K0} }}"#
        );
        let stress = if initial { stress } else { String::new() };
        subdomains.push(format!(r#""l{k}": {{ "msh": "m{k}", "material": "m{k}"{stress} }}"#));
        materials.push(format!(r#""m{k}": {{ "young": {E}, "poisson": 0.3, "density": {density} }}"#));
    }
    let joint = |k: usize| {
        format!(
            r#""j{k}": {{ "side_a": "l{k}.top", "side_b": "l{}.bottom", "law": {{ {} }} }}"#,
            k + 1,
            laws[k]
        )
    };
    let text = format!(
        r#"{{ "plane": "strain", "subdomains": {{ {} }}, "materials": {{ {} }}, "interfaces": {{ {}, {} }}, "steps": [ {steps} ],
           "output": {{ "history": {{ "up": "l2.top.displacement_y" }} }} }}"#,
        subdomains.join(", "),
        materials.join(", "),
        joint(0),
        joint(1)
    );
    bind(&text, meshes())
}

fn weight(pressure: f64) -> String {
    format!(
        r#"{{ "name": "ground", "gravity": [0, -{G}], "load": {{ "l2.top": {{ "pressure": {pressure} }} }},
            "fix": {{ "l0.bottom": ["x", "y"], "l0.left": ["x"], "l0.right": ["x"], "l1.left": ["x"], "l1.right": ["x"],
                      "l2.left": ["x"], "l2.right": ["x"] }} }}"#
    )
}

/// Settlement of the top, were the weight put on.
fn settlement() -> f64 {
    let whole: f64 = LAYERS.iter().map(|(height, _)| height).sum();
    2.2 * G * whole * whole / (2.0 * E)
}

#[test]
fn layered_ground_stays_where_it_is() {
    for laws in [[CRACKING, COULOMB], [COULOMB, ELASTIC], [ELASTIC, ELASTIC]] {
        for increments in [1, 4] {
            let steps =
                weight(TOP).replace(r#""gravity""#, &format!(r#""increments": {increments}, "gravity""#));
            let problem = ground(laws, overburdens(), true, &steps).unwrap();
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
    let load = r#"{ "name": "built", "increments": 3, "load": { "l2.top": { "pressure": 40 } } }"#;
    let steps = format!("{}, {load}", weight(TOP));
    let with = solve(&ground([ELASTIC; 2], overburdens(), true, &steps).unwrap()).0;
    let without = solve(&ground([ELASTIC; 2], overburdens(), false, &steps).unwrap()).0;
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
    let problem = ground([CRACKING, COULOMB], overburdens(), true, &weight(0.0)).unwrap();
    let weight_of_all: f64 = LAYERS.iter().map(|(height, density)| height * density * G * WIDTH).sum();
    let share = format!("{:.3e} % of the weight", 100.0 * TOP * WIDTH / weight_of_all);
    assert!(
        told(&problem).iter().any(|text| text.starts_with("W25") && text.contains(&share)),
        "{:?}",
        told(&problem)
    );
    // a layer that knows nothing of what lies on it
    let [low, middle, top] = overburdens();
    let problem = ground([CRACKING, COULOMB], [low, middle - 5.0, top], true, &weight(TOP)).unwrap();
    let differ =
        |text: &String| text.contains("interface j1") && text.contains("sides differ by 5.000e0 at (");
    assert!(told(&problem).iter().any(differ), "{:?}", told(&problem));
}

/// A constant stress across a joint that slopes, held by tractions all around: the signs of both components.
#[test]
fn a_sloping_joint_carries_the_stress_of_the_ground() {
    let [xx, yy, xy] = [-1.0, -3.0, 0.4];
    let stress = format!(r#""initial_stress": {{ "xx": {xx}, "yy": "{yy} + 0*x", "zz": -2, "xy": {xy} }}"#);
    let text = format!(
        r#"{{ "plane": "strain",
          "subdomains": {{ "a": {{ "msh": "a", "material": "rock", {stress} }}, "b": {{ "msh": "b", "material": "rock", {stress} }} }},
          "materials": {{ "rock": {{ "young": 1e4, "poisson": 0.2 }} }},
          "interfaces": {{ "joint": {{ "side_a": "a.top", "side_b": "b.bottom", "law": {{ {CRACKING} }} }} }},
          "steps": [ {{ "name": "hold", "fix": {{ "a.bottom": ["x", "y"] }}, "load": {{
            "a.left": {{ "traction": [{}, {}] }}, "b.left": {{ "traction": [{}, {}] }},
            "a.right": {{ "traction": [{xx}, {xy}] }}, "b.right": {{ "traction": [{xx}, {xy}] }},
            "b.top": {{ "traction": [{xy}, {yy}] }} }} }} ] }}"#,
        -xx, -xy, -xx, -xy
    );
    let slope = |x: f64, y: f64| [x, y + 0.4 * x * (1.0 - (y - 1.0).abs())];
    let lower = rectangle(&even(0.0, 2.0, 4), &even(0.0, 1.0, 3), Shape::Quadrilateral4, slope);
    let upper = rectangle(&even(0.0, 2.0, 5), &even(1.0, 2.0, 3), Shape::Triangle3, slope);
    let problem = bind(&text, vec![lower, upper]).unwrap();
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
