//! Claim: parts come free of stress where their neighbours are, and go with their forces let go over a step.
//!
//! ```text
//!     ↓ p  ┌───────┐      weight γ of both, ν = 0, E, joint K: blocks of height H = 1
//!          │   b   │      b comes later:  joint  σ = −γ_b H,  a  u(H) = −γ_a H²/2E − γ_b H²/E
//!          ├───────┤                       b  u(2H) = Δu_a − γ_b H/K − γ_b H²/2E from where it came
//!          │   a   │      b goes by half:  a keeps half of what lay on it
//!          └───────┘
//! ```

use crate::common::*;
use midplane::error::Result;
use midplane::history::ModelState;
use midplane::problem::Problem;
use midplane::shape::Shape;

const E: f64 = 1e4;
const K: f64 = 5e4;
const GAMMA: [f64; 2] = [20.0, 24.0];

const ELASTIC: &str = r#""type": "elastic", "normal_stiffness": 5e4, "tangential_stiffness": 5e4"#;
const COULOMB: &str =
    r#""type": "coulomb", "normal_stiffness": 5e4, "tangential_stiffness": 5e4, "friction_coefficient": 0.6"#;
const CRACKING: &str = r#""type": "cracking", "normal_stiffness": 5e4, "tangential_stiffness": 5e4, "tensile_strength": 300,
    "cohesion": 500, "tan_friction": 0.7, "fracture_energy_i": 100, "fracture_energy_iia": 1000, "dilatancy_stress": 0"#;

fn stack(law: &str, strategy: &str, steps: &str) -> Result<Problem> {
    let text = format!(
        r#"{{ "plane": "stress",
          "subdomains": {{ "a": {{ "msh": "a", "material": "a" }}, "b": {{ "msh": "b", "material": "b" }} }},
          "materials": {{ "a": {{ "young": {E}, "poisson": 0, "density": {} }}, "b": {{ "young": {E}, "poisson": 0, "density": {} }} }},
          "interfaces": {{ "joint": {{ "side_a": "a.top", "side_b": "b.bottom", "law": {{ {law} }} }} }},
          "solution": {{ "strategy": "{strategy}" }},
          "steps": [ {steps} ] }}"#,
        GAMMA[0], GAMMA[1]
    );
    let block = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 1.0, 2), Shape::Quadrilateral8, |x, y| [x, y])
    };
    bind(&text, vec![block(3, 0.0), block(4, 1.0)])
}

const WEIGHT: &str = r#"{ "name": "ground", "gravity": [0, -1], "fix": { "a.bottom": ["x", "y"] } }"#;

fn top(problem: &Problem, state: &ModelState, subdomain: usize) -> f64 {
    displacement(problem, state, subdomain, group(problem, subdomain, "top")[0])[1]
}

#[test]
fn a_lift_comes_where_its_neighbours_are() {
    let come = r#"{ "name": "lift", "increments": 3, "activate": ["b"] }"#;
    for law in [ELASTIC, COULOMB, CRACKING] {
        for strategy in ["auto", "condensed", "blocks", "plain"] {
            let problem = stack(law, strategy, &[WEIGHT, come].join(", ")).unwrap();
            let (states, _) = solve(&problem);
            let alone = -GAMMA[0] / (2.0 * E);
            let scale = GAMMA[1] / E;
            close(top(&problem, &states[0], 0), alone, 1e-11, scale, "a alone");
            close(top(&problem, &states[0], 1), 0.0, 1e-16, scale, "b is not there");
            assert!(states[0].snapshot.presence.absent[0] && !states[1].snapshot.presence.absent[0]);
            assert!(states[0].snapshot.tractions[0].iter().all(|t| t.norm() == 0.0));
            for (k, state) in states[1..].iter().enumerate() {
                let share = (k + 1) as f64 / 3.0;
                let below = -share * GAMMA[1] / E;
                close(
                    top(&problem, state, 0),
                    alone + below,
                    1e-10,
                    scale,
                    &format!("{law} {strategy}: a under b"),
                );
                let above = below - share * GAMMA[1] * (1.0 / K + 1.0 / (2.0 * E));
                close(top(&problem, state, 1), above, 1e-10, scale, "b since it came");
                for (t, r) in state.snapshot.tractions[0].iter().zip(&state.snapshot.jumps[0]) {
                    close(t[0], -share * GAMMA[1], 1e-10, GAMMA[1], "t_n");
                    close(r[0], -share * GAMMA[1] / K, 1e-10, GAMMA[1] / K, "jump since it came");
                }
                assert!(state.energy_balance().abs() < 1e-10, "{}", state.energy_balance());
            }
        }
    }
}

/// Forces of b on a go by half, wait, and go wholly; the energy stored in b goes with it.
#[test]
fn forces_are_held_and_let_go() {
    let load = r#"{ "name": "load", "load": { "b.top": { "pressure": 30 } } }"#;
    held_and_let_go(load);
}

/// Water between the two carries a part of what lies on it: the whole is the same.
#[test]
fn forces_of_water_are_held_and_let_go() {
    for pressure in ["7", "\"7 + 100*opening\""] {
        let water = format!(r#""joint": {{ "pressure": {pressure} }}"#);
        held_and_let_go(&format!(
            r#"{{ "name": "load", "load": {{ "b.top": {{ "pressure": 30 }}, {water} }} }}"#
        ));
    }
}

fn held_and_let_go(load: &str) {
    let half = r#"{ "name": "half", "increments": 2, "deactivate": { "b": 0.5 } }"#;
    let wait = r#"{ "name": "wait" }"#;
    let rest = r#"{ "name": "rest", "increments": 2, "deactivate": { "*b": 1.0 } }"#;
    for law in [ELASTIC, COULOMB] {
        for strategy in ["auto", "plain", "blocks"] {
            let problem = stack(law, strategy, &[WEIGHT, load, half, wait, rest].join(", ")).unwrap();
            let (states, _) = solve(&problem);
            let on = 30.0 + GAMMA[1];
            let own = -GAMMA[0] / (2.0 * E);
            let left = [GAMMA[1], on, 0.75 * on, 0.5 * on, 0.5 * on, 0.25 * on, 0.0];
            for (k, (state, left)) in states.iter().zip(left).enumerate() {
                close(
                    top(&problem, state, 0),
                    own - left / E,
                    1e-10,
                    on / E,
                    &format!("{law} {strategy}: a, row {k}"),
                );
                assert!(state.energy_balance().abs() < 1e-9, "row {k}: {}", state.energy_balance());
            }
            let last = states.last().unwrap();
            assert!(top(&problem, last, 1).abs() < 1e-30);
            assert!(last.snapshot.stresses[1].cells.iter().flatten().all(|s| s.abs() < 1e-30));
            // a alone stores γ²/6E, whatever was there between
            close(last.stored, GAMMA[0] * GAMMA[0] / (6.0 * E), 1e-9, 0.01, "stored");
        }
    }
}

/// What joined a part that has slid is forgotten with it: the joint is as at the start while the part is away.
#[test]
fn a_part_that_goes_takes_its_slip_along() {
    let load = r#"{ "name": "load", "load": { "b.top": { "pressure": 30 } } }"#;
    let slide = r#"{ "name": "slide", "displace": { "b.top": { "x": 0.05 } } }"#;
    let away = r#"{ "name": "away", "deactivate": { "b": 1.0 } }"#;
    let problem = stack(COULOMB, "auto", &[WEIGHT, load, slide, away].join(", ")).unwrap();
    let (states, _) = solve(&problem);
    let slip = |state: &ModelState| {
        state.snapshot.states[0].iter().map(|state| state.jump_plastic.norm()).fold(0.0, f64::max)
    };
    assert!(slip(&states[2]) > 1e-6, "{}", slip(&states[2]));
    assert_eq!(slip(&states[3]), 0.0);
    assert!(states[3].snapshot.jumps[0].iter().all(|jump| jump.norm() == 0.0));
}

/// Taken away and filled again without stress, twice: the same every time.
#[test]
fn taking_away_and_filling_again_repeats() {
    let away = |n: usize| format!(r#"{{ "name": "away {n}", "deactivate": {{ "b": 1.0 }} }}"#);
    let fill = |n: usize| format!(r#"{{ "name": "fill {n}", "activate": ["b"] }}"#);
    let steps = [WEIGHT.to_string(), away(1), fill(1), away(2), fill(2)].join(", ");
    for law in [ELASTIC, COULOMB, CRACKING] {
        let problem = stack(law, "auto", &steps).unwrap();
        let (states, _) = solve(&problem);
        for (one, two) in [(1, 3), (2, 4)] {
            let scale = GAMMA[1] / E;
            for (a, b) in states[one].snapshot.u.iter().zip(&states[two].snapshot.u) {
                close(*a, *b, 1e-10, scale, law);
            }
            for (a, b) in states[one].snapshot.tractions[0].iter().zip(&states[two].snapshot.tractions[0]) {
                close((a - b).norm(), 0.0, 1e-10, GAMMA[1], law);
            }
        }
    }
}

/// A part under initial stress goes: its neighbours lose what it carried, and what comes in its place carries nothing from before.
#[test]
fn ground_is_dug_and_filled() {
    let stress = |top: f64, gamma: f64, q: f64| {
        format!(
            r#", "initial_stress": {{ "gravity": [0, -1], "surface": {top}, "overburden": {q}, "k0": 0 }}"#
        )
        .replace("GAMMA", &gamma.to_string())
    };
    let text = format!(
        r#"{{ "plane": "stress",
          "subdomains": {{ "a": {{ "msh": "a", "material": "a" {} }}, "b": {{ "msh": "b", "material": "b" {} }} }},
          "materials": {{ "a": {{ "young": {E}, "poisson": 0, "density": {} }}, "b": {{ "young": {E}, "poisson": 0, "density": {} }} }},
          "interfaces": {{ "joint": {{ "side_a": "a.top", "side_b": "b.bottom", "law": {{ {COULOMB} }} }} }},
          "steps": [ {WEIGHT}, {{ "name": "dig", "increments": 2, "deactivate": {{ "b": 1 }} }}, {{ "name": "fill", "activate": ["b"] }} ] }}"#,
        stress(1.0, GAMMA[0], GAMMA[1]),
        stress(2.0, GAMMA[1], 0.0),
        GAMMA[0],
        GAMMA[1]
    );
    let block = |n: usize, y: f64| {
        rectangle(&even(0.0, 1.0, n), &even(y, y + 1.0, 2), Shape::Quadrilateral8, |x, y| [x, y])
    };
    let problem = bind(&text, vec![block(3, 0.0), block(4, 1.0)]).unwrap();
    assert!(problem.warnings.is_empty(), "{:?}", problem.warnings);
    let (states, _) = solve(&problem);
    let scale = GAMMA[1] / E;
    for (state, heave) in states.iter().zip([0.0, 0.5, 1.0, 0.0]) {
        close(top(&problem, state, 0), heave * scale, 1e-10, scale, "heave");
    }
    let last = states.last().unwrap();
    close(top(&problem, last, 1), -scale * (1.0 + E / K + 0.5), 1e-10, scale, "what was filled settles");
    for s in &last.snapshot.stresses[1].nodes {
        assert!(s[1] <= 1e-9 && s[1] >= -GAMMA[1] - 1e-9, "{s:?}");
    }
}

/// Strains of a part count from when it comes: those before leave no stress, later ones move its free top by Δε H.
#[test]
fn strains_of_a_part_count_from_when_it_comes() {
    let steps = r#"{ "name": "before", "fix": { "a.bottom": ["x", "y"] }, "strain": { "b": [0, 3e-4, 0, 0] } },
        { "name": "come", "activate": ["b"] }, { "name": "after", "strain": { "b": [0, 5e-4, 0, 0] } }"#;
    for law in [ELASTIC, CRACKING] {
        let problem = stack(law, "auto", steps).unwrap();
        let (states, _) = solve(&problem);
        for (state, exact) in states.iter().zip([0.0, 0.0, 2e-4]) {
            close(top(&problem, state, 1), exact, 1e-12, 1e-4, "free top");
            let stresses = state.snapshot.stresses[1].cells.iter().flatten();
            assert!(stresses.into_iter().all(|s| s.abs() < 1e-10), "no stress");
        }
    }
}

#[test]
fn what_cannot_come_or_go_is_refused() {
    let refused = |steps: &str| stack(ELASTIC, "auto", &[WEIGHT, steps].join(", ")).unwrap_err().to_string();
    let message = refused(r#"{ "name": "s", "activate": ["c*"] }"#);
    assert!(message.contains("no subdomain is called like \"c*\""), "{message}");
    let message =
        refused(r#"{ "name": "s", "deactivate": { "b": 1 } }, { "name": "t", "deactivate": { "b": 1 } }"#);
    assert!(message.contains("steps.2.deactivate.b") && message.contains("is not there"), "{message}");
    let message = refused(r#"{ "name": "s", "deactivate": { "b": 1.5 } }"#);
    assert!(message.contains("1.5 is no share"), "{message}");
    let message = refused(r#"{ "name": "s", "activate": ["b"] }, { "name": "t", "activate": ["b"] }"#);
    assert!(message.contains("is there already"), "{message}");
    let message =
        refused(r#"{ "name": "s", "deactivate": { "b": 0.5 } }, { "name": "t", "activate": ["b"] }"#);
    assert!(message.contains("is not wholly let go"), "{message}");
    let message =
        refused(r#"{ "name": "s", "deactivate": { "b": 1 }, "load": { "b.top": { "pressure": 1 } } }"#);
    assert!(
        message.contains("steps.1.load.b.top") && message.contains("is not there in this step"),
        "{message}"
    );
}
